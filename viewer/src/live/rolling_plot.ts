import uPlot from 'uplot';
import { element } from '../dom';
import { steadyNumberText } from '../number_text';
import { tickText, verticalRange } from '../plots/scaling';
import { Legend } from '../plots/legend';
import type { Theme } from '../theme';

const shown = 20; // what a plot shows of the past [s]
const height = 150; // [CSS px]

// A plot of the last seconds that moves on as values arrive.
export class RollingPlot {
  readonly root: HTMLElement;
  private readonly body = element('div', { class: 'plot-body' });
  private readonly legend: Legend;
  private columns: number[][];
  private plot: uPlot | null = null;

  constructor(
    quantity: string,
    unit: string,
    private readonly names: string[],
  ) {
    this.columns = [[], ...names.map(() => [])];
    const lines = names.map((name, channel) => ({ name, style: 'measured' as const, channel }));
    this.legend = new Legend(lines, (index, on) => this.plot?.setSeries(index + 1, { show: on }));
    const label = `${quantity} [${unit}]`;
    this.root = element(
      'figure',
      { class: 'plot live-plot', 'aria-label': `${label} over time` },
      element('figcaption', {}, element('span', { class: 'quantity' }, label), this.legend.root),
      this.body,
    );
  }

  clear(): void {
    this.columns = this.columns.map(() => []);
  }

  add(t: number, values: number[]): void {
    [t, ...values].forEach((value, i) => this.columns[i].push(value));
    const old = this.columns[0].findIndex((time) => time >= t - shown);
    if (old > 0) this.columns.forEach((column) => column.splice(0, old));
    const largest = Math.max(...this.columns.slice(1).flat().map(Math.abs));
    this.legend.setValues(values.map((value) => steadyNumberText(value, largest)));
    this.plot?.setData(this.columns as uPlot.AlignedData, false);
    this.plot?.setScale('x', { min: Math.max(0, t - shown), max: Math.max(shown, t) });
  }

  draw(theme: Theme, width: number): void {
    this.plot?.destroy();
    const ruler = { stroke: theme.grid, width: 1 };
    const axis: uPlot.Axis = {
      stroke: theme.muted,
      font: '11px system-ui, sans-serif',
      labelFont: '11px system-ui, sans-serif',
      grid: ruler,
      ticks: { ...ruler, size: 4 },
      border: { show: true, stroke: theme.axis, width: 1 },
      gap: 4,
      values: (_, splits, __, ___, step) => splits.map((value) => tickText(value, step)),
    };
    const options: uPlot.Options = {
      width,
      height,
      padding: [6, 16, 0, 0],
      legend: { show: false },
      scales: {
        x: { time: false, auto: false, min: 0, max: shown },
        y: { range: (_, low, high) => verticalRange(low, high, []) },
      },
      axes: [
        { ...axis, size: 24, space: 60, label: 'time [s]', labelSize: 18, labelGap: 2 },
        { ...axis, size: 58, space: 28 },
      ],
      series: [
        {},
        ...this.names.map((label, i) => ({
          label,
          stroke: theme.series.plain[i],
          width: 1.6,
          points: { show: false },
          pxAlign: 0,
        })),
      ],
      cursor: { show: false },
    };
    this.plot = new uPlot(options, this.columns as uPlot.AlignedData, this.body);
  }
}
