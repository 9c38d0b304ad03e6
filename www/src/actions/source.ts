import type { Soup } from 'fast-winding';
import type { Source } from '../page.ts';
import { newId } from './open.ts';

/** A source for triangles that are in no file: as they are now, to the last bit. */
export async function sourceOf(soup: Soup, name: string): Promise<Source> {
  const bytes = await soup.export('ply');
  return { name, id: newId(), unit: 'millimeter', read: async () => bytes.slice() };
}
