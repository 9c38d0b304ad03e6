import { init } from 'fast-winding';
import type { FastWinding, ReadOptions, Warning } from 'fast-winding';
import { Jobs } from './jobs.ts';
import { initialState } from './state.ts';
import type { State } from './state.ts';
import { Store } from './store.ts';

export type Unit = NonNullable<ReadOptions['unit']>;

/** A cloud with the normals that were estimated for it, and what was known of it. */
export interface Oriented {
  /** What `save` gives. */
  readonly content: Blob;
  readonly format: string;
  readonly warnings: readonly Warning[];
}

/** Where a model comes from; read again when the engine had to be replaced. */
export interface Source {
  readonly name: string;
  /** No other source has it. */
  readonly id: string;
  /** The file of a sample; absent for all else. */
  readonly sample?: string;
  /** Of the file's numbers, where its format does not say. */
  readonly unit: Unit;
  /** What is to be read in the place of the file. */
  readonly oriented?: Oriented;
  read(signal: AbortSignal): Promise<Uint8Array>;
}

/** Whether both are the same model: in another unit it is another one. */
export function isSame(a: Source | undefined, b: Source | undefined): boolean {
  return a?.id === b?.id && a?.unit === b?.unit;
}

/** What every action works with. */
export interface Page {
  readonly store: Store<State>;
  readonly jobs: Jobs;
  engine: FastWinding;
  /** Of the model that is shown. */
  source?: Source;
  /** Of what it is combined with. */
  secondSource?: Source;
  /** Pending while a new engine takes the place of one that died. */
  revival?: Promise<void>;
}

/** Starts the engine; rejects when the browser cannot run it at all. */
export async function startPage(store: Store<State> = new Store(initialState())): Promise<Page> {
  const engine = await init();
  store.set({ info: engine.info });
  return { store, jobs: new Jobs(store), engine };
}

/** Ends the engine with all its handles and starts another. */
export async function restartEngine(page: Page): Promise<void> {
  page.engine.dispose();
  page.engine = await init();
  page.store.set({ info: page.engine.info });
}
