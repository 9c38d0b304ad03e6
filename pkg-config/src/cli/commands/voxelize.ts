import { command } from '../command.js';
import { CELLS, MESH_FORMATS, saveMesh, verifyCells } from '../meshes.js';
import { given } from '../options.js';
import { counts, figure, length, volume } from '../words.js';

export const voxelize = command({
  name: 'voxelize',
  summary: 'which cells of a lattice are inside',
  description: [
    'A cell is inside where the winding number of its centre is at least ½, proven for meshes.',
    'Writes nrrd, as 3D Slicer, ITK and numpy readers have it, places in millimetres; vox, for MagicaVoxel; or the cells’ outer faces as a mesh.',
  ],
  files: 'each',
  options: {
    ...CELLS,
    threshold: { kind: 'number', value: 'W', help: 'least winding number inside (0.5)' },
    method: { kind: 'choice', choices: ['lattice', 'continuation'], help: 'ask every cell (lattice, unless given), or follow the surface (continuation)' },
    raw: { kind: 'flag', help: 'of nrrd: without compression' },
    solid: { kind: 'flag', help: 'of vox: all voxels inside, not those alone that can be seen' },
  },
  formats: ['nrrd', 'vox', ...MESH_FORMATS],
  verify: verifyCells,
  examples: ['voxelize --resolution 256 part.stl -o part.nrrd', 'voxelize --spacing 0.5 statue.obj -o statue.vox'],
  async run(task, { raw, solid, ...options }) {
    const voxels = await task.shapes[0]!.voxelBricks({ ...options, ...task.call });
    const { bricks: _, ...report } = voxels;
    if (task.format === 'nrrd' || task.format === 'vox') {
      await task.save(await task.fw.exportVoxels(voxels, task.format, given(task.format === 'vox' ? { solid } : { raw })));
    } else if (task.format) {
      await saveMesh(task, await task.fw.voxelSurface(voxels));
    }
    const rows: [string, string][] = [['volume', volume(report.volume)], ['spacing', length(report.spacing[0])]];
    return { report, headline: `${figure(report.count)} of ${counts(report.counts)} voxels inside`, rows };
  },
});
