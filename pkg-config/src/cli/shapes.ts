// What commands ask of the shapes they are given.
import type { Soup } from '../api.js';
import { WindingError } from '../error.js';
import type { Task } from './command.js';

/** The soup of a task for a command that takes nothing else. */
export function soupFrom({ shapes }: Task, name: string): Soup {
  const shape = shapes[0]!;
  if (shape.kind === 'soup') return shape;
  throw new WindingError('InvalidArgument', `${name} takes triangles, and this is a point cloud: make a mesh of it first, by surface`);
}
