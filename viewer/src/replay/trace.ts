import { Color, type Object3D } from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import type { Poses } from '../data/recording';

// The way of a body through the world. `height` puts it on the floor.
export class Trace {
  readonly objects: Object3D[];
  private readonly past: LineSegments2;
  private readonly materials: { past: LineMaterial; whole: LineMaterial };
  // How many segments end at or before each row of the poses: gaps have none.
  private readonly segmentsUntil: number[] = [];

  constructor(poses: Poses, dashed: boolean, height?: number) {
    const points: number[] = [];
    const rows = poses.length / 7;
    for (let i = 0; i < rows; i++) {
      if (i > 0) {
        const ends = [i - 1, i].map((row) => [
          poses[7 * row],
          poses[7 * row + 1],
          height ?? poses[7 * row + 2],
        ]);
        if (ends.flat().every(Number.isFinite)) points.push(...ends.flat());
      }
      this.segmentsUntil.push(points.length / 6);
    }
    const line = (opacity: number, width: number) => {
      const geometry = new LineSegmentsGeometry().setPositions(points);
      const material = new LineMaterial({ linewidth: width, opacity, transparent: opacity < 1 });
      if (dashed) Object.assign(material, { dashed: true, dashSize: 0.02, gapSize: 0.014 });
      const segments = new LineSegments2(geometry, material);
      if (dashed) segments.computeLineDistances();
      return { segments, material };
    };
    const whole = line(0.3, 1.2);
    const past = line(1, 2.2);
    this.past = past.segments;
    this.objects = [whole.segments, past.segments];
    this.materials = { past: past.material, whole: whole.material };
  }

  setColour(colour: string): void {
    this.materials.past.color = new Color(colour);
    this.materials.whole.color = new Color(colour);
  }

  // Draws the part up to that row of the poses strong.
  show(row: number): void {
    this.past.geometry.instanceCount = this.segmentsUntil[row];
    this.past.visible = this.segmentsUntil[row] > 0;
  }
}
