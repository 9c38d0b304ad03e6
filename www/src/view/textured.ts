/** A textured soup and the proxy that its texture is from, as objects of the scene. */
import {
  BufferAttribute, BufferGeometry, CanvasTexture, Color, DoubleSide, InstancedMesh, Matrix4, Mesh, MeshBasicMaterial, MeshStandardMaterial,
  SphereGeometry, SRGBColorSpace,
} from 'three';
import type { Object3D } from 'three';
import type { ProxyGeometry, TexturedGeometry } from 'fast-winding';
import { boundsOf, diagonal } from '../bounds.ts';
import { token } from '../dom.ts';
import type { Picture } from '../picture.ts';
import { hueOf } from '../texture.ts';
import type { Seam } from '../texture.ts';
import { thickLines } from './lines.ts';
import type { Surroundings } from './part.ts';

const SEAM_PIXELS = 2;
const DRAWN_PIXELS = 5;
/** Radius of a ball at the end of a seam, as a part of the proxy's diagonal. */
const BALL = 0.005;
const ANISOTROPY = 8;
/** Of a proxy around something else that is shown. */
const SEEN_THROUGH = 0.3;

/** Each triangle shaded as it is, with its part of the picture on both sides. */
export function texturedMesh({ positions, indices, uvs }: TexturedGeometry, { canvas }: Picture, { origin, cut }: Surroundings): Mesh {
  const geometry = cornerGeometry(positions, indices, origin);
  geometry.setAttribute('uv', new BufferAttribute(uvs, 2));
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  map.anisotropy = ANISOTROPY;
  // What is marked on it lies before it.
  const behind = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
  return new Mesh(geometry, new MeshStandardMaterial({ map, side: DoubleSide, roughness: 0.9, metalness: 0, flatShading: true, clippingPlanes: cut, ...behind }));
}

/** The proxy with a colour for each chart. */
export function chartMesh({ positions, indices, charts }: ProxyGeometry, { origin, cut }: Surroundings): Mesh<BufferGeometry, MeshStandardMaterial> {
  const geometry = cornerGeometry(positions, indices, origin);
  const colours = new Float32Array(3 * indices.length);
  const known = new Map<number, number[]>();
  charts.forEach((chart, triangle) => {
    const colour = known.get(chart) ?? new Color().setHSL(hueOf(chart), 0.42, chart % 2 ? 0.6 : 0.7).toArray();
    known.set(chart, colour);
    for (let k = 0; k < 3; k++) colours.set(colour, 9 * triangle + 3 * k);
  });
  geometry.setAttribute('color', new BufferAttribute(colours, 3));
  const material = new MeshStandardMaterial({
    vertexColors: true,
    roughness: 0.9,
    flatShading: true,
    clippingPlanes: cut,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  return new Mesh(geometry, material);
}

/** A proxy around something that is shown too lets it be seen. */
export function letThrough({ material }: Mesh<BufferGeometry, MeshStandardMaterial>, isAround: boolean): void {
  material.transparent = isAround;
  material.opacity = isAround ? SEEN_THROUGH : 1;
  material.depthWrite = !isAround;
  material.needsUpdate = true;
}

/** Where the charts meet. */
export function seamLines(proxy: ProxyGeometry, { origin, cut }: Surroundings): Object3D[] {
  return proxy.seams.length > 0 ? [thickLines(places(proxy, proxy.seams, origin), '--view-seam', SEAM_PIXELS, cut)] : [];
}

/** What the person has drawn: seams, and the place where the next one starts. */
export function drawnSeams(proxy: ProxyGeometry, seams: readonly Seam[], start: number | undefined, { origin, cut }: Surroundings): Object3D[] {
  const objects: Object3D[] = [];
  const edges = seams.flatMap(({ chain }) => [...chain].slice(1).flatMap((vertex, k) => [chain[k], vertex]));
  if (edges.length > 0) objects.push(thickLines(places(proxy, edges, origin), '--view-chosen', DRAWN_PIXELS, cut));
  const ends = seams.flatMap(({ picks }) => picks);
  if (start !== undefined) ends.push(start);
  if (ends.length > 0) objects.push(balls(places(proxy, ends, origin), BALL * diagonal(boundsOf(proxy.positions))));
  for (const object of objects) object.renderOrder = 2;
  return objects;
}

function balls(centres: Float32Array, radius: number): InstancedMesh {
  const count = centres.length / 3;
  const mesh = new InstancedMesh(new SphereGeometry(radius, 16, 12), new MeshBasicMaterial({ color: token('--view-chosen') }), count);
  for (let k = 0; k < count; k++) mesh.setMatrixAt(k, new Matrix4().makeTranslation(centres[3 * k], centres[3 * k + 1], centres[3 * k + 2]));
  mesh.frustumCulled = false;
  return mesh;
}

/** Three vertices a triangle, relative to the scene. */
function cornerGeometry(positions: Float64Array, indices: Uint32Array, origin: Float64Array): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(places({ positions }, indices, origin), 3));
  geometry.computeVertexNormals();
  return geometry;
}

function places({ positions }: { readonly positions: Float64Array }, vertices: ArrayLike<number>, origin: Float64Array): Float32Array {
  const result = new Float32Array(3 * vertices.length);
  for (let k = 0; k < result.length; k++) result[k] = positions[3 * vertices[Math.floor(k / 3)] + (k % 3)] - origin[k % 3];
  return result;
}
