import type { Soup } from 'fast-winding';
import { nextFrame } from '../dom.ts';
import { FOLLOWED } from '../jobs.ts';
import type { Page } from '../page.ts';
import type { TextureRecipe, Texturing } from '../texture.ts';
import { made } from './texture.ts';

/**
 * Makes a texture again from its recipe, as a job that lets whatever a person wants meanwhile go first; none when it is not wanted any
 * longer.
 */
export async function remade({ jobs }: Page, source: Soup, recipe: TextureRecipe, isWanted: () => boolean): Promise<Texturing | undefined> {
  for (;;) {
    await jobs.idle();
    // Whoever waited for the job that ended goes on first.
    await nextFrame();
    if (jobs.isRunning) continue;
    if (!isWanted()) return undefined;
    let signal: AbortSignal | undefined;
    try {
      const { value } = await jobs.run('Making the texture again', (options) => {
        signal = options.signal;
        return made(source, recipe, options);
      }, true);
      if (isWanted()) return value;
      value.handle.free();
    } catch (error) {
      if (signal?.reason !== FOLLOWED) throw error;
    }
  }
}
