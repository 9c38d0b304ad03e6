import type { RepairOptions } from 'fast-winding';
import type { Page } from '../page.ts';
import type { Repair } from '../results.ts';
import { attempt } from './attempt.ts';
import { checked } from './check.ts';
import { only } from './only.ts';
import { timed } from './timed.ts';

/** A closed mesh of the model that is shown, beside it, and what is wrong with either. */
export async function repairModel(page: Page, how: Pick<RepairOptions, 'method' | 'resolution'>): Promise<void> {
  const { store } = page;
  const { shape } = store.state.model!;
  await attempt(page, 'Repair', 'The model could not be repaired', async (options) => {
    if (shape.kind === 'soup' && !store.state.report) store.set({ report: await checked(page, shape, options) });
    const before = store.state.report?.value;
    // Checked here, by the limits of the page.
    const wanted = { ...how, check: false, ...options };
    const made = await timed(() => (shape.kind === 'soup' ? shape.repair(wanted) : shape.repair({ ...wanted, method: 'remesh' })));
    const { soup, report } = made.value;
    try {
      const after = (await checked(page, soup, options)).value;
      const value: Repair = { soup, triangles: await soup.geometry(), report, before, after };
      store.set({ repair: { value, milliseconds: made.milliseconds }, visible: only(page, 'repaired'), halves: true });
    } catch (error) {
      soup.free();
      throw error;
    }
  });
}
