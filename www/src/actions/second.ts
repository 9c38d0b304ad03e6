import type { BooleanOperation, CallOptions } from 'fast-winding';
import { centreOf, diagonal } from '../bounds.ts';
import type { Page, Source } from '../page.ts';
import { firstPlacement, matrixOf } from '../placement.ts';
import { PRIMITIVES } from '../primitives.ts';
import type { PrimitiveName } from '../primitives.ts';
import { sentence } from '../problem.ts';
import type { Model } from '../state.ts';
import { attempt } from './attempt.ts';
import { load, modelOf } from './load.ts';
import { only } from './only.ts';
import { fileSource, newId } from './open.ts';
import { sourceOf } from './source.ts';
import { timed } from './timed.ts';

/** Parts of the model's diagonal that a simple shape is large. */
const SIZE = 0.4;

/** Opens what the model is to be combined with; its numbers are in the unit of the model's. */
export async function openSecond(page: Page, file: File): Promise<void> {
  await takeSecond(page, { ...fileSource(file), unit: page.source?.unit ?? 'millimeter' });
}

/** Takes a simple shape, in the middle of the model. */
export async function makeSecond(page: Page, name: PrimitiveName): Promise<void> {
  const { bounds } = page.store.state.model!;
  const { positions, indices } = PRIMITIVES[name].make();
  const [size, centre] = [SIZE * diagonal(bounds) || 1, centreOf(bounds)];
  const placed = positions.map((value, i) => size * value + centre[i % 3]);
  const read = async (): Promise<Uint8Array> => {
    const soup = await page.engine.Soup.from({ positions: placed, indices });
    try {
      return await soup.export('ply');
    } finally {
      soup.free();
    }
  };
  await takeSecond(page, { name, id: newId(), unit: 'millimeter', read });
}

async function takeSecond(page: Page, source: Source): Promise<void> {
  const { store } = page;
  await attempt(page, `Opening ${source.name}`, `${source.name} could not be opened`, async (options) => {
    const [asItIs, { shape, geometry, bounds, name }] = await loadOriented(page, source, options);
    store.state.second?.shape.free();
    page.secondSource = asItIs;
    const { model, visible } = store.state;
    store.set({
      second: { shape, geometry, bounds, name },
      placement: firstPlacement(model!.bounds, bounds),
      visible: { ...visible, model: true, second: true, combined: false },
      halves: false,
    });
  });
}

/** A cloud gets normals if it has none, which its source then has too. */
async function loadOriented(page: Page, source: Source, options: Required<CallOptions>): Promise<[Source, Model]> {
  const model = await load(page, source, options);
  const { shape, name, oriented, readMilliseconds } = model;
  if (shape.kind === 'soup' || oriented) return [source, model];
  try {
    await shape.orient(options);
    return [await sourceOf(shape, name), await modelOf(shape, name, readMilliseconds, options)];
  } catch (error) {
    shape.free();
    throw error;
  }
}

export function removeSecond(page: Page): void {
  page.store.state.second?.shape.free();
  page.secondSource = undefined;
  page.store.set({ second: undefined });
}

/** What the model and the second one give together, as they stand. */
export async function combine(page: Page, operation: BooleanOperation): Promise<void> {
  const { store } = page;
  const { model, second, placement } = store.state;
  if (!model || !second) return;
  await attempt(page, 'Combining', 'The models could not be combined', async (options: Required<CallOptions>) => {
    const transform = matrixOf(placement, second.bounds);
    const made = await timed(() => model.shape.boolean(operation, second.shape, { transform, ...options }));
    const { soup, operands, warnings } = made.value;
    if (!soup) {
      const detail = warnings.map(({ message }) => sentence(message)).join(' ');
      return store.set({ problem: { title: 'Nothing is left of the models', detail } });
    }
    try {
      const value = { soup, triangles: await soup.geometry(), operands, warnings };
      store.set({ combined: { value, milliseconds: made.milliseconds }, visible: only(page, 'combined') });
    } catch (error) {
      soup.free();
      throw error;
    }
  });
}
