import type { Bounds, CallOptions, Drain, Soup } from 'fast-winding';
import type { Page } from '../page.ts';
import { attempt } from './attempt.ts';
import { only } from './only.ts';
import { timed } from './timed.ts';

/** Degrees from which edges of an offset are kept. */
const SHARP = 35;
/** Cells of the lattice that a place for the drain is sought in. */
const DRAIN_RESOLUTION = 48;

export interface Cells {
  readonly resolution: number;
  readonly isSharp: boolean;
}

/** The surface so many millimetres outside of the model, or inside. */
export async function makeOffset(page: Page, distance: number, { resolution, isSharp }: Cells): Promise<void> {
  const { store } = page;
  const { shape } = store.state.model!;
  await attempt(page, 'Offset', 'The offset could not be made', async (options) => {
    const { value: mesh, milliseconds } = await timed(() => shape.offset({ distance, resolution, sharp: isSharp ? SHARP : undefined, ...options }));
    store.set({ offset: { value: { mesh, kind: 'offset' }, milliseconds }, visible: only(page, 'offset') });
  });
}

/** Walls along the inside of the model, with a hole of `drain` millimetres from below if that is not 0. */
export async function makeHollow(page: Page, thickness: number, drain: number, { resolution, isSharp }: Cells): Promise<void> {
  const { store } = page;
  const { shape, bounds } = store.state.model!;
  if (shape.kind !== 'soup') return;
  await attempt(page, 'Hollow', 'The model could not be hollowed', async (options) => {
    const { value: mesh, milliseconds } = await timed(async () => {
      const drains = drain > 0 ? [await drainUnder(shape, bounds, thickness, drain / 2, options)] : [];
      return shape.hollow({ thickness, drains, resolution, sharp: isSharp ? SHARP : undefined, ...options });
    });
    store.set({ offset: { value: { mesh, kind: 'hollow' }, milliseconds }, visible: only(page, 'offset') });
  });
}

/** From below into the lowest part of the cavity that is as wide as the hole, or the deepest place inside. */
async function drainUnder(shape: Soup, bounds: Bounds, thickness: number, radius: number, options: CallOptions): Promise<Drain> {
  const { counts, origin, spacing, values } = await shape.signedDistance({ resolution: DRAIN_RESOLUTION, ...options });
  let place = values.findIndex((value) => value <= -thickness - radius);
  if (place < 0) place = values.reduce((deepest, value, k) => (value < values[deepest] ? k : deepest), 0);
  const [i, j] = [place % counts[0], Math.floor(place / counts[0]) % counts[1]];
  return { at: [origin[0] + i * spacing[0], origin[1] + j * spacing[1], bounds.min[2]], direction: [0, 0, 1], radius };
}
