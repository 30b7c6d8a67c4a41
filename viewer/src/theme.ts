// Colours live in the style sheet; whatever paints on a canvas reads them here. Print is always
// light.
export interface Theme {
  dark: boolean;
  text: string;
  muted: string;
  grid: string;
  axis: string;
  limit: string;
  series: { plain: string[]; strong: string[] }; // by channel
  phase: Record<'push' | 'contact' | 'hold' | 'fault', { fill: string; ink: string }>;
  scene: { background: string; floor: string; line: string; strongLine: string };
}

const channels = Array.from({ length: 6 }, (_, i) => `series-${i}`);

export function readTheme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
  const phase = (kind: string) => ({ fill: colour(`${kind}-fill`), ink: colour(`${kind}-ink`) });
  return {
    dark: colour('scheme') === 'dark',
    text: colour('text'),
    muted: colour('muted'),
    grid: colour('grid'),
    axis: colour('axis'),
    limit: colour('limit'),
    series: { plain: channels.map(colour), strong: channels.map((c) => colour(`${c}-strong`)) },
    phase: { push: phase('push'), contact: phase('contact'), hold: phase('hold'), fault: phase('fault') },
    scene: {
      background: colour('scene'),
      floor: colour('scene-floor'),
      line: colour('scene-line'),
      strongLine: colour('scene-strong-line'),
    },
  };
}

export function onThemeChange(listener: () => void): void {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', listener);
}
