import type { Lane, Phase } from '../data/format';
import { element, svg } from '../dom';
import type { Timeline } from '../time/timeline';
import { niceStep, tickText, ticks } from './scaling';

const laneHeight = 20; // [CSS px]
const gap = 3;
// The left and right edges are those of the plots over time beneath, so that one time is one column.
const margin = { left: 58, right: 16, top: 16, bottom: 4 };
const bottomWithTimes = 38;
const labelWidth = 6.2; // of a letter, about [CSS px]
const narrowest = 1.5; // a stretch of one cycle still shows [CSS px]

type Stretch = Lane['stretches'][number];

// States over time: a lane for each thing, a bar for each state it was in, with its word where there
// is room. Zooms, scrubs and marks the time as the plots do.
export class LanePlot {
  readonly root: HTMLElement;
  private readonly body = element('div', { class: 'plot-body' });
  private width = 0;

  constructor(
    private readonly lanes: Lane[],
    private readonly phases: Phase[],
    private readonly timeline: Timeline,
    private readonly last: boolean, // carries the times beneath
  ) {
    this.root = element(
      'figure',
      { class: 'plot lane-plot', 'aria-label': 'states over time' },
      element('figcaption', {}, element('span', { class: 'quantity' }, 'state')),
      this.body,
    );
    timeline.onTime(() => this.draw(this.width));
    timeline.onWindow(() => this.draw(this.width));
    this.listen();
  }

  draw(width: number): void {
    this.width = width;
    const inner = Math.max(width - margin.left - margin.right, 1);
    const rows = this.lanes.length * (laneHeight + gap);
    const height = margin.top + rows + (this.last ? bottomWithTimes : margin.bottom);
    const { start, end } = this.timeline.window;
    const toX = (t: number) => margin.left + ((t - start) / (end - start)) * inner;
    const picture = svg('svg', { width, height, viewBox: `0 0 ${width} ${height}` });
    this.lanes.forEach((lane, i) => {
      const y = margin.top + i * (laneHeight + gap);
      picture.append(
        svg('text', { class: 'lane-name', x: margin.left - 6, y: y + 14, 'text-anchor': 'end' }, lane.name),
      );
      for (const stretch of lane.stretches) picture.append(...this.bar(stretch, y, toX, inner));
    });
    picture.append(...this.marks(toX, inner, margin.top + rows), ...this.now(toX, inner, rows));
    if (this.last) picture.append(...this.times(toX, inner, margin.top + rows + 14));
    this.body.replaceChildren(picture);
  }

  private bar(stretch: Stretch, y: number, toX: (t: number) => number, inner: number): SVGElement[] {
    const from = Math.max(toX(stretch.start), margin.left);
    const to = Math.min(toX(stretch.end), margin.left + inner);
    if (to < margin.left || from > margin.left + inner || to < from) return [];
    const wide = Math.max(to - from, narrowest);
    const bar = svg(
      'rect',
      { class: `lane-bar ${stretch.tone}`, x: from, y, width: wide, height: laneHeight },
      svg('title', {}, stretch.word),
    );
    if (wide < stretch.word.length * labelWidth + 8) return [bar];
    return [bar, svg('text', { class: 'lane-word', x: from + 5, y: y + 14 }, stretch.word)];
  }

  private marks(toX: (t: number) => number, inner: number, bottom: number): SVGElement[] {
    const parts: SVGElement[] = [];
    let free = margin.left;
    for (const phase of this.phases) {
      const x = toX(phase.start);
      if (x < margin.left || x > margin.left + inner) continue;
      parts.push(svg('path', { class: `lane-mark ${phase.kind}-mark`, d: `M${x} ${margin.top - 3}V${bottom}` }));
      const length = phase.label.length * labelWidth;
      const at = Math.min(x, margin.left + inner - length);
      if (at < free) continue;
      parts.push(svg('text', { class: `lane-event ${phase.kind}-mark`, x: at, y: margin.top - 5 }, phase.label));
      free = at + length + 8;
    }
    return parts;
  }

  private now(toX: (t: number) => number, inner: number, rows: number): SVGElement[] {
    const x = toX(this.timeline.time);
    if (x < margin.left || x > margin.left + inner) return [];
    return [svg('path', { class: 'lane-now', d: `M${x} ${margin.top}v${rows}` })];
  }

  private times(toX: (t: number) => number, inner: number, y: number): SVGElement[] {
    const { start, end } = this.timeline.window;
    const step = niceStep(end - start, Math.max(2, inner / 90));
    const numbers = ticks(start, end, step).map((t) =>
      svg('text', { x: toX(t), y, 'text-anchor': 'middle' }, tickText(t, step)),
    );
    const middle = margin.left + inner / 2;
    return [...numbers, svg('text', { x: middle, y: y + 16, 'text-anchor': 'middle' }, 'time [s]')];
  }

  private listen(): void {
    let pressedAt: number | null = null;
    const timeAt = (clientX: number) => {
      const left = this.body.getBoundingClientRect().left + margin.left;
      const inner = Math.max(this.width - margin.left - margin.right, 1);
      const { start, end } = this.timeline.window;
      return start + ((clientX - left) / inner) * (end - start);
    };
    const dragged = 4; // [CSS px]
    this.body.addEventListener('mousedown', (event) => (pressedAt = event.clientX));
    this.body.addEventListener('mouseup', (event) => {
      if (pressedAt === null || event.button !== 0) return;
      const from = pressedAt;
      pressedAt = null;
      const [a, b] = [timeAt(from), timeAt(event.clientX)];
      if (Math.abs(event.clientX - from) < dragged) this.timeline.setTime(b);
      else this.timeline.setWindow(Math.min(a, b), Math.max(a, b));
    });
    this.body.addEventListener('dblclick', () => this.timeline.resetWindow());
  }
}
