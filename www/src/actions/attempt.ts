import type { CallOptions } from 'fast-winding';
import type { Page } from '../page.ts';
import { fail } from './fail.ts';

/** Runs a job; when it fails, `failure` is told with the reason. */
export async function attempt(page: Page, label: string, failure: string, work: (options: Required<CallOptions>) => Promise<void>): Promise<void> {
  page.store.set({ problem: undefined });
  try {
    await page.jobs.run(label, work);
  } catch (error) {
    await fail(page, failure, error);
  }
}
