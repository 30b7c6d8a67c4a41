import type { Style } from '../data/format';
import { element, svg } from '../dom';
import { colourName, strokeOf } from './stroke';

interface Line {
  name: string;
  style: Style;
  channel: number;
}

function sample(line: Line): SVGSVGElement {
  const stroke = strokeOf(line.style);
  const path = svg('path', {
    d: 'M0 5H26',
    style:
      `stroke: var(--${colourName(line.style, line.channel)});` +
      `stroke-width: ${stroke.width + 0.6}; stroke-dasharray: ${stroke.dash.join(' ') || 'none'}`,
  });
  return svg('svg', { viewBox: '0 0 26 10', width: 26, height: 10, 'aria-hidden': 'true' }, path);
}

// The lines of one pair of axes: each a button that shows or hides its line, with the line's value
// at the cursor.
export class Legend {
  readonly root = element('div', { class: 'legend' });
  private values: HTMLElement[] = [];

  constructor(lines: Line[], onToggle: (index: number, shown: boolean) => void) {
    lines.forEach((line, index) => {
      const value = element('span', { class: 'legend-value' });
      const button = element(
        'button',
        { type: 'button', class: 'legend-line', 'aria-pressed': 'true', title: 'Show or hide' },
        sample(line),
        element('span', {}, line.name),
        value,
      );
      button.addEventListener('click', () => {
        const shown = button.getAttribute('aria-pressed') !== 'true';
        button.setAttribute('aria-pressed', String(shown));
        onToggle(index, shown);
      });
      this.values.push(value);
      this.root.append(button);
    });
  }

  addLimit(text: string): void {
    const mark = svg('path', { d: 'M0 5H26', class: 'limit-line' });
    this.root.append(
      element(
        'span',
        { class: 'legend-line' },
        svg('svg', { viewBox: '0 0 26 10', width: 26, height: 10, 'aria-hidden': 'true' }, mark),
        element('span', {}, text),
      ),
    );
  }

  setValues(values: string[]): void {
    values.forEach((value, i) => {
      this.values[i].textContent = value;
    });
  }
}
