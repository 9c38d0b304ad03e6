import { colourOf, spanOf } from '../colour.ts';
import type { Span } from '../colour.ts';
import { byId } from '../dom.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

const COLUMNS = 256;

/** The scale of the heat map, with 1/2, the border between inside and outside, marked. */
export function legendPanel(store: Store<State>): void {
  store.on(['heat'], ({ heat }) => {
    byId('legend').hidden = !heat;
    if (!heat) return;
    const span = spanOf(heat.value.values);
    paintBar(byId<HTMLCanvasElement>('legend-bar'), span);
    byId('legend-ticks').replaceChildren(...ticks(span));
  });
}

function paintBar(bar: HTMLCanvasElement, span: Span): void {
  bar.width = COLUMNS;
  bar.height = 1;
  const context = bar.getContext('2d')!;
  for (let column = 0; column < COLUMNS; column++) {
    const value = span.low + ((column + 0.5) / COLUMNS) * (span.high - span.low);
    context.fillStyle = `rgb(${colourOf(value, span).map(Math.round).join(' ')})`;
    context.fillRect(column, 0, 1, 1);
  }
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
