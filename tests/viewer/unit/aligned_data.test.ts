import assert from 'node:assert/strict';
import test from 'node:test';
import type { Series } from '../../../viewer/src/data/recording';
import { alignedData } from '../../../viewer/src/plots/aligned_data';

function series(t: Float64Array, values: number[]): Series {
  return { name: '', style: 'measured', channel: 0, t, values: Float64Array.from(values) };
}

test('series over the same times are taken as they are, gaps as null', () => {
  const t = Float64Array.of(0, 1, 2);
  const data = alignedData([series(t, [1, 2, 3]), series(t, [4, NaN, 6])]);
  assert.deepEqual(data.map((column) => Array.from(column)), [[0, 1, 2], [1, 2, 3], [4, null, 6]]);
});

test('series over other times are joined in the order given; only gaps break a line', () => {
  const slow = Float64Array.of(0, 2);
  const fast = Float64Array.of(0, 1, 2);
  const data = alignedData([series(fast, [1, 2, 3]), series(slow, [4, 5]), series(fast, [6, NaN, 8])]);
  assert.deepEqual(data.map((column) => Array.from(column)), [
    [0, 1, 2],
    [1, 2, 3],
    [4, undefined, 5],
    [6, null, 8],
  ]);
});

test('no series make an empty plot', () => {
  assert.deepEqual(alignedData([]), [[]]);
});
