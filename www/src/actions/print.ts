import type { CallOptions, PrinterProfile } from 'fast-winding';
import { sizeOf } from '../bounds.ts';
import type { Page } from '../page.ts';
import { withProfile } from '../print.ts';
import type { Print, Recipe } from '../print.ts';
import { isLost, sentence } from '../problem.ts';
import { endOf, segmentsOf } from '../segments.ts';
import type { Model } from '../state.ts';
import { isRecord, remember, remembered } from '../storage.ts';
import { attempt } from './attempt.ts';
import { fail } from './fail.ts';
import { only } from './only.ts';
import { timed } from './timed.ts';

/** Millimetres: what most people print at with a common nozzle. */
const LAYER_HEIGHT = 0.2;
const KEY = 'fast-winding.recipe';

/** Starts with the engine's defaults, and holds each recipe against the engine's ranges and the model against the printer. */
export async function followRecipe(page: Page): Promise<void> {
  const { store } = page;
  const { settings, profile } = await page.engine.printSettings();
  store.set({ recipe: await lastRecipe(page, { layerHeight: LAYER_HEIGHT, settings, profile }) });
  store.on(['recipe', 'model'], ({ recipe, model }) => {
    if (recipe) void check(page, recipe, model);
  });
  store.on(['recipe'], ({ recipe }) => remember(KEY, recipe));
}

/** What was set when the page was here last, if the engine still takes it. */
async function lastRecipe({ engine }: Page, usual: Recipe): Promise<Recipe> {
  const value = remembered(KEY);
  if (!isRecord(value) || typeof value.layerHeight !== 'number') return usual;
  const last = value as unknown as Recipe;
  try {
    const { settings, profile } = await engine.printSettings(last);
    return { layerHeight: last.layerHeight, settings, profile };
  } catch {
    return usual;
  }
}

async function check(page: Page, recipe: Recipe, model?: Model): Promise<void> {
  const { store } = page;
  const isStale = (): boolean => store.state.recipe !== recipe || store.state.model !== model;
  try {
    await page.engine.printSettings({ ...recipe, size: model && sizeOf(model.bounds) });
    if (!isStale()) store.set({ misfit: undefined });
  } catch (error) {
    if (isLost(error)) await fail(page, 'The settings could not be checked', error);
    else if (!isStale()) store.set({ misfit: sentence(error instanceof Error ? error.message : String(error)) });
  }
}

/** Layers, toolpaths and the printer's program of the model that is shown. */
export async function preparePrint(page: Page): Promise<void> {
  const { store } = page;
  const { model, recipe } = store.state;
  if (!model || !recipe) return;
  await attempt(page, 'Print', 'The print could not be prepared', async (options) => {
    const print = await timed(() => prepare(page, model, recipe, options));
    store.set({ print, nozzle: endOf(print.value.segments), isPlaying: false, visible: { ...only(page, 'print'), layer: false } });
  });
}

async function prepare({ engine }: Page, { shape, geometry }: Model, recipe: Recipe, options: Required<CallOptions>): Promise<Print> {
  const { layerHeight, settings, profile } = recipe;
  const layers = await shape.slice({ layerHeight, ...options });
  const paths = await engine.toolpaths(layers, { ...settings, ...options });
  // It cannot be cancelled on its way and tells no progress: it takes a fraction of the time that toolpaths take.
  options.onProgress(0, 'G-code');
  const gcode = await engine.gcode(paths, profile);
  options.signal.throwIfAborted();
  const segments = segmentsOf(paths, geometry.origin, settings.lineWidth);
  return { recipe, layers, segments, gcode, warnings: [...paths.warnings, ...gcode.warnings] };
}

/** Takes a printer's profile from a JSON file; what it does not say is as in the default printer. */
export async function loadProfile(page: Page, file: File): Promise<void> {
  const { store } = page;
  store.set({ problem: undefined });
  try {
    const given: unknown = JSON.parse(await file.text());
    if (!isRecord(given)) throw new Error('the file holds no object with the values of a printer');
    const { profile } = await page.engine.printSettings({ profile: given as PrinterProfile });
    if (store.state.recipe) store.set({ recipe: withProfile(store.state.recipe, profile) });
  } catch (error) {
    await fail(page, `${file.name} is no printer profile`, error);
  }
}
