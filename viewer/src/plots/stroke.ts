import type { Style } from '../data/format';

// How the role of a line shows: reference and commanded values take the darker shade of their
// channel, so that they stay visible on top of the measured line of the same channel.
export interface Stroke {
  dash: number[]; // [CSS px]; empty: solid
  width: number; // [CSS px]
  shade: 'plain' | 'strong';
}

const strokes: Record<Style, Stroke> = {
  measured: { dash: [], width: 1.6, shade: 'plain' },
  reference: { dash: [7, 4], width: 1.4, shade: 'strong' },
  estimated: { dash: [9, 3, 2, 3], width: 1.4, shade: 'plain' },
  commanded: { dash: [2, 3], width: 1.4, shade: 'strong' },
};

export function strokeOf(style: Style): Stroke {
  return strokes[style];
}

// Name of the style sheet's colour for a line.
export function colourName(style: Style, channel: number): string {
  return `series-${channel}${strokes[style].shade === 'strong' ? '-strong' : ''}`;
}
