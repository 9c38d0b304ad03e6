import type { CheckReport } from 'fast-winding';
import { adoptSoup } from '../actions/adopt.ts';
import { repairModel } from '../actions/repair.ts';
import { saveSoup } from '../actions/save.ts';
import { byId, setFacts } from '../dom.ts';
import { count, milliseconds, significant, volume } from '../format.ts';
import type { Page } from '../page.ts';
import type { Repair } from '../results.ts';
import type { Timed } from '../state.ts';
import { headline } from './check.ts';
import { saver } from './saver.ts';
import { slider } from './slider.ts';
import { enableWhenUsable, reveal } from './usable.ts';

const NOTES = {
  conserve: 'Drops what bounds nothing, turns faces outward, splits what crosses and closes holes along w = ½. All else stays as it is, to the last bit.',
  remesh: 'A new mesh of w = ½ that follows the triangles where they are good and closes smoothly where they are missing.',
} as const;

const FALLBACKS = {
  disagrees: 'made anew: its triangles bound another solid',
  empty: 'made anew: its triangles bound nothing',
  open: 'made anew: its triangles could not be closed',
} as const;

/** One button that makes a closed mesh of the model, and what it has changed. */
export function repairPanel(page: Page): void {
  const { store } = page;
  const method = byId<HTMLSelectElement>('repair-method');
  const auto = byId<HTMLInputElement>('repair-auto');
  const resolution = slider('repair-resolution');
  const adapt = (): void => {
    const isRemesh = method.value === 'remesh';
    byId('repair-note').textContent = NOTES[method.value as keyof typeof NOTES];
    byId('repair-cells').hidden = !isRemesh;
    resolution.disabled = auto.checked;
  };
  for (const control of [method, auto]) control.addEventListener('change', adapt);
  store.on(['model'], ({ model }) => {
    const isCloud = model?.shape.kind === 'cloud';
    method.disabled = isCloud;
    if (isCloud) method.value = 'remesh';
    adapt();
  });
  enableWhenUsable(page, byId<HTMLButtonElement>('repair'));
  byId('repair').addEventListener('click', () => {
    const isRemesh = method.value === 'remesh';
    void repairModel(page, { method: isRemesh ? 'remesh' : 'conserve', resolution: isRemesh && !auto.checked ? resolution.valueAsNumber : undefined });
  });
  byId('repair-use').addEventListener('click', () => {
    const repair = store.state.repair?.value;
    if (repair) void adoptSoup(page, repair.soup, 'repaired');
  });
  enableWhenUsable(page, byId<HTMLButtonElement>('repair-use'), ({ repair }) => repair !== undefined);
  saver(page, 'repair-download', ({ repair }) => repair !== undefined, (format) => {
    const repair = store.state.repair?.value;
    if (repair) void saveSoup(page, repair.soup, 'repaired', format);
  });
  store.on(['repair'], (state) => {
    const { repair } = state;
    byId('repair-result').hidden = !repair;
    if (!repair) return;
    byId('repair-caption').textContent = headline(repair.value.after);
    byId('repair-rows').replaceChildren(...rowsOf(repair.value).map(row));
    setFacts(byId('repair-facts'), factsOf(repair));
    reveal(state, 'repair-facts');
  });
}

const FIGURES: readonly (readonly [label: string, figure: (report: CheckReport) => string, isDefect: boolean])[] = [
  ['Triangles', ({ triangles }) => count(triangles), false],
  ['Shells', ({ shells }) => count(shells.count), false],
  ['Holes', ({ boundary }) => count(boundary.loops.count), true],
  ['Open edges', ({ boundary }) => count(boundary.edges), true],
  ['Edges of 3 or more faces', ({ nonManifoldEdges }) => count(nonManifoldEdges.count), true],
  ['Self-intersections', ({ selfIntersections }) => (selfIntersections ? count(selfIntersections.count) : '–'), true],
  ['Flipped faces', ({ flippedFaces }) => count(flippedFaces.count), true],
  ['Internal faces', ({ internalFaces }) => count(internalFaces.count), true],
  ['Duplicates', ({ duplicateFaces }) => count(duplicateFaces.count), true],
  ['Volume', (report) => volume(report.volume), false],
  ['Area', ({ area }) => `${significant(area)} mm²`, false],
];

interface Row {
  readonly label: string;
  readonly before: string;
  readonly after: string;
  readonly isDefect: boolean;
}

/** Figures of both, without defects that neither has. */
function rowsOf({ before, after }: Repair): Row[] {
  return FIGURES.map(([label, figure, isDefect]) => ({ label, before: before ? figure(before) : '–', after: figure(after), isDefect })).filter(
    ({ before, after, isDefect }) => !isDefect || !['0', '–'].includes(before) || !['0', '–'].includes(after),
  );
}

function row({ label, before, after, isDefect }: Row): HTMLElement {
  const line = document.createElement('tr');
  const name = document.createElement('th');
  name.scope = 'row';
  name.textContent = label;
  const cells = [before, after].map((text) => {
    const cell = document.createElement('td');
    cell.textContent = text;
    if (isDefect && text !== '–') cell.className = text === '0' ? 'good' : 'bad';
    return cell;
  });
  line.append(name, ...cells);
  return line;
}

function factsOf({ value: { report }, milliseconds: time }: Timed<Repair>): [string, string][] {
  const { holes, capArea, flipped, duplicates, internal, kept, new: added, fallback, agreement } = report;
  const facts: [string, string][] = [];
  if (fallback) facts.push(['Surface', FALLBACKS[fallback]]);
  if (holes) facts.push(['Closed', `${count(holes)} ${holes === 1 ? 'hole' : 'holes'}, ${significant(capArea, 3)} mm²`]);
  if (flipped) facts.push(['Turned over', count(flipped)]);
  if (duplicates + internal) facts.push(['Dropped', count(duplicates + internal)]);
  facts.push(['Of the input, new', `${count(kept)}, ${count(added)}`]);
  facts.push(['Same solid as w ≥ ½', `${significant(100 * agreement, 4)} %`]);
  facts.push(['Computed', milliseconds(time)]);
  return facts;
}
