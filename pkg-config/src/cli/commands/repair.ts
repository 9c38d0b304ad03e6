import { command } from '../command.js';
import { CELLS, MESH_FORMATS, saveShape, verifyCells } from '../meshes.js';
import { figure, plural, volume } from '../words.js';
import { UsageError } from '../usage.js';

/** Names of the report's figures for people, in the order of what is done. */
const DONE = {
  duplicates: 'duplicates dropped', cancelled: 'cancelled', degenerate: 'degenerate dropped', stitchedVertices: 'vertices stitched',
  flipped: 'turned over', holes: 'holes closed', intersecting: 'cut by others', internal: 'internal dropped', outside: 'outside dropped',
  sheets: 'sheets dropped',
} as const;

/** Why the surface was made anew. */
const FALLBACKS = {
  disagrees: 'its triangles bound another solid than the winding number sees',
  empty: 'its triangles bound nothing',
  open: 'its triangles could not be closed',
};

export const repair = command({
  name: 'repair',
  summary: 'a closed manifold mesh, with its own triangles or made anew',
  description: [
    'Keeps the triangles where it can: drops duplicates and what bounds nothing, turns, stitches, closes holes along w = ½, splits what intersects. Where that does not give the solid that the winding number sees, the surface is made anew; the report says so.',
  ],
  files: 'each',
  options: {
    method: { kind: 'choice', choices: ['conserve', 'remesh'], help: 'keep the triangles (conserve, unless given), or make the surface anew (remesh)' },
    ...CELLS,
    sharp: { kind: 'number', value: 'DEG', help: 'of remesh: from which angle edges stay sharp (35), 0 for none' },
    tolerance: { kind: 'number', value: 'MM', help: 'of conserve: open edges no farther apart are stitched' },
    noOrient: { kind: 'flag', help: 'of conserve: turn no triangle over' },
    noFallback: { kind: 'flag', help: 'of conserve: never make the surface anew' },
    noCheck: { kind: 'flag', help: 'no verdict before and after: faster' },
  },
  formats: MESH_FORMATS,
  verify(values) {
    verifyCells(values);
    if (values.method === 'remesh' && (values.tolerance !== undefined || values.noOrient || values.noFallback)) {
      throw new UsageError('--tolerance, --no-orient and --no-fallback are options of --method conserve');
    }
  },
  examples: ['repair broken.stl -o fixed.stl', 'repair --method remesh --spacing 0.3 *.obj -o fixed/ --format 3mf'],
  async run(task, { noOrient, noFallback, noCheck, method = 'conserve', ...options }) {
    const shape = task.shapes[0]!;
    const anew = { ...options, check: !noCheck, ...task.call };
    const kept = { ...anew, method, ...(method === 'conserve' && { orient: !noOrient, fallback: !noFallback }) };
    const repaired = await (shape.kind === 'soup' ? shape.repair(kept) : shape.repair(anew));
    const { report, before, after, soup } = repaired;
    await saveShape(task, soup);
    const rows: [string, string][] = [];
    if (before) rows.push(['before', before.verdict.text]);
    if (after) rows.push(['after', after.verdict.text]);
    const done = Object.entries(DONE).filter(([name]) => report[name as keyof typeof DONE] > 0);
    rows.push(...done.map(([name, words]): [string, string] => [words, figure(report[name as keyof typeof DONE])]));
    if (report.method === 'conserve') rows.push(['kept, new', `${figure(report.kept)}, ${figure(report.new)} triangles`]);
    rows.push(['solid', volume(report.volume)]);
    if (report.fallback) rows.push(['made anew, as', FALLBACKS[report.fallback]]);
    const how = report.method === 'remesh' ? 'made anew' : 'repaired';
    const headline = `${how}: ${plural(soup.count, 'triangle')}, ${report.closed ? 'closed' : 'still open'}`;
    soup.free();
    return { report: { triangles: soup.count, ...report, before: before?.verdict, after: after?.verdict }, headline, rows };
  },
});
