import type { BufferGeometry } from 'three';
import type { Layer } from '../api.js';
import type { ThreeGeometry } from './module.js';

/** Where contours are drawn. */
export interface ContourOptions {
  /** The height at which contours are drawn: where the layer was sampled unless said otherwise. */
  at?: 'zBottom' | 'zSample' | 'zTop';
  /** Subtracted before coordinates become 32-bit floats: for models far from the origin. */
  origin?: ArrayLike<number>;
}

/** The contours of layers as lines, for `THREE.LineSegments`: each vertex once, two indices for each side of a ring. */
export function contourGeometry(THREE: ThreeGeometry, layers: readonly Layer[], { at = 'zSample', origin = [0, 0, 0] }: ContourOptions = {}): BufferGeometry {
  const rings = layers.flatMap((layer) =>
    layer.polygons.flatMap(({ outer, holes }) => [outer, ...holes].map((ring) => ({ ring, z: layer[at] - origin[2]! }))),
  );
  const count = rings.reduce((sum, { ring }) => sum + ring.length / 2, 0);
  const positions = new Float32Array(3 * count);
  const indices = new Uint32Array(2 * count);
  let vertex = 0;
  for (const { ring, z } of rings) {
    const [first, sides] = [vertex, ring.length / 2];
    for (let side = 0; side < sides; side++, vertex++) {
      positions.set([ring[2 * side]! - origin[0]!, ring[2 * side + 1]! - origin[1]!, z], 3 * vertex);
      indices.set([vertex, first + ((side + 1) % sides)], 2 * vertex);
    }
  }
  return new THREE.BufferGeometry()
    .setAttribute('position', new THREE.BufferAttribute(positions, 3))
    .setIndex(new THREE.BufferAttribute(indices, 1));
}
