import { distanceColour, levelsOf, scaleOf } from '../distances.ts';
import { byId } from '../dom.ts';
import { significant } from '../format.ts';
import { paintScale } from '../ramp.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** Share of the scale's width that a figure needs. */
const ROOM = 0.14;

/** The scale of signed distances, with 0, the surface, marked. */
export function distanceLegend(store: Store<State>): void {
  store.on(['distances'], ({ distances }) => {
    byId('distance-legend').hidden = !distances;
    if (!distances) return;
    const scale = scaleOf(distances.value);
    paintScale(byId<HTMLCanvasElement>('distance-bar'), scale, (value) => distanceColour(value, scale));
    byId('distance-title').textContent = `a line every ${significant(scale.step)} mm`;
    const place = (value: number): number => (value - scale.low) / (scale.high - scale.low || 1);
    // 0 first, then outward from it, those that have room.
    const ticks: number[] = [];
    for (const level of [...levelsOf(scale)].sort((a, b) => Math.abs(a) - Math.abs(b))) {
      if (ticks.every((other) => Math.abs(place(other) - place(level)) > ROOM)) ticks.push(level);
    }
    byId('distance-ticks').replaceChildren(...ticks.map((value) => tick(value, place(value))));
  });
}

function tick(value: number, place: number): HTMLElement {
  const element = document.createElement('span');
  element.textContent = value > 0 ? `+${significant(value)}` : significant(value);
  element.style.left = `${100 * place}%`;
  if (value === 0) element.className = 'half';
  else if (place < ROOM / 3) element.className = 'start';
  else if (place > 1 - ROOM / 3) element.className = 'end';
  return element;
}
