// Ranges and ticks of axes.

export type Range = [number, number];

// The vertical range for data within [low, high]: some air around it, and the limits that the data
// come near to. A limit far away would squeeze the data and is left out.
export function verticalRange(
  low: number | null,
  high: number | null,
  limits: number[],
): Range {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) {
    return [-1, 1];
  }
  const smallest = Math.max(1e-9, 1e-4 * Math.max(Math.abs(low), Math.abs(high)));
  const span = Math.max(high - low, smallest);
  const near = limits.filter((limit) => limit > low - span / 2 && limit < high + span / 2);
  const from = Math.min(low, ...near);
  const to = Math.max(high, ...near);
  const air = 0.08 * Math.max(to - from, smallest);
  return [from - air, to + air];
}

// 1, 2 or 5 times a power of ten, so that about `wanted` steps fill `span`.
export function niceStep(span: number, wanted: number): number {
  const rough = span / wanted;
  const power = 10 ** Math.floor(Math.log10(rough));
  const factor = [1, 2, 5, 10].find((f) => f * power >= rough) ?? 10;
  return factor * power;
}

// Multiples of `step` within [from, to].
export function ticks(from: number, to: number, step: number): number[] {
  const list: number[] = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; i++) list.push(i * step);
  return list;
}

// A tick's text: the decimals that a spacing of `step` needs, and no more.
export function tickText(value: number, step: number): string {
  const size = Math.abs(value);
  if (step < 1e-4 || size >= 1e6) {
    return value === 0 ? '0' : value.toExponential(1).replace(/-/g, '−');
  }
  let decimals = 0;
  while (decimals < 5 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6) {
    decimals++;
  }
  return value.toFixed(decimals).replace(/^-(0(?:\.0*)?)$/, '$1').replace('-', '−');
}
