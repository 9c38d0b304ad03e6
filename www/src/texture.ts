/** A texture of the model, by a proxy around it, and the seams that the proxy is cut along. */
import type { AffectedTriangles, AtlasOptions, FieldLines, ProxyGeometry, ProxyOptions, Soup, Texture, TexturedGeometry, TextureReport } from 'fast-winding';

/** The proxy, and how it is cut and laid flat. */
export type Mapping = ProxyOptions & Omit<AtlasOptions, 'seams'>;

/** A cut through places of the proxy, two at least. */
export interface Seam {
  /** Vertices of the proxy. */
  readonly picks: readonly number[];
  /** From the first to the last along edges, through the others. */
  readonly chain: Uint32Array;
  /** What it was before it was led on to the last of the places. */
  readonly before?: Seam;
}

/** By what a texture is made again as it is. */
export interface TextureRecipe {
  /** With what it was made first: its field lines are from there. */
  readonly first: Mapping;
  /** Whether triangles were split before that cross. */
  readonly refine: boolean;
  /** How it is mapped. */
  readonly mapping: Mapping;
  /** Those that its charts were cut along, of those that were drawn. */
  readonly seams: readonly Seam[];
}

export interface Texturing extends TextureRecipe {
  /** What has the texture. */
  readonly source: Soup;
  readonly handle: Texture;
  readonly report: TextureReport;
  readonly soup: TexturedGeometry;
  /** Of its triangles. */
  readonly affected: AffectedTriangles;
  readonly proxy: ProxyGeometry;
  readonly lines: FieldLines;
}

export function recipeOf({ first, refine, mapping, seams }: TextureRecipe): TextureRecipe {
  return { first, refine, mapping, seams };
}

/** Millimetres along a chain of vertices. */
export function lengthOf({ chain }: Seam, { positions }: ProxyGeometry): number {
  let length = 0;
  for (let k = 1; k < chain.length; k++) length += distance(positions, chain[k - 1], positions, chain[k]);
  return length;
}

/** The vertex of a proxy next to a vertex of another one. */
export function nearestVertex({ positions }: ProxyGeometry, other: ProxyGeometry, vertex: number): number {
  let nearest = 0;
  let least = Infinity;
  for (let k = 0; k < positions.length / 3; k++) {
    const away = distance(positions, k, other.positions, vertex);
    if (away < least) [nearest, least] = [k, away];
  }
  return nearest;
}

function distance(a: Float64Array, i: number, b: Float64Array, j: number): number {
  return Math.hypot(a[3 * i] - b[3 * j], a[3 * i + 1] - b[3 * j + 1], a[3 * i + 2] - b[3 * j + 2]);
}

/** The outlines of charts in the texture: two ends u v u v for each edge of a triangle that is a seam. */
export function outlinesOf(proxy: ProxyGeometry): Float32Array {
  const known = outlines.get(proxy) ?? findOutlines(proxy);
  outlines.set(proxy, known);
  return known;
}

/** Found once for each proxy. */
const outlines = new WeakMap<ProxyGeometry, Float32Array>();

function findOutlines({ positions, indices, uvs, seams }: ProxyGeometry): Float32Array {
  const vertices = positions.length / 3;
  const key = (a: number, b: number): number => Math.min(a, b) * vertices + Math.max(a, b);
  const cut = new Set<number>();
  for (let k = 0; k < seams.length; k += 2) cut.add(key(seams[k], seams[k + 1]));
  const ends: number[] = [];
  for (let from = 0; from < indices.length; from++) {
    const to = from % 3 === 2 ? from - 2 : from + 1;
    if (cut.has(key(indices[from], indices[to]))) ends.push(uvs[2 * from], uvs[2 * from + 1], uvs[2 * to], uvs[2 * to + 1]);
  }
  return Float32Array.from(ends);
}

/** Degrees around the circle of colours: charts with neighbouring numbers are far apart. */
const GOLDEN_DEGREES = 137.508;

/** From 0 to 1. */
export function hueOf(chart: number): number {
  return ((chart * GOLDEN_DEGREES) % 360) / 360;
}
