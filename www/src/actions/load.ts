import type { CallOptions, Cloud, Soup } from 'fast-winding';
import type { Page, Source } from '../page.ts';
import type { Geometry, Model } from '../state.ts';

/** Reads a source into a model whose field is built. */
export async function load(page: Page, source: Source, options: Required<CallOptions>): Promise<Model> {
  const { name, unit, oriented } = source;
  const bytes = oriented ? new Uint8Array(await oriented.content.arrayBuffer()) : await source.read(options.signal);
  const start = performance.now();
  const shape = await page.engine.open(bytes, { ...options, unit, transfer: true });
  const readMilliseconds = performance.now() - start;
  try {
    const model = await modelOf(shape, name, readMilliseconds, options);
    return oriented ? { ...model, format: oriented.format, warnings: oriented.warnings } : model;
  } catch (error) {
    shape.free();
    throw error;
  }
}

/** The model of a shape as it is now: its normals, its warnings, its field. */
export async function modelOf(shape: Soup | Cloud, name: string, readMilliseconds: number, options: CallOptions): Promise<Model> {
  const geometry = await geometryOf(shape);
  const oriented = shape.kind === 'soup' || shape.hasNormals;
  const prepared = oriented ? await shape.prepare(options) : undefined;
  const { bounds, format } = shape;
  return { name, shape, geometry, bounds, format, warnings: [...shape.warnings], oriented, readMilliseconds, prepared };
}

async function geometryOf(shape: Soup | Cloud): Promise<Geometry> {
  if (shape.kind === 'cloud') {
    const { positions, normals, origin } = await shape.geometry();
    return { positions, normals, origin, boundary: new Float32Array() };
  }
  const [{ positions, indices, origin }, boundary] = await Promise.all([shape.geometry(), shape.boundaryEdges()]);
  return { positions, indices, origin, boundary: movedTo(origin, boundary.positions, boundary.origin) };
}

/** The same points, relative to another origin. */
function movedTo(origin: Float64Array, positions: Float32Array, from: Float64Array): Float32Array {
  if (from.every((value, k) => value === origin[k])) return positions;
  return positions.map((value, i) => value + from[i % 3] - origin[i % 3]);
}
