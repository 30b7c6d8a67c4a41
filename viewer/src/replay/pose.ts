import { Quaternion, type Object3D } from 'three';
import { interpolated, type Bracket } from '../data/lookup';
import type { Poses } from '../data/recording';

const width = 7; // x y z qw qx qy qz
const from = new Quaternion();
const to = new Quaternion();

function readQuaternion(poses: Poses, row: number, q: Quaternion): void {
  const i = row * width + 3;
  q.set(poses[i + 1], poses[i + 2], poses[i + 3], poses[i]);
}

// Puts the object where the poses say it is at that time; hides it where they have a gap.
export function applyPose(object: Object3D, poses: Poses, at: Bracket): void {
  const fixed = poses.length === width;
  const where = fixed ? { index: 0, fraction: 0 } : at;
  for (let k = 0; k < 3; k++) object.position.setComponent(k, interpolated(poses, width, k, where));
  readQuaternion(poses, where.index, from);
  if (where.fraction > 0) {
    readQuaternion(poses, where.index + 1, to);
    from.slerp(to, where.fraction);
  }
  object.quaternion.copy(from);
  object.visible = Number.isFinite(object.position.x + from.w);
}
