/** How much the browser keeps: models that were used longest ago make way, with all that belongs to them. */
import type { Belonging } from './belongings.ts';
import type { Shelves } from './database.ts';
import type { Kept } from './kept.ts';

/** Bytes of one thing. */
export const MOST = 64e6;
/** Bytes of all. */
export const MOST_OF_ALL = 128e6;

export async function makeRoom({ files, belongings, contents }: Shelves): Promise<void> {
  const things = await belongings.all<Belonging>();
  const models = new Map<string, { bytes: number; time: number }>();
  const add = (model: string, bytes: number, time: number): void => {
    const before = models.get(model) ?? { bytes: 0, time: 0 };
    models.set(model, { bytes: before.bytes + bytes, time: Math.max(before.time, time) });
  };
  for (const { id, content, time } of await files.all<Kept>()) add(id, content.size, time);
  for (const { model, bytes, time } of things) add(model, bytes, time);
  let bytes = 0;
  for (const [model, own] of [...models].sort(([, a], [, b]) => b.time - a.time)) {
    bytes += own.bytes;
    if (bytes <= MOST_OF_ALL) continue;
    await files.delete(model);
    for (const { id } of things.filter((thing) => thing.model === model)) {
      await belongings.delete(id);
      await contents.delete(id);
    }
  }
}
