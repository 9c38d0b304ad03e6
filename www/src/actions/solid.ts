import type { CallOptions, SurfaceOptions } from 'fast-winding';
import type { ComparedMethod } from '../comparison.ts';
import type { Page } from '../page.ts';
import { attempt } from './attempt.ts';
import { only } from './only.ts';
import { timed } from './timed.ts';

export async function makeVoxels(page: Page, method: ComparedMethod, resolution: number, threshold: number): Promise<void> {
  const { store } = page;
  const shape = store.state.model!.shape;
  await attempt(page, 'Voxels', 'The voxels could not be made', async (options) => {
    const voxels = await timed(() => shape.voxelize({ method, resolution, threshold, format: 'bits', surface: true, ...options }));
    store.set({ voxels, visible: only(page, 'voxels') });
  });
}

export async function makeSurface(page: Page, how: Omit<SurfaceOptions, keyof CallOptions>): Promise<void> {
  const { store } = page;
  const shape = store.state.model!.shape;
  await attempt(page, 'Surface', 'The surface could not be made', async (options) => {
    const surface = await timed(() => shape.surface({ ...how, ...options }));
    store.set({ surface, visible: only(page, 'surface') });
  });
}
