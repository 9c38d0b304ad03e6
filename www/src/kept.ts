/** Files that the browser keeps, so that they are there when the page is loaded again. */
import { transact } from './database.ts';
import type { Unit } from './page.ts';
import { makeRoom, MOST } from './room.ts';

export interface Kept {
  readonly id: string;
  readonly name: string;
  readonly unit: Unit;
  /** Read when it is needed. */
  readonly content: Blob;
  /** When it was opened last. */
  readonly time: number;
}

/** Whether the file is kept now; the one that is too large, or whose browser keeps nothing, is not. */
export async function keep(file: Omit<Kept, 'time'>): Promise<boolean> {
  if (file.content.size > MOST) return false;
  const isKept = await transact('readwrite', async (shelves) => {
    await shelves.files.put({ ...file, time: Date.now() });
    await makeRoom(shelves);
    return true;
  });
  return isKept ?? false;
}

export async function keptFile(id: string): Promise<Kept | undefined> {
  return transact('readonly', ({ files }) => files.get<Kept>(id));
}

/** Files, and all that belongs to any model. */
export async function forgetAll(): Promise<void> {
  await transact('readwrite', async (shelves) => {
    for (const shelf of Object.values(shelves)) await shelf.clear();
  });
}
