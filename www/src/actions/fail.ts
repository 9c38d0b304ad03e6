import { restartEngine } from '../page.ts';
import type { Page } from '../page.ts';
import { isAborted, isLost, problemOf } from '../problem.ts';
import { load } from './load.ts';
import { handleOf } from './results.ts';

/** Tells a problem in words; an engine that died is replaced first, and the model given to the new one. Cancelling is no problem. */
export async function fail(page: Page, title: string, error: unknown): Promise<void> {
  if (isAborted(error)) return;
  try {
    if (isLost(error)) await revive(page);
    page.store.set({ problem: problemOf(title, error) });
  } catch (second) {
    page.store.set({ problem: problemOf('The engine stopped and could not start again', second) });
  }
}

async function revive(page: Page): Promise<void> {
  page.revival ??= restart(page).finally(() => {
    page.revival = undefined;
  });
  await page.revival;
}

async function restart(page: Page): Promise<void> {
  await restartEngine(page);
  const { store } = page;
  const { source, secondSource } = page;
  // Their shapes were in the engine that is gone.
  const results = store.state.results.filter((result) => !handleOf(result));
  store.set({ results, against: undefined, repair: undefined, combined: undefined, texture: undefined, seams: [], seamStart: undefined, isDrawing: false });
  if (source) {
    const model = await page.jobs.run('Starting again', (options) => load(page, source, options));
    store.set({ model });
  }
  if (!secondSource || !store.state.second) return;
  const { shape, geometry, bounds, name } = await page.jobs.run('Starting again', (options) => load(page, secondSource, options));
  store.set({ second: { shape, geometry, bounds, name } });
}
