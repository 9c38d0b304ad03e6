import type { Layer, SliceOptions } from '../../api.js';
import { type Outcome, type Task, command } from '../command.js';
import { type Values, given } from '../options.js';
import { UsageError } from '../usage.js';
import { figure, length, plural, volume, warningRows } from '../words.js';
import { OF_GCODE, gcodeOf } from './gcode.js';

const OPTIONS = {
  layerHeight: { kind: 'number', value: 'MM', help: 'height of a layer (0.2)' },
  firstLayerHeight: { kind: 'number', value: 'MM', help: 'of the first; as the others unless given' },
  adaptive: { kind: 'numbers', value: 'LEAST,MOST,OFF', count: 3, help: 'layers as thick as slopes allow: their heights, and how far steps may stand off' },
  mode: { kind: 'choice', choices: ['winding', 'even-odd', 'largest'], help: 'what is inside: w ≥ ½ (winding, unless given), what overlaps left out (even-odd), or the largest outline, for a vase (largest)' },
  simplify: { kind: 'number', value: 'MM', help: 'leave out vertices where contours stay this near' },
  tolerance: { kind: 'number', value: 'MM', help: 'of clouds: edge of a cell in the plane' },
  separate: { kind: 'flag', help: 'a file for each layer, SVG: -o is a folder' },
  ...OF_GCODE,
} as const;
type SliceValues = Values<typeof OPTIONS>;

/** What is known of layers without keeping them. */
class Sum {
  layers = 0;
  contours = 0;
  /** Of the layers' areas times their heights. */
  volume = 0;
  private height = [Infinity, -Infinity];

  add({ polygons, zBottom, zTop }: Layer): void {
    const rings = polygons.flatMap(({ outer, holes }) => [outer, ...holes]);
    this.layers++;
    this.contours += rings.length;
    this.volume += (zTop - zBottom) * rings.reduce((sum, ring) => sum + areaOf(ring), 0);
    this.height = [Math.min(this.height[0]!, zBottom), Math.max(this.height[1]!, zTop)];
  }

  outcome(more: object = {}, rows: [string, string][] = []): Outcome {
    const { layers, contours, volume: total } = this;
    const [zBottom, zTop] = this.height as [number, number];
    return {
      report: { layers, contours, zBottom, zTop, volume: total, ...more },
      headline: `${plural(layers, 'layer')}, ${plural(contours, 'contour')}`,
      rows: [['height', length(zTop - zBottom)], ['volume', volume(total)], ...rows],
    };
  }
}

/** Negative for clockwise rings, which are holes. */
function areaOf(ring: Float64Array): number {
  let twice = 0;
  for (let i = 0; i < ring.length; i += 2) {
    const j = (i + 2) % ring.length;
    twice += ring[i]! * ring[j + 1]! - ring[j]! * ring[i + 1]!;
  }
  return twice / 2;
}

function sliceOptions(values: SliceValues, task: Task): SliceOptions {
  const { layerHeight, firstLayerHeight, mode, simplify, tolerance } = values;
  const [least, most, deviation] = values.adaptive ?? [];
  const adaptive = values.adaptive && { least: least!, most: most!, deviation: deviation! };
  return given({ layerHeight, firstLayerHeight, mode, simplify, tolerance, adaptive, ...task.call });
}

/** A file for each layer: only some layers are in memory at a time. */
async function separately(task: Task, options: SliceOptions): Promise<Outcome> {
  const sum = new Sum();
  for await (const layer of task.shapes[0]!.layers(options)) {
    sum.add(layer);
    await task.save(await task.fw.exportLayer(layer, 'svg'), String(sum.layers).padStart(4, '0'));
  }
  return sum.outcome();
}

async function together(task: Task, options: SliceOptions, values: SliceValues): Promise<Outcome> {
  const shape = task.shapes[0]!;
  const layers = await shape.slice(options);
  const sum = new Sum();
  layers.forEach((layer) => sum.add(layer));
  if (task.format === 'gcode') {
    const { bytes, estimate, warnings } = await gcodeOf(task, layers, values);
    await task.save(bytes);
    const minutes = `${figure(Math.round(estimate.seconds / 60))} min`;
    const print = `${minutes}, ${length(estimate.filamentLength)} of filament, ${figure(estimate.filamentMass)} g`;
    return sum.outcome({ estimate, warnings }, [['print', print], ...warningRows(warnings)]);
  }
  if (task.format === '3mf') {
    // The format wants a mesh beside the slices.
    const mesh = await (shape.kind === 'soup' ? shape.geometry() : shape.surface(task.call));
    await task.save(await task.fw.exportLayers(layers, '3mf', mesh));
  } else if (task.format) {
    await task.save(await task.fw.exportLayers(layers, task.format as 'svg' | 'dxf' | 'json'));
  }
  return sum.outcome();
}

export const slice = command({
  name: 'slice',
  summary: 'contours of layers; with --format gcode, a program for a printer',
  description: [
    'Contours of meshes are exact sections of the triangles, overlaps united; where the surface is missing they follow w = ½. Layers are sampled in the middle of their span.',
    'Writes one svg with a group for each layer, dxf, json, 3mf with the slice extension, or gcode in Marlin’s dialect.',
  ],
  files: 'each',
  options: OPTIONS,
  formats: ['svg', 'dxf', 'json', '3mf', 'gcode'],
  verify(values: SliceValues) {
    if (values.adaptive && values.layerHeight !== undefined) throw new UsageError('give one of --layer-height and --adaptive');
  },
  formatFor: ({ separate }: SliceValues) => (separate ? 'svg' : undefined),
  writesParts: ({ separate }: SliceValues) => separate === true,
  examples: [
    'slice --layer-height 0.2 part.stl -o part.svg',
    'slice --separate part.stl -o layers/',
    'slice --infill gyroid --density 0.15 --profile printer.json part.stl -o part.gcode',
  ],
  async run(task, values: SliceValues) {
    const options = sliceOptions(values, task);
    return values.separate && task.format ? separately(task, options) : together(task, options, values);
  },
});
