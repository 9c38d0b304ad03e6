import type { Page } from '../page.ts';
import type { PointMeasure } from '../state.ts';
import { attempt } from './attempt.ts';
import { modelOf } from './load.ts';

/** How normals are estimated. */
export type Method = 'consistency' | 'stochastic' | 'propagation';

/** Estimates the normals of the cloud that is shown, which shows them while they settle. */
export async function orient(page: Page, method: Method): Promise<void> {
  const { store } = page;
  const { shape, name, readMilliseconds } = store.state.model!;
  if (shape.kind !== 'cloud') return;
  await attempt(page, 'Normals', 'The normals could not be estimated', async (options) => {
    try {
      await shape.orient({ ...options, method, onNormals: (settling) => store.set({ settling }) });
      const model = await modelOf(shape, name, readMilliseconds, options);
      store.set({ model, visible: { ...store.state.visible, normals: true } });
    } finally {
      store.set({ settling: undefined });
    }
  });
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
