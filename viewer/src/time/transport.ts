import type { Phase } from '../data/format';
import { element, icon } from '../dom';
import { timeText } from '../number_text';
import { phaseNames } from '../plots/phases';
import type { Timeline } from './timeline';

const icons = {
  play: 'M4 2.5v11l9-5.5z',
  pause: 'M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z',
};
const speeds = [0.1, 0.25, 0.5, 1, 2, 4];
const sliderSteps = 10000;
const hint =
  'In a plot: click to go to that time, drag to zoom, double-click to see all. Keys: space plays, ' +
  'arrows step.';

// Play, pause, speed, a slider over the whole run with its phases and the plots' window, zoom.
export class Transport {
  readonly root: HTMLElement;
  private readonly play = element('button', { type: 'button', class: 'play' });
  private readonly slider = element('input', {
    type: 'range',
    class: 'scrubber',
    min: 0,
    max: sliderSteps,
    step: 1,
    'aria-label': 'Time',
  });
  private readonly now = element('output', { class: 'time-now' });
  private readonly windowMark = element('div', { class: 'window-mark' });
  private readonly resetZoom = element(
    'button',
    { type: 'button', class: 'reset-zoom', title: 'Show the whole run (0)' },
    'Reset zoom',
  );

  constructor(
    private readonly timeline: Timeline,
    phases: Phase[],
  ) {
    const speed = element('select', { class: 'speed', 'aria-label': 'Speed of the replay' });
    for (const rate of speeds) {
      speed.append(element('option', { value: rate, selected: rate === 1 }, `${rate}×`));
    }
    speed.addEventListener('change', () => timeline.setSpeed(Number(speed.value)));
    this.play.addEventListener('click', () => timeline.toggle());
    this.slider.addEventListener('input', () => {
      const fraction = Number(this.slider.value) / sliderSteps;
      timeline.setTime(timeline.start + fraction * (timeline.end - timeline.start));
    });
    this.resetZoom.addEventListener('click', () => timeline.resetWindow());

    const zoomIn = element('button', { type: 'button', title: 'Zoom in about the time shown (+)' }, '+');
    const zoomOut = element('button', { type: 'button', title: 'Zoom out (−)' }, '−');
    zoomIn.setAttribute('aria-label', 'Zoom in');
    zoomOut.setAttribute('aria-label', 'Zoom out');
    zoomIn.addEventListener('click', () => this.zoom(0.5));
    zoomOut.addEventListener('click', () => this.zoom(2));

    const track = element('div', { class: 'track' }, ...this.phaseMarks(phases), this.windowMark);
    this.root = element(
      'div',
      { class: 'transport', role: 'group', 'aria-label': 'Time' },
      this.play,
      element('div', { class: 'scrub' }, track, this.slider),
      this.now,
      element('div', { class: 'transport-tools' }, speed, zoomOut, zoomIn, this.resetZoom),
      element('p', { class: 'hint' }, hint),
    );
    timeline.onTime(() => this.showTime());
    timeline.onWindow(() => this.showWindow());
    timeline.onState(() => this.showState());
    this.showTime();
    this.showWindow();
    this.showState();
    document.addEventListener('keydown', (event) => this.onKey(event));
  }

  private percent(t: number): string {
    const { start, end } = this.timeline;
    return `${(100 * (t - start)) / (end - start)}%`;
  }

  private phaseMarks(phases: Phase[]): HTMLElement[] {
    return phases.map((phase) => {
      const { start, end } = this.timeline;
      const mark = element('div', {
        class: `phase-mark ${phase.kind}`,
        title: `${phaseNames[phase.kind]}: ${phase.label}`,
      });
      mark.style.left = this.percent(phase.start);
      mark.style.width = `${(100 * (phase.end - phase.start)) / (end - start)}%`;
      return mark;
    });
  }

  private zoom(factor: number): void {
    const { start, end } = this.timeline.window;
    const t = this.timeline.time;
    this.timeline.zoomAbout(t >= start && t <= end ? t : (start + end) / 2, factor);
  }

  private showTime(): void {
    const { start, end, time } = this.timeline;
    const fraction = (time - start) / (end - start);
    this.slider.value = String(Math.round(fraction * sliderSteps));
    this.slider.setAttribute('aria-valuetext', `${timeText(time)} s`);
    this.slider.style.setProperty('--done', `${100 * fraction}%`);
    this.now.textContent = `${timeText(time)} / ${timeText(end)} s`;
    this.root.dataset.time = String(time);
  }

  private showWindow(): void {
    const { start, end } = this.timeline.window;
    const length = this.timeline.end - this.timeline.start;
    this.windowMark.hidden = !this.timeline.zoomed;
    this.windowMark.style.left = this.percent(start);
    this.windowMark.style.width = `${(100 * (end - start)) / length}%`;
    this.resetZoom.disabled = !this.timeline.zoomed;
  }

  private showState(): void {
    const { playing } = this.timeline;
    this.play.replaceChildren(icon(playing ? icons.pause : icons.play));
    this.play.setAttribute('aria-label', playing ? 'Pause' : 'Play');
    this.play.title = playing ? 'Pause (space)' : 'Play (space)';
    this.root.dataset.playing = String(playing);
  }

  private onKey(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    const typing = target.closest('input, select, textarea, button, summary, pre') !== null;
    if (typing || event.altKey || event.ctrlKey || event.metaKey) return;
    const { timeline } = this;
    const step = event.shiftKey ? 0.5 : 0.02; // [s]
    const actions: Record<string, () => void> = {
      ' ': () => timeline.toggle(),
      ArrowLeft: () => timeline.setTime(timeline.time - step),
      ArrowRight: () => timeline.setTime(timeline.time + step),
      '+': () => this.zoom(0.5),
      '-': () => this.zoom(2),
      '0': () => timeline.resetWindow(),
    };
    if (!(event.key in actions)) return;
    event.preventDefault();
    actions[event.key]();
  }
}
