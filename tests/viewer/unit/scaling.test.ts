import assert from 'node:assert/strict';
import test from 'node:test';
import { niceStep, tickText, ticks, verticalRange } from '../../../viewer/src/plots/scaling';

test('the range holds all data with some air', () => {
  for (const [low, high] of [[-1, 3], [0, 1e-6], [5, 5], [-1e9, -1e8], [0, 0]]) {
    const [from, to] = verticalRange(low, high, []);
    assert.ok(from < low && to > high, `${low} ${high}`);
    assert.ok(to - from < 1.2 * Math.max(high - low, 1e-4 * Math.max(Math.abs(low), 1e-5)));
  }
  assert.deepEqual(verticalRange(null, null, [3]), [-1, 1]);
});

test('a limit is in range when the data come near it, and squeezes nothing when they do not', () => {
  assert.ok(verticalRange(0, 4, [5])[1] > 5);
  assert.deepEqual(verticalRange(0, 4, [20]), verticalRange(0, 4, []));
  assert.ok(verticalRange(-4, 0, [-5, 5])[0] < -5);
});

test('steps are 1, 2 or 5 times a power of ten and fill the span', () => {
  for (let span = 1e-5; span < 1e5; span *= 1.37) {
    const step = niceStep(span, 5);
    const mantissa = Number((step / 10 ** Math.floor(Math.log10(step) + 1e-9)).toFixed(6));
    assert.ok([1, 2, 5].includes(mantissa), `${step}`);
    const count = span / step;
    assert.ok(count <= 5.0001 && count > 1.9, `${span}: ${count}`);
  }
});

test('ticks are all multiples within the range', () => {
  assert.deepEqual(ticks(-0.25, 0.5, 0.25), [-0.25, 0, 0.25, 0.5]);
  assert.equal(ticks(0, 1, 0.1).length, 11);
});

test('a tick text tells neighbours apart', () => {
  for (const step of [1e-5, 0.02, 0.25, 2.5, 50, 2e6]) {
    const texts = [0, 1, 2, 3].map((i) => tickText(i * step, step));
    assert.equal(new Set(texts).size, 4, texts.join(' '));
  }
  assert.equal(tickText(-0.25, 0.25), '−0.25');
  assert.equal(tickText(-0.0, 0.1), '0.0');
});
