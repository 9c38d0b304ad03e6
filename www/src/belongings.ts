/** What belongs to a model, and is kept with it: what was made of it, its second model, its normals, and how it was shown. Of a texture, how it is made. */
import { transact } from './database.ts';
import type { Kept } from './kept.ts';
import type { Source, Unit } from './page.ts';
import { makeRoom, MOST, MOST_OF_ALL } from './room.ts';

/** Of what is kept; what has another one is not understood. */
const VERSION = 1;

export type Kind = 'result' | 'texture' | 'picture' | 'normals' | 'second' | 'view';

/** Whose it is. In another unit the model is another one. */
export type Owner = Pick<Source, 'id' | 'unit' | 'sample'>;

export interface Belonging {
  readonly id: string;
  /** The id of the model's source. */
  readonly model: string;
  readonly unit: Unit;
  readonly kind: Kind;
  /** What a person calls it. */
  readonly title: string;
  readonly version: number;
  readonly bytes: number;
  /** Later than that of what the model had before. */
  readonly time: number;
}

/** The id of what a model has one of. */
export function onlyOne({ id, unit }: Owner, kind: Exclude<Kind, 'result'>): string {
  return `${id}/${unit}/${kind}`;
}

/** Whether it is kept now. Nothing is that is too large, or whose model is a file that is not kept. */
export async function keepBelonging(owner: Owner, { id, kind, title }: Pick<Belonging, 'id' | 'kind' | 'title'>, content: unknown): Promise<boolean> {
  const bytes = bytesOf(content);
  if (bytes > MOST) return false;
  const isKept = await transact('readwrite', async (shelves) => {
    const file = await shelves.files.get<Kept>(owner.id);
    if (owner.sample === undefined && !file) return false;
    const others = (await shelves.belongings.all<Belonging>()).filter((other) => other.model === owner.id && other.id !== id);
    if (others.reduce((sum, other) => sum + other.bytes, bytes + (file?.content.size ?? 0)) > MOST_OF_ALL) return false;
    const time = Math.max(Date.now(), ...others.map((other) => other.time + 1));
    const belonging: Belonging = { id, model: owner.id, unit: owner.unit, kind, title, version: VERSION, bytes, time };
    await shelves.belongings.put(belonging);
    await shelves.contents.put(content, id);
    await makeRoom(shelves);
    return true;
  });
  return isKept ?? false;
}

/** The oldest first. What is not understood is removed. */
export async function belongingsOf({ id, unit }: Owner): Promise<Belonging[]> {
  const own = await transact('readonly', async ({ belongings }) => (await belongings.all<Belonging>()).filter(({ model }) => model === id));
  const [known, unknown] = [true, false].map((isKnown) => (own ?? []).filter(({ version }) => (version === VERSION) === isKnown));
  if (unknown.length > 0) await removeBelongings(unknown.map((belonging) => belonging.id));
  return known.filter((belonging) => belonging.unit === unit).sort((a, b) => a.time - b.time);
}

export async function contentOf(id: string): Promise<unknown> {
  return transact('readonly', ({ contents }) => contents.get(id));
}

export async function removeBelongings(ids: readonly string[]): Promise<void> {
  await transact('readwrite', async ({ belongings, contents }) => {
    for (const id of ids) {
      await belongings.delete(id);
      await contents.delete(id);
    }
  });
}

/** How much plain data takes, about. */
function bytesOf(value: unknown): number {
  if (ArrayBuffer.isView(value)) return value.byteLength;
  if (value instanceof Blob) return value.size;
  if (typeof value === 'string') return 2 * value.length;
  if (typeof value !== 'object' || value === null) return 8;
  return Object.values(value).reduce<number>((sum, part) => sum + bytesOf(part), 0);
}
