import type { HeadlineFact, ReportJson } from '../data/format';
import { element, icon } from '../dom';

const check = 'M6.2 12.6 1.9 8.3l1.6-1.6 2.7 2.7 6.3-6.3 1.6 1.6z';
const cross = 'M3.4 1.9 8 6.5l4.6-4.6 1.5 1.5L9.5 8l4.6 4.6-1.5 1.5L8 9.5l-4.6 4.6-1.5-1.5L6.5 8 1.9 3.4z';

export function documentId(name: string): string {
  return `document-${name.replace(/[^A-Za-z0-9]+/g, '-')}`;
}

// Passed or failed, said in words and shape as well as in colour.
export function verdictMark(passed: boolean): HTMLElement {
  return element(
    'span',
    { class: `verdict-mark ${passed ? 'passed' : 'failed'}` },
    icon(passed ? check : cross),
    element('span', {}, passed ? 'Passed' : 'Failed'),
  );
}

// Goes to a document of the page and unfolds it.
function documentLink(text: string, name: string): HTMLElement {
  const link = element('a', { href: `#${documentId(name)}` }, text);
  link.addEventListener('click', () => {
    (document.getElementById(documentId(name)) as HTMLDetailsElement).open = true;
  });
  return link;
}

function headlineFacts(facts: HeadlineFact[]): HTMLElement {
  const rows = facts.map(({ name, text, document: opens }) =>
    element(
      'div',
      {},
      element('dt', {}, name),
      element('dd', {}, opens ? documentLink(text, opens) : text),
    ),
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
