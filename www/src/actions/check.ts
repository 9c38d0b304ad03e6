import type { CallOptions, CheckReport, Soup } from 'fast-winding';
import type { Page } from '../page.ts';
import { isAborted } from '../problem.ts';
import { initialState } from '../state.ts';
import type { Model, Timed } from '../state.ts';
import { attempt } from './attempt.ts';
import { fail } from './fail.ts';
import { forgotten } from './forget.ts';
import { modelOf } from './load.ts';
import { sourceOf } from './source.ts';
import { timed } from './timed.ts';

/** Soups of no more triangles are checked without being asked: that takes about a second. */
const QUICK = 20_000;

/** Checks small models as they are opened, beside whatever else is done. */
export function followModel(page: Page): void {
  const { store } = page;
  const tried = new WeakSet<Model>();
  let running: AbortController | undefined;
  const next = (): void => {
    const { model, job, report } = store.state;
    // Without shared memory, stopping would cost a new engine.
    if (job && crossOriginIsolated) running?.abort();
    if (job || running || report || model?.shape.kind !== 'soup' || model.shape.count > QUICK || tried.has(model)) return;
    running = new AbortController();
    void quietly(page, model, model.shape, running.signal).then((isDone) => {
      running = undefined;
      if (isDone) tried.add(model);
      next();
    });
  };
  store.on(['model', 'job', 'report'], next);
}

/** Whether the check need not be tried again. */
async function quietly(page: Page, model: Model, shape: Soup, signal: AbortSignal): Promise<boolean> {
  const { store } = page;
  try {
    const report = await timed(() => shape.check({ ...wanted(page), ...(crossOriginIsolated ? { signal } : {}) }));
    if (store.state.model === model) store.set({ report });
    return true;
  } catch (error) {
    if (isAborted(error)) return false;
    if (store.state.model === model) await fail(page, 'The model could not be checked', error);
    return true;
  }
}

/** Looks the model over that is shown. */
export async function checkModel(page: Page): Promise<void> {
  const { store } = page;
  const { shape } = store.state.model!;
  if (shape.kind !== 'soup') return;
  await attempt(page, 'Check', 'The model could not be checked', async (options) => {
    store.set({ report: await checked(page, shape, options), defect: undefined });
  });
}

export function checked(page: Page, shape: Soup, options: CallOptions): Promise<Timed<CheckReport>> {
  return timed(() => shape.check({ ...wanted(page), ...options }));
}

/** Turns the faces of the model so that their fronts look outward, and checks it again. */
export async function turnFaces(page: Page): Promise<void> {
  const { store } = page;
  const { shape, name, readMilliseconds } = store.state.model!;
  if (shape.kind !== 'soup') return;
  await attempt(page, 'Turning faces', 'The faces could not be turned', async (options) => {
    await shape.orient(options);
    const model = await modelOf(shape, name, readMilliseconds, options);
    page.source = await sourceOf(shape, page.source?.name ?? name);
    store.set({ ...forgotten(store.state), model, visible: initialState().visible });
    store.set({ report: await checked(page, shape, options) });
  });
}

function wanted({ store }: Page): { minimumThickness: number; overhangAngle: number; bed?: [number, number, number] } {
  const { limits, recipe } = store.state;
  if (!recipe) return limits;
  const { bedWidth, bedDepth, height } = recipe.profile;
  return { ...limits, bed: [bedWidth, bedDepth, height] };
}
