/** What the address of the page says after its `#`: the model, and the tool at hand. */
import { SAMPLES } from '../samples/catalogue.ts';
import { stem } from './download.ts';

export const TOOLS = ['layer', 'check', 'repair', 'voxels', 'surface', 'offset', 'combine', 'texture', 'print', 'engine'] as const;
export type Tool = (typeof TOOLS)[number];

export interface Address {
  /** As it is named: `bunny` for `bunny.stl`. */
  readonly sample?: string;
  /** Of a file that the browser keeps; its name is nobody else's business. */
  readonly file?: string;
  readonly tool?: Tool;
}

export function addressOf(hash: string): Address {
  const fields = new URLSearchParams(hash.replace(/^#/, ''));
  const tool = TOOLS.find((name) => name === fields.get('tool'));
  return { sample: fields.get('sample') || undefined, file: fields.get('file') || undefined, tool };
}

/** With its `#`. */
export function hashOf({ sample, file, tool }: Address): string {
  const fields = Object.entries({ sample, file, tool }).filter((field): field is [string, string] => field[1] !== undefined);
  return `#${new URLSearchParams(fields)}`;
}

/** The file of a sample that is named, if there is one. */
export function sampleNamed(name: string): string | undefined {
  return SAMPLES.find(({ file }) => stem(file) === name)?.file;
}
