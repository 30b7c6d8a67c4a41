import {
  BufferGeometry,
  Color,
  DirectionalLight,
  Float32BufferAttribute,
  Fog,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  PCFShadowMap,
  PerspectiveCamera,
  PlaneGeometry,
  Scene,
  ShadowMaterial,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Theme } from '../theme';

export const views = {
  oblique: { name: 'Oblique', from: new Vector3(1.15, -2.6, 0.75) },
  side: { name: 'Side', from: new Vector3(0, -3, 0.15) },
  front: { name: 'Front', from: new Vector3(3, 0, 0.15) },
  top: { name: 'Top', from: new Vector3(0, -0.01, 3.2) },
};
export type ViewName = keyof typeof views;

const gridSpacing = 0.5; // [m]
const gridHalf = 12; // [m]
const lookHeight = 0.42; // of the camera's target above the floor [m]

function grid(strong: boolean): LineSegments {
  const points: number[] = [];
  const count = gridHalf / gridSpacing;
  for (let i = -count; i <= count; i++) {
    const whole = (i * gridSpacing) % 1 === 0;
    if (whole !== strong) continue;
    const at = i * gridSpacing;
    points.push(at, -gridHalf, 0, at, gridHalf, 0, -gridHalf, at, 0, gridHalf, at, 0);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
  return new LineSegments(geometry, new LineBasicMaterial());
}

// Floor, light, camera: everything of the 3-D view that is not the robot. Drawn on request only.
export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(30, 1, 0.05, 60);
  readonly renderer: WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly sun = new DirectionalLight(0xffffff, 2.6);
  private readonly sky = new HemisphereLight(0xffffff, 0x9aa0a8, 2.2);
  private readonly lines = { weak: grid(false), strong: grid(true) };
  private readonly followed = new Vector3();
  private pending = false;
  private afterRender: () => void = () => undefined;

  // Throws if the browser has no WebGL 2.
  constructor() {
    // The drawing is kept so that the page can be printed.
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.camera.up.set(0, 0, 1);

    const floor = new Mesh(new PlaneGeometry(2 * gridHalf, 2 * gridHalf), new ShadowMaterial({ opacity: 0.22 }));
    floor.receiveShadow = true;
    floor.position.z = -0.002;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    const reach = 1.3; // around the followed body [m]
    Object.assign(this.sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, far: 12 });
    this.sun.shadow.radius = 4;
    this.scene.add(floor, this.lines.weak, this.lines.strong, this.sky, this.sun, this.sun.target);

    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.maxDistance = 25;
    this.controls.minDistance = 0.3;
    this.controls.addEventListener('change', () => this.requestRender());
    this.look('oblique');
  }

  onRender(listener: () => void): void {
    this.afterRender = listener;
  }

  setTheme(theme: Theme): void {
    const background = new Color(theme.scene.background);
    this.scene.background = background;
    this.scene.fog = new Fog(background, 5, 13);
    (this.lines.weak.material as LineBasicMaterial).color.set(theme.scene.line);
    (this.lines.strong.material as LineBasicMaterial).color.set(theme.scene.strongLine);
    this.requestRender();
  }

  setSize(width: number, height: number, pixelRatio: number): void {
    this.renderer.setPixelRatio(pixelRatio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.requestRender();
  }

  look(name: ViewName): void {
    const target = new Vector3(this.followed.x, this.followed.y, lookHeight);
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(views[name].from);
    this.controls.update();
    this.requestRender();
  }

  // Tells where the followed body is; the light stays with it, and the camera if asked to.
  follow(position: Vector3, withCamera: boolean): void {
    const moved = new Vector3(position.x - this.followed.x, position.y - this.followed.y, 0);
    this.followed.copy(position);
    this.sun.target.position.set(position.x, position.y, 0.3);
    this.sun.position.copy(this.sun.target.position).add(new Vector3(1.6, -1.2, 3.6));
    if (withCamera) {
      this.controls.target.add(moved);
      this.camera.position.add(moved);
    }
    this.requestRender();
  }

  // Brings the camera back to the followed body from wherever it was left.
  catchUp(): void {
    const target = new Vector3(this.followed.x, this.followed.y, this.controls.target.z);
    this.camera.position.add(target).sub(this.controls.target);
    this.controls.target.copy(target);
    this.controls.update();
    this.requestRender();
  }

  requestRender(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => this.render());
  }

  render(): void {
    this.pending = false;
    this.renderer.render(this.scene, this.camera);
    this.afterRender();
  }
}
