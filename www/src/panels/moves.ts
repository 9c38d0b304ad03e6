import { byId } from '../dom.ts';
import { length } from '../format.ts';
import { KINDS } from '../print.ts';
import type { MoveKind } from '../print.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** One check box for each kind of moves in the print: the legend of its colours, and how long each is. */
export function movesPanel(store: Store<State>): void {
  store.on(['print'], ({ print }) => {
    const { kinds, lengths } = print?.value.segments ?? { kinds: [], lengths: [] };
    const rows = kinds.flatMap((kind, place) => (lengths[place] > 0 ? [rowOf(store, kind, lengths[place])] : []));
    byId('print-moves').hidden = rows.length === 0;
    byId('print-moves').replaceChildren(...rows);
  });
}

function rowOf(store: Store<State>, kind: MoveKind, millimetres: number): HTMLElement {
  const row = document.createElement('li');
  const label = document.createElement('label');
  const input = document.createElement('input');
  const [swatch, text, figure] = [0, 1, 2].map(() => document.createElement('span'));
  label.className = 'check';
  input.type = 'checkbox';
  input.dataset.move = kind;
  input.checked = !store.state.hiddenMoves.has(kind);
  swatch.className = 'swatch';
  swatch.style.setProperty('--swatch', `var(${KINDS[kind].token})`);
  text.textContent = KINDS[kind].label;
  figure.className = 'figure';
  figure.textContent = length(millimetres);
  input.addEventListener('change', () => {
    const hidden = new Set(store.state.hiddenMoves);
    if (input.checked) hidden.delete(kind);
    else hidden.add(kind);
    store.set({ hiddenMoves: hidden });
  });
  label.append(input, swatch, text, figure);
  row.append(label);
  return row;
}
