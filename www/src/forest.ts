/** Disjoint sets of the numbers below a count. */
export class Forest {
  readonly #parents: Uint32Array;

  constructor(count: number) {
    this.#parents = Uint32Array.from({ length: count }, (_, k) => k);
  }

  join(a: number, b: number): void {
    const [first, second] = [this.#root(a), this.#root(b)];
    this.#parents[Math.max(first, second)] = Math.min(first, second);
  }

  groups(): number[][] {
    const groups = new Map<number, number[]>();
    this.#parents.forEach((_, k) => {
      const root = this.#root(k);
      const group = groups.get(root);
      if (group) group.push(k);
      else groups.set(root, [k]);
    });
    return [...groups.values()];
  }

  #root(k: number): number {
    while (this.#parents[k] !== k) {
      this.#parents[k] = this.#parents[this.#parents[k]];
      k = this.#parents[k];
    }
    return k;
  }
}
