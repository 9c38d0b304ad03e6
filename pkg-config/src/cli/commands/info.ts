import { command } from '../command.js';
import { plural, sizeOf } from '../words.js';

export const info = command({
  name: 'info',
  summary: 'what a file holds: kind, format, size, openings',
  description: ['Reads the file and says what is in it. Points without normals stay without.'],
  files: 'each',
  options: {},
  formats: [],
  orientsClouds: false,
  examples: ['info part.stl scan.ply'],
  async run({ shapes, call }) {
    const shape = shapes[0]!;
    const { kind, format, count, bounds } = shape;
    const report = { kind, format, count, bounds };
    const rows: [string, string][] = [['size', sizeOf(bounds)]];
    if (shape.kind === 'cloud') {
      const { hasNormals, hasAreas } = shape;
      rows.push(['normals', hasNormals ? 'yes' : 'no'], ['areas', hasAreas ? 'yes' : 'no']);
      return { report: { ...report, hasNormals, hasAreas }, headline: `${format}, ${plural(count, 'point')}`, rows };
    }
    const { components, boundaryEdges } = await shape.prepare(call);
    rows.push(['pieces', String(components)], ['boundary edges', boundaryEdges === 0 ? 'none: closed' : String(boundaryEdges)]);
    return { report: { ...report, components, boundaryEdges }, headline: `${format}, ${plural(count, 'triangle')}`, rows };
  },
});
