/** The results of the model, in the order in which they were made: each can be shown again, held against another, saved and removed. */
import type { Soup, Texture } from 'fast-winding';
import { ALL_MADE, MADE, nextId } from '../made.ts';
import type { Made, Making, Result } from '../made.ts';
import type { Page } from '../page.ts';
import type { State } from '../state.ts';
import { only } from './only.ts';
import { saveTexture } from './picture.ts';
import { saveGCode, saveMesh, saveSoup } from './save.ts';

/** More make the oldest ones go. */
export const MOST = 8;
/** One at a time: the next takes the place of the last. */
const SINGLE: readonly Made[] = ['textured', 'print'];

/** Whatever is made is put down. */
export function followResults({ store }: Page): void {
  store.on(ALL_MADE.map((item) => MADE[item].slot), (state) => {
    for (const item of ALL_MADE) {
      const made = state[MADE[item].slot];
      if (!made || store.state.results.some((result) => result.made === made)) continue;
      const result = { id: nextId(store.state.results), item, made } as Result;
      const others = store.state.results.filter((other) => !(SINGLE.includes(item) && other.item === item));
      const oldest = others.filter((other) => state[MADE[other.item].slot] !== other.made).slice(0, Math.max(0, others.length + 1 - MOST));
      oldest.forEach(release);
      store.set({ results: [...others.filter((other) => !oldest.includes(other)), result], against: oldest.includes(store.state.against!) ? undefined : store.state.against });
    }
  });
}

/** What a result has in the engine, if anything. */
export function handleOf({ item, made }: Making): Soup | Texture | undefined {
  if (item === 'repaired' || item === 'combined') return made.value.soup;
  return item === 'textured' ? made.value.handle : undefined;
}

/** Gives back what a result has in the engine. */
export function release(making: Making): void {
  handleOf(making)?.free();
}

/** Shows a result alone; without one, the model. */
export function showResult(page: Page, result?: Result): void {
  const { store } = page;
  if (!result) return store.set({ visible: { ...only(page, 'model'), boundary: true }, halves: false });
  const isPrint = result.item === 'print';
  store.set({ [MADE[result.item].slot]: result.made, visible: { ...only(page, result.item), ...(isPrint ? { layer: false } : {}) }, halves: store.state.halves && !isPrint });
}

/** What the left half of the view shows beside what is shown: a result, or the model. */
export function compareWith({ store }: Page, against?: Result): void {
  store.set({ against, halves: true });
}

export function removeResult(page: Page, result: Result): void {
  const { store } = page;
  const { results, against, visible } = store.state;
  const rest = results.filter((other) => other !== result);
  const slot = MADE[result.item].slot;
  const patch: Partial<State> = { results: rest, against: against === result ? undefined : against };
  if (store.state[slot] === result.made) {
    Object.assign(patch, { [slot]: rest.findLast(({ item }) => item === result.item)?.made });
    if (result.item === 'textured') Object.assign(patch, { seams: [], seamStart: undefined, isDrawing: false });
    // The place of what is gone is the model's, unless another of its kind has it.
    if (visible[result.item] && !patch[slot]) Object.assign(patch, { visible: { ...visible, [result.item]: false, model: true } });
  }
  store.set(patch);
  release(result);
}

/** In the format that is chosen for meshes, if it is one. */
export async function saveResult(page: Page, result: Result): Promise<void> {
  const { meshFormat } = page.store.state;
  switch (result.item) {
    case 'repaired':
    case 'combined':
      return saveSoup(page, result.made.value.soup, result.item, meshFormat);
    case 'textured':
      return saveTexture(page, 'glb');
    case 'offset':
      return saveMesh(page, result.made.value.mesh, result.made.value.kind, meshFormat);
    case 'surface':
      return saveMesh(page, result.made.value, 'surface', meshFormat);
    case 'voxels':
      return result.made.value.surface && saveMesh(page, result.made.value.surface, 'voxels', meshFormat);
    case 'print':
      return saveGCode(page);
  }
}
