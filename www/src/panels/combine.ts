import type { BooleanOperation } from 'fast-winding';
import { adoptSoup } from '../actions/adopt.ts';
import { saveSoup } from '../actions/save.ts';
import { combine, makeSecond, openSecond, removeSecond } from '../actions/second.ts';
import { byId, setFacts, setList } from '../dom.ts';
import { count, milliseconds, plural, significant, volume } from '../format.ts';
import type { Page } from '../page.ts';
import { PRIMITIVES } from '../primitives.ts';
import type { PrimitiveName } from '../primitives.ts';
import { sentence } from '../problem.ts';
import { areaOf, volumeOf } from '../results.ts';
import type { Combined } from '../results.ts';
import { isBusy } from '../state.ts';
import type { GizmoMode, Timed } from '../state.ts';
import { placementFields } from './placement.ts';
import { saver } from './saver.ts';
import { enableWhenUsable, reveal } from './usable.ts';

/** A second model, where it stands, and what it gives together with the first one. */
export function combinePanel(page: Page): void {
  const { store } = page;
  chooser(page);
  placementFields(store);
  const modes = [...document.querySelectorAll<HTMLInputElement>('input[name=gizmo]')];
  for (const mode of modes) mode.addEventListener('change', () => store.set({ gizmo: mode.value as GizmoMode }));
  byId('second-remove').addEventListener('click', () => {
    removeSecond(page);
    byId('second-choose').focus();
  });
  store.on(['second'], ({ second }) => {
    byId('second').hidden = !second;
    byId('second-name').textContent = second ? `${second.name}, ${plural(second.shape.count, second.shape.kind === 'soup' ? 'triangle' : 'point')}` : '';
  });

  const operation = byId<HTMLSelectElement>('operation');
  byId('combine').addEventListener('click', () => void combine(page, operation.value as BooleanOperation));
  enableWhenUsable(page, byId<HTMLButtonElement>('combine'), ({ second }) => second !== undefined);
  byId('combine-use').addEventListener('click', () => {
    const combined = store.state.combined?.value;
    if (combined) void adoptSoup(page, combined.soup, 'combined');
  });
  enableWhenUsable(page, byId<HTMLButtonElement>('combine-use'), ({ combined }) => combined !== undefined);
  saver(page, 'combine-download', ({ combined }) => combined !== undefined, (format) => {
    const combined = store.state.combined?.value;
    if (combined) void saveSoup(page, combined.soup, 'combined', format);
  });
  store.on(['combined'], (state) => {
    const { combined } = state;
    byId('combine-result').hidden = !combined;
    setFacts(byId('combine-facts'), combined ? factsOf(combined) : []);
    setList(byId('combine-warnings'), (combined?.value.warnings ?? []).map(({ message }) => sentence(message)));
    if (combined) reveal(state, 'combine-result');
  });
}

/** A file, chosen or dropped on the field, or a simple shape. */
function chooser(page: Page): void {
  const input = byId<HTMLInputElement>('second-file');
  byId('second-choose').addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    if (input.files?.[0]) void openSecond(page, input.files[0]);
    input.value = '';
  });
  const menu = byId<HTMLSelectElement>('second-shape');
  menu.append(...Object.entries(PRIMITIVES).map(([name, { label }]) => new Option(label, name)));
  menu.addEventListener('change', () => {
    if (menu.value) void makeSecond(page, menu.value as PrimitiveName);
    menu.value = '';
  });
  page.store.on(['model', 'job'], (state) => {
    for (const id of ['second-choose', 'second-shape']) byId<HTMLButtonElement | HTMLSelectElement>(id).disabled = !state.model || isBusy(state);
  });
}

function factsOf({ value: { triangles, operands }, milliseconds: time }: Timed<Combined>): [string, string][] {
  const ofSecond = operands.reduce((sum, operand) => sum + Number(operand !== 0), 0);
  return [
    ['Triangles', count(operands.length)],
    ['Of the second', count(ofSecond)],
    ['Volume', volume(volumeOf(triangles))],
    ['Area', `${significant(areaOf(triangles))} mm²`],
    ['Computed', milliseconds(time)],
  ];
}
