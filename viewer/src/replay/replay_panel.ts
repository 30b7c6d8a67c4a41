import { element, icon } from '../dom';
import type { Replay } from '../data/recording';
import type { Timeline } from '../time/timeline';
import { ReplayView, type Layer } from './replay_view';
import { views, type ViewName } from './stage';

const layers: { layer: Layer; name: string; has: (replay: Replay) => boolean }[] = [
  { layer: 'forces', name: 'Forces', has: (replay) => replay.forces.length > 0 },
  { layer: 'frames', name: 'Frames', has: () => true },
  { layer: 'traces', name: 'Traces', has: () => true },
];
const expandIcon = 'M2 2h5v2H4v3H2zM9 2h5v5h-2V4H9zM2 9h2v3h3v2H2zM12 9h2v5H9v-2h3z';

function toggle(name: string, title: string, onChange: (on: boolean) => void): HTMLButtonElement {
  const button = element('button', { type: 'button', class: 'toggle', 'aria-pressed': 'true', title }, name);
  button.addEventListener('click', () => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(on));
    onChange(on);
  });
  return button;
}

function frameKey(replay: Replay): HTMLElement {
  const frames = replay.frames.map((frame) =>
    frame.style === 'measured' ? `${frame.name} (solid)` : `${frame.name} (pale)`,
  );
  const all = ['world', ...frames].join(', ');
  const text = `Frames: ${all}; x red, y green, z blue. Grid 0.5 m.`;
  return element('p', { class: 'scene-note' }, text);
}

export interface ReplayPanel {
  root: HTMLElement;
  view: ReplayView | null; // nothing without WebGL 2
}

// The 3-D view with what switches it. A layer that is not offered has no switch.
export function replayPanel(
  replay: Replay,
  timeline: Timeline,
  offered: Partial<Record<Layer, boolean>> = {},
): ReplayPanel {
  let view: ReplayView;
  try {
    view = new ReplayView(replay, timeline);
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    const text = `This browser cannot draw the 3-D replay, which needs WebGL 2: ${reason}`;
    const notice = element('p', { class: 'notice' }, text);
    return { root: element('div', { class: 'scene-panel' }, notice), view: null };
  }
  const root = element('div', { class: 'scene-panel' });
  const camera = element('select', { 'aria-label': 'View', title: 'View' });
  for (const [name, { name: text }] of Object.entries(views)) {
    camera.append(element('option', { value: name }, text));
  }
  camera.addEventListener('change', () => view.look(camera.value as ViewName));
  const expand = element(
    'button',
    { type: 'button', class: 'expand', title: 'Full screen', 'aria-label': 'Full screen' },
    icon(expandIcon),
  );
  expand.addEventListener('click', () => {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void root.requestFullscreen();
  });
  const tools = element(
    'div',
    { class: 'scene-tools' },
    toggle('Follow', 'The camera moves with the robot', (on) => view.setFollowing(on)),
    ...layers
      .filter(({ layer, has }) => has(replay) && offered[layer] !== false)
      .map(({ layer, name }) => toggle(name, `Show ${name.toLowerCase()}`, (on) => view.showLayer(layer, on))),
    camera,
    expand,
  );
  root.append(view.root, tools, frameKey(replay));
  for (const problem of view.problems) root.append(element('p', { class: 'notice' }, problem));
  return { root, view };
}
