import assert from 'node:assert/strict';
import test from 'node:test';
import { bracket, indexAtOrBefore, interpolated, nearestIndex } from '../../../viewer/src/data/lookup';

const times = Float64Array.of(0, 1, 2.5, 3);

test('indexAtOrBefore agrees with a linear search, and holds at the ends', () => {
  for (let t = -1; t < 5; t += 0.0625) {
    let expected = 0;
    times.forEach((value, i) => {
      if (value <= t) expected = i;
    });
    assert.equal(indexAtOrBefore(times, t), expected, `t = ${t}`);
  }
});

test('nearestIndex agrees with the smallest distance', () => {
  for (let t = -1; t < 5; t += 0.0625) {
    const distance = Array.from(times, (value) => Math.abs(value - t));
    assert.equal(distance[nearestIndex(times, t)], Math.min(...distance), `t = ${t}`);
  }
});

test('interpolation is exact for a linear function, row by row', () => {
  const rows = Float64Array.from([...times].flatMap((t) => [2 * t + 1, -t]));
  for (let t = 0; t <= 3; t += 0.03125) {
    const at = bracket(times, t);
    assert.ok(Math.abs(interpolated(rows, 2, 0, at) - (2 * t + 1)) < 1e-12);
    assert.ok(Math.abs(interpolated(rows, 2, 1, at) + t) < 1e-12);
  }
});

test('outside of the recording the ends are held', () => {
  assert.deepEqual(bracket(times, -3), { index: 0, fraction: 0 });
  assert.deepEqual(bracket(times, 9), { index: 3, fraction: 0 });
});
