import type { CallOptions } from 'fast-winding';
import type { Page } from '../page.ts';
import type { Item } from '../state.ts';
import { fail } from './fail.ts';
import { modelOf } from './load.ts';
import { timed } from './timed.ts';

export async function makeVoxels(page: Page, resolution: number, threshold: number): Promise<void> {
  const { store } = page;
  const shape = store.state.model!.shape;
  await attempt(page, 'Voxels', 'The voxels could not be made', async (options) => {
    const voxels = await timed(() => shape.voxelize({ resolution, threshold, format: 'bits', surface: true, ...options }));
    store.set({ voxels, visible: only(page, 'voxels') });
  });
}

export async function makeSurface(page: Page, resolution: number): Promise<void> {
  const { store } = page;
  const shape = store.state.model!.shape;
  await attempt(page, 'Surface', 'The surface could not be made', async (options) => {
    const surface = await timed(() => shape.surface({ resolution, ...options }));
    store.set({ surface, visible: only(page, 'surface') });
  });
}

/** Estimates the normals of the cloud that is shown. */
export async function orient(page: Page): Promise<void> {
  const { store } = page;
  const { shape, name, readMilliseconds } = store.state.model!;
  if (shape.kind !== 'cloud') return;
  await attempt(page, 'Normals', 'The normals could not be estimated', async (options) => {
    await shape.orient(options);
    const model = await modelOf(shape, name, readMilliseconds, options);
    store.set({ model, visible: { ...store.state.visible, normals: true } });
  });
}

async function attempt(page: Page, label: string, failure: string, work: (options: Required<CallOptions>) => Promise<void>): Promise<void> {
  page.store.set({ problem: undefined });
  try {
    await page.jobs.run(label, work);
  } catch (error) {
    await fail(page, failure, error);
  }
}

/** Of the solid things only `item`: they fill the same space and would hide one another. */
function only({ store }: Page, item: Item): Readonly<Record<Item, boolean>> {
  return { ...store.state.visible, model: false, boundary: false, normals: false, voxels: false, surface: false, [item]: true };
}
