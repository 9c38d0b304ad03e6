import type { Soup, Cloud } from 'fast-winding';
import { Latest } from '../latest.ts';
import type { Page } from '../page.ts';
import { planeHeight } from '../state.ts';
import { fail } from './fail.ts';
import { timed } from './timed.ts';

/** Samples of the heat map along its longest side: first a rough one that keeps up with the slider, then a fine one. */
const HEAT_RESOLUTIONS = [96, 384];

interface Cut {
  readonly shape: Soup | Cloud;
  readonly z: number;
  readonly layerHeight: number;
  readonly heat: boolean;
}

/** Keeps the layer (and the heat map, when wanted) in step with the plane. */
export function followPlane(page: Page): void {
  const { store } = page;
  const latest = new Latest<Cut>((cut, signal) => compute(page, cut, signal));
  store.on(['model', 'plane', 'heatWanted', 'job'], ({ model, plane, heatWanted, job }) => {
    // The engine does one thing at a time: while a long job has it, the plane waits.
    if (!model?.oriented || job) return;
    const z = planeHeight(plane, model.bounds);
    if (!heatWanted) store.set({ heat: undefined });
    if (isCurrent(page, model.shape, z, heatWanted)) return;
    latest.request({ shape: model.shape, z, layerHeight: plane.layerHeight, heat: heatWanted });
  });
}

/** Whether what is shown answers the question already. */
function isCurrent({ store }: Page, shape: Soup | Cloud, z: number, heat: boolean): boolean {
  const { model, layer, heat: map } = store.state;
  const fine = map?.value.z === z && Math.max(...map.value.counts) > HEAT_RESOLUTIONS[0];
  return model?.shape === shape && layer?.value.zSample === z && (!heat || fine);
}

async function compute(page: Page, { shape, z, layerHeight, heat }: Cut, signal: AbortSignal): Promise<void> {
  const { store } = page;
  // Without shared memory an abort costs a new worker and reading the model again: letting a layer finish is quicker.
  const options = crossOriginIsolated ? { signal } : {};
  const isStale = (): boolean => signal.aborted || store.state.model?.shape !== shape;
  try {
    const layers = await timed(() => shape.slice({ heights: [z], layerHeight, ...options }));
    if (isStale()) return;
    store.set({ layer: { value: layers.value[0], milliseconds: layers.milliseconds } });
    if (!heat) return;
    for (const resolution of HEAT_RESOLUTIONS) {
      const map = await timed(() => shape.heatMap({ z, resolution, ...options }));
      if (isStale() || !store.state.heatWanted) return;
      store.set({ heat: map });
    }
  } catch (error) {
    if (!isStale()) await fail(page, 'The layer could not be computed', error);
  }
}
