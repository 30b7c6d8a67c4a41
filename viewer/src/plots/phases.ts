import type uPlot from 'uplot';
import type { Phase } from '../data/format';
import { element } from '../dom';
import type { Theme } from '../theme';

export const phaseNames = { push: 'Push', contact: 'Contact', hold: 'Hold', fault: 'Fault' } as const;

// Shades the phases behind the lines of a plot.
export function shadePhases(u: uPlot, phases: Phase[], theme: Theme): void {
  const { left, top, width, height } = u.bbox;
  u.ctx.save();
  u.ctx.beginPath();
  u.ctx.rect(left, top, width, height);
  u.ctx.clip();
  for (const phase of phases) {
    const from = u.valToPos(phase.start, 'x', true);
    const to = u.valToPos(phase.end, 'x', true);
    u.ctx.fillStyle = theme.phase[phase.kind].fill;
    // A phase of no length, an impact, still shows as a line.
    u.ctx.fillRect(from, top, Math.max(to - from, 2), height);
  }
  u.ctx.restore();
}

// Writes the phases' labels above a plot, where its padding leaves room for them.
export function labelPhases(u: uPlot, phases: Phase[], theme: Theme, fontSize: number): void {
  const { left, top, width } = u.bbox;
  const gap = fontSize * 0.6;
  u.ctx.save();
  u.ctx.font = `${fontSize}px system-ui, sans-serif`;
  u.ctx.textBaseline = 'bottom';
  u.ctx.textAlign = 'left';
  let free = left;
  for (const phase of phases) {
    const from = Math.max(u.valToPos(phase.start, 'x', true), left);
    const to = Math.min(u.valToPos(phase.end, 'x', true), left + width);
    const textWidth = u.ctx.measureText(phase.label).width;
    // A text may be longer than its phase. It gives way to the one before it as long as it still
    // begins within its phase, and to the end of the plot.
    const at = Math.min(Math.max(from, free), left + width - textWidth);
    if (to <= from || at > to || at < free) continue;
    u.ctx.fillStyle = theme.phase[phase.kind].ink;
    u.ctx.fillText(phase.label, at, top - fontSize * 0.2);
    free = at + textWidth + gap;
  }
  u.ctx.restore();
}

// What the shades mean.
export function phaseKey(phases: Phase[]): HTMLElement | null {
  const kinds = [...new Set(phases.map((phase) => phase.kind))];
  if (kinds.length === 0) return null;
  const entries = kinds.map((kind) =>
    element(
      'span',
      { class: 'phase-entry' },
      element('span', { class: `phase-swatch ${kind}` }),
      phaseNames[kind],
    ),
  );
  return element('div', { class: 'phase-key' }, 'Shaded:', ...entries);
}
