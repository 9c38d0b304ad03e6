import type { CallOptions, Cloud, Soup } from 'fast-winding';
import type { Page, Source } from '../page.ts';
import { isAborted, problemOf } from '../problem.ts';
import { initialState } from '../state.ts';
import type { Geometry, Model } from '../state.ts';
import { planeFor } from './plane.ts';

/** Opens a model and shows it. When that fails, the model shown before stays and the problem is told. */
export async function open(page: Page, source: Source): Promise<void> {
  const { store, jobs } = page;
  store.set({ problem: undefined });
  try {
    const model = await jobs.run(`Opening ${source.name}`, (options) => load(page, source, options));
    page.source = source;
    show(page, model);
  } catch (error) {
    if (!isAborted(error)) store.set({ problem: problemOf(`${source.name} could not be opened`, error) });
  }
}

/** A source for a file that was dropped or chosen. */
export function fileSource(file: File): Source {
  return { name: file.name, read: async () => new Uint8Array(await file.arrayBuffer()) };
}

/** A source for one of the samples served with the page. */
export function sampleSource(file: string): Source {
  return {
    name: file,
    async read(signal) {
      const response = await fetch(`samples/${file}`, { signal });
      if (!response.ok) throw new Error(`the server answered ${response.status} for samples/${file}`);
      return new Uint8Array(await response.arrayBuffer());
    },
  };
}

/** The model of a shape that may have changed: its normals, its warnings, its field. */
export async function modelOf(shape: Soup | Cloud, name: string, readMilliseconds: number, options: CallOptions): Promise<Model> {
  const geometry = await geometryOf(shape);
  const oriented = shape.kind === 'soup' || shape.hasNormals;
  const prepared = oriented ? await shape.prepare(options) : undefined;
  return { name, shape, geometry, bounds: shape.bounds, warnings: [...shape.warnings], oriented, readMilliseconds, prepared };
}

async function load(page: Page, source: Source, options: Required<CallOptions>): Promise<Model> {
  options.onProgress(0, 'fetching');
  const bytes = await source.read(options.signal);
  const start = performance.now();
  const shape = await page.engine.open(bytes, { ...options, transfer: true });
  const readMilliseconds = performance.now() - start;
  try {
    return await modelOf(shape, source.name, readMilliseconds, options);
  } catch (error) {
    shape.free();
    throw error;
  }
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

function show({ store }: Page, model: Model): void {
  const { heatWanted, cutAway, model: before } = store.state;
  before?.shape.free();
  const { visible } = initialState();
  store.set({
    model,
    plane: planeFor(model.bounds),
    visible: { ...visible, normals: model.shape.kind === 'cloud' && model.oriented && model.shape.count <= 5000 },
    layer: undefined,
    heat: undefined,
    voxels: undefined,
    surface: undefined,
    heatWanted,
    cutAway,
  });
}
