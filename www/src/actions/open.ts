import type { CallOptions } from 'fast-winding';
import { contentOf, onlyOne, removeBelongings } from '../belongings.ts';
import type { Kept } from '../kept.ts';
import type { Oriented, Page, Source, Unit } from '../page.ts';
import { planeFor } from '../plane.ts';
import { isAborted, isLost, lost } from '../problem.ts';
import { initialState } from '../state.ts';
import type { Model } from '../state.ts';
import { fail } from './fail.ts';
import { forgotten } from './forget.ts';
import { load } from './load.ts';

/** Opens a model and shows it. When that fails, the model shown before stays and the problem is told. */
export async function open(page: Page, source: Source): Promise<void> {
  page.store.set({ problem: undefined });
  try {
    const { model, isLess, ...left } = await page.jobs.run(`Opening ${source.name}`, (options) => loadAsLeft(page, source, options));
    page.source = left.source;
    show(page, model);
    if (isLess) page.store.set({ problem: lost(['Normals']) });
  } catch (error) {
    await fail(page, `${source.name} could not be opened`, error);
  }
}

interface AsLeft {
  readonly source: Source;
  readonly model: Model;
  /** Whether its normals could not be read. */
  readonly isLess: boolean;
}

/** A cloud has the normals again that were estimated for it, if the browser has kept them. */
async function loadAsLeft(page: Page, source: Source, options: Required<CallOptions>): Promise<AsLeft> {
  const id = onlyOne(source, 'normals');
  const oriented = (await contentOf(id)) as Oriented | undefined;
  if (oriented) {
    try {
      const whole = { ...source, oriented };
      return { source: whole, model: await load(page, whole, options), isLess: false };
    } catch (error) {
      if (isAborted(error) || isLost(error)) throw error;
      await removeBelongings([id]);
    }
  }
  const bare = { ...source, oriented: undefined };
  return { source: bare, model: await load(page, bare, options), isLess: oriented !== undefined };
}

/** Opens the same file again, its numbers taken in another unit. */
export async function reopen(page: Page, unit: Unit): Promise<void> {
  if (page.source) await open(page, { ...page.source, unit });
}

/** A source for a file that was dropped or chosen. */
export function fileSource(file: File): Source {
  return { name: file.name, id: newId(), unit: 'millimeter', read: async () => new Uint8Array(await file.arrayBuffer()) };
}

/** A source for a file that the browser has kept. */
export function keptSource({ id, name, unit, content }: Kept): Source {
  return { id, name, unit, read: async () => new Uint8Array(await content.arrayBuffer()) };
}

/** By which a source is told from all others. */
export function newId(): string {
  return Math.random().toString(36).slice(2, 12);
}

/** A source for one of the samples served with the page. */
export function sampleSource(file: string): Source {
  return {
    name: file,
    id: file,
    sample: file,
    unit: 'millimeter',
    async read(signal) {
      const response = await fetch(`samples/${file}`, { signal }).catch((error: unknown) => {
        throw signal.aborted ? error : new Error(`the server does not answer, and ${file} was not opened here before`);
      });
      if (!response.ok) throw new Error(`the server answered ${response.status} for samples/${file}`);
      return new Uint8Array(await response.arrayBuffer());
    },
  };
}

/** Shows a model in the place of the one before, of which nothing is kept. */
export function show({ store }: Page, model: Model): void {
  store.state.model?.shape.free();
  store.set({
    ...forgotten(store.state),
    model,
    plane: planeFor(model.bounds),
    visible: initialState().visible,
  });
}
