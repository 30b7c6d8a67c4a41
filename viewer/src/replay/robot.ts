import { Mesh, MeshPhongMaterial, MeshStandardMaterial, type Object3D } from 'three';
import URDFLoader, { type URDFRobot } from 'urdf-loader';
import { interpolated, type Bracket } from '../data/lookup';
import type { Replay } from '../data/recording';
import { applyPose } from './pose';

// Materials that take light like painted metal, in the colours of the URDF.
function paint(robot: Object3D): void {
  robot.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    node.castShadow = true;
    node.receiveShadow = true;
    const old = node.material as MeshPhongMaterial;
    // A URDF gives the colour as a screen shows it; three computes with linear light.
    const color = old.color.clone().convertSRGBToLinear();
    node.material = new MeshStandardMaterial({
      color,
      roughness: 0.55,
      metalness: 0.1,
      transparent: old.transparent,
      opacity: old.opacity,
    });
  });
}

// The robot of a URDF, moved by a replay: free bodies by their poses, the rest by joint angles.
export class Robot {
  readonly parts: Object3D[] = [];
  readonly problems: string[] = [];
  private readonly robot: URDFRobot;

  constructor(private readonly replay: Replay) {
    const loader = new URDFLoader();
    let meshes = 0;
    loader.loadMeshCb = () => {
      meshes++;
    };
    this.robot = loader.parse(replay.urdf);
    if (meshes > 0) {
      this.problems.push(`${meshes} mesh files of the URDF are not shown: a report is one file.`);
    }
    for (const { link } of replay.bodies) {
      const part = this.robot.links[link];
      if (part) this.parts.push(part);
      else this.problems.push(`The URDF has no link '${link}'.`);
    }
    // A free body hangs on nothing but the world.
    for (const part of this.parts) part.removeFromParent();
    for (const { name } of replay.joints) {
      const joint = this.robot.joints[name];
      if (joint) joint.ignoreLimits = true; // what was recorded is shown, whatever the limits say
      else this.problems.push(`The URDF has no joint '${name}'.`);
    }
    this.parts.forEach(paint);
  }

  show(at: Bracket): void {
    for (const { name, angles } of this.replay.joints) {
      this.robot.joints[name]?.setJointValue(interpolated(angles, 1, 0, at));
    }
    for (const { link, poses } of this.replay.bodies) {
      const part = this.robot.links[link];
      if (part) applyPose(part, poses, at);
    }
  }
}
