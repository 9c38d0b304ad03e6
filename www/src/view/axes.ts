import { Vector3 } from 'three';
import type { Camera } from 'three';

const AXES = [
  { name: 'x', direction: new Vector3(1, 0, 0) },
  { name: 'y', direction: new Vector3(0, 1, 0) },
  { name: 'z', direction: new Vector3(0, 0, 1) },
];
const LENGTH = 21;

/** Draws how the axes lie as seen by the camera. */
export function drawAxes(svg: SVGElement, camera: Camera): void {
  const drawn = AXES.map(({ name, direction }) => ({ name, at: direction.clone().transformDirection(camera.matrixWorldInverse) }));
  drawn.sort((a, b) => a.at.z - b.at.z);
  svg.innerHTML = drawn
    .map(({ name, at }) => {
      const [x, y] = [LENGTH * at.x, -LENGTH * at.y];
      const colour = `var(--view-${name})`;
      return `<line x2="${x.toFixed(1)}" y2="${y.toFixed(1)}" stroke="${colour}"/><text x="${(1.35 * x).toFixed(1)}" y="${(1.35 * y).toFixed(1)}" fill="${colour}">${name}</text>`;
    })
    .join('');
}
