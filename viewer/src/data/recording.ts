// What the views draw: plain arrays, whatever they came from. A report decodes them from its own
// text (decode.ts); a live source would build and extend the same arrays.
import type { Lane, PhaseKind, Style } from './format';

export interface Series {
  name: string;
  style: Style;
  channel: number;
  t: Float64Array; // [s], ascending
  values: Float64Array; // NaN: gap
}

export interface Axes {
  quantity: string;
  unit: string;
  limits: { name: string; value: number }[];
  series: Series[];
}

export interface PathSeries {
  name: string;
  style: Style;
  channel: number;
  t: Float64Array;
  x: Float64Array;
  y: Float64Array;
}

export interface PathAxes {
  title: string;
  xLabel: string;
  yLabel: string;
  unit: string;
  series: PathSeries[];
}

export interface Group {
  title: string;
  caption: string;
  axes: Axes[];
  paths: PathAxes[];
  lanes: Lane[];
}

// Rows of x y z qw qx qy qz, one per time, or a single row for what never moves.
export type Poses = Float64Array;

export interface Replay {
  urdf: string;
  t: Float64Array;
  followedLink: string;
  bodies: { link: string; poses: Poses }[];
  joints: { name: string; angles: Float64Array }[];
  frames: { name: string; style: Style; poses: Poses }[];
  forces: { name: string; kind: PhaseKind; points: Float64Array; forces: Float64Array }[];
  objects: { name: string; size: [number, number, number]; poses: Poses }[];
}
