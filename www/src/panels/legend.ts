import { colourOf, spanOf } from '../colour.ts';
import type { Span } from '../colour.ts';
import { byId } from '../dom.ts';
import { paintScale } from '../ramp.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** The scale of the heat map, with 1/2, the border between inside and outside, marked. */
export function legendPanel(store: Store<State>): void {
  store.on(['heat'], ({ heat }) => {
    byId('legend').hidden = !heat;
    if (!heat) return;
    const span = spanOf(heat.value.values);
    paintScale(byId<HTMLCanvasElement>('legend-bar'), span, (value) => colourOf(value, span));
    byId('legend-ticks').replaceChildren(...ticks(span));
  });
}

/** The integers in the span, and 1/2. */
function ticks({ low, high }: Span): HTMLElement[] {
  const values = [0.5];
  for (let value = Math.ceil(low); value <= high; value++) values.push(value);
  return values.map((value) => {
    const tick = document.createElement('span');
    tick.textContent = value === 0.5 ? '1/2' : String(value).replace('-', '−');
    tick.style.left = `${(100 * (value - low)) / (high - low)}%`;
    if (value === 0.5) tick.className = 'half';
    else if (value === low) tick.className = 'start';
    else if (value === high) tick.className = 'end';
    return tick;
  });
}
