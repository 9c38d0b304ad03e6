import type { Cloud } from 'fast-winding';
import type { Oriented, Page } from '../page.ts';
import type { Model, PointMeasure } from '../state.ts';
import { attempt } from './attempt.ts';
import { modelOf } from './load.ts';

/** How normals are estimated. */
export type Method = 'consistency' | 'stochastic' | 'propagation';

/** Estimates the normals of the cloud that is shown, which shows them while they settle. */
export async function orient(page: Page, method: Method): Promise<void> {
  const { store, source } = page;
  const { shape, name, readMilliseconds } = store.state.model!;
  if (shape.kind !== 'cloud' || !source) return;
  await attempt(page, 'Normals', 'The normals could not be estimated', async (options) => {
    try {
      await shape.orient({ ...options, method, onNormals: (settling) => store.set({ settling }) });
      const model = await modelOf(shape, name, readMilliseconds, options);
      page.source = { ...source, oriented: await saved(shape, model) };
      store.set({ model, visible: { ...store.state.visible, normals: true } });
    } finally {
      store.set({ settling: undefined });
    }
  });
}

/** For when it is to be read again, if there is memory for that. */
async function saved(shape: Cloud, { format, warnings }: Model): Promise<Oriented | undefined> {
  const bytes = await shape.save().catch(() => undefined);
  return bytes && { content: new Blob([bytes as Uint8Array<ArrayBuffer>]), format, warnings };
}

/** Colours the points of the cloud that is shown by a quantity; without one, not at all. */
export async function measurePoints(page: Page, quantity: PointMeasure['quantity'] | undefined): Promise<void> {
  const { store } = page;
  const { shape } = store.state.model!;
  if (shape.kind !== 'cloud' || !quantity) return store.set({ measure: undefined });
  await attempt(page, 'Points', 'The points could not be measured', async (options) => {
    const values = quantity === 'noise' ? await shape.noise(options) : (await shape.geometry()).areas;
    store.set({ measure: values && { quantity, values } });
  });
}
