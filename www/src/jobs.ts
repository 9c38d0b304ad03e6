import type { CallOptions } from 'fast-winding';
import type { State } from './state.ts';
import type { Store } from './store.ts';

/** Why a job is aborted when another one takes its place. */
export const FOLLOWED = 'another job takes its place';

/** Runs long work one piece at a time, tells its progress to the store and can cancel it. */
export class Jobs {
  readonly #store: Store<State>;
  #running?: { controller: AbortController; settled: Promise<unknown> };
  /** The label of what the person has cancelled. */
  #cancelled?: string;

  constructor(store: Store<State>) {
    this.#store = store;
  }

  get isRunning(): boolean {
    return this.#running !== undefined;
  }

  /** Resolves when none runs. */
  async idle(): Promise<void> {
    while (this.#running) await this.#running.settled;
  }

  /** Cancels what runs, waits until it has stopped, then starts `work`, which tells its own progress. It is `isPatient` that is asked for again if it had to stop. */
  async run<T>(label: string, work: (options: Required<CallOptions>) => Promise<T>, isPatient = false): Promise<T> {
    while (this.#running) {
      this.#running.controller.abort(FOLLOWED);
      await this.#running.settled;
    }
    const controller = new AbortController();
    this.#store.set({ job: { label, stage: '', canCancel: true, isPatient } });
    const result = work({
      signal: controller.signal,
      onProgress: (fraction, stage) => {
        if (!controller.signal.aborted) this.#store.set({ job: { label, stage, fraction: Number.isFinite(fraction) ? fraction : undefined, canCancel: true, isPatient } });
      },
    });
    const running = { controller, settled: result.catch(() => undefined) };
    this.#running = running;
    try {
      return await result;
    } finally {
      this.#running = undefined;
      const note = this.#cancelled ? { note: `${this.#cancelled}: cancelled` } : {};
      this.#cancelled = undefined;
      this.#store.set({ job: undefined, ...note });
    }
  }

  cancel(): void {
    const job = this.#store.state.job;
    if (!job || !this.#running) return;
    this.#running.controller.abort();
    this.#cancelled = job.label;
    this.#store.set({ job: { ...job, stage: 'stopping', fraction: undefined, canCancel: false } });
  }
}
