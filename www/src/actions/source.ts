import type { Cloud, Soup } from 'fast-winding';
import type { Source } from '../page.ts';
import { newId } from './open.ts';

/** A source for what is in no file: triangles, or points with their normals, as they are now, to the last bit. */
export async function sourceOf(shape: Soup | Cloud, name: string): Promise<Source> {
  const bytes = shape.kind === 'soup' ? await shape.export('ply') : await shape.save();
  return { name, id: newId(), unit: 'millimeter', read: async () => bytes.slice() };
}
