// Meshes on their way into a file, and the options that commands which make them have in common.
import type { FastWinding, Mesh, Soup } from '../api.js';
import type { Task } from './command.js';
import { UsageError } from './usage.js';

/** What meshes are written as. */
export const MESH_FORMATS = ['stl', 'obj', 'ply', 'off', '3mf'] as const;

/** How fine a mesh made anew is. */
export const CELLS = {
  resolution: { kind: 'whole', value: 'N', help: 'cells along the longest side' },
  spacing: { kind: 'number', value: 'MM', help: 'edge of a cell, in place of --resolution' },
} as const;
export const SHARP = {
  sharp: { kind: 'number', value: 'DEG', help: 'keep edges sharp from this angle, such as 35' },
} as const;

export function verifyCells({ resolution, spacing }: { resolution?: number; spacing?: number }): void {
  if (resolution !== undefined && spacing !== undefined) throw new UsageError('give one of --resolution and --spacing');
}

/** A mesh as a shape, in the model's own frame. */
export function soupOf(fw: FastWinding, { positions, indices, origin }: Omit<Mesh, 'normals'>): Promise<Soup> {
  const placed = Float64Array.from(positions, (x, i) => x + origin[i % 3]!);
  return fw.Soup.from({ positions: placed, indices });
}

/** Writes a mesh, if one is wanted. */
export async function saveMesh(task: Task, mesh: Omit<Mesh, 'normals'>): Promise<void> {
  if (!task.format) return;
  const soup = await soupOf(task.fw, mesh);
  await saveShape(task, soup);
  soup.free();
}

export async function saveShape(task: Task, shape: Pick<Soup, 'export'>): Promise<void> {
  if (task.format) await task.save(await shape.export(task.format as (typeof MESH_FORMATS)[number]));
}

/** Triangles and vertices of a mesh, for a report. */
export function meshFigures({ positions, indices }: Omit<Mesh, 'normals'>): { triangles: number; vertices: number } {
  return { triangles: indices.length / 3, vertices: positions.length / 3 };
}
