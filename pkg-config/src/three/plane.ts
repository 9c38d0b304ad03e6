// A plane of the field, as `heatMap` gives it, to be drawn where it lies.
import type { BufferGeometry, DataTexture } from 'three';
import type { HeatMap } from '../api.js';
import type { ThreeGeometry, ThreeTexture } from './module.js';

/** What the texture holds. */
export interface PlaneTextureOptions {
  /** Red, green, blue and perhaps opacity for a winding number, from 0 to 255, in sRGB. */
  colour?: (w: number) => readonly [number, number, number, number?];
}

/**
 * The values as a texture, a texel for each sample: winding numbers as 32-bit floats in the red channel, for a shader of your own, or
 * as colours. It fits {@link planeGeometry}.
 */
export function planeTexture(THREE: ThreeTexture, { counts, values }: HeatMap, { colour }: PlaneTextureOptions = {}): DataTexture {
  const [width, height] = counts;
  const texture = colour
    ? new THREE.DataTexture(coloured(values, colour), width, height, THREE.RGBAFormat, THREE.UnsignedByteType)
    : new THREE.DataTexture(Float32Array.from(values), width, height, THREE.RedFormat, THREE.FloatType);
  if (colour) texture.colorSpace = THREE.SRGBColorSpace;
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.wrapS = texture.wrapT = THREE.ClampToEdgeWrapping;
  texture.needsUpdate = true;
  return texture;
}

function coloured(values: Float64Array, colour: NonNullable<PlaneTextureOptions['colour']>): Uint8Array<ArrayBuffer> {
  const texels = new Uint8Array(4 * values.length);
  values.forEach((w, i) => {
    const [red, green, blue, opacity = 255] = colour(w);
    texels.set([red, green, blue, opacity], 4 * i);
  });
  return texels;
}

/** The plane in space, facing up, with texture coordinates: samples lie in the middles of texels, so it reaches half a step beyond them. */
export function planeGeometry(THREE: ThreeGeometry, { counts, origin, spacing, z }: HeatMap): BufferGeometry {
  const corner = (u: 0 | 1, v: 0 | 1) => [origin[0] + (u * counts[0] - 0.5) * spacing[0], origin[1] + (v * counts[1] - 0.5) * spacing[1], z];
  const positions = new Float32Array([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)].flat());
  const attribute = (array: Float32Array<ArrayBuffer>, size: number) => new THREE.BufferAttribute(array, size);
  return new THREE.BufferGeometry()
    .setAttribute('position', attribute(positions, 3))
    .setAttribute('normal', attribute(new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1]), 3))
    .setAttribute('uv', attribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2))
    .setIndex([0, 1, 2, 0, 2, 3]);
}
