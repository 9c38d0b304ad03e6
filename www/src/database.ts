/** The page's database in the browser. Where a browser keeps nothing, or has no room, nothing is what comes of a request. */

const NAME = 'fast-winding';
/** One more with each store that comes. */
const VERSION = 2;

/** Files of models; what is known of things that belong to a model; what these hold, read only when it is needed. */
const STORES = ['files', 'belongings', 'contents'] as const;

/** One store of a transaction, its requests as promises. */
export class Shelf {
  readonly #store: IDBObjectStore;

  constructor(store: IDBObjectStore) {
    this.#store = store;
  }

  get<T>(id: string): Promise<T | undefined> {
    return answer(this.#store.get(id) as IDBRequest<T | undefined>);
  }

  all<T>(): Promise<T[]> {
    return answer(this.#store.getAll() as IDBRequest<T[]>);
  }

  async put(value: unknown, id?: string): Promise<void> {
    await answer(this.#store.put(value, id));
  }

  async delete(id: string): Promise<void> {
    await answer(this.#store.delete(id));
  }

  async clear(): Promise<void> {
    await answer(this.#store.clear());
  }
}

export type Shelves = Readonly<Record<(typeof STORES)[number], Shelf>>;

/** What `work` gives, all of whose requests are done, or none. It may wait for these alone, or the transaction ends. */
export async function transact<T>(mode: IDBTransactionMode, work: (shelves: Shelves) => Promise<T>): Promise<T | undefined> {
  try {
    const database = await opened();
    try {
      const transaction = database.transaction(STORES, mode);
      const isDone = new Promise<void>((resolve, reject) => {
        transaction.oncomplete = () => resolve();
        transaction.onabort = () => reject(transaction.error);
      });
      const shelves = Object.fromEntries(STORES.map((name) => [name, new Shelf(transaction.objectStore(name))])) as Shelves;
      const [result] = await Promise.all([work(shelves).catch((error) => giveUp(transaction, error)), isDone]);
      return result;
    } finally {
      database.close();
    }
  } catch {
    return undefined;
  }
}

/** Takes back what is done so far. */
function giveUp(transaction: IDBTransaction, error: unknown): never {
  transaction.abort();
  throw error;
}

function answer<T>(request: IDBRequest<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

function opened(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(NAME, VERSION);
    request.onupgradeneeded = () => {
      const { result: database } = request;
      for (const name of STORES) {
        if (!database.objectStoreNames.contains(name)) database.createObjectStore(name, name === 'contents' ? undefined : { keyPath: 'id' });
      }
    };
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}
