import uPlot from 'uplot';
import type { Series } from '../data/recording';

type Column = (number | null | undefined)[] | Float64Array;

function withGaps(values: Float64Array): Column {
  return values.some(Number.isNaN) ? Array.from(values, (v) => (Number.isNaN(v) ? null : v)) : values;
}

// uPlot wants one column of times for all series. Series over other times are joined: undefined
// where a series has no sample (the line goes on), null where it has a gap (the line breaks).
export function alignedData(series: Series[]): uPlot.AlignedData {
  const times = [...new Set(series.map((s) => s.t))];
  if (times.length === 0) return [[]];
  if (times.length === 1) {
    return [times[0], ...series.map((s) => withGaps(s.values))] as uPlot.AlignedData;
  }
  const members = times.map((t) => series.filter((s) => s.t === t));
  const tables = times.map((t, i) => [t, ...members[i].map((s) => withGaps(s.values))]);
  const joined = uPlot.join(tables as uPlot.AlignedData[]) as Column[];
  const order = members.flat();
  return [
    joined[0],
    ...series.map((s) => joined[1 + order.indexOf(s)]),
  ] as uPlot.AlignedData;
}
