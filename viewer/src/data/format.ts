// The JSON inside a report, as report/report_json.cpp writes it. Columns of numbers are base64 of
// little-endian 32-bit floats; NaN is a gap. Times are listed once and referred to by index.

export type Style = 'measured' | 'reference' | 'estimated' | 'commanded';
export type PhaseKind = 'push' | 'contact' | 'hold' | 'fault';

export type TimesJson = { start: number; step: number; count: number } | { values: string };

export interface SeriesJson {
  name: string;
  style: Style;
  channel: number;
  time: number;
  values: string;
}

export interface AxesJson {
  quantity: string;
  unit: string;
  limits: { name: string; value: number }[];
  series: SeriesJson[];
}

export interface PathSeriesJson {
  name: string;
  style: Style;
  channel: number;
  time: number;
  x: string;
  y: string;
}

export interface PathAxesJson {
  title: string;
  x_label: string;
  y_label: string;
  unit: string;
  series: PathSeriesJson[];
}

export type Tone = 'quiet' | 'ready' | 'active' | 'warning' | 'bad';

export interface Lane {
  name: string;
  stretches: { start: number; end: number; word: string; tone: Tone }[];
}

export interface GroupJson {
  title: string;
  caption: string;
  axes: AxesJson[];
  paths: PathAxesJson[];
  lanes: Lane[];
}

export interface Phase {
  kind: PhaseKind;
  start: number;
  end: number;
  label: string;
}

export interface Requirement {
  name: string;
  value: number | null;
  limit: string;
  unit: string;
  passed: boolean;
}

export interface Metric {
  section: string;
  name: string;
  value: number | null;
  unit: string;
}

export interface Fact {
  name: string;
  text: string;
}

export interface HeadlineFact extends Fact {
  document: string; // name of the one it opens, or empty
}

export interface Table {
  title: string;
  caption: string;
  columns: string[];
  rows: { cells: string[]; marked: boolean }[];
  first: boolean; // before the figures
}

export interface ReplayJson {
  urdf: string;
  time: number;
  followed_link: string;
  bodies: { link: string; poses: string }[];
  joints: { name: string; angles: string }[];
  frames: { name: string; style: Style; poses: string }[];
  forces: { name: string; kind: PhaseKind; points: string; forces: string }[];
  objects: { name: string; size: [number, number, number]; moves: boolean; poses: string }[];
}

export interface ReportJson {
  format: number;
  title: string;
  subtitle: string;
  passed: boolean;
  verdict: string;
  start: number;
  end: number;
  headline: HeadlineFact[];
  requirements: Requirement[];
  metrics: Metric[];
  phases: Phase[];
  groups: GroupJson[];
  replay: ReplayJson | null;
  manifest: Fact[];
  documents: Fact[];
  tables: Table[];
  view: { start: number; end: number; at: number } | null;
  times: TimesJson[];
}
