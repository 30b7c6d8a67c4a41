import assert from 'node:assert/strict';
import test from 'node:test';
import { decodeFloats, decodeTimes } from '../../../viewer/src/data/decode';

function encoded(values: number[]): string {
  return Buffer.from(Float32Array.from(values).buffer).toString('base64');
}

test('floats come back, gaps as NaN', () => {
  const values = [0, -1.5, 3.1415927410125732, NaN, 1e-30];
  const back = Array.from(decodeFloats(encoded(values)));
  assert.deepEqual(back, Array.from(Float32Array.from(values)));
  assert.equal(decodeFloats('').length, 0);
});

test('even times are counted, not added up', () => {
  const t = decodeTimes({ start: 1, step: 0.1, count: 1001 });
  assert.equal(t.length, 1001);
  assert.equal(t[1000], 1 + 1000 * 0.1);
});

test('other times are listed', () => {
  assert.deepEqual(Array.from(decodeTimes({ values: encoded([0, 0.25, 7]) })), [0, 0.25, 7]);
});
