import { BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshBasicMaterial, MeshStandardMaterial, Points, PointsMaterial } from 'three';
import type { Object3D } from 'three';
import { token } from '../dom.ts';
import type { Located, Place } from '../places.ts';
import { thickLines } from './lines.ts';

const LINE_PIXELS = 4;
const OUTLINE_PIXELS = 1.5;
const MOST_OUTLINED = 1000;
const POINT_PIXELS = 9;
/** Of what lies behind the model. */
const SEEN_THROUGH = 0.3;

/** Places on the model in colour, also where the model hides them. */
export function defectObjects(places: readonly Place[], { positions, indices }: Located, colourToken: string): Object3D[] {
  const objects: Object3D[] = [];
  const corners = places.flatMap(({ faces }) => faces).flatMap((face) => [...indices!.subarray(3 * face, 3 * face + 3)]);
  if (corners.length > 0) {
    objects.push(...twice((isThrough) => faceMesh(corners, positions, colourToken, isThrough)));
    // Faces without area are seen by their edges alone; of many faces these would hide the shape.
    if (corners.length <= 3 * MOST_OUTLINED) {
      const ends = edgesOf(corners, positions);
      objects.push(...twice((isThrough) => lines(ends, colourToken, OUTLINE_PIXELS, isThrough)));
    }
  }
  const ends = places.flatMap((place) => place.lines);
  if (ends.length > 0) objects.push(...twice((isThrough) => lines(new Float32Array(ends), colourToken, LINE_PIXELS, isThrough)));
  const spots = places.flatMap((place) => place.points);
  if (spots.length > 0) objects.push(...twice((isThrough) => dots(new Float32Array(spots), colourToken, isThrough)));
  return objects;
}

function twice(make: (isThrough: boolean) => Object3D): Object3D[] {
  return [make(false), make(true)].map((object, k) => {
    object.renderOrder = 3 + k;
    return object;
  });
}

function seen(isThrough: boolean): { transparent: boolean; opacity: number; depthTest: boolean; depthWrite: boolean } {
  return { transparent: isThrough, opacity: isThrough ? SEEN_THROUGH : 1, depthTest: !isThrough, depthWrite: false };
}

function faceMesh(corners: readonly number[], positions: Float32Array, colourToken: string, isThrough: boolean): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(corners), 1));
  const colour = { color: token(colourToken), side: DoubleSide, ...seen(isThrough) };
  return new Mesh(geometry, isThrough ? new MeshBasicMaterial(colour) : new MeshStandardMaterial({ ...colour, flatShading: true, roughness: 0.9 }));
}

function lines(ends: Float32Array, colourToken: string, pixels: number, isThrough: boolean): Object3D {
  const object = thickLines(ends, colourToken, pixels);
  Object.assign(object.material, seen(isThrough));
  return object;
}

function dots(places: Float32Array, colourToken: string, isThrough: boolean): Points {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(places, 3));
  return new Points(geometry, new PointsMaterial({ color: token(colourToken), size: POINT_PIXELS, sizeAttenuation: false, ...seen(isThrough) }));
}

/** The sides of triangles as segments. */
function edgesOf(corners: readonly number[], positions: Float32Array): Float32Array {
  const ends = new Float32Array(6 * corners.length);
  corners.forEach((from, k) => {
    const to = corners[k % 3 === 2 ? k - 2 : k + 1];
    ends.set(positions.subarray(3 * from, 3 * from + 3), 6 * k);
    ends.set(positions.subarray(3 * to, 3 * to + 3), 6 * k + 3);
  });
  return ends;
}
