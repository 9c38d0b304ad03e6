import { NOTHING_MADE } from '../state.ts';
import type { State } from '../state.ts';
import { release } from './results.ts';

/** Gives back what was made of the model, of which nothing is left then. */
export function forgotten({ results }: State): typeof NOTHING_MADE {
  results.forEach(release);
  return NOTHING_MADE;
}
