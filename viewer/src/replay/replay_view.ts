import { Group, Vector3, type Object3D } from 'three';
import { bracket, type Bracket } from '../data/lookup';
import type { Replay } from '../data/recording';
import { element } from '../dom';
import type { Theme } from '../theme';
import type { Timeline } from '../time/timeline';
import { ForceArrow, greatestForce } from './force_arrow';
import { glassBox } from './glass_box';
import { applyPose } from './pose';
import { Robot } from './robot';
import { Stage, type ViewName } from './stage';
import { Trace } from './trace';
import { triad } from './triad';

export type Layer = 'forces' | 'frames' | 'traces';

const onFloor = 0.003; // traces lie just above the floor [m]

// The 3-D view of a replay: robot, surroundings, forces, frames and traces at the timeline's time.
export class ReplayView {
  readonly root = element('div', { class: 'scene' });
  readonly problems: string[];
  private readonly labels = element('div', { class: 'scene-labels' });
  private readonly stage = new Stage();
  private readonly robot: Robot;
  private readonly frames: { object: Group; index: number }[];
  private readonly objects: Object3D[];
  private readonly arrows: ForceArrow[];
  private readonly arrowLabels: HTMLElement[];
  private readonly traces: { trace: Trace; channel: number }[] = [];
  private readonly layers: Record<Layer, Object3D> = {
    forces: new Group(),
    frames: new Group(),
    traces: new Group(),
  };
  private readonly followed: Object3D;
  private following = true;

  // Throws if the browser has no WebGL 2.
  constructor(
    private readonly replay: Replay,
    private readonly timeline: Timeline,
  ) {
    const { scene } = this.stage;
    this.robot = new Robot(replay);
    this.problems = this.robot.problems;
    scene.add(...this.robot.parts);
    this.followed = this.robot.parts[
      Math.max(0, replay.bodies.findIndex((body) => body.link === replay.followedLink))
    ] ?? new Group();

    this.frames = replay.frames.map((frame, index) => ({
      object: frame.style === 'measured' ? triad(0.13) : triad(0.18, 0.45),
      index,
    }));
    this.layers.frames.add(triad(0.25), ...this.frames.map((frame) => frame.object));

    this.objects = replay.objects.map((object) => glassBox(object.size));

    const greatest = greatestForce(replay.forces);
    this.arrows = replay.forces.map((force) => new ForceArrow(force, greatest));
    this.arrowLabels = replay.forces.map(() => element('span', { class: 'force-label' }));
    this.labels.append(...this.arrowLabels);
    for (const arrow of this.arrows) this.layers.forces.add(arrow.group);

    this.addTraces();
    scene.add(...this.objects, ...Object.values(this.layers));

    this.root.append(this.stage.renderer.domElement, this.labels);
    this.stage.renderer.domElement.setAttribute('role', 'img');
    this.stage.renderer.domElement.setAttribute('aria-label', '3-D replay of the robot');
    this.stage.onRender(() => this.placeLabels());
    new ResizeObserver(() => this.fit()).observe(this.root);
    timeline.onTime(() => this.showTime());
    this.showTime();
  }

  setTheme(theme: Theme): void {
    this.arrows.forEach((arrow) => arrow.setTheme(theme));
    for (const { trace, channel } of this.traces) trace.setColour(theme.series.plain[channel]);
    this.stage.setTheme(theme);
  }

  look(name: ViewName): void {
    this.stage.look(name);
  }

  setFollowing(following: boolean): void {
    this.following = following;
    if (following) this.stage.catchUp();
  }

  showLayer(layer: Layer, shown: boolean): void {
    this.layers[layer].visible = shown;
    if (layer === 'forces') this.labels.hidden = !shown;
    this.stage.requestRender();
  }

  // Draws at once in that size [CSS px], for paper.
  drawOnPaper(width: number, height: number, sharpness: number): void {
    this.root.style.width = `${width}px`;
    this.root.style.height = `${height}px`;
    this.stage.setSize(width, height, sharpness);
    this.stage.render();
  }

  drawOnScreen(): void {
    this.root.style.width = this.root.style.height = '';
    this.fit();
  }

  // The followed body leaves its way on the floor, every frame its own through space.
  private addTraces(): void {
    const { replay } = this;
    const body = replay.bodies.find((b) => b.link === replay.followedLink);
    if (body) this.traces.push({ trace: new Trace(body.poses, false, onFloor), channel: 0 });
    for (const frame of replay.frames) {
      const trace = new Trace(frame.poses, frame.style !== 'measured');
      this.traces.push({ trace, channel: 1 });
    }
    for (const { trace } of this.traces) this.layers.traces.add(...trace.objects);
  }

  // Shows what the replay holds now, after it was written to.
  refresh(): void {
    this.showTime();
  }

  private showTime(): void {
    const at = bracket(this.replay.t, this.timeline.time);
    this.robot.show(at);
    this.frames.forEach(({ object, index }) => applyPose(object, this.replay.frames[index].poses, at));
    this.objects.forEach((mesh, i) => applyPose(mesh, this.replay.objects[i].poses, at));
    this.traces.forEach(({ trace }) => trace.show(at.index));
    this.showForces(at);
    this.stage.follow(this.followed.position, this.following);
  }

  private showForces(at: Bracket): void {
    this.arrows.forEach((arrow, i) => {
      arrow.show(at);
      const label = this.arrowLabels[i];
      label.hidden = !arrow.group.visible;
      label.textContent = `${this.replay.forces[i].name} ${arrow.magnitude.toFixed(1)} N`;
    });
  }

  private fit(): void {
    const { clientWidth, clientHeight } = this.root;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.stage.setSize(clientWidth, clientHeight, Math.min(devicePixelRatio, 2));
  }

  // Keeps each force's label at the tail of its arrow and inside the view.
  private placeLabels(): void {
    const { clientWidth, clientHeight } = this.root;
    this.arrows.forEach((arrow, i) => {
      const label = this.arrowLabels[i];
      if (label.hidden) return;
      const at = new Vector3().copy(arrow.tail).project(this.stage.camera);
      const x = (0.5 + at.x / 2) * clientWidth - label.offsetWidth / 2;
      const y = (0.5 - at.y / 2) * clientHeight - label.offsetHeight - 6;
      const left = Math.min(Math.max(x, 4), clientWidth - label.offsetWidth - 4);
      const top = Math.min(Math.max(y, 4), clientHeight - label.offsetHeight - 4);
      label.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
    });
  }
}
