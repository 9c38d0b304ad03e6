import type { CheckReport } from 'fast-winding';
import { checkModel, turnFaces } from '../actions/check.ts';
import { saveReport } from '../actions/save.ts';
import { sizeOf } from '../bounds.ts';
import { defectsOf } from '../defects.ts';
import { byId, setFacts, setList } from '../dom.ts';
import { count, length, milliseconds, plural, significant, size, volume } from '../format.ts';
import type { Page } from '../page.ts';
import { sentence } from '../problem.ts';
import type { Limits, State, Timed } from '../state.ts';
import { showFindings } from './defects.ts';
import { enableWhenUsable, reveal } from './usable.ts';

const RATINGS: Record<CheckReport['verdict']['rating'], { readonly headline: string; readonly colour: string }> = {
  clean: { headline: 'Clean: prints as it is.', colour: 'good' },
  printsAsSeen: { headline: 'Prints as seen.', colour: 'good' },
  doubtful: { headline: 'Doubtful: it may not print as it is meant.', colour: 'caution' },
  noSolid: { headline: 'No solid: there is nothing to print.', colour: 'alarm' },
};

/** The verdict without its reasons. */
export function headline({ verdict }: CheckReport): string {
  return RATINGS[verdict.rating].headline;
}

/** What is wrong with the model: the verdict, the list of defects, and figures. */
export function checkPanel(page: Page): void {
  const { store } = page;
  const isSoup = ({ model }: State): boolean => model?.shape.kind === 'soup';
  enableWhenUsable(page, byId<HTMLButtonElement>('check'), isSoup);
  enableWhenUsable(page, byId<HTMLButtonElement>('turn'), isSoup);
  byId('check').addEventListener('click', () => void checkModel(page));
  byId('turn').addEventListener('click', () => void turnFaces(page));
  byId('check-save').addEventListener('click', () => saveReport(page));
  limit(page, 'check-thickness', 'minimumThickness');
  limit(page, 'check-angle', 'overhangAngle');
  store.on(['model'], (state) => {
    byId('check-cloud').hidden = !state.model || isSoup(state);
  });
  store.on(['report'], (state) => {
    const { found, absent } = state.report ? defectsOf(state.report.value) : { found: [], absent: [] };
    showFindings(store, byId('defects'), found, ({ visible }) => ({ ...visible, model: true, defects: true }));
    byId('check-absent').hidden = absent.length === 0;
    byId('check-absent').textContent = `Not found: ${absent.join(', ')}.`;
    showReport(state.report);
    if (state.report) reveal(state, 'verdict');
  });
}

/** A number that the check goes by; with another one the model is checked again. */
function limit(page: Page, id: string, name: keyof Limits): void {
  const { store } = page;
  const input = byId<HTMLInputElement>(id);
  input.addEventListener('change', () => {
    const value = input.valueAsNumber;
    const isUsable = value >= 0 && value <= (name === 'overhangAngle' ? 90 : 1e6);
    if (!isUsable) return void (input.value = String(store.state.limits[name]));
    store.set({ limits: { ...store.state.limits, [name]: value } });
    if (store.state.report) void checkModel(page);
  });
  store.on(['limits'], ({ limits }) => {
    input.value = String(limits[name]);
  });
}

function showReport(report: Timed<CheckReport> | undefined): void {
  byId<HTMLButtonElement>('check-save').disabled = !report;
  byId('verdict').hidden = !report;
  byId('turn-row').hidden = !report || report.value.flippedFaces.count + report.value.inconsistentEdges.count === 0;
  setFacts(byId('check-facts'), report ? factsOf(report) : []);
  if (!report) return;
  const { rating, reasons } = report.value.verdict;
  byId('verdict').dataset.rating = RATINGS[rating].colour;
  byId('verdict-text').textContent = headline(report.value);
  setList(byId('verdict-reasons'), reasons.map((reason) => sentence(reason.text)));
}

function factsOf({ value, milliseconds: time }: Timed<CheckReport>): [string, string][] {
  const { triangles, vertices, shells, closedShells, area, volume: enclosed, bounds, thickness, overhangs, genus, bed } = value;
  const facts: [string, string][] = [
    ['Triangles', `${count(triangles)}, ${plural(vertices, 'vertex', 'vertices')}`],
    ['Shells', closedShells === shells.count ? `${count(shells.count)}, closed` : `${count(shells.count)}, ${count(closedShells)} closed`],
    ['Volume', volume(enclosed)],
    ['Area', `${significant(area)} mm²`],
    ['Size', size(sizeOf(bounds))],
  ];
  if (genus != null) facts.push(['Handles', count(genus)]);
  if (thickness) facts.push(['Thinnest', length(thickness.minimum)]);
  const half = thickness?.percentiles.find(([share]) => share === 50);
  if (half) facts.push(['Thickness, median', length(half[1])]);
  facts.push([`Overhangs over ${significant(overhangs.angle)}°`, `${significant(overhangs.area, 3)} mm²`]);
  if (bed) facts.push(['In the printer', bed.fits ? 'fits' : bed.fitsTurned ? 'fits turned by 90°' : 'does not fit']);
  facts.push(['Checked', milliseconds(time)]);
  return facts;
}
