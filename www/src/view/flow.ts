import type { BufferGeometry, LineSegments, ShaderMaterial } from 'three';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';
import { fieldLines, ROUND, show } from './field-lines.ts';
import type { Part, Surroundings } from './part.ts';
import type { Stage } from './stage.ts';

const ROUND_SECONDS = 3.5;

/** The field lines in the 3D view, at rest or flowing. */
export class Flow {
  readonly #store: Store<State>;
  readonly #stage: Stage;
  readonly #part: Part;
  #lines?: LineSegments<BufferGeometry, ShaderMaterial>;
  #start?: number;

  constructor(store: Store<State>, stage: Stage, part: Part) {
    this.#store = store;
    this.#stage = stage;
    this.#part = part;
    store.on(['isFlowing', 'visible', 'halves', 'texture'], () => this.#move());
    matchMedia('(prefers-reduced-motion: reduce)').addEventListener('change', ({ matches }) => {
      if (matches) store.set({ isFlowing: false });
    });
  }

  refresh(surroundings: Surroundings): void {
    const { texture } = this.#store.state;
    this.#lines = texture ? fieldLines(texture.value.lines, surroundings) : undefined;
    this.#part.replace(...(this.#lines ? [this.#lines] : []));
    this.#stage.draw();
  }

  get #isMoving(): boolean {
    const { isFlowing, visible, halves, texture } = this.#store.state;
    return isFlowing && visible.fieldLines && !halves && texture !== undefined;
  }

  #move(): void {
    if (this.#isMoving && this.#start === undefined) {
      this.#start = performance.now();
      requestAnimationFrame((now) => this.#step(now));
    }
  }

  /** A page out of sight gets no frames. */
  #step(now: number): void {
    const isMoving = this.#isMoving;
    const seconds = Math.max(0, now - (this.#start ?? now)) / 1000;
    if (this.#lines) show(this.#lines.material, isMoving ? ((seconds / ROUND_SECONDS) % 1) * ROUND : undefined);
    this.#stage.draw();
    if (isMoving) requestAnimationFrame((next) => this.#step(next));
    else this.#start = undefined;
  }
}
