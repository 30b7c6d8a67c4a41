import type { Replay } from '../data/recording';
import type { FrameJson, SceneJson } from './live_format';

const arrowScale = 20; // force drawn half a metre long [N]
const restPose = [0, 0, 0, 1, 0, 0, 0];

function slices(count: number, first: number[]): Float64Array[] {
  return Array.from({ length: count }, () => Float64Array.from(first));
}

function spread(from: number[], to: Float64Array[]): void {
  to.forEach((row, i) => row.set(from.slice(i * row.length, (i + 1) * row.length)));
}

// A replay of one sample, which every frame that arrives overwrites.
export class LiveReplay {
  readonly replay: Replay;

  constructor(scene: SceneJson) {
    const bodies = slices(scene.bodies.length, restPose);
    const frames = slices(scene.frames.length, restPose);
    const objects = slices(scene.objects.length, restPose);
    const joints = slices(scene.joints.length, [0]);
    const points = slices(scene.forces.length, [0, 0, 0]);
    // Views take the scale of their arrows from the greatest force of a replay.
    const forces = slices(scene.forces.length, [arrowScale, 0, 0]);
    this.replay = {
      urdf: scene.urdf,
      t: new Float64Array(1),
      followedLink: scene.followed_link,
      bodies: scene.bodies.map((link, i) => ({ link, poses: bodies[i] })),
      joints: scene.joints.map((name, i) => ({ name, angles: joints[i] })),
      frames: scene.frames.map((frame, i) => ({ ...frame, poses: frames[i] })),
      forces: scene.forces.map((force, i) => ({ ...force, points: points[i], forces: forces[i] })),
      objects: scene.objects.map((object, i) => ({ ...object, poses: objects[i] })),
    };
  }

  // Nothing acts before a first frame has come.
  clearForces(): void {
    for (const { forces } of this.replay.forces) forces.fill(0);
  }

  take(frame: FrameJson): void {
    const { replay } = this;
    replay.t[0] = frame.t;
    spread(frame.bodies, replay.bodies.map((b) => b.poses));
    spread(frame.joints, replay.joints.map((j) => j.angles));
    spread(frame.frames, replay.frames.map((f) => f.poses));
    spread(frame.points, replay.forces.map((f) => f.points));
    spread(frame.forces, replay.forces.map((f) => f.forces));
    spread(frame.objects, replay.objects.map((o) => o.poses));
  }
}

