// Layers to a printer's program: options of `slice` for `--format gcode`.
import type { GCode, Layer, PrinterProfile, ToolpathSettings } from '../../api.js';
import { WindingError } from '../../error.js';
import type { Task } from '../command.js';
import type { Values } from '../options.js';

export const OF_GCODE = {
  profile: { kind: 'text', value: 'FILE', help: 'of gcode: JSON of the printer (bedWidth, nozzleDiameter, …), its toolpaths under "settings"' },
  perimeters: { kind: 'whole', value: 'N', help: 'of gcode: lines around each part' },
  infill: { kind: 'choice', choices: ['rectilinear', 'grid', 'gyroid'], help: 'of gcode: pattern of the inside' },
  density: { kind: 'number', value: 'SHARE', help: 'of gcode: share of the inside that is filled, 0 to 1' },
} as const;

type Profile = PrinterProfile & { settings?: ToolpathSettings };

async function profileOf(task: Task, path: string | undefined): Promise<Profile> {
  if (path === undefined) return {};
  const text = new TextDecoder().decode(await task.readBytes(path));
  try {
    return JSON.parse(text) as Profile;
  } catch (error) {
    throw new WindingError('ParseError', `the profile ${path} is no JSON: ${(error as Error).message}`, { format: 'JSON' });
  }
}

/** The program that prints `layers`. What an option says goes before the profile's file. */
export async function gcodeOf(task: Task, layers: Layer[], values: Values<typeof OF_GCODE>): Promise<GCode> {
  const { profile: path, ...given } = values;
  const { settings, ...profile } = await profileOf(task, path);
  const wanted = Object.fromEntries(Object.entries(given).filter(([name, value]) => name in OF_GCODE && value !== undefined));
  const paths = await task.fw.toolpaths(layers, { ...settings, ...wanted, ...task.call });
  const gcode = await task.fw.gcode(paths, profile);
  return { ...gcode, warnings: [...paths.warnings, ...gcode.warnings] };
}
