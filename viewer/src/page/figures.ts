import type { Phase } from '../data/format';
import type { Group } from '../data/recording';
import { element } from '../dom';
import { LanePlot } from '../plots/lane_plot';
import { PathPlot } from '../plots/path_plot';
import { phaseKey } from '../plots/phases';
import { TimePlot } from '../plots/time_plot';
import type { Theme } from '../theme';
import type { Timeline } from '../time/timeline';

// All groups of plots, and what drawing them together needs.
export class Figures {
  readonly sections: HTMLElement[];
  private readonly timePlots: TimePlot[] = [];
  private readonly drawnPlots: (PathPlot | LanePlot)[] = [];

  constructor(groups: Group[], phases: Phase[], timeline: Timeline) {
    this.sections = groups.map((group, index) => {
      const plots = group.axes.map((axes, i) => {
        const place = { first: i === 0 && group.lanes.length === 0, last: i === group.axes.length - 1 };
        return new TimePlot(axes, phases, timeline, place);
      });
      const paths = group.paths.map((path) => new PathPlot(path, timeline));
      const lanes =
        group.lanes.length > 0 ? new LanePlot(group.lanes, phases, timeline, plots.length === 0) : null;
      this.timePlots.push(...plots);
      this.drawnPlots.push(...paths, ...(lanes ? [lanes] : []));
      return element(
        'section',
        { id: `figure-${index + 1}`, class: 'card figure' },
        element(
          'div',
          { class: 'figure-head' },
          element('h2', {}, group.title),
          group.axes.length + group.lanes.length > 0 ? phaseKey(phases) : null,
        ),
        group.caption ? element('p', { class: 'caption' }, group.caption) : null,
        lanes?.root ?? null,
        ...plots.map((plot) => plot.root),
        ...paths.map((plot) => plot.root),
      );
    });
  }

  draw(theme: Theme, width: number, sharpness = 1): void {
    this.timePlots.forEach((plot) => plot.draw(theme, width, sharpness));
    this.drawnPlots.forEach((plot) => plot.draw(width));
  }

  resize(width: number): void {
    this.timePlots.forEach((plot) => plot.resize(width));
    this.drawnPlots.forEach((plot) => plot.draw(width));
  }
}
