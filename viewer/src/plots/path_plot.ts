import { nearestIndex } from '../data/lookup';
import type { PathAxes, PathSeries } from '../data/recording';
import { element, svg } from '../dom';
import type { Timeline } from '../time/timeline';
import { Legend } from './legend';
import { niceStep, tickText, ticks } from './scaling';
import { colourName, strokeOf } from './stroke';

const height = 320; // [CSS px]
const margin = { left: 58, right: 12, top: 8, bottom: 40 };

interface Box {
  left: number;
  right: number;
  low: number;
  high: number;
}

function boundingBox(series: PathSeries[]): Box {
  const box = { left: Infinity, right: -Infinity, low: Infinity, high: -Infinity };
  for (const { x, y } of series) {
    for (let i = 0; i < x.length; i++) {
      if (!Number.isFinite(x[i]) || !Number.isFinite(y[i])) continue;
      box.left = Math.min(box.left, x[i]);
      box.right = Math.max(box.right, x[i]);
      box.low = Math.min(box.low, y[i]);
      box.high = Math.max(box.high, y[i]);
    }
  }
  return box.left <= box.right ? box : { left: -1, right: 1, low: -1, high: 1 };
}

// Curves in a plane with one scale for both directions. The part of a curve that belongs to the
// timeline's window is strong, the rest faint; a dot marks the present time.
export class PathPlot {
  readonly root: HTMLElement;
  private readonly body = element('div', { class: 'plot-body' });
  private readonly box: Box;
  private readonly curves: { whole: SVGPathElement; shown: SVGPathElement; dot: SVGElement }[] = [];
  private toX = (x: number) => x;
  private toY = (y: number) => y;

  constructor(
    private readonly axes: PathAxes,
    private readonly timeline: Timeline,
  ) {
    this.box = boundingBox(axes.series);
    for (const series of axes.series) {
      const stroke = strokeOf(series.style);
      const style =
        `stroke: var(--${colourName(series.style, series.channel)}); stroke-width: ${stroke.width};` +
        `stroke-dasharray: ${stroke.dash.join(' ') || 'none'}`;
      this.curves.push({
        whole: svg('path', { class: 'curve faint', style }),
        shown: svg('path', { class: 'curve', style }),
        dot: svg('circle', {
          class: 'curve-dot',
          r: 4,
          style: `fill: var(--${colourName(series.style, series.channel)})`,
        }),
      });
    }
    const legend = new Legend(axes.series, (index, shown) => {
      for (const node of Object.values(this.curves[index])) node.classList.toggle('off', !shown);
    });
    const label = `${axes.title}, ${axes.xLabel} and ${axes.yLabel} [${axes.unit}]`;
    this.root = element(
      'figure',
      { class: 'plot path-plot', 'aria-label': label },
      element('figcaption', {}, element('span', { class: 'quantity' }, axes.title), legend.root),
      this.body,
    );
    timeline.onTime(() => this.showTime());
    timeline.onWindow(() => this.showWindow());
  }

  draw(width: number): void {
    const inner = { width: width - margin.left - margin.right, height: height - margin.top - margin.bottom };
    const air = 1.12;
    const smallest = 1e-3;
    const spanX = Math.max((this.box.right - this.box.left) * air, smallest);
    const spanY = Math.max((this.box.high - this.box.low) * air, smallest);
    const scale = Math.min(inner.width / spanX, inner.height / spanY); // [px per unit]
    const midX = (this.box.left + this.box.right) / 2;
    const midY = (this.box.low + this.box.high) / 2;
    this.toX = (x) => margin.left + inner.width / 2 + (x - midX) * scale;
    this.toY = (y) => margin.top + inner.height / 2 - (y - midY) * scale;

    const picture = svg('svg', { width, height, viewBox: `0 0 ${width} ${height}` });
    const frame = svg('rect', {
      class: 'frame',
      x: margin.left,
      y: margin.top,
      width: inner.width,
      height: inner.height,
    });
    picture.append(...this.grid(inner, scale, midX, midY), frame);
    for (const { whole, shown, dot } of this.curves) picture.append(whole, shown, dot);
    this.body.replaceChildren(picture);
    this.axes.series.forEach((series, i) => {
      this.curves[i].whole.setAttribute('d', this.curve(series, 0, series.t.length - 1));
    });
    this.showWindow();
    this.showTime();
  }

  private grid(
    inner: { width: number; height: number },
    scale: number,
    midX: number,
    midY: number,
  ): SVGElement[] {
    const step = niceStep(inner.height / scale, 5);
    const bottom = margin.top + inner.height;
    const parts: SVGElement[] = [];
    const halfX = inner.width / scale / 2;
    const halfY = inner.height / scale / 2;
    const text = (x: number, y: number, anchor: string, words: string) =>
      svg('text', { x, y, 'text-anchor': anchor }, words);
    for (const x of ticks(midX - halfX, midX + halfX, step)) {
      parts.push(
        svg('path', { class: 'grid', d: `M${this.toX(x)} ${margin.top}V${bottom}` }),
        text(this.toX(x), bottom + 15, 'middle', tickText(x, step)),
      );
    }
    for (const y of ticks(midY - halfY, midY + halfY, step)) {
      parts.push(
        svg('path', { class: 'grid', d: `M${margin.left} ${this.toY(y)}h${inner.width}` }),
        text(margin.left - 7, this.toY(y) + 4, 'end', tickText(y, step)),
      );
    }
    const { xLabel, yLabel, unit } = this.axes;
    const middle = margin.top + inner.height / 2;
    parts.push(
      text(margin.left + inner.width / 2, height - 7, 'middle', `${xLabel} [${unit}]`),
      svg(
        'text',
        { x: 12, y: middle, 'text-anchor': 'middle', transform: `rotate(-90 12 ${middle})` },
        `${yLabel} [${unit}]`,
      ),
    );
    return parts;
  }

  private curve(series: PathSeries, from: number, to: number): string {
    let d = '';
    let pen = 'M';
    for (let i = from; i <= to; i++) {
      const x = this.toX(series.x[i]);
      const y = this.toY(series.y[i]);
      if (!Number.isFinite(x) || !Number.isFinite(y)) {
        pen = 'M';
        continue;
      }
      d += `${pen}${x.toFixed(1)} ${y.toFixed(1)}`;
      pen = 'L';
    }
    return d;
  }

  private showWindow(): void {
    const { start, end } = this.timeline.window;
    this.axes.series.forEach((series, i) => {
      const from = nearestIndex(series.t, start);
      const to = nearestIndex(series.t, end);
      this.curves[i].shown.setAttribute('d', this.curve(series, from, to));
    });
  }

  private showTime(): void {
    this.axes.series.forEach((series, i) => {
      const at = nearestIndex(series.t, this.timeline.time);
      const x = this.toX(series.x[at]);
      const y = this.toY(series.y[at]);
      const there = Number.isFinite(x) && Number.isFinite(y);
      this.curves[i].dot.setAttribute('visibility', there ? 'visible' : 'hidden');
      if (!there) return;
      this.curves[i].dot.setAttribute('cx', x.toFixed(1));
      this.curves[i].dot.setAttribute('cy', y.toFixed(1));
    });
  }
}
