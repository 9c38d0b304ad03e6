import { ConeGeometry, Mesh, MeshStandardMaterial } from 'three';
import type { LineSegments } from 'three';
import { token } from '../dom.ts';
import type { Print } from '../print.ts';
import { movesIn, tipOf } from '../segments.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';
import { thinLines } from './lines.ts';
import type { Part } from './part.ts';
import { Ribbons } from './ribbons.ts';
import type { Range } from './ribbons.ts';
import type { Stage } from './stage.ts';

/** Millimetres: the cone of a common nozzle. */
const NOZZLE_HEIGHT = 5;
const NOZZLE_RADIUS = 2;

/** The print in the 3D view: its moves up to the nozzle, the nozzle while a layer is being laid, and the bed. */
export class Preview {
  readonly #store: Store<State>;
  readonly #stage: Stage;
  readonly #part: Part;
  #ribbons?: Ribbons;
  #nozzle?: Mesh;

  constructor(store: Store<State>, stage: Stage, part: Part) {
    this.#store = store;
    this.#stage = stage;
    this.#part = part;
    store.on(['print'], () => this.refresh());
    store.on(['nozzle', 'onlyLayer', 'hiddenMoves'], () => this.#show());
  }

  /** Makes everything anew, with the colours of the style sheet as they are now. */
  refresh(): void {
    const { print, model } = this.#store.state;
    this.#ribbons?.dispose();
    this.#ribbons = this.#nozzle = undefined;
    if (print && model) {
      this.#ribbons = new Ribbons(print.value.segments);
      this.#nozzle = nozzleCone();
      this.#part.replace(this.#ribbons.mesh, this.#nozzle, bedOf(print.value, model.geometry.origin));
    } else this.#part.replace();
    this.#show();
  }

  #show(): void {
    const { print, nozzle, onlyLayer, hiddenMoves } = this.#store.state;
    if (print && this.#ribbons && this.#nozzle) {
      const { segments } = print.value;
      this.#ribbons.show(rangeOf(segments.starts, nozzle.layer, nozzle.moves, onlyLayer), hiddenMoves);
      this.#nozzle.visible = segments.count > 0 && nozzle.moves < movesIn(segments, nozzle.layer);
      if (this.#nozzle.visible) this.#nozzle.position.set(...tipOf(segments, nozzle));
    }
    this.#stage.draw();
  }
}

function rangeOf(starts: Uint32Array, layer: number, moves: number, onlyLayer: boolean): Range {
  const whole = Math.ceil(moves);
  return { first: onlyLayer ? starts[layer] : 0, end: starts[layer] + whole, part: moves === whole ? 1 : moves - whole + 1 };
}

/** A cone whose tip is its origin. */
function nozzleCone(): Mesh {
  const geometry = new ConeGeometry(NOZZLE_RADIUS, NOZZLE_HEIGHT, 24);
  geometry.rotateX(-Math.PI / 2).translate(0, 0, NOZZLE_HEIGHT / 2);
  return new Mesh(geometry, new MeshStandardMaterial({ color: token('--print-nozzle'), roughness: 0.5, metalness: 0.2 }));
}

/** The bed's outline, where the print lies on it. */
function bedOf({ recipe: { profile }, gcode: { shift } }: Print, origin: Float64Array): LineSegments {
  const corner = profile.origin === 'center' ? [-profile.bedWidth / 2, -profile.bedDepth / 2] : [0, 0];
  const [x, y, z] = [corner[0] - shift[0] - origin[0], corner[1] - shift[1] - origin[1], -shift[2] - origin[2]];
  const [right, far] = [x + profile.bedWidth, y + profile.bedDepth];
  const ends = [x, y, z, right, y, z, right, y, z, right, far, z, right, far, z, x, far, z, x, far, z, x, y, z];
  return thinLines(new Float32Array(ends), '--print-bed');
}
