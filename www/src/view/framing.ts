import { Vector3 } from 'three';
import type { PerspectiveCamera } from 'three';

/** An axis-aligned box in the scene's coordinates. */
export interface Box {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

export type Direction = 'corner' | 'top' | 'front' | 'side';

/** From the target towards the camera; `top` leans a little, as "up" is undefined along z. */
const DIRECTIONS: Record<Direction, Vector3> = {
  corner: new Vector3(0.5, -1, 0.55),
  top: new Vector3(0, -1e-3, 1),
  front: new Vector3(0, -1, 0),
  side: new Vector3(1, 0, 0),
};
/** Part of a direction that is level, at least. */
const LEAST_LEVEL = 0.3;
/** Room left around the box. */
const MARGIN = 1.07;

export interface CameraPlace {
  readonly position: Vector3;
  readonly target: Vector3;
  readonly near: number;
  readonly far: number;
}

/** The nearest place from which all corners of the box are in view. */
export function cameraFor(box: Box, camera: PerspectiveCamera, target: Vector3, direction?: Direction | Vector3): CameraPlace {
  const centre = new Vector3(...box.min).add(new Vector3(...box.max)).multiplyScalar(0.5);
  const given = typeof direction === 'string' ? DIRECTIONS[direction] : direction;
  const back = given ? given.clone() : new Vector3().subVectors(camera.position, target);
  if (back.lengthSq() === 0) back.copy(DIRECTIONS.corner);
  back.normalize();
  const right = new Vector3().crossVectors(camera.up, back).normalize();
  const up = new Vector3().crossVectors(back, right);

  const tanY = Math.tan((camera.fov * Math.PI) / 360) / MARGIN;
  const tanX = tanY * camera.aspect;
  let distance = 0;
  for (const corner of cornersOf(box)) {
    corner.sub(centre);
    const reach = Math.max(Math.abs(corner.dot(right)) / tanX, Math.abs(corner.dot(up)) / tanY);
    distance = Math.max(distance, reach + corner.dot(back));
  }
  const radius = Math.max(1e-6, new Vector3(...box.max).sub(centre).length());
  distance = Math.max(distance, radius * 1e-3);
  return {
    position: centre.clone().addScaledVector(back, distance),
    target: centre,
    near: Math.max(distance, radius) / 500,
    far: (distance + radius) * 20,
  };
}

/** Where to look from at what faces that way: aslant, as the camera is, if straight up or down; "up" is undefined there. */
export function sideOf(facing: readonly number[], arm: Vector3): Vector3 {
  const side = new Vector3(facing[0], facing[1], facing[2]).normalize();
  const level = Math.hypot(side.x, side.y);
  if (level >= LEAST_LEVEL) return side;
  const across = new Vector3(arm.x, arm.y, 0);
  if (across.lengthSq() === 0) across.copy(DIRECTIONS.front);
  return side.addScaledVector(across.normalize(), LEAST_LEVEL);
}

function cornersOf({ min, max }: Box): Vector3[] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map(
    (bits) => new Vector3(bits & 1 ? max[0] : min[0], bits & 2 ? max[1] : min[1], bits & 4 ? max[2] : min[2]),
  );
}
