import uPlot from 'uplot';
import type { Phase } from '../data/format';
import { nearestIndex } from '../data/lookup';
import type { Axes, Series } from '../data/recording';
import { element } from '../dom';
import { numberText, steadyNumberText, timeText } from '../number_text';
import type { Theme } from '../theme';
import type { Timeline } from '../time/timeline';
import { alignedData } from './aligned_data';
import { Legend } from './legend';
import { labelPhases, shadePhases } from './phases';
import { tickText, verticalRange } from './scaling';
import { strokeOf } from './stroke';

const plotHeight = 150; // of the plot with its time axis [CSS px]
const timeLabelHeight = 18;
const phaseLabelHeight = 10;
const syncKey = 'report';

export interface Place {
  first: boolean; // of its group: carries the phases' labels
  last: boolean; // of its group: carries the label of the time axis
}

function valueAt(series: Series, t: number): number {
  return series.t.length === 0 ? NaN : series.values[nearestIndex(series.t, t)];
}

function largestValue(series: Series[]): number {
  let largest = 0;
  for (const { values } of series) {
    for (const value of values) if (Math.abs(value) > largest) largest = Math.abs(value);
  }
  return largest;
}

// Shows a plot drawn too large by `factor` in its true size.
function shrink(u: uPlot, factor: number): void {
  if (factor === 1) return;
  const wrap = u.root.querySelector<HTMLElement>('.u-wrap')!;
  for (const part of [u.root, wrap]) part.style.width = `${u.width / factor}px`;
  wrap.style.height = `${u.height / factor}px`;
}

// "limit 0.45 m"; a pair of opposite limits of one name is said once.
function limitTexts(axes: Axes): string[] {
  const opposite = (limit: { name: string; value: number }) =>
    axes.limits.some((other) => other.name === limit.name && other.value === -limit.value);
  return axes.limits
    .filter((limit) => limit.value > 0 || !opposite(limit))
    .map((limit) => {
      const sign = limit.value > 0 && opposite(limit) ? '±' : '';
      return `${limit.name} ${sign}${numberText(limit.value)} ${axes.unit}`;
    });
}

// One pair of axes over time. The timeline decides what stretch is shown and where the marker of
// the replay stands; dragging and clicking on the plot tell the timeline.
export class TimePlot {
  readonly root: HTMLElement;
  private readonly body = element('div', { class: 'plot-body' });
  private readonly marker = element('div', { class: 'time-marker' });
  private readonly cursorTime = element('div', { class: 'cursor-time' });
  private readonly legend: Legend;
  private readonly data: uPlot.AlignedData;
  private readonly largest: number; // absolute value in the data
  private readonly hidden = new Set<number>();
  private plot: uPlot | null = null;

  constructor(
    private readonly axes: Axes,
    private readonly phases: Phase[],
    private readonly timeline: Timeline,
    private readonly place: Place,
  ) {
    this.data = alignedData(axes.series);
    this.largest = largestValue(axes.series);
    this.legend = new Legend(axes.series, (index, shown) => this.show(index, shown));
    for (const limit of limitTexts(axes)) this.legend.addLimit(limit);
    const label = axes.unit ? `${axes.quantity} [${axes.unit}]` : axes.quantity;
    this.root = element(
      'figure',
      { class: 'plot', 'aria-label': `${label} over time` },
      element('figcaption', {}, element('span', { class: 'quantity' }, label), this.legend.root),
      this.body,
    );
    timeline.onTime(() => this.showTime());
    timeline.onWindow(() => this.showWindow());
  }

  // Draws anew. A `sharpness` above 1 gives more pixels for the same size, for paper.
  draw(theme: Theme, width: number, sharpness = 1): void {
    this.plot?.destroy();
    this.plot = new uPlot(this.options(theme, width * sharpness, sharpness), this.data, this.body);
    this.plot.over.append(this.marker, this.cursorTime);
    this.listen(this.plot);
    this.showWindow();
    this.showTime();
  }

  resize(width: number): void {
    this.plot?.setSize({ width, height: this.plot.height });
  }

  private show(index: number, shown: boolean): void {
    if (shown) this.hidden.delete(index);
    else this.hidden.add(index);
    this.plot?.setSeries(index + 1, { show: shown });
  }

  private showWindow(): void {
    if (!this.plot) return;
    const { start, end } = this.timeline.window;
    this.plot.setScale('x', { min: start, max: end });
    this.root.dataset.window = `${start},${end}`;
  }

  private showTime(): void {
    if (!this.plot) return;
    const { start, end } = this.timeline.window;
    const t = this.timeline.time;
    const at = (t - start) / (end - start);
    this.marker.hidden = at < 0 || at > 1;
    this.marker.style.left = `${100 * at}%`;
    if (!this.hovered()) this.showValues(t);
  }

  private hovered(): boolean {
    return (this.plot?.cursor.left ?? -1) >= 0;
  }

  private showValues(t: number): void {
    this.legend.setValues(
      this.axes.series.map((series) => steadyNumberText(valueAt(series, t), this.largest)),
    );
  }

  private showCursor(u: uPlot): void {
    if (!this.hovered()) {
      this.showValues(this.timeline.time);
      return;
    }
    const t = u.posToVal(u.cursor.left ?? 0, 'x');
    this.showValues(t);
    const { start, end } = this.timeline.window;
    this.cursorTime.textContent = `${timeText(t, end - start)} s`;
    this.cursorTime.style.left = `${u.cursor.left}px`;
  }

  private listen(u: uPlot): void {
    let pressedAt = 0;
    const dragged = 4; // [CSS px]
    u.over.addEventListener('mousedown', (event) => (pressedAt = event.clientX));
    u.over.addEventListener('mouseup', (event) => {
      if (event.button !== 0 || Math.abs(event.clientX - pressedAt) >= dragged) return;
      this.timeline.setTime(u.posToVal(event.clientX - u.over.getBoundingClientRect().left, 'x'));
    });
    u.over.addEventListener(
      'wheel',
      (event) => {
        if (!event.ctrlKey) return; // a bare wheel scrolls the page
        event.preventDefault();
        const t = u.posToVal(event.clientX - u.over.getBoundingClientRect().left, 'x');
        this.timeline.zoomAbout(t, Math.exp(event.deltaY / 200));
      },
      { passive: false },
    );
  }

  private options(theme: Theme, width: number, sharpness: number): uPlot.Options {
    const px = (size: number) => size * sharpness;
    const fontSize = px(11);
    const font = `${fontSize}px system-ui, sans-serif`;
    const limits = this.axes.limits.map((limit) => limit.value);
    const labelled = this.place.first && this.phases.length > 0;
    const ruler = { stroke: theme.grid, width: px(1) };
    const axis: uPlot.Axis = {
      stroke: theme.muted,
      font,
      labelFont: font,
      grid: ruler,
      ticks: { ...ruler, size: px(4) },
      border: { show: true, stroke: theme.axis, width: px(1) },
      gap: px(4),
      values: (_, splits, __, ___, step) => splits.map((value) => tickText(value, step)),
    };
    const timeLabel = this.place.last
      ? { label: 'time [s]', labelSize: px(timeLabelHeight), labelGap: px(2) }
      : {};
    return {
      width,
      height: px(
        plotHeight + (this.place.last ? timeLabelHeight : 0) + (labelled ? phaseLabelHeight : 0),
      ),
      padding: [px(labelled ? 6 + phaseLabelHeight : 6), px(16), 0, 0],
      legend: { show: false },
      scales: {
        x: { time: false },
        y: { range: (_, low, high) => verticalRange(low, high, limits) },
      },
      axes: [
        { ...axis, ...timeLabel, size: px(24), space: px(60) },
        { ...axis, size: px(58), space: px(28) },
      ],
      series: [{}, ...this.axes.series.map((series, i) => this.seriesOptions(series, i, theme, px))],
      cursor: {
        y: false,
        drag: { x: true, y: false, setScale: false },
        sync: { key: syncKey, setSeries: false, scales: ['x', null] },
        points: { size: px(6) },
        bind: { dblclick: () => () => (this.timeline.resetWindow(), null) },
      },
      hooks: {
        ready: [(u) => shrink(u, sharpness)],
        drawClear: [(u) => shadePhases(u, this.phases, theme)],
        draw: [
          (u) => this.drawLimits(u, theme, px(1)),
          (u) => {
            if (labelled) labelPhases(u, this.phases, theme, px(10.5) * uPlot.pxRatio);
          },
        ],
        setCursor: [(u) => this.showCursor(u)],
        setScale: [() => this.showTime()],
        setSelect: [(u) => this.zoomToSelection(u)],
      },
    };
  }

  private seriesOptions(
    series: Series,
    index: number,
    theme: Theme,
    px: (size: number) => number,
  ): uPlot.Series {
    const stroke = strokeOf(series.style);
    return {
      label: series.name,
      show: !this.hidden.has(index),
      stroke: theme.series[stroke.shade][series.channel],
      width: px(stroke.width),
      dash: stroke.dash.map(px),
      points: { show: false },
      pxAlign: 0, // smooth lines rather than steps from pixel to pixel
    };
  }

  private drawLimits(u: uPlot, theme: Theme, line: number): void {
    const { left, top, width, height } = u.bbox;
    u.ctx.save();
    u.ctx.strokeStyle = theme.limit;
    u.ctx.lineWidth = line * uPlot.pxRatio;
    u.ctx.setLineDash([4 * u.ctx.lineWidth, 3 * u.ctx.lineWidth]);
    for (const limit of this.axes.limits) {
      const y = u.valToPos(limit.value, 'y', true);
      if (y < top || y > top + height) continue;
      u.ctx.beginPath();
      u.ctx.moveTo(left, y);
      u.ctx.lineTo(left + width, y);
      u.ctx.stroke();
    }
    u.ctx.restore();
  }

  private zoomToSelection(u: uPlot): void {
    const { left, width } = u.select;
    const shortest = 4; // [CSS px]
    if (width < shortest) return;
    const from = u.posToVal(left, 'x');
    const to = u.posToVal(left + width, 'x');
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.timeline.setWindow(from, to);
  }
}
