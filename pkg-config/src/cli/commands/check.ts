import type { CheckOptions, CheckReport } from '../../api.js';
import { command } from '../command.js';
import { toJson, area, figure, length, plural, sizeOf, volume } from '../words.js';
import { soupFrom } from '../shapes.js';

/** As many defects of a kind as a person would look at. */
const LIMIT = 100;

const HEADLINES: Record<CheckReport['verdict']['rating'], string> = {
  clean: 'clean: prints as it is',
  printsAsSeen: 'prints as seen',
  doubtful: 'doubtful',
  noSolid: 'holds no solid',
};

function rowsOf(report: CheckReport): [string, string][] {
  const { field, thickness, bed } = report;
  const rows: [string, string][] = report.verdict.reasons.map(({ text }) => ['reason', text]);
  rows.push(['triangles', `${figure(report.triangles)}, ${plural(report.shells.count, 'shell')}, ${report.closedShells} closed`]);
  rows.push(['size', sizeOf(report.bounds)], ['area', area(report.area)]);
  if (field) rows.push(['solid', volume(field.solidVolume)]);
  if (thickness) rows.push(['thinnest', length(thickness.minimum)]);
  if (bed) rows.push(['bed', bed.fits ? 'fits' : bed.fitsTurned ? 'fits turned' : 'does not fit']);
  return rows;
}

export const check = command({
  name: 'check',
  summary: 'whether a mesh will print, and what is wrong with it',
  description: [
    'Holes, flipped, internal and duplicate faces, self-intersections, thin walls, overhangs, and what the winding number makes of them all.',
    'Exit code 0: each file prints as it is, or as seen, its openings closed by the field. 3: one is doubtful or holds no solid; with --strict, one is not clean. 1: one could not be read.',
  ],
  files: 'each',
  options: {
    strict: { kind: 'flag', help: 'only what is clean prints: without holes for the field to close' },
    bed: { kind: 'numbers', value: 'X,Y,Z', count: 3, help: 'size of the printer it is to fit in, mm' },
    minimumThickness: { kind: 'number', value: 'MM', help: 'thinner walls are listed (0.8)' },
    overhangAngle: { kind: 'number', value: 'DEG', help: 'faces that lean out by more are overhangs (50)' },
    limit: { kind: 'whole', value: 'N', help: `most entries of each list of defects (${LIMIT}); counts are true` },
    resolution: { kind: 'whole', value: 'N', help: 'cells along the longest side that the volume is judged by (48)' },
    samples: { kind: 'whole', value: 'N', help: 'places on the surface that are looked at (10000)' },
  },
  formats: ['json'],
  examples: ['check part.stl', 'check --json --bed 220,220,250 models/*.stl', 'check --strict part.3mf && echo ready'],
  async run(task, { strict, limit = LIMIT, ...options }) {
    const soup = soupFrom(task, 'check');
    const report = await soup.check({ ...(options as CheckOptions), limit, ...task.call });
    if (task.format) await task.save(new TextEncoder().encode(`${toJson(report)}\n`));
    const { rating } = report.verdict;
    const passes = rating === 'clean' || (rating === 'printsAsSeen' && !strict);
    return { report: { prints: passes, ...report }, headline: HEADLINES[rating], rows: rowsOf(report), passes };
  },
});
