// Finding and interpolating samples over ascending times.

export interface Bracket {
  index: number; // of the sample at or before the time asked for
  fraction: number; // 0 at that sample, towards 1 at the next
}

// Index of the last time not after `t`; 0 before the first.
export function indexAtOrBefore(times: Float64Array, t: number): number {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

// Index of the time nearest to `t`.
export function nearestIndex(times: Float64Array, t: number): number {
  const i = indexAtOrBefore(times, t);
  return i + 1 < times.length && times[i + 1] - t < t - times[i] ? i + 1 : i;
}

// Where `t` lies between two samples; held at the ends.
export function bracket(times: Float64Array, t: number): Bracket {
  const index = indexAtOrBefore(times, t);
  if (index + 1 >= times.length || t <= times[index]) return { index, fraction: 0 };
  return { index, fraction: (t - times[index]) / (times[index + 1] - times[index]) };
}

// Component `k` of rows of `width` numbers, linearly between two rows.
export function interpolated(rows: Float64Array, width: number, k: number, at: Bracket): number {
  const a = rows[at.index * width + k];
  if (at.fraction === 0) return a;
  return a + at.fraction * (rows[(at.index + 1) * width + k] - a);
}
