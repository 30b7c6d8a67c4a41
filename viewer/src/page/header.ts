import type { Fact, ReportJson } from '../data/format';
import { element, icon } from '../dom';

const check = 'M6.2 12.6 1.9 8.3l1.6-1.6 2.7 2.7 6.3-6.3 1.6 1.6z';
const cross = 'M3.4 1.9 8 6.5l4.6-4.6 1.5 1.5L9.5 8l4.6 4.6-1.5 1.5L8 9.5l-4.6 4.6-1.5-1.5L6.5 8 1.9 3.4z';

// Passed or failed, said in words and shape as well as in colour.
export function verdictMark(passed: boolean): HTMLElement {
  return element(
    'span',
    { class: `verdict-mark ${passed ? 'passed' : 'failed'}` },
    icon(passed ? check : cross),
    element('span', {}, passed ? 'Passed' : 'Failed'),
  );
}

function headlineFacts(facts: Fact[]): HTMLElement {
  const rows = facts.map(({ name, text }) =>
    element('div', {}, element('dt', {}, name), element('dd', {}, text)),
  );
  return element('dl', { class: 'headline' }, ...rows);
}

export function header(report: ReportJson): HTMLElement {
  return element(
    'header',
    { class: `report-header ${report.passed ? 'passed' : 'failed'}` },
    element(
      'div',
      { class: 'heading' },
      element(
        'div',
        { class: 'title-row' },
        verdictMark(report.passed),
        element('h1', {}, report.title),
      ),
      element(
        'p',
        { class: 'subtitle' },
        element('strong', {}, report.verdict),
        report.verdict && report.subtitle ? ' · ' : null,
        report.subtitle,
      ),
    ),
    headlineFacts(report.headline),
  );
}
