import {
  BoxGeometry,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshStandardMaterial,
} from 'three';

const colour = 0xa8895a;

// A part of the surroundings, see-through so that it never hides the robot. Sizes in metres.
export function glassBox(size: [number, number, number]): Group {
  const box = new BoxGeometry(...size);
  const walls = new MeshStandardMaterial({
    color: colour,
    roughness: 0.8,
    transparent: true,
    opacity: 0.35,
    depthWrite: false,
  });
  const edges = new LineSegments(new EdgesGeometry(box), new LineBasicMaterial({ color: colour }));
  return new Group().add(new Mesh(box, walls), edges);
}
