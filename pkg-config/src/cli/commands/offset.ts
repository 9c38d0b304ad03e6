import type { Mesh } from '../../api.js';
import { type Outcome, type Task, command } from '../command.js';
import { CELLS, MESH_FORMATS, SHARP, meshFigures, saveMesh, verifyCells } from '../meshes.js';
import { soupFrom } from '../shapes.js';
import { plural } from '../words.js';

async function made(task: Task, mesh: Mesh, what: string): Promise<Outcome> {
  await saveMesh(task, mesh);
  const report = meshFigures(mesh);
  return { report, headline: `${what}: ${plural(report.triangles, 'triangle')}, closed` };
}

export const offset = command({
  name: 'offset',
  summary: 'the surface at a distance: thicker or thinner solids',
  description: ['Closed and manifold, at the signed distance: above 0 outside of the solid, below 0 inside.'],
  files: 'each',
  options: { distance: { kind: 'number', value: 'MM', isRequired: true, help: 'how far' }, ...CELLS, ...SHARP },
  formats: MESH_FORMATS,
  verify: verifyCells,
  examples: ['offset --distance 0.5 part.stl -o thicker.stl', 'offset --distance -1 part.stl -o core.stl'],
  async run(task, { distance, ...cells }) {
    return made(task, await task.shapes[0]!.offset({ distance: distance!, ...cells, ...task.call }), 'offset surface');
  },
});

export const hollow = command({
  name: 'hollow',
  summary: 'walls in place of a full inside, with drains',
  description: ['The walls along the inside of a mesh, less round holes through them.'],
  files: 'each',
  options: {
    thickness: { kind: 'number', value: 'MM', isRequired: true, help: 'of the walls: two cells at least' },
    drain: { kind: 'lists', value: 'X,Y,Z,DX,DY,DZ,R', count: 7, help: 'a hole: a place on its axis, the direction into the cavity, the radius; may be repeated' },
    ...CELLS,
    ...SHARP,
  },
  formats: MESH_FORMATS,
  verify: verifyCells,
  examples: ['hollow --thickness 2 --drain 0,0,-1,0,0,1,1.5 statue.stl -o shell.stl'],
  async run(task, { thickness, drain = [], ...cells }) {
    const drains = drain.map(([x, y, z, dx, dy, dz, radius]) => ({
      at: [x!, y!, z!] as [number, number, number],
      direction: [dx!, dy!, dz!] as [number, number, number],
      radius: radius!,
    }));
    return made(task, await soupFrom(task, 'hollow').hollow({ thickness: thickness!, drains, ...cells, ...task.call }), 'walls');
  },
});
