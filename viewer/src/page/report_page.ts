import { decodeGroups, decodeReplay } from '../data/decode';
import type { ReportJson } from '../data/format';
import { element } from '../dom';
import { replayPanel } from '../replay/replay_panel';
import { onThemeChange, readTheme } from '../theme';
import { Timeline } from '../time/timeline';
import { Transport } from '../time/transport';
import { Figures } from './figures';
import { header } from './header';
import { onPrint, paperSceneHeight, paperSharpness, paperWidth } from './printing';
import { manifest, metricTables, requirementTable, wordTables } from './tables';

// A browser may show a page before its window has a size; plots wait for room to draw in [CSS px].
const narrowest = 100;

// Width that the plots of a column have [CSS px].
function plotWidth(column: HTMLElement): number {
  const figure = column.querySelector('.plot');
  return Math.floor(figure?.clientWidth ?? column.clientWidth);
}

// Builds the whole page from its data and keeps its views together.
export function showReport(report: ReportJson, root: HTMLElement): void {
  const timeline = new Timeline(report.start, report.end);
  if (report.view) {
    timeline.setWindow(report.view.start, report.view.end);
    timeline.setTime(report.view.at);
  }
  const figures = new Figures(decodeGroups(report), report.phases, timeline);
  const transport = new Transport(timeline, report.phases);
  const replay = report.replay
    ? replayPanel(decodeReplay(report.replay, report.times), timeline)
    : null;

  const column = element(
    'div',
    { class: 'column' },
    requirementTable(report.requirements),
    ...wordTables(report.tables.filter((table) => table.first)),
    ...figures.sections,
    ...wordTables(report.tables.filter((table) => !table.first)),
    metricTables(report.metrics),
    manifest(report.manifest, report.documents),
  );
  const side = element('aside', { class: 'side' }, replay?.root ?? null, transport.root);
  const main = element('main', { class: replay ? 'report-main' : 'report-main no-replay' }, side, column);
  root.append(header(report), main);

  let drawnWidth = 0;
  const draw = () => {
    const theme = readTheme();
    replay?.view?.setTheme(theme);
    const width = plotWidth(column);
    if (width < narrowest) return;
    figures.draw(theme, width);
    drawnWidth = width;
  };
  const fit = () => {
    const width = plotWidth(column);
    const printing = document.documentElement.classList.contains('printing');
    if (width === drawnWidth || width < narrowest || printing) return;
    if (drawnWidth === 0) draw();
    else figures.resize(width);
    drawnWidth = width;
  };
  draw();
  new ResizeObserver(fit).observe(column);
  onThemeChange(draw);
  const drawOnPaper = () => {
    const theme = readTheme();
    figures.draw(theme, paperWidth, paperSharpness);
    replay?.view?.setTheme(theme);
    replay?.view?.drawOnPaper(paperWidth, paperSceneHeight, paperSharpness);
  };
  onPrint(drawOnPaper, () => {
    draw();
    replay?.view?.drawOnScreen();
  });
}
