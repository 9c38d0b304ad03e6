import type { Soup } from 'fast-winding';
import { stem } from '../download.ts';
import type { Page } from '../page.ts';
import { placed } from '../results.ts';
import type { Triangles } from '../results.ts';
import { attempt } from './attempt.ts';
import { modelOf } from './load.ts';
import { show } from './open.ts';
import { sourceOf } from './source.ts';

/** Makes a result the model that all else is done with. */
export async function adopt(page: Page, triangles: Triangles, suffix: string): Promise<void> {
  await adoptOf(page, suffix, () => page.engine.Soup.from({ positions: placed(triangles), indices: triangles.indices }));
}

/** The same for triangles in the engine, which keep every bit. */
export async function adoptSoup(page: Page, soup: Soup, suffix: string): Promise<void> {
  await adoptOf(page, suffix, async () => page.engine.Soup.parse(await soup.export('ply')));
}

async function adoptOf(page: Page, suffix: string, made: () => Promise<Soup>): Promise<void> {
  const name = `${stem(page.store.state.model!.name)}-${suffix}`;
  await attempt(page, 'Model', 'The result could not become the model', async (options) => {
    const soup = await made();
    try {
      const model = await modelOf(soup, name, 0, options);
      const source = await sourceOf(soup, name);
      page.source = source;
      show(page, model);
    } catch (error) {
      soup.free();
      throw error;
    }
  });
}
