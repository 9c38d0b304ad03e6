import { WindingError } from '../../error.js';
import type { BooleanOperation, Shape, Soup, Warning } from '../../api.js';
import { command } from '../command.js';
import { CELLS, MESH_FORMATS, saveShape } from '../meshes.js';
import { plural, sizeOf, warningRows } from '../words.js';

export const boolean = command({
  name: 'boolean',
  summary: 'union, intersection or difference of solids',
  description: [
    'Combines the first file with the second, the result with the third, and so on: a difference takes all others away from the first.',
    'Each solid is trimmed along the other’s surface, exactly; where that is missing, along w = ½. Of closed meshes the result is closed.',
  ],
  words: [{ name: 'OPERATION', choices: ['union', 'intersection', 'difference'] }],
  files: { atLeast: 2 },
  options: {
    tolerance: { kind: 'number', value: 'MM', help: 'longest step of a cut where a surface is missing' },
    resolution: { ...CELLS.resolution, help: 'of clouds: cells along the longest side of the traced surface' },
  },
  formats: MESH_FORMATS,
  examples: ['boolean union a.stl b.stl c.stl -o all.stl', 'boolean difference block.stl hole.stl -o part.3mf'],
  async run(task, options) {
    const operation = task.words[0] as BooleanOperation;
    const warnings: Warning[] = [];
    let result: Shape = task.shapes[0]!;
    for (const other of task.shapes.slice(1)) {
      const combined: { soup: Soup | null; warnings: Warning[] } = await result.boolean(operation, other, { ...options, ...task.call });
      warnings.push(...combined.warnings);
      if (result !== task.shapes[0]) result.free();
      if (!combined.soup) throw new WindingError('EmptyResult', `nothing is left of the ${operation}`);
      result = combined.soup;
    }
    await saveShape(task, result as Soup);
    const report = { operation, triangles: result.count, bounds: result.bounds, warnings };
    const rows: [string, string][] = [['size', sizeOf(result.bounds)], ...warningRows(warnings)];
    const headline = `${operation} of ${task.shapes.length}: ${plural(result.count, 'triangle')}`;
    result.free();
    return { report, headline, rows };
  },
});
