import type { DistanceLattice, DistanceOptions, Shape } from '../../api.js';
import { type Outcome, type Task, command } from '../command.js';
import { CELLS, verifyCells } from '../meshes.js';
import type { Values } from '../options.js';
import { UsageError } from '../usage.js';
import { counts, length, plural } from '../words.js';

const OPTIONS = {
  at: { kind: 'text', value: 'FILE', help: 'distances at the points or vertices of this file, as csv; else over a lattice, as nrrd' },
  sign: { kind: 'choice', choices: ['hard', 'smooth', 'none'], help: 'negative where w ≥ ½ (hard, unless given), times 1 − 2 w (smooth), or never (none)' },
  band: { kind: 'number', value: 'MM', help: 'distances up to this are exact, what is farther has this one' },
  padding: { kind: 'number', value: 'MM', help: 'of the lattice: beyond the bounds on every side' },
  ...CELLS,
} as const;
type DistanceValues = Values<typeof OPTIONS>;

/** A lattice of floats as NRRD, uncompressed, little-endian as WebAssembly's numbers are: the first sample's centre is its origin. */
function nrrdOf({ counts: sizes, origin, spacing, values }: DistanceLattice): Uint8Array {
  const vector = (numbers: readonly number[]) => `(${numbers.join(',')})`;
  const axes = spacing.map((step, axis) => vector([0, 1, 2].map((other) => (other === axis ? step : 0))));
  const header = [
    'NRRD0004', 'type: float', 'dimension: 3', 'space dimension: 3', `sizes: ${sizes.join(' ')}`,
    `space directions: ${axes.join(' ')}`, `space origin: ${vector(origin)}`, 'space units: "mm" "mm" "mm"',
    'kinds: domain domain domain', 'endian: little', 'encoding: raw',
  ];
  return Buffer.concat([Buffer.from(`${header.join('\n')}\n\n`), new Uint8Array(values.buffer, values.byteOffset, values.byteLength)]);
}

function extremes(values: Float32Array | Float64Array): { least: number; greatest: number } {
  let [least, greatest] = [Infinity, -Infinity];
  for (const value of values) [least, greatest] = [Math.min(least, value), Math.max(greatest, value)];
  return { least, greatest };
}

const range = ({ least, greatest }: { least: number; greatest: number }): [string, string] => ['from, to', `${length(least)}, ${length(greatest)}`];

async function atPoints(task: Task, shape: Shape, path: string, options: DistanceOptions): Promise<Outcome> {
  const other = await task.open(path);
  const { positions, origin } = await other.geometry();
  other.free();
  const points = Float64Array.from(positions, (x, i) => x + origin[i % 3]!);
  const distances = await shape.signedDistance(points, options);
  if (task.format) {
    const lines = Array.from(distances, (distance, i) => `${points[3 * i]},${points[3 * i + 1]},${points[3 * i + 2]},${distance}\n`);
    await task.save(new TextEncoder().encode(`x,y,z,distance\n${lines.join('')}`));
  }
  const found = extremes(distances);
  return { report: { points: distances.length, ...found, distances }, headline: `distances of ${plural(distances.length, 'point')}`, rows: [range(found)] };
}

export const distance = command({
  name: 'distance',
  summary: 'signed distances, at points or over a lattice',
  description: ['To the nearest triangle or point, in millimetres, negative inside. Writes csv with --at, else nrrd.'],
  files: 'each',
  options: OPTIONS,
  formats: ['nrrd', 'csv'],
  verify(values: DistanceValues) {
    verifyCells(values);
    if (values.at !== undefined && (values.resolution ?? values.spacing ?? values.padding) !== undefined) {
      throw new UsageError('--resolution, --spacing and --padding are of lattices, not of points named by --at');
    }
  },
  formatFor: ({ at }: DistanceValues) => (at === undefined ? 'nrrd' : 'csv'),
  examples: ['distance --at scan.xyz part.stl -o deviation.csv', 'distance --resolution 128 part.stl -o part.nrrd'],
  async run(task, { at, ...options }: DistanceValues) {
    const shape: Shape = task.shapes[0]!;
    if (at !== undefined) return atPoints(task, shape, at, { ...options, ...task.call });
    const lattice = await shape.signedDistance({ ...options, ...task.call });
    if (task.format) await task.save(nrrdOf(lattice));
    const { values, ...report } = lattice;
    const found = extremes(values);
    return { report: { ...report, ...found }, headline: `distances at ${counts(report.counts)} places`, rows: [range(found)] };
  },
});
