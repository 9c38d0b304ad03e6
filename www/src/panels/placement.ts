import { centreOf } from '../bounds.ts';
import { byId } from '../dom.ts';
import { UNMOVED } from '../placement.ts';
import type { Placement } from '../placement.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

const AXES = ['x', 'y', 'z'] as const;

interface Row {
  readonly key: 'centre' | 'angles';
  readonly label: string;
  readonly unit: string;
  readonly name: string;
}

const ROWS: readonly Row[] = [
  { key: 'centre', label: 'Middle at', unit: 'mm', name: 'Middle of the second model' },
  { key: 'angles', label: 'Turned', unit: '°', name: 'Turn of the second model about' },
];

/** Numbers for where the second model stands, which follow its handles in the view. */
export function placementFields(store: Store<State>): void {
  const rows = ROWS.map((row) => fieldsOf(store, row));
  byId('placement').replaceChildren(...rows, scaleRow(store));
}

function fieldsOf(store: Store<State>, { key, label, unit, name }: Row): HTMLElement {
  const inputs = AXES.map((axis, k) => {
    const change = (value: number): Partial<Placement> => ({ [key]: store.state.placement[key].map((old, i) => (i === k ? value : old)) });
    return numberField(store, `second-${key}-${axis}`, `${name} ${axis}`, (placement) => placement[key][k], change);
  });
  return rowOf(label, unit, inputs);
}

function scaleRow(store: Store<State>): HTMLElement {
  const scale = numberField(store, 'second-scale', 'Size of the second model, times its own', ({ scale }) => scale, (value) => (value > 0 ? { scale: value } : {}));
  const back = document.createElement('button');
  back.type = 'button';
  back.className = 'link';
  back.id = 'second-back';
  back.textContent = 'As in its file';
  back.addEventListener('click', () => {
    const { second } = store.state;
    if (second) place(store, { ...UNMOVED, centre: centreOf(second.bounds) });
  });
  return rowOf('Size', '×', [scale, back]);
}

function numberField(store: Store<State>, id: string, name: string, get: (placement: Placement) => number, change: (value: number) => Partial<Placement>): HTMLInputElement {
  const input = document.createElement('input');
  input.type = 'number';
  input.step = 'any';
  input.id = id;
  input.setAttribute('aria-label', name);
  const show = ({ placement }: State): void => {
    input.value = String(Number(get(placement).toPrecision(5)));
  };
  input.addEventListener('change', () => {
    if (Number.isFinite(input.valueAsNumber)) place(store, { ...store.state.placement, ...change(input.valueAsNumber) });
    show(store.state);
  });
  store.on(['placement'], show);
  return input;
}

/** Shows the second model where it is put, in the place of a result of where it was. */
function place(store: Store<State>, placement: Placement): void {
  store.set({ placement, visible: { ...store.state.visible, model: true, second: true, combined: false } });
}

function rowOf(label: string, unit: string, controls: readonly HTMLElement[]): HTMLElement {
  const row = document.createElement('div');
  const [name, last] = [label, unit].map((text) => {
    const span = document.createElement('span');
    span.textContent = text;
    return span;
  });
  row.className = 'placement-row';
  row.append(name, ...controls, last);
  return row;
}
