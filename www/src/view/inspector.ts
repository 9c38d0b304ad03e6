import { diagonal } from '../bounds.ts';
import type { Place } from '../places.ts';
import { shownOf } from '../shown.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';
import { defectObjects } from './defects.ts';
import type { Box } from './framing.ts';
import type { Part } from './part.ts';
import type { Stage } from './stage.ts';

/** Around a place at least this part of the model's diagonal is shown, to know where it is. */
const LEAST_VIEW = 0.08;
/** Room around a place, as a part of its own size. */
const ROOM = 0.6;

/** Defects, and triangles of a texture, in the 3D view: all of a kind in colour, one of them brighter, with the camera on it. */
export class Inspector {
  readonly #store: Store<State>;
  readonly #stage: Stage;
  readonly #part: Part;

  constructor(store: Store<State>, stage: Stage, part: Part) {
    this.#store = store;
    this.#stage = stage;
    this.#part = part;
    store.on(['defect', 'report'], () => {
      this.refresh();
      this.#look();
    });
  }

  refresh(): void {
    const { defect } = this.#store.state;
    const shown = shownOf(this.#store.state);
    if (!shown) return void this.#part.replace();
    const { places, geometry } = shown;
    const chosen = defect?.place === undefined ? [] : places.slice(defect.place, defect.place + 1);
    const others = places.filter((place) => !chosen.includes(place));
    this.#part.replace(...defectObjects(others, geometry, '--view-defect'), ...defectObjects(chosen, geometry, '--view-chosen'));
    this.#stage.draw();
  }

  #look(): void {
    const { model, defect } = this.#store.state;
    const places = shownOf(this.#store.state)?.places ?? [];
    if (!model || !defect || places.length === 0) return;
    const least = LEAST_VIEW * diagonal(model.bounds);
    const chosen = defect.place === undefined ? places : [places[defect.place]];
    this.#stage.look(around(chosen, least), chosen.length === 1 ? chosen[0].facing : undefined);
  }
}

function around(places: readonly Place[], least: number): Box {
  const side = (k: number): [number, number] => {
    const [low, high] = [Math.min(...places.map(({ min }) => min[k])), Math.max(...places.map(({ max }) => max[k]))];
    const half = Math.max(least, (high - low) * (1 + ROOM)) / 2;
    return [(low + high) / 2 - half, (low + high) / 2 + half];
  };
  const [x, y, z] = [0, 1, 2].map(side);
  return { min: [x[0], y[0], z[0]], max: [x[1], y[1], z[1]] };
}
