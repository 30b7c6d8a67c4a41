import type { Fact, Metric, Requirement, Table } from '../data/format';
import { element } from '../dom';
import { numberText } from '../number_text';
import { documentId, verdictMark } from './header';

function section(id: string, title: string, ...content: (Node | null)[]): HTMLElement {
  return element('section', { id, class: 'card' }, element('h2', {}, title), ...content);
}

function headRow(...names: [string, string][]): HTMLElement {
  const cells = names.map(([text, kind]) => element('th', { scope: 'col', class: kind }, text));
  return element('thead', {}, element('tr', {}, ...cells));
}

export function requirementTable(requirements: Requirement[]): HTMLElement | null {
  if (requirements.length === 0) return null;
  const rows = requirements.map((r) =>
    element(
      'tr',
      { class: r.passed ? 'passed' : 'failed' },
      element('th', { scope: 'row' }, r.name),
      element('td', { class: 'number' }, numberText(r.value)),
      element('td', { class: 'number' }, r.limit),
      element('td', { class: 'unit' }, r.unit),
      element('td', { class: 'verdict' }, verdictMark(r.passed)),
    ),
  );
  const head = headRow(
    ['Requirement', ''],
    ['Value', 'number'],
    ['Limit', 'number'],
    ['Unit', 'unit'],
    ['Verdict', 'verdict'],
  );
  const table = element('table', { class: 'requirements' }, head, element('tbody', {}, ...rows));
  return section('requirements', 'Requirements', table);
}

export function metricTables(metrics: Metric[]): HTMLElement | null {
  if (metrics.length === 0) return null;
  const names = [...new Set(metrics.map((m) => m.section))];
  const tables = names.map((name) => {
    const rows = metrics
      .filter((m) => m.section === name)
      .map((m) =>
        element(
          'tr',
          {},
          element('th', { scope: 'row' }, m.name),
          element('td', { class: 'number' }, numberText(m.value)),
          element('td', { class: 'unit' }, m.unit),
        ),
      );
    return element(
      'table',
      { class: 'metrics' },
      name ? element('caption', {}, name) : null,
      headRow(['Metric', ''], ['Value', 'number'], ['Unit', 'unit']),
      element('tbody', {}, ...rows),
    );
  });
  return section('metrics', 'Metrics', element('div', { class: 'table-columns' }, ...tables));
}

export function wordTables(tables: Table[]): HTMLElement[] {
  return tables.map((table, index) => {
    const rows = table.rows.map((row) =>
      element(
        'tr',
        { class: row.marked ? 'marked' : undefined },
        ...row.cells.map((cell) => element('td', {}, cell)),
      ),
    );
    const head = headRow(...table.columns.map((name): [string, string] => [name, '']));
    return section(
      `${table.first ? 'first-' : ''}table-${index + 1}`,
      table.title,
      table.caption ? element('p', { class: 'caption' }, table.caption) : null,
      element(
        'div',
        { class: 'words-frame', tabindex: 0 },
        element('table', { class: 'words' }, head, element('tbody', {}, ...rows)),
      ),
    );
  });
}

export function manifest(facts: Fact[], documents: Fact[]): HTMLElement | null {
  if (facts.length === 0 && documents.length === 0) return null;
  const rows = facts.map(({ name, text }) =>
    element('tr', {}, element('th', { scope: 'row' }, name), element('td', {}, text)),
  );
  const table = element('table', { class: 'manifest' }, element('tbody', {}, ...rows));
  const texts = documents.map(({ name, text }) =>
    element(
      'details',
      { id: documentId(name) },
      element('summary', {}, name),
      element('pre', { tabindex: 0 }, text),
    ),
  );
  return section('manifest', 'Manifest', facts.length > 0 ? table : null, ...texts);
}
