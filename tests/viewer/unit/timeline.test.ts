import assert from 'node:assert/strict';
import test from 'node:test';
import { Timeline } from '../../../viewer/src/time/timeline';

test('time stays within the run and is told only when it changes', () => {
  const timeline = new Timeline(1, 5);
  let told = 0;
  timeline.onTime(() => told++);
  timeline.setTime(9);
  assert.equal(timeline.time, 5);
  timeline.setTime(7);
  assert.equal(told, 1);
  timeline.setTime(-3);
  assert.equal(timeline.time, 1);
});

test('zooming keeps the centre where it is, as long as the run has room', () => {
  const timeline = new Timeline(0, 10);
  const centre = 4;
  timeline.zoomAbout(centre, 0.5);
  const { start, end } = timeline.window;
  assert.ok(Math.abs(end - start - 5) < 1e-12);
  assert.ok(Math.abs((centre - start) / (end - start) - 0.4) < 1e-12);
  timeline.zoomAbout(centre, 2);
  assert.ok(!timeline.zoomed);
});

test('a window is moved into the run and never vanishes', () => {
  const timeline = new Timeline(0, 10);
  timeline.setWindow(8, 12);
  assert.deepEqual(timeline.window, { start: 6, end: 10 });
  timeline.setWindow(3, 3);
  assert.ok(timeline.window.end > timeline.window.start);
  timeline.setWindow(-5, 50);
  assert.deepEqual(timeline.window, { start: 0, end: 10 });
});

// A browser's frames, one every `period` milliseconds.
function frames(period: number) {
  let wall = 1000;
  let next: FrameRequestCallback | null = null;
  globalThis.requestAnimationFrame = (callback) => {
    next = callback;
    return 1;
  };
  Object.defineProperty(globalThis, 'performance', { value: { now: () => wall }, configurable: true });
  return () => {
    wall += period;
    const callback = next;
    next = null;
    callback?.(wall);
    return callback !== null;
  };
}

test('playing runs at the chosen speed whatever the frame rate, and stops at the end', () => {
  for (const period of [5, 16, 100]) {
    const frame = frames(period);
    const timeline = new Timeline(0, 3);
    timeline.setSpeed(2);
    timeline.play();
    for (let wall = 0; wall < 1000; wall += period) frame();
    assert.ok(Math.abs(timeline.time - 2) < 2e-3 * period + 1e-9, `${period}: ${timeline.time}`);
    while (frame());
    assert.equal(timeline.time, 3);
    assert.ok(!timeline.playing);
    timeline.play();
    assert.equal(timeline.time, 0);
    timeline.pause();
  }
});

test('while playing, a zoomed window follows the time', () => {
  const frame = frames(50);
  const timeline = new Timeline(0, 10);
  timeline.setWindow(0, 1);
  timeline.play();
  for (let i = 0; i < 60; i++) {
    frame();
    const { start, end } = timeline.window;
    assert.ok(timeline.time >= start && timeline.time <= end);
    assert.ok(Math.abs(end - start - 1) < 1e-9);
  }
  timeline.pause();
});
