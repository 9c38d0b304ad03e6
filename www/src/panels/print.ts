import { loadProfile, preparePrint } from '../actions/print.ts';
import { saveGCode, saveLayer, saveLayers, saveProfile } from '../actions/save.ts';
import { sizeOf } from '../bounds.ts';
import { byId, setFacts, setList } from '../dom.ts';
import { bytes, count, duration, length, mass, milliseconds, significant } from '../format.ts';
import type { Page } from '../page.ts';
import type { Print } from '../print.ts';
import { sentence } from '../problem.ts';
import { layerCount } from '../segments.ts';
import type { State, Timed } from '../state.ts';
import { printFields } from './print-fields.ts';
import { enableWhenUsable, reveal } from './usable.ts';

/** A model this many lines long or less is hardly meant: its numbers are in another unit. */
const FEW_LINES = 10;

/** Settings, the printer, and what a print takes. */
export function printPanel(page: Page): void {
  const { store } = page;
  printFields(store);
  profileControls(page);
  enableWhenUsable(page, byId<HTMLButtonElement>('prepare'), ({ recipe, misfit }) => recipe !== undefined && misfit === undefined);
  byId('prepare').addEventListener('click', () => void preparePrint(page));
  byId('gcode-download').addEventListener('click', () => saveGCode(page));
  byId('slices-download').addEventListener('click', () => void saveLayers(page));
  byId('print-layer-download').addEventListener('click', () => {
    const { print, nozzle } = store.state;
    if (print) void saveLayer(page, print.value.layers[nozzle.layer]);
  });
  byId('print-unit').addEventListener('click', () => byId('unit').focus());
  store.on(['misfit'], ({ misfit }) => {
    byId('print-misfit').hidden = !misfit;
    byId('print-misfit').textContent = misfit ?? '';
  });
  store.on(['recipe', 'model'], (state) => {
    byId('print-tiny').hidden = !isTiny(state);
    byId('print-tiny-size').textContent = state.model ? significant(Math.max(...sizeOf(state.model.bounds)), 2) : '';
  });
  store.on(['print'], showPrint);
  store.on(['print', 'recipe'], ({ print, recipe }) => {
    byId('print-stale').hidden = !print || JSON.stringify(print.value.recipe) === JSON.stringify(recipe);
  });
}

function profileControls(page: Page): void {
  const { store } = page;
  const input = byId<HTMLInputElement>('profile-file');
  byId('profile-load').addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    if (input.files?.[0]) void loadProfile(page, input.files[0]);
    input.value = '';
  });
  byId('profile-save').addEventListener('click', () => saveProfile(page));
  store.on(['recipe'], ({ recipe }) => {
    byId<HTMLButtonElement>('profile-save').disabled = byId<HTMLButtonElement>('profile-load').disabled = !recipe;
    byId('printer-name').textContent = recipe?.profile.name ?? '';
  });
}

function isTiny({ recipe, model }: State): boolean {
  return recipe !== undefined && model !== undefined && Math.max(...sizeOf(model.bounds)) < FEW_LINES * recipe.settings.lineWidth;
}

function showPrint(state: State): void {
  const { print } = state;
  for (const id of ['gcode-download', 'slices-download']) byId<HTMLButtonElement>(id).disabled = !print;
  setList(byId('print-warnings'), (print?.value.warnings ?? []).map(({ message }) => sentence(message)));
  setFacts(byId('print-facts'), print ? factsOf(print) : []);
  if (print) reveal(state, 'print-facts');
}

function factsOf({ value: { gcode, segments }, milliseconds: time }: Timed<Print>): [string, string][] {
  const { seconds, filamentLength, filamentMass } = gcode.estimate;
  return [
    ['Time', duration(seconds)],
    ['Filament', `${length(filamentLength)}, ${mass(filamentMass)}`],
    ['Layers', count(layerCount(segments))],
    ['Moves', count(segments.count)],
    ['G-code', bytes(gcode.bytes.length)],
    ['Computed', milliseconds(time)],
  ];
}
