import type { Cloud, FaceOrientOptions, OrientOptions, Soup } from '../../api.js';
import { WindingError } from '../../error.js';
import { type Outcome, type Task, command } from '../command.js';
import { given } from '../options.js';
import { plural } from '../words.js';

const OF_SOUPS = ['parity', 'visibility', 'consistency'] as const;
const OF_CLOUDS = ['consistency', 'stochastic', 'propagation'] as const;

function only<M extends string>(method: string | undefined, known: readonly M[], kind: string): M | undefined {
  if (method === undefined || known.includes(method as M)) return method as M | undefined;
  throw new WindingError('InvalidArgument', `method ${method} is not for ${kind}: one of ${known.join(', ')} is`);
}

async function orientSoup(soup: Soup, options: FaceOrientOptions): Promise<Outcome> {
  const { flipped, patches, method } = await soup.orient(options);
  const report = { kind: soup.kind, triangles: soup.count, flipped: flipped.length, patches, method };
  return { report, headline: `${plural(flipped.length, 'face')} of ${soup.count} turned`, rows: [['method', method]] };
}

async function orientCloud(cloud: Cloud, options: OrientOptions): Promise<Outcome> {
  const hadNormals = cloud.hasNormals;
  await cloud.orient(options);
  const what = hadNormals ? 'had normals already' : 'outward normals';
  return { report: { kind: cloud.kind, points: cloud.count, hadNormals }, headline: `${plural(cloud.count, 'point')}: ${what}` };
}

async function save(task: Task, shape: Soup | Cloud): Promise<void> {
  if (task.format) await task.save(await shape.export(task.format as 'ply'));
}

export const orient = command({
  name: 'orient',
  summary: 'faces turned outward; outward normals for points without any',
  description: [
    'Of meshes: faces run with their neighbours and face outward; cavities stay cavities as far as that can be told.',
    'Of clouds: points without normals get them, by winding number normal consistency unless another method is named. Clouds are written as ply or xyz.',
  ],
  files: 'each',
  options: {
    method: {
      kind: 'choice',
      choices: ['parity', 'visibility', 'consistency', 'stochastic', 'propagation'],
      help: `of meshes ${OF_SOUPS.join(', ')} (the first unless given); of clouds ${OF_CLOUDS.join(', ')} (likewise)`,
    },
    rays: { kind: 'whole', value: 'N', help: 'of meshes: rays from each piece at most (128)' },
    noiseLevel: { kind: 'number', value: 'N', help: 'of clouds, by consistency: 0 to 5, estimated unless given' },
  },
  formats: ['ply', 'stl', 'obj', 'off', '3mf', 'xyz'],
  orientsClouds: false,
  examples: ['orient scan.xyz -o scan.ply', 'orient part.stl -o turned.stl'],
  async run(task, { method, rays, noiseLevel }) {
    const shape = task.shapes[0]!;
    const outcome = await (shape.kind === 'soup'
      ? orientSoup(shape, given({ method: only(method, OF_SOUPS, 'triangles'), rays, ...task.call }))
      : orientCloud(shape, given({ method: only(method, OF_CLOUDS, 'points'), noiseLevel, ...task.call })));
    await save(task, shape);
    return outcome;
  },
});
