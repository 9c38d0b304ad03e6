import type { VoxelDifference } from 'fast-winding';
import { methodsFor } from '../comparison.ts';
import type { ComparedMethod, ComparedVoxels } from '../comparison.ts';
import type { Page } from '../page.ts';
import { allOf } from '../state.ts';
import { attempt } from './attempt.ts';
import { timed } from './timed.ts';

const SAME: VoxelDifference = { lost: new Uint32Array(), gained: new Uint32Array(), count: 0, intersectionOverUnion: 1 };

/** Makes the voxels of the model in every way, and holds them against the exact ones. */
export async function compareMethods(page: Page, resolution: number, threshold: number): Promise<void> {
  const { store, engine } = page;
  const { shape } = store.state.model!;
  await attempt(page, 'Voxels', 'The methods could not be compared', async (options) => {
    const methods = methodsFor(shape.kind);
    const rows: ComparedVoxels[] = [];
    for (const [k, method] of methods.entries()) {
      const onProgress = (fraction: number): void => options.onProgress((k + fraction) / methods.length, `${method} (${k + 1} of ${methods.length})`);
      const { value: voxels, milliseconds } = await timed(() => shape.voxelize({ method, resolution, threshold, format: 'bits', ...options, onProgress }));
      const difference = k === 0 ? SAME : await engine.compareVoxels(rows[0].voxels, voxels);
      rows.push({ method, voxels, milliseconds, difference });
    }
    showDifference(page, rows, methods[1]);
  });
}

/** Colours the voxels that one method has wrong. */
export function showDifference({ store }: Page, rows: readonly ComparedVoxels[], shown: ComparedMethod): void {
  store.set({ comparison: { rows, shown }, visible: { ...allOf(false), layer: store.state.visible.layer, model: true, difference: true }, halves: false });
}
