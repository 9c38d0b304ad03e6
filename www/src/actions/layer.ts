import type { Bounds, CallOptions, Cloud, Soup } from 'fast-winding';
import type { PlaneDistances } from '../distances.ts';
import { Latest } from '../latest.ts';
import type { Page } from '../page.ts';
import { heightOf } from '../plane.ts';
import type { Model, PlaneColours } from '../state.ts';
import { fail } from './fail.ts';
import { timed } from './timed.ts';

/** Samples of the plane's colours along its longest side: first a rough one that keeps up with the slider, then a fine one. */
const RESOLUTIONS = [96, 384];
/** How far distances are asked beyond the bounds, as a part of the width. */
const MARGIN = 0.08;

interface Cut {
  readonly model: Model;
  readonly z: number;
  readonly layerHeight: number;
  readonly colours: PlaneColours;
}

/** Keeps the layer (and the colours, when wanted) in step with the plane. */
export function followPlane(page: Page): void {
  const { store } = page;
  const latest = new Latest<Cut>((cut, signal) => compute(page, cut, signal));
  store.on(['model', 'plane', 'planeColours', 'job'], ({ model, plane, planeColours: colours, job }) => {
    // The engine does one thing at a time: while a long job has it, the plane waits.
    if (!model?.oriented || job) return;
    const z = heightOf(plane, model.bounds);
    if (colours !== 'winding') store.set({ heat: undefined });
    if (colours !== 'distance') store.set({ distances: undefined });
    const cut = { model, z, layerHeight: plane.layerHeight, colours };
    if (!isCurrent(page, cut)) latest.request(cut);
  });
}

/** Whether what is shown answers the question already. */
function isCurrent({ store }: Page, { model, z, colours }: Cut): boolean {
  const { model: shown, layer, heat, distances } = store.state;
  const map = (colours === 'winding' ? heat : distances)?.value;
  const isFine = map?.z === z && Math.max(...map.counts) > RESOLUTIONS[0];
  return shown?.shape === model.shape && layer?.value.zSample === z && (colours === 'none' || isFine);
}

async function compute(page: Page, { model: { shape, bounds }, z, layerHeight, colours }: Cut, signal: AbortSignal): Promise<void> {
  const { store } = page;
  // Without shared memory an abort costs a new worker and reading the model again: letting a layer finish is quicker.
  const options = crossOriginIsolated ? { signal } : {};
  const isStale = (): boolean => signal.aborted || store.state.model?.shape !== shape;
  try {
    const layers = await timed(() => shape.slice({ heights: [z], layerHeight, ...options }));
    if (isStale()) return;
    store.set({ layer: { value: layers.value[0], milliseconds: layers.milliseconds } });
    if (colours === 'none') return;
    for (const resolution of RESOLUTIONS) {
      const found =
        colours === 'winding'
          ? { heat: await timed(() => shape.heatMap({ z, resolution, ...options })) }
          : { distances: await timed(() => distancesAt(shape, bounds, z, resolution, options)) };
      if (isStale() || store.state.planeColours !== colours) return;
      store.set(found);
    }
  } catch (error) {
    if (!isStale()) await fail(page, 'The layer could not be computed', error);
  }
}

/** Signed distances over the plane, a little beyond the bounds. */
async function distancesAt(shape: Soup | Cloud, { min, max }: Bounds, z: number, resolution: number, options: CallOptions): Promise<PlaneDistances> {
  const sides = [0, 1].map((k) => max[k] - min[k]);
  const width = Math.max(...sides, 1e-9);
  const step = (width * (1 + 2 * MARGIN)) / resolution;
  const [columns, rows] = sides.map((side) => Math.ceil((side + 2 * MARGIN * width) / step));
  const origin = [columns, rows].map((count, k) => (min[k] + max[k]) / 2 - (step * (count - 1)) / 2);
  const points = new Float64Array(3 * columns * rows);
  for (let j = 0; j < rows; j++) {
    for (let i = 0; i < columns; i++) points.set([origin[0] + i * step, origin[1] + j * step, z], 3 * (j * columns + i));
  }
  const values = await shape.signedDistance(points, options);
  return { counts: [columns, rows], origin: [origin[0], origin[1]], spacing: [step, step], z, values };
}
