/** What was kept of a model, read again. */
import { belongingsOf, contentOf, onlyOne, removeBelongings } from '../belongings.ts';
import type { Belonging, Owner } from '../belongings.ts';
import type { Left } from '../left.ts';
import type { Making } from '../made.ts';
import { unpacked, unpackedTexture } from '../packing.ts';
import type { PackedTexture } from '../packing.ts';
import type { Page, Source } from '../page.ts';
import { readPicture } from '../picture.ts';
import type { Picture } from '../picture.ts';
import { isAborted, isLost } from '../problem.ts';
import type { Second } from '../state.ts';
import { isRecord } from '../storage.ts';
import { load } from './load.ts';
import { MOST, release } from './results.ts';

export interface Restored {
  /** In their order, by what they are kept as. */
  readonly results: ReadonlyMap<string, Making>;
  readonly second?: { readonly source: Source; readonly value: Second };
  /** Still to be made. */
  readonly texture?: PackedTexture;
  readonly picture?: Picture;
  readonly left?: Left;
  /** Titles of what could not be read, and is not kept any longer. */
  readonly lost: readonly string[];
}

/** Reads all that belongs to a model but is not there, one after the other; what fails is left out. */
export async function restored(page: Page, owner: Owner, there: ReadonlySet<string>): Promise<Restored> {
  const belongings = (await belongingsOf(owner)).filter(({ id }) => !there.has(id));
  const ofKind = (kind: Belonging['kind']): Belonging[] => belongings.filter((belonging) => belonging.kind === kind);
  const lost: Belonging[] = [];
  const attempt = async <T>(belonging: Belonging, read: (content: unknown) => Promise<T>): Promise<T | undefined> => {
    try {
      return await read(await contentOf(belonging.id));
    } catch (error) {
      // An engine that ended tells nothing of what it was given.
      if (!isAborted(error) && !isLost(error)) lost.push(belonging);
      return undefined;
    }
  };
  const all = ofKind('result');
  const results = new Map<string, Making>();
  for (const belonging of all.slice(-MOST)) {
    const making = await attempt(belonging, (content) => unpacked(page.engine, content));
    if (making) results.set(belonging.id, making);
  }
  const [ofSecond] = page.secondSource ? [] : ofKind('second');
  const second = ofSecond && (await attempt(ofSecond, (content) => secondOf(page, content)));
  const [ofTexture] = ofKind('texture');
  const [ofPicture] = page.store.state.picture ? [] : ofKind('picture');
  const texture = ofTexture && (await attempt(ofTexture, async (content) => unpackedTexture(content)));
  const picture = ofPicture && (await attempt(ofPicture, pictureOf));
  const left = (await contentOf(onlyOne(owner, 'view'))) as Left | undefined;
  const gone = [...lost, ...all.slice(0, -MOST)];
  if (gone.length > 0) await removeBelongings(gone.map(({ id }) => id));
  return { results, second, texture, picture, left, lost: lost.map(({ title }) => title) };
}

/** Gives back what is not wanted after all. */
export function releaseRestored({ results, second }: Restored): void {
  [...results.values()].forEach(release);
  second?.value.shape.free();
}

/** What is kept of a second model, and of a picture: a file, as it is. */
export interface KeptFile {
  readonly name: string;
  readonly content: Blob;
}

async function secondOf(page: Page, content: unknown): Promise<{ source: Source; value: Second }> {
  const { name, content: file } = fileIn(content);
  const source: Source = { name, id: name, unit: 'millimeter', read: async () => new Uint8Array(await file.arrayBuffer()) };
  const { shape, geometry, bounds } = await load(page, source, { signal: new AbortController().signal, onProgress: () => undefined });
  return { source, value: { name, shape, geometry, bounds } };
}

async function pictureOf(content: unknown): Promise<Picture> {
  const { name, content: file } = fileIn(content);
  return readPicture(new File([file], name, { type: file.type }));
}

function fileIn(content: unknown): KeptFile {
  if (!isRecord(content) || typeof content.name !== 'string' || !(content.content instanceof Blob)) throw new Error('this is no file');
  return content as unknown as KeptFile;
}
