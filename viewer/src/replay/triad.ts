import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from 'three';

const axisColours = [0xd0342c, 0x2e9e4f, 0x2f6fde]; // x y z, as everywhere in robotics
const directions = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

// A coordinate frame as three arrows of the given length [m].
export function triad(length: number, opacity = 1): Group {
  const group = new Group();
  const radius = length * 0.035;
  const head = length * 0.22;
  const shaft = new CylinderGeometry(radius, radius, length - head).translate(0, (length - head) / 2, 0);
  const tip = new ConeGeometry(radius * 2.6, head, 16).translate(0, length - head / 2, 0);
  axisColours.forEach((color, axis) => {
    const material = new MeshBasicMaterial({ color, opacity, transparent: opacity < 1 });
    const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), directions[axis]);
    for (const geometry of [shaft, tip]) {
      const mesh = new Mesh(geometry, material);
      mesh.quaternion.copy(turn);
      group.add(mesh);
    }
  });
  return group;
}
