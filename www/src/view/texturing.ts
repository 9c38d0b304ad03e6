import type { BufferGeometry, Mesh, MeshStandardMaterial, Object3D, Plane } from 'three';
import { checker } from '../picture.ts';
import type { Item, State } from '../state.ts';
import type { Store } from '../store.ts';
import { Flow } from './flow.ts';
import { Marking } from './marking.ts';
import type { Markable } from './marking.ts';
import { Part } from './part.ts';
import type { Surroundings } from './part.ts';
import type { Stage } from './stage.ts';
import { chartMesh, drawnSeams, letThrough, seamLines, texturedMesh } from './textured.ts';

/** Things inside the proxy, or beside it, that are to be seen through it. */
const WITHIN: readonly Item[] = ['model', 'textured', 'fieldLines', 'surface', 'voxels', 'repaired', 'combined'];

/** A textured model, its proxy and its field lines in the 3D view. */
export class TexturingView {
  readonly #store: Store<State>;
  readonly #stage: Stage;
  readonly #parts: Record<'proxy' | 'textured', Part>;
  readonly #drawn = new Part();
  readonly #flow: Flow;
  #charts?: Mesh<BufferGeometry, MeshStandardMaterial>;
  #seams: Object3D[] = [];
  #cut: Plane[] = [];

  constructor(store: Store<State>, stage: Stage, parts: Record<'proxy' | 'textured' | 'fieldLines', Part>) {
    this.#store = store;
    this.#stage = stage;
    this.#parts = parts;
    this.#flow = new Flow(store, stage, parts.fieldLines);
    stage.scene.add(this.#drawn.group);
    new Marking(stage, () => this.#markable(), (vertex) => stage.canvas.dispatchEvent(new CustomEvent('mark', { detail: vertex })));
    store.on(['texture'], () => this.refresh());
    store.on(['picture'], () => this.#showTextured());
    store.on(['seams', 'seamStart', 'texture'], () => this.#showDrawn());
    store.on(['visible', 'halves'], () => this.#fit());
    store.on(['isDrawing'], ({ isDrawing }) => stage.canvas.classList.toggle('marking', isDrawing));
  }

  /** Draws all anew, with the colours of the style sheet as they are now. */
  refresh(cut = this.#cut): void {
    this.#cut = cut;
    const { texture } = this.#store.state;
    this.#charts = texture && chartMesh(texture.value.proxy, this.#surroundings);
    this.#seams = texture ? seamLines(texture.value.proxy, this.#surroundings) : [];
    this.#parts.proxy.replace(...(this.#charts ? [this.#charts] : []), ...this.#seams);
    this.#flow.refresh(this.#surroundings);
    this.#showTextured();
    this.#showDrawn();
    this.#fit();
  }

  get #surroundings(): Surroundings {
    return { origin: this.#store.state.model?.geometry.origin ?? new Float64Array(3), cut: this.#cut };
  }

  #showTextured(): void {
    const { texture, picture } = this.#store.state;
    this.#parts.textured.replace(...(texture ? [texturedMesh(texture.value.soup, picture ?? checker(), this.#surroundings)] : []));
    this.#stage.draw();
  }

  #showDrawn(): void {
    const { texture, seams, seamStart } = this.#store.state;
    this.#drawn.replace(...(texture ? drawnSeams(texture.value.proxy, seams, seamStart, this.#surroundings) : []));
    this.#stage.draw();
  }

  /** Drawn seams are where the proxy is; those of charts would hide what is seen through it. */
  #fit(): void {
    const { visible, halves } = this.#store.state;
    this.#drawn.group.visible = visible.proxy && !halves;
    const isAround = WITHIN.some((item) => visible[item]);
    if (this.#charts) letThrough(this.#charts, isAround);
    for (const lines of this.#seams) lines.visible = !isAround;
    this.#stage.draw();
  }

  #markable(): Markable | undefined {
    const { texture, isDrawing, visible, halves, job, seams, seamStart: start } = this.#store.state;
    if (!texture || !this.#charts || !isDrawing || !visible.proxy || halves || job) return undefined;
    return { mesh: this.#charts, proxy: texture.value.proxy, origin: this.#surroundings.origin, seams, start };
  }
}
