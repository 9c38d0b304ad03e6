/** Results as plain data, which the browser can keep, and back again: what is in the engine goes as the bytes of a file. */
import type { FastWinding, Soup } from 'fast-winding';
import { ALL_MADE } from './made.ts';
import type { Made, Making } from './made.ts';
import type { Triangles } from './results.ts';
import { isRecord } from './storage.ts';
import { recipeOf } from './texture.ts';
import type { TextureRecipe } from './texture.ts';

interface Packed {
  readonly item: Made;
  readonly milliseconds: number;
  /** Of a soup and its triangles there is a file, `ply`. */
  readonly value: unknown;
}

/** What a texture is made again from, which is in the engine alone. */
export interface PackedTexture {
  readonly milliseconds: number;
  readonly recipe: TextureRecipe;
}

export async function packed({ item, made }: Making): Promise<Packed | PackedTexture> {
  const { milliseconds, value } = made;
  if ('handle' in value) return { milliseconds, recipe: recipeOf(value) };
  if (!('soup' in value)) return { item, milliseconds, value };
  const { soup, triangles: _, ...rest } = value;
  return { item, milliseconds, value: { ...rest, ply: await soup.export('ply') } };
}

/** Rejects what is no such thing. */
export async function unpacked(engine: FastWinding, content: unknown): Promise<Making> {
  const { item, milliseconds, value } = isRecord(content) ? content : {};
  const known = ALL_MADE.find((name) => name === item);
  if (!known || typeof milliseconds !== 'number' || !isRecord(value) || !ARE_WHOLE[known](value)) throw new Error('this is no result');
  const { ply, ...rest } = value;
  return { item: known, made: { milliseconds, value: ply ? { ...rest, ...(await soupOf(engine, ply as Uint8Array)) } : rest } } as unknown as Making;
}

/** Throws for what is none. */
export function unpackedTexture(content: unknown): PackedTexture {
  const { milliseconds, recipe } = isRecord(content) ? content : {};
  if (typeof milliseconds !== 'number' || !isRecipe(recipe)) throw new Error('this is no texture');
  return { milliseconds, recipe };
}

function isRecipe(value: unknown): value is TextureRecipe {
  if (!isRecord(value) || !isRecord(value.first) || !isRecord(value.mapping) || typeof value.refine !== 'boolean' || !Array.isArray(value.seams)) return false;
  return value.seams.every((seam) => isRecord(seam) && Array.isArray(seam.picks) && seam.chain instanceof Uint32Array);
}

async function soupOf(engine: FastWinding, ply: Uint8Array): Promise<{ soup: Soup; triangles: Triangles }> {
  const soup = await engine.Soup.parse(ply);
  try {
    return { soup, triangles: await soup.geometry() };
  } catch (error) {
    soup.free();
    throw error;
  }
}

type Check = (value: Record<string, unknown>) => boolean;

const isMesh = (value: unknown): boolean =>
  isRecord(value) && value.positions instanceof Float32Array && value.indices instanceof Uint32Array && value.origin instanceof Float64Array;

/** Whether there is what is drawn of each, and what is saved. */
const ARE_WHOLE: Record<Made, Check> = {
  repaired: ({ ply, report, after }) => ply instanceof Uint8Array && isRecord(report) && isRecord(after),
  combined: ({ ply, operands, warnings }) => ply instanceof Uint8Array && operands instanceof Uint8Array && Array.isArray(warnings),
  textured: () => false,
  offset: ({ mesh }) => isMesh(mesh),
  surface: isMesh,
  voxels: ({ inside, surface }) => inside instanceof Uint8Array && (surface === undefined || isMesh(surface)),
  print: ({ layers, segments, gcode }) => Array.isArray(layers) && isRecord(segments) && segments.data instanceof Float32Array && isRecord(gcode),
};
