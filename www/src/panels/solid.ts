import type { SurfaceOptions } from 'fast-winding';
import { adopt } from '../actions/adopt.ts';
import { saveMesh, saveVoxels } from '../actions/save.ts';
import { makeSurface, makeVoxels } from '../actions/solid.ts';
import { byId, setFacts } from '../dom.ts';
import { count, milliseconds, volume } from '../format.ts';
import type { Page } from '../page.ts';
import type { MeshFormat } from '../state.ts';
import { comparisonPanel } from './comparison.ts';
import { formatMenu, saver } from './saver.ts';
import { cells, slider } from './slider.ts';
import { enableWhenUsable, reveal } from './usable.ts';

/** Points drawn by lot leave no holes between them within so many of their distances. */
const TRIM = 3;

export function voxelPanel(page: Page): void {
  const { store } = page;
  const resolution = slider('voxel-resolution');
  const threshold = slider('voxel-threshold');
  const describe = (): void => {
    byId('voxel-cells').textContent = cells(store.state, resolution.valueAsNumber);
  };
  resolution.addEventListener('input', describe);
  store.on(['model'], describe);
  const method = comparisonPanel(page, () => ({ resolution: resolution.valueAsNumber, threshold: threshold.valueAsNumber }));
  byId('voxelize').addEventListener('click', () => void makeVoxels(page, method(), resolution.valueAsNumber, threshold.valueAsNumber));
  formatMenu(page, 'voxel-download', ['vox', 'nrrd'], (state) => state.voxels !== undefined, (format) => {
    const voxels = store.state.voxels?.value;
    if (!voxels) return;
    if (format === 'vox' || format === 'nrrd') void saveVoxels(page, voxels, format);
    else if (voxels.surface) void saveMesh(page, voxels.surface, 'voxels', format as MeshFormat);
  });
  store.on(['voxels'], (state) => {
    const { voxels } = state;
    setFacts(
      byId('voxel-facts'),
      voxels
        ? [
            ['Inside', `${count(voxels.value.count)} of ${count(voxels.value.counts.reduce((product, n) => product * n))}`],
            ['Volume', volume(voxels.value.volume)],
            ['Computed', milliseconds(voxels.milliseconds)],
          ]
        : [],
    );
    if (voxels) reveal(state, 'voxel-facts');
  });
  enableWhenUsable(page, byId<HTMLButtonElement>('voxelize'));
}

export function surfacePanel(page: Page): void {
  const { store } = page;
  const resolution = slider('surface-resolution');
  const describe = (): void => {
    byId('surface-cells').textContent = cells(store.state, resolution.valueAsNumber);
  };
  resolution.addEventListener('input', describe);
  store.on(['model'], describe);
  const smoothing = slider('surface-smoothing');
  const [fine, trim] = ['surface-fine', 'surface-trim'].map((id) => byId<HTMLInputElement>(id));
  store.on(['model'], ({ model }) => {
    byId('surface-of-cloud').hidden = model?.shape.kind !== 'cloud';
    adapt();
  });
  fine.addEventListener('change', adapt);
  byId('surface').addEventListener('click', () => void makeSurface(page, wanted()));

  function adapt(): void {
    resolution.disabled = fine.checked && store.state.model?.shape.kind === 'cloud';
    byId('surface-cells').hidden = resolution.disabled;
  }

  function wanted(): SurfaceOptions {
    const fixed = resolution.disabled ? {} : { resolution: resolution.valueAsNumber };
    if (store.state.model?.shape.kind !== 'cloud') return fixed;
    return { ...fixed, smoothing: smoothing.valueAsNumber || undefined, trim: trim.checked ? TRIM : undefined };
  }
  saver(page, 'surface-download', (state) => state.surface !== undefined, (format) => {
    const mesh = store.state.surface?.value;
    if (mesh) void saveMesh(page, mesh, 'surface', format);
  });
  byId('surface-use').addEventListener('click', () => {
    const mesh = store.state.surface?.value;
    if (mesh) void adopt(page, mesh, 'surface');
  });
  enableWhenUsable(page, byId<HTMLButtonElement>('surface-use'), (state) => state.surface !== undefined);
  store.on(['surface'], (state) => {
    const { surface } = state;
    setFacts(
      byId('surface-facts'),
      surface
        ? [
            ['Triangles', count(surface.value.indices.length / 3)],
            ['Vertices', count(surface.value.positions.length / 3)],
            ['Computed', milliseconds(surface.milliseconds)],
          ]
        : [],
    );
    if (surface) reveal(state, 'surface-facts');
  });
  enableWhenUsable(page, byId<HTMLButtonElement>('surface'));
}
