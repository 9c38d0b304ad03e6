import { SAMPLES } from '../../samples/catalogue.ts';
import { forgetKept } from '../actions/keep-file.ts';
import { fileSource, open, reopen, sampleSource } from '../actions/open.ts';
import { takePicture } from '../actions/picture.ts';
import { openSecond } from '../actions/second.ts';
import { sizeOf } from '../bounds.ts';
import { byId, setFacts, setList } from '../dom.ts';
import { acceptDrops } from '../drop.ts';
import type { DropField } from '../drop.ts';
import { bytes, count, milliseconds, significant, size } from '../format.ts';
import type { Page, Unit } from '../page.ts';
import { sentence } from '../problem.ts';
import type { Model, State } from '../state.ts';
import type { Store } from '../store.ts';

/** What the numbers of a file may mean, when its format has no unit. */
const UNITS: readonly (readonly [Unit, string])[] = [
  ['millimeter', 'millimetres'],
  ['centimeter', 'centimetres'],
  ['meter', 'metres'],
  ['inch', 'inches'],
  ['foot', 'feet'],
  ['micron', 'microns'],
];

/** The facts and warnings of the model; works without an engine. */
export function showModelFacts(store: Store<State>): void {
  store.on(['model'], ({ model }) => {
    if (!model) return;
    setFacts(byId('facts'), factsOf(model));
    setList(byId('warnings'), model.warnings.map(({ message }) => sentence(message)));
    byId('orient-block').hidden = model.oriented;
  });
}

/** The menu of samples, the file button, and dropping. */
export function modelControls(page: Page): void {
  const menu = byId<HTMLSelectElement>('sample');
  menu.replaceChildren(...SAMPLES.map(({ file, title }) => new Option(title, file)));
  menu.addEventListener('change', () => {
    if (menu.value) void open(page, sampleSource(menu.value));
  });
  const ownFile = new Option('', '');
  // Also when a job ends: a sample that was not opened after all leaves the menu on what is shown.
  page.store.on(['model', 'job'], ({ model, job }) => {
    if (!model || job) return;
    const isSample = SAMPLES.some(({ file }) => file === model.name);
    if (!isSample) {
      ownFile.textContent = model.name;
      menu.prepend(ownFile);
    } else ownFile.remove();
    menu.value = isSample ? model.name : '';
    const sample = SAMPLES.find(({ file }) => file === model.name);
    byId('sample-note').hidden = !sample;
    byId('sample-note').textContent = sample ? `${sample.note}. Model: ${sample.credit}.` : '';
  });
  const unit = byId<HTMLSelectElement>('unit');
  unit.replaceChildren(...UNITS.map(([value, text]) => new Option(text, value)));
  unit.addEventListener('change', () => void reopen(page, unit.value as Unit));
  page.store.on(['model', 'job'], ({ model, job }) => {
    if (!model || job) return;
    byId('unit-field').hidden = ['3mf', 'arrays', 'field'].includes(model.format);
    unit.value = page.source?.unit ?? 'millimeter';
  });

  keptLine(page);
  const input = byId<HTMLInputElement>('file');
  byId('choose').addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    if (input.files?.[0]) void open(page, fileSource(input.files[0]));
    input.value = '';
  });
  acceptDrops((file, field) => void take(page, file, field));
}

/** Whether the model, or what was made of it, is there when the page is loaded again. */
function keptLine(page: Page): void {
  page.store.on(['model', 'kept', 'unkept'], (state) => {
    const text = keptText(state, page.source?.sample !== undefined);
    byId('kept').hidden = text === '';
    byId('kept-text').textContent = text;
    byId('forget').hidden = !state.kept;
  });
  byId('forget').addEventListener('click', () => {
    void forgetKept(page);
    byId('choose').focus();
  });
}

function keptText({ kept, unkept }: State, isSample: boolean): string {
  if (kept === false && !isSample) return 'Not kept: it is to be opened again when the page is loaded again.';
  const names = unkept.join(', ');
  if (!kept) return names && `Not kept, to be made again when the page is loaded again: ${names}.`;
  const what = isSample ? 'What was made of it is kept' : 'It is kept with what was made of it';
  return `${what} in this browser, to be there when the page is loaded again.${names && ` Not kept: ${names}.`}`;
}

/** A file that was dropped. A textured model takes an image wherever it falls. */
async function take(page: Page, file: File, field?: DropField): Promise<void> {
  if (field === 'picture' || (page.store.state.texture && file.type.startsWith('image/'))) return takePicture(page, file);
  return field === 'second' ? openSecond(page, file) : open(page, fileSource(file));
}

function factsOf({ shape, geometry, bounds, format, prepared, readMilliseconds, oriented }: Model): [string, string][] {
  const facts: [string, string][] = [];
  if (shape.kind === 'soup') {
    facts.push(['Triangles', count(shape.count)]);
    const edges = geometry.boundary.length / 6;
    facts.push(['Boundary edges', edges === 0 ? 'none, it is closed' : count(edges)]);
  } else {
    facts.push(['Points', count(shape.count)]);
    facts.push(['Normals', oriented ? 'yes' : 'missing']);
  }
  facts.push(['Size', size(sizeOf(bounds))]);
  facts.push(['Lowest corner', bounds.min.map((value) => significant(value)).join(', ')]);
  facts.push(['Format', format.toUpperCase()]);
  facts.push(['Read', milliseconds(readMilliseconds)]);
  if (prepared) facts.push(['Field built', `${milliseconds(prepared.milliseconds)}, ${bytes(prepared.bytes)}`]);
  return facts;
}
