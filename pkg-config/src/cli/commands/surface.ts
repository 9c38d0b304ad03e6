import { command } from '../command.js';
import { CELLS, MESH_FORMATS, SHARP, meshFigures, saveMesh, verifyCells } from '../meshes.js';
import { plural } from '../words.js';

export const surface = command({
  name: 'surface',
  summary: 'a closed mesh of a scan, a point cloud or a broken mesh',
  description: [
    'The surface where the winding number is ½, closed and manifold. Points without normals get them first.',
    'Clouds need no option: cells and level come from their points. Meshes get 64 cells along the longest side.',
  ],
  files: 'each',
  options: {
    ...CELLS,
    ...SHARP,
    level: { kind: 'number', value: 'W', help: 'the surface is where the winding number is this' },
    smoothing: { kind: 'number', value: 'N', help: 'of noisy clouds: points spread over so many distances between them' },
    trim: { kind: 'number', value: 'N', help: 'of open scans: leave out what is farther from any point than so many' },
    minComponent: { kind: 'number', value: 'SHARE', help: 'leave out pieces smaller than this share of the largest' },
  },
  formats: MESH_FORMATS,
  verify: verifyCells,
  examples: ['surface scan.xyz -o scan.stl', 'surface --resolution 256 --sharp 35 part.stl -o part.ply'],
  async run(task, values) {
    const mesh = await task.shapes[0]!.surface({ ...values, ...task.call });
    await saveMesh(task, mesh);
    const report = meshFigures(mesh);
    return { report, headline: `surface of ${plural(report.triangles, 'triangle')}` };
  },
});
