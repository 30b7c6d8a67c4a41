import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from 'three';
import type { PhaseKind } from '../data/format';
import { interpolated, type Bracket } from '../data/lookup';
import type { Replay } from '../data/recording';
import type { Theme } from '../theme';

const longest = 0.5; // the greatest force of a run [m]
const smallestShown = 0.01; // of the greatest force: below that it is noise
const headLength = 0.07;
const up = new Vector3(0, 1, 0);

type Force = Replay['forces'][number];

// The greatest magnitude among the forces of a run [N]; all arrows share one scale.
export function greatestForce(forces: Force[]): number {
  let greatest = 0;
  for (const { forces: f } of forces) {
    for (let i = 0; i < f.length; i += 3) {
      const size = Math.hypot(f[i], f[i + 1], f[i + 2]);
      if (size > greatest) greatest = size; // NaN compares false
    }
  }
  return greatest;
}

// A force as an arrow whose tip is where it acts.
export class ForceArrow {
  readonly group = new Group();
  readonly tail = new Vector3(); // where its label belongs, in the world [m]
  magnitude = 0; // [N]
  readonly kind: PhaseKind;
  private readonly material = new MeshBasicMaterial();
  private readonly shaft: Mesh;
  private readonly metresPerNewton: number;

  constructor(
    private readonly force: Force,
    private readonly greatest: number,
  ) {
    this.kind = force.kind;
    this.metresPerNewton = greatest > 0 ? longest / greatest : 0;
    // Both parts point along +y, the tip of the head at the origin.
    const head = new Mesh(
      new ConeGeometry(0.026, headLength, 20).translate(0, -headLength / 2, 0),
      this.material,
    );
    this.shaft = new Mesh(
      new CylinderGeometry(0.011, 0.011, 1, 16).translate(0, -0.5, 0),
      this.material,
    );
    this.shaft.position.y = -headLength * 0.9;
    this.group.add(head, this.shaft);
  }

  setTheme(theme: Theme): void {
    this.material.color.set(theme.phase[this.kind].ink);
  }

  show(at: Bracket): void {
    const read = (rows: Float64Array) =>
      new Vector3(...[0, 1, 2].map((k) => interpolated(rows, 3, k, at)));
    const f = read(this.force.forces);
    this.magnitude = f.length();
    // Also false for a gap.
    this.group.visible = this.magnitude > smallestShown * this.greatest;
    if (!this.group.visible) return;
    const length = Math.max(this.magnitude * this.metresPerNewton, headLength * 1.1);
    this.group.position.copy(read(this.force.points));
    this.group.quaternion.setFromUnitVectors(up, f.clone().normalize());
    this.shaft.scale.y = length - headLength * 0.9;
    this.tail.copy(this.group.position).addScaledVector(f, -length / this.magnitude);
  }
}
