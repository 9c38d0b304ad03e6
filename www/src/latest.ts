/** A request older than this is stopped when a newer one waits; a younger one may finish, so that a moving slider still shows something. */
const PATIENCE_MILLISECONDS = 250;

/** Runs the newest request only: one at work, one waiting, all between forgotten. */
export class Latest<T> {
  readonly #work: (request: T, signal: AbortSignal) => Promise<void>;
  #running?: { controller: AbortController; since: number };
  #waiting?: { request: T };
  #timer?: ReturnType<typeof setTimeout>;

  /** `work` must stop early, without throwing, when its signal says so. */
  constructor(work: (request: T, signal: AbortSignal) => Promise<void>) {
    this.#work = work;
  }

  request(request: T): void {
    this.#waiting = { request };
    if (!this.#running) return void this.#drain();
    clearTimeout(this.#timer);
    const age = performance.now() - this.#running.since;
    const { controller } = this.#running;
    this.#timer = setTimeout(() => controller.abort(), Math.max(0, PATIENCE_MILLISECONDS - age));
  }

  async #drain(): Promise<void> {
    while (this.#waiting) {
      const { request } = this.#waiting;
      this.#waiting = undefined;
      const controller = new AbortController();
      this.#running = { controller, since: performance.now() };
      await this.#work(request, controller.signal);
      clearTimeout(this.#timer);
      this.#running = undefined;
    }
  }
}
