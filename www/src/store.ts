/** Holds the page's state; a change is told to those who listen to a part that changed. */
export class Store<S extends object> {
  #state: S;
  readonly #listeners: { keys: readonly (keyof S)[]; call: (state: Readonly<S>) => void }[] = [];

  constructor(initial: S) {
    this.#state = initial;
  }

  get state(): Readonly<S> {
    return this.#state;
  }

  set(patch: Partial<S>): void {
    const before = this.#state;
    this.#state = { ...before, ...patch };
    const changed = (Object.keys(patch) as (keyof S)[]).filter((key) => before[key] !== this.#state[key]);
    for (const { keys, call } of this.#listeners) {
      if (keys.some((key) => changed.includes(key))) call(this.#state);
    }
  }

  /** Calls at once, and again after each change of one of `keys`. */
  on(keys: readonly (keyof S)[], call: (state: Readonly<S>) => void): void {
    this.#listeners.push({ keys, call });
    call(this.#state);
  }
}
