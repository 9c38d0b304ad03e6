/** What is made of a model, its second model and its normals: the browser keeps them, and they are there again when the model is opened again. */
import { keepBelonging, onlyOne, removeBelongings } from '../belongings.ts';
import type { Belonging } from '../belongings.ts';
import { nextFrame } from '../dom.ts';
import { asLeft, asTextureLeft, leftOf } from '../left.ts';
import type { Left } from '../left.ts';
import { ALL_MADE, labelOf, MADE, nextId } from '../made.ts';
import type { Result } from '../made.ts';
import { packed } from '../packing.ts';
import type { PackedTexture } from '../packing.ts';
import { isSame } from '../page.ts';
import type { Page, Source } from '../page.ts';
import type { Picture } from '../picture.ts';
import { firstPlacement } from '../placement.ts';
import { lost } from '../problem.ts';
import type { Model } from '../state.ts';
import { fail } from './fail.ts';
import { newId } from './open.ts';
import { remade } from './remake.ts';
import { releaseRestored, restored } from './restore.ts';
import type { KeptFile, Restored } from './restore.ts';
import { mayMove } from './texture.ts';

const SECOND = 'Second model';
const NORMALS = 'Normals';
const PICTURE = 'Picture';

export function followMade(page: Page): void {
  let keeping: Keeping | undefined;
  const slots = ALL_MADE.map((item) => MADE[item].slot);
  page.store.on(['model', 'kept', 'results', 'second', 'visible', 'halves', 'against', 'placement', 'seams', 'picture', ...slots], ({ model }) => {
    const { source } = page;
    if (!model || !source) return;
    if (keeping?.isOf(source, model)) return keeping.follow();
    keeping = new Keeping(page, source, model, keeping);
    void keeping.start();
  });
}

type Thing = Pick<Belonging, 'id' | 'kind' | 'title'> & { content(): Promise<unknown> };

interface Entry extends Pick<Belonging, 'id' | 'title'> {
  /** Undefined while it is being written. */
  isKept?: boolean;
}

/** Of one model, as long as it is shown. */
class Keeping {
  readonly #page: Page;
  readonly #source: Source;
  readonly #shape: Model['shape'];
  readonly #engine: Page['engine'];
  /** By what they are of: results, the source of the second model, the normals. */
  readonly #entries = new Map<object, Entry>();
  /** How all is shown, as it was written last. */
  #left?: string;
  /** A texture that is still to be made again. */
  #awaited?: PackedTexture;
  #isReady = false;
  #isForgotten = false;
  #isOver = false;
  /** What is written is written in order. */
  #writing: Promise<void> = Promise.resolve();

  constructor(page: Page, source: Source, { shape }: Model, before: Keeping | undefined) {
    this.#page = page;
    this.#source = source;
    this.#shape = shape;
    this.#engine = page.engine;
    if (before) before.#hand(this);
  }

  isOf(source: Source, { shape }: Model): boolean {
    return shape === this.#shape && isSame(source, this.#source);
  }

  /** Ends. Of the same model, read again in a new engine, what is still there need not be read. */
  #hand(next: Keeping): void {
    this.#isOver = true;
    if (!isSame(this.#source, next.#source)) return;
    const things = next.#things();
    for (const [of, entry] of this.#entries) if (things.has(of)) next.#entries.set(of, entry);
  }

  /** Shows again what was kept; the first view of the model does not wait for that. */
  async start(): Promise<void> {
    const { store } = this.#page;
    store.set({ unkept: [] });
    await nextFrame();
    const again = await restored(this.#page, this.#source, new Set([...this.#entries.values()].map(({ id }) => id)));
    if (this.#isOver) return releaseRestored(again);
    this.#show(again);
    if (again.lost.length > 0) store.set({ problem: lost(again.lost) });
    this.#isReady = true;
    this.#awaited = again.texture;
    this.#left = again.left && JSON.stringify(again.left);
    this.follow();
    if (again.texture) await this.#remake(again.texture, again.left);
  }

  /** One that fails, or that the person cancels, is not tried again. */
  async #remake(texture: PackedTexture, left: Left | undefined): Promise<void> {
    const { store } = this.#page;
    const { visible, model } = store.state;
    const { milliseconds, recipe } = texture;
    const isWanted = (): boolean => !this.#isOver && this.#awaited === texture && !store.state.texture;
    try {
      const value = model?.shape.kind === 'soup' ? await remade(this.#page, model.shape, recipe, isWanted) : undefined;
      this.#awaited = undefined;
      if (value) store.set({ texture: { value, milliseconds }, isFlowing: mayMove(), ...asTextureLeft(value, left, store.state.visible === visible) });
    } catch (error) {
      this.#awaited = undefined;
      this.#write(() => removeBelongings((['texture', 'picture'] as const).map((kind) => onlyOne(this.#source, kind))));
      await fail(this.#page, 'The texture could not be made again', error);
    }
    if (!this.#isOver) this.follow();
  }

  #show({ results, second, picture, left }: Restored): void {
    const { store } = this.#page;
    const { oriented } = this.#source;
    const kept = new Map<Result, string>();
    for (const [id, making] of results) kept.set({ id: nextId(store.state.results) + kept.size, ...making }, id);
    for (const [result, id] of kept) this.#entries.set(result, { id, title: labelOf(result), isKept: true });
    if (oriented && !this.#entries.has(oriented)) this.#entries.set(oriented, { id: onlyOne(this.#source, 'normals'), title: NORMALS, isKept: true });
    if (picture && !store.state.picture) {
      this.#entries.set(picture, { id: onlyOne(this.#source, 'picture'), title: PICTURE, isKept: true });
      store.set({ picture });
    }
    if (second && this.#page.secondSource) second.value.shape.free();
    else if (second) {
      this.#entries.set(second.source, { id: onlyOne(this.#source, 'second'), title: SECOND, isKept: true });
      this.#page.secondSource = second.source;
      store.set({ second: second.value, placement: left?.placement ?? firstPlacement(store.state.model!.bounds, second.value.bounds) });
    }
    if (this.#entries.size > 0) store.set(asLeft(store.state, kept, left));
  }

  /** Writes what has changed. */
  follow(): void {
    const { kept } = this.#page.store.state;
    // Of an engine that ended nothing is left to be read: that is no removal.
    if (!this.#isReady || this.#page.engine !== this.#engine) return;
    if (kept === false && !this.#isForgotten) this.#forget();
    this.#isForgotten = kept === false;
    if (this.#source.sample === undefined && kept !== true) return;
    const things = this.#things();
    for (const [of, { id }] of this.#entries) {
      if (things.has(of)) continue;
      this.#entries.delete(of);
      this.#write(() => removeBelongings([id]));
    }
    for (const [of, thing] of things) if (!this.#entries.has(of)) this.#keep(of, thing);
    // As it is shown with the texture is not known before that is there.
    if (!this.#awaited) this.#keepLeft();
    this.#tell();
  }

  /** Nothing is kept any longer, not even what was on its way. */
  #forget(): void {
    this.#awaited = undefined;
    const entries = [...this.#entries.values()];
    for (const entry of entries) entry.isKept = false;
    this.#write(() => removeBelongings(entries.map(({ id }) => id)));
  }

  #things(): Map<object, Thing> {
    const { store, secondSource: second, source } = this.#page;
    const things = new Map<object, Thing>();
    const { results, picture } = store.state;
    for (const result of results) {
      const kind = result.item === 'textured' ? 'texture' : 'result';
      const id = kind === 'texture' ? onlyOne(this.#source, kind) : (this.#entries.get(result)?.id ?? newId());
      things.set(result, { id, kind, title: labelOf(result), content: () => packed(result) });
    }
    if (second) things.set(second, { id: onlyOne(this.#source, 'second'), kind: 'second', title: SECOND, content: () => fileOf(second) });
    if (picture && (store.state.texture || this.#awaited)) things.set(picture, { id: onlyOne(this.#source, 'picture'), kind: 'picture', title: PICTURE, content: () => pictureFileOf(picture) });
    const oriented = source?.oriented;
    if (oriented) things.set(oriented, { id: onlyOne(this.#source, 'normals'), kind: 'normals', title: NORMALS, content: async () => oriented });
    return things;
  }

  #keep(of: object, { content, ...belonging }: Thing): void {
    const entry: Entry = { id: belonging.id, title: belonging.title };
    this.#entries.set(of, entry);
    this.#write(async () => {
      const value = await content().catch(() => undefined);
      const isWanted = this.#entries.get(of) === entry && entry.isKept === undefined;
      const isKept = isWanted && value !== undefined && (await keepBelonging(this.#source, belonging, value));
      entry.isKept ??= isKept;
      this.#tell();
    });
  }

  #keepLeft(): void {
    const entries = [...this.#entries.values()].filter(({ isKept }) => isKept !== false);
    const left = leftOf(this.#page.store.state, (result) => this.#entries.get(result)?.id);
    const text = entries.length > 0 ? JSON.stringify(left) : undefined;
    if (text === this.#left) return;
    this.#left = text;
    const id = onlyOne(this.#source, 'view');
    this.#write(async () => {
      // A later one is on its way.
      if (text !== this.#left) return;
      if (text === undefined) await removeBelongings([id]);
      else await keepBelonging(this.#source, { id, kind: 'view', title: 'View' }, left);
    });
  }

  #write(work: () => Promise<unknown>): void {
    this.#writing = this.#writing.then(work).then(() => undefined);
  }

  /** Says what is kept, and what is not. */
  #tell(): void {
    if (this.#isOver) return;
    const { store } = this.#page;
    const entries = [...this.#entries.values()];
    const unkept = entries.filter(({ isKept }) => isKept === false).map(({ title }) => title);
    if (unkept.join() !== store.state.unkept.join()) store.set({ unkept });
    if (this.#source.sample === undefined) return;
    const isKept = entries.some((entry) => entry.isKept === true);
    if (isKept || store.state.kept) store.set({ kept: isKept || undefined });
  }
}

/** A second model as a file. */
async function fileOf({ name, read }: Source): Promise<KeptFile> {
  const bytes = await read(new AbortController().signal);
  return { name, content: new Blob([bytes as Uint8Array<ArrayBuffer>]) };
}

async function pictureFileOf({ name, given }: Picture): Promise<KeptFile | undefined> {
  return given && { name, content: new Blob([await given.arrayBuffer()], { type: given.type }) };
}
