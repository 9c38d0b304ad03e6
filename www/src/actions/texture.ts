import type { AtlasOptions, CallOptions, ProxyGeometry, Soup, Texture } from 'fast-winding';
import type { Page } from '../page.ts';
import type { Timed } from '../state.ts';
import { nearestVertex } from '../texture.ts';
import type { Mapping, Seam, TextureRecipe, Texturing } from '../texture.ts';
import { attempt } from './attempt.ts';
import { fail } from './fail.ts';
import { only } from './only.ts';
import { timed } from './timed.ts';

/** Field lines that are drawn: more hide one another. */
const LINES = 400;

/** Gives the model that is shown a texture; `refine` splits triangles first that cross. */
export async function makeTexture(page: Page, mapping: Mapping, refine: boolean): Promise<void> {
  const { store } = page;
  const { shape } = store.state.model!;
  if (shape.kind !== 'soup') return;
  await attempt(page, 'Texture', 'The texture could not be made', async (options) => {
    const texture = await made(shape, { first: mapping, refine, mapping, seams: [] }, options);
    store.state.texture?.value.handle.free();
    store.set({ texture, seams: [], seamStart: undefined, isDrawing: false, isFlowing: mayMove(), visible: only(page, 'textured') });
  });
}

/** A texture as its recipe has it. */
export async function made(source: Soup, { first, refine, mapping, seams }: TextureRecipe, options: Required<CallOptions>): Promise<Timed<Texturing>> {
  const isMappedAnew = mapping !== first || seams.length > 0;
  const { value: handle, milliseconds } = await timed(() => source.texture({ ...first, onlySeams: false, refine, ...(isMappedAnew ? share(options, 0, 0.75) : options) }));
  try {
    if (isMappedAnew) await handle.remap({ ...mapping, ...cuts(mapping, seams), ...share(options, 0.75, 1) });
    return { value: { source, ...(await contents(handle)), first, refine, mapping, seams }, milliseconds };
  } catch (error) {
    handle.free();
    throw error;
  }
}

/** Whether things may move by themselves. */
export function mayMove(): boolean {
  return !matchMedia('(prefers-reduced-motion: reduce)').matches;
}

/** Another proxy for the same field lines. Seams that were drawn are drawn again, between the same places. */
export async function remap(page: Page, mapping: Mapping): Promise<void> {
  const { store } = page;
  const before = store.state.texture?.value;
  if (!before) return;
  const { seams } = store.state;
  await attempt(page, 'Texture', 'The texture could not be mapped anew', async (options) => {
    const isCut = seams.length > 0;
    const after = await mapped(page, before, mapping, [], isCut ? share(options, 0, 0.5) : options);
    store.set({ seams: after.seams, seamStart: undefined });
    if (!isCut) return;
    const moved = await seamsOn(after, before.proxy, seams);
    store.set({ seams: moved });
    await mapped(page, after, mapping, moved, share(options, 0.5, 1));
  });
}

/** Cuts the proxy along the seams that were drawn, and lays its charts flat again. */
export async function flatten(page: Page, mapping: Mapping): Promise<void> {
  const { texture, seams } = page.store.state;
  if (!texture) return;
  await attempt(page, 'Charts', 'The charts could not be laid flat', async (options) => {
    await mapped(page, texture.value, mapping, seams, options);
  });
}

async function mapped(page: Page, before: Texturing, mapping: Mapping, seams: readonly Seam[], options: CallOptions): Promise<Texturing> {
  const { handle, source, first, refine } = before;
  const { milliseconds } = await timed(() => handle.remap({ ...mapping, ...cuts(mapping, seams), ...options }));
  const value = { source, ...(await contents(handle)), first, refine, mapping, seams };
  page.store.set({ texture: { value, milliseconds } });
  return value;
}

function cuts({ onlySeams }: Mapping, seams: readonly Seam[]): AtlasOptions {
  return { seams: seams.map(({ chain }) => chain), onlySeams: onlySeams && seams.length > 0 };
}

async function contents(handle: Texture): Promise<Omit<Texturing, 'source' | keyof TextureRecipe>> {
  const [soup, affected, proxy, lines] = await Promise.all([handle.geometry(), handle.affected(), handle.proxy(), handle.lines({ count: LINES })]);
  return { handle, report: handle.report, soup, affected, proxy, lines };
}

async function seamsOn({ handle, proxy }: Texturing, before: ProxyGeometry, seams: readonly Seam[]): Promise<Seam[]> {
  const moved: Seam[] = [];
  for (const seam of seams) {
    const nearest = seam.picks.map((vertex) => nearestVertex(proxy, before, vertex));
    const picks = nearest.filter((vertex, k) => vertex !== nearest[k - 1]);
    if (picks.length > 1) moved.push({ picks, chain: await chainThrough(handle, picks) });
  }
  return moved;
}

function chainThrough(handle: Texture, [from, to, ...further]: readonly number[]): Promise<Uint32Array> {
  return handle.seam(from, to, ...further);
}

/** For a call that is a part of a job. */
function share({ signal, onProgress }: Required<CallOptions>, start: number, end: number): CallOptions {
  return { signal, onProgress: (fraction, stage) => onProgress(start + fraction * (end - start), stage) };
}

/** A place for the start of a seam, or for its end: then the seam is there. One that starts where another ends leads that on; no edge is cut twice then. The same place twice is none. */
export async function markSeam(page: Page, vertex: number): Promise<void> {
  const { store } = page;
  const { texture, seamStart } = store.state;
  if (!texture) return;
  if (seamStart === undefined || seamStart === vertex) return store.set({ seamStart: seamStart === undefined ? vertex : undefined });
  // What is marked meanwhile begins another one.
  store.set({ seamStart: undefined });
  try {
    const before = store.state.seams.find(({ picks }) => picks.at(-1) === seamStart);
    const picks = [...(before?.picks ?? [seamStart]), vertex];
    const chain = await chainThrough(texture.value.handle, picks);
    if (store.state.texture !== texture) return;
    store.set({ seams: [...store.state.seams.filter((seam) => seam !== before), { picks, chain, before }] });
  } catch (error) {
    await fail(page, 'No seam leads there', error);
  }
}

/** The least offset whose proxy holds all parts of the model together. */
export async function suggestOffset(page: Page, sides: Mapping['sides']): Promise<number | undefined> {
  const { shape } = page.store.state.model!;
  let offset: number | undefined;
  if (shape.kind !== 'soup') return offset;
  await attempt(page, 'Offset', 'No offset could be suggested', async (options) => {
    offset = await shape.suggestOffset({ sides, ...options });
  });
  return offset;
}
