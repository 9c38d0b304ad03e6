import type { PrinterProfile } from 'fast-winding';
import { byId } from '../dom.ts';
import { withProfile } from '../print.ts';
import type { Recipe } from '../print.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

interface Named {
  readonly id: string;
  readonly label: string;
}

interface NumberField extends Named {
  readonly unit: string;
  /** What the arrows beside it add. */
  readonly step: number;
  readonly get: (recipe: Recipe) => number;
  readonly set: (recipe: Recipe, value: number) => Recipe;
}

interface ChoiceField extends Named {
  readonly name: 'infill' | 'seam';
  readonly choices: readonly (readonly [value: string, text: string])[];
}

const SETTINGS: readonly (NumberField | ChoiceField)[] = [
  {
    id: 'print-layer-height', label: 'Layer height', unit: 'mm', step: 0.05,
    get: (r: Recipe) => r.layerHeight,
    set: (r: Recipe, layerHeight: number) => ({ ...r, layerHeight }),
  },
  setting('lineWidth', 'print-line-width', 'Line width', 'mm', 0.05),
  setting('perimeters', 'print-walls', 'Walls', '', 1),
  {
    name: 'seam', id: 'print-seam', label: 'Seam',
    choices: [['aligned', 'aligned'], ['nearest', 'nearest'], ['rear', 'at the back'], ['random', 'random']],
  },
  { name: 'infill', id: 'print-infill', label: 'Infill', choices: [['rectilinear', 'lines'], ['grid', 'grid'], ['gyroid', 'gyroid']] },
  {
    id: 'print-density', label: 'Density', unit: '%', step: 5,
    get: (r: Recipe) => Number((100 * r.settings.density).toPrecision(6)),
    set: (r: Recipe, percent: number) => ({ ...r, settings: { ...r.settings, density: percent / 100 } }),
  },
  setting('bottomLayers', 'print-bottom', 'Bottom layers', '', 1),
  setting('topLayers', 'print-top', 'Top layers', '', 1),
];

const PRINTER: readonly NumberField[] = [
  printer('bedWidth', 'printer-width', 'Bed, x', 'mm', 1),
  printer('bedDepth', 'printer-depth', 'Bed, y', 'mm', 1),
  printer('height', 'printer-height', 'Height, z', 'mm', 1),
  printer('nozzleDiameter', 'printer-nozzle', 'Nozzle', 'mm', 0.1),
  printer('nozzleTemperature', 'printer-temperature', 'Nozzle at', '°C', 1),
  printer('bedTemperature', 'printer-bed-temperature', 'Bed at', '°C', 1),
];

/** The fields of a recipe: what they hold is the store's, and a change goes there. */
export function printFields(store: Store<State>): void {
  for (const [list, fields] of [['print-fields', SETTINGS], ['printer-fields', PRINTER]] as const) {
    byId(list).replaceChildren(...fields.map((field) => ('choices' in field ? choiceOf(store, field) : numberOf(store, field))));
  }
}

function setting(name: 'lineWidth' | 'perimeters' | 'bottomLayers' | 'topLayers', id: string, label: string, unit: string, step: number): NumberField {
  const set = (r: Recipe, value: number): Recipe => ({ ...r, settings: { ...r.settings, [name]: value } });
  return { id, label, unit, step, get: (r) => r.settings[name], set };
}

/** Fields of the profile that are numbers. */
type Measure = { [K in keyof PrinterProfile]-?: NonNullable<PrinterProfile[K]> extends number ? K : never }[keyof PrinterProfile];

function printer(name: Measure, id: string, label: string, unit: string, step: number): NumberField {
  const set = (r: Recipe, value: number): Recipe => withProfile(r, { ...r.profile, [name]: value });
  return { id, label, unit, step, get: (r) => r.profile[name], set };
}

function numberOf(store: Store<State>, field: NumberField): HTMLElement {
  const input = document.createElement('input');
  input.type = 'number';
  input.inputMode = 'decimal';
  input.min = '0';
  input.step = String(field.step);
  const show = ({ recipe }: State): void => {
    input.disabled = !recipe;
    if (recipe) input.value = String(field.get(recipe));
  };
  input.addEventListener('change', () => {
    const { recipe } = store.state;
    if (!recipe) return;
    const value = field.step === 1 && field.unit === '' ? Math.round(input.valueAsNumber) : input.valueAsNumber;
    if (Number.isFinite(value)) store.set({ recipe: field.set(recipe, value) });
    else show(store.state);
  });
  store.on(['recipe'], show);
  const box = document.createElement('span');
  box.className = 'with-unit';
  box.append(input, unitOf(field.unit));
  return labelled(field, input, box);
}

function unitOf(text: string): HTMLElement {
  const unit = document.createElement('span');
  unit.textContent = text;
  return unit;
}

function choiceOf(store: Store<State>, field: ChoiceField): HTMLElement {
  const menu = document.createElement('select');
  menu.replaceChildren(...field.choices.map(([value, text]) => new Option(text, value)));
  menu.addEventListener('change', () => {
    const { recipe } = store.state;
    if (recipe) store.set({ recipe: { ...recipe, settings: { ...recipe.settings, [field.name]: menu.value } } });
  });
  store.on(['recipe'], ({ recipe }) => {
    menu.disabled = !recipe;
    if (recipe) menu.value = recipe.settings[field.name];
  });
  return labelled(field, menu, menu);
}

function labelled({ id, label }: Named, control: HTMLElement, content: HTMLElement): HTMLElement {
  control.id = id;
  const field = document.createElement('label');
  const name = document.createElement('span');
  field.className = 'field';
  name.textContent = label;
  field.append(name, content);
  return field;
}
