import { element } from '../dom';
import { replayPanel } from '../replay/replay_panel';
import { onThemeChange, readTheme } from '../theme';
import { Timeline } from '../time/timeline';
import type { FrameJson, SceneJson } from './live_format';
import { LiveReplay } from './live_replay';
import { RollingPlot } from './rolling_plot';

const silence = 1000; // after which a run counts as ended or paused [ms]
const longestRun = 1e6; // [s]

type Status = 'waiting' | 'running' | 'ended' | 'gone';
const statusTexts: Record<Status, string> = {
  waiting: 'Waiting for a run',
  running: 'Running',
  ended: 'The run has ended or pauses',
  gone: 'ballbot view has ended',
};

// Shows a run as it happens: the newest state in 3-D, the last seconds as plots.
export function showLive(scene: SceneJson, events: EventSource, root: HTMLElement): void {
  const live = new LiveReplay(scene);
  const timeline = new Timeline(0, longestRun);
  const panel = replayPanel(live.replay, timeline, { traces: false });
  live.clearForces();
  panel.view?.refresh();

  const plots = scene.plots.map((p) => new RollingPlot(p.quantity, p.unit, p.series));
  const statusNode = element('strong', {});
  const time = element('dd', { class: 'live-time' }, '0.00 s');
  const header = element(
    'header',
    { class: 'report-header live' },
    element(
      'div',
      { class: 'heading' },
      element('div', { class: 'title-row' }, element('h1', {}, scene.title)),
      element('p', { class: 'subtitle' }, statusNode, ' · ', scene.subtitle),
    ),
    element('dl', { class: 'headline' }, element('div', {}, element('dt', {}, 'time'), time)),
  );
  const column = element(
    'div',
    { class: 'column' },
    element('section', { class: 'card figure' }, ...plots.map((plot) => plot.root)),
  );
  root.append(
    header,
    element('main', { class: 'report-main' }, element('aside', { class: 'side' }, panel.root), column),
  );

  const setStatus = (status: Status) => {
    statusNode.textContent = statusTexts[status];
    root.dataset.status = status;
  };
  setStatus('waiting');
  const draw = () => {
    const theme = readTheme();
    panel.view?.setTheme(theme);
    const width = Math.floor(plots[0]?.root.clientWidth ?? 0);
    if (width > 0) plots.forEach((plot) => plot.draw(theme, width));
  };
  draw();
  new ResizeObserver(draw).observe(column);
  onThemeChange(draw);

  let lastTime = -1;
  let silenceTimer = 0;
  events.onmessage = (message) => {
    const frame = JSON.parse(message.data as string) as FrameJson;
    if (frame.t < lastTime) plots.forEach((plot) => plot.clear()); // another run
    lastTime = frame.t;
    live.take(frame);
    panel.view?.refresh();
    plots.forEach((plot, i) => plot.add(frame.t, frame.values[i]));
    time.textContent = `${frame.t.toFixed(2)} of ${scene.duration} s`;
    root.dataset.time = String(frame.t);
    setStatus('running');
    window.clearTimeout(silenceTimer);
    silenceTimer = window.setTimeout(() => setStatus('ended'), silence);
  };
  events.onerror = () => {
    window.clearTimeout(silenceTimer);
    setStatus('gone'); // the browser tries again by itself
  };
  events.onopen = () => setStatus(lastTime < 0 ? 'waiting' : 'ended');
}
