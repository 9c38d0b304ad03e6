/** Files that the browser keeps, so that they are there when the page is loaded again. */
import type { Unit } from './page.ts';

export interface Kept {
  readonly id: string;
  readonly name: string;
  readonly unit: Unit;
  /** Read when it is needed. */
  readonly content: Blob;
  /** When it was opened last. */
  readonly time: number;
}

/** Bytes of one file, and of all: the oldest make way. */
const MOST = 64e6;
const MOST_OF_ALL = 128e6;
const DATABASE = 'fast-winding';
const STORE = 'files';

/** Whether the file is kept now; the one that is too large, or whose browser keeps nothing, is not. */
export async function keep(file: Omit<Kept, 'time'>): Promise<boolean> {
  if (file.content.size > MOST) return false;
  const isDone = await transact('readwrite', (files) => files.put({ ...file, time: Date.now() }));
  await makeRoom();
  return isDone !== undefined;
}

export async function keptFile(id: string): Promise<Kept | undefined> {
  return transact('readonly', (files) => files.get(id) as IDBRequest<Kept | undefined>);
}

export async function forgetFiles(): Promise<void> {
  await transact('readwrite', (files) => files.clear());
}

async function makeRoom(): Promise<void> {
  const files = (await transact('readonly', (store) => store.getAll() as IDBRequest<Kept[]>)) ?? [];
  files.sort((a, b) => b.time - a.time);
  let bytes = 0;
  for (const file of files) {
    bytes += file.content.size;
    if (bytes > MOST_OF_ALL) await transact('readwrite', (store) => store.delete(file.id));
  }
}

/** What a request gives; nothing where the browser keeps nothing, or has no room. */
async function transact<T>(mode: IDBTransactionMode, work: (files: IDBObjectStore) => IDBRequest<T>): Promise<T | undefined> {
  try {
    const database = await opened();
    try {
      const transaction = database.transaction(STORE, mode);
      const request = work(transaction.objectStore(STORE));
      return await new Promise<T>((resolve, reject) => {
        transaction.oncomplete = () => resolve(request.result);
        transaction.onabort = () => reject(transaction.error);
      });
    } finally {
      database.close();
    }
  } catch {
    return undefined;
  }
}

function opened(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(DATABASE, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE, { keyPath: 'id' });
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}
