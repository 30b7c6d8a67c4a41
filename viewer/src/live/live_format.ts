import type { PhaseKind, Style } from '../data/format';

// What the tool's HTTP server sends, as experiment/live_scene.cpp writes it.

export interface SceneJson {
  title: string;
  subtitle: string;
  duration: number; // [s]
  urdf: string;
  followed_link: string;
  bodies: string[];
  joints: string[];
  frames: { name: string; style: Style }[];
  forces: { name: string; kind: PhaseKind }[];
  objects: { name: string; size: [number, number, number] }[];
  plots: { quantity: string; unit: string; series: string[] }[];
}

// One time: rows of the same things in the same order, one after the other.
export interface FrameJson {
  t: number; // [s]
  bodies: number[];
  joints: number[];
  frames: number[];
  points: number[];
  forces: number[];
  objects: number[];
  values: number[][]; // by plot
}
