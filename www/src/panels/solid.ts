import type { SurfaceOptions } from 'fast-winding';
import { saveMesh } from '../actions/save.ts';
import { makeSurface, makeVoxels } from '../actions/solid.ts';
import { byId, paintSlider, setFacts } from '../dom.ts';
import { count, milliseconds, volume } from '../format.ts';
import type { Page } from '../page.ts';
import type { State } from '../state.ts';
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
  byId('voxelize').addEventListener('click', () => void makeVoxels(page, resolution.valueAsNumber, threshold.valueAsNumber));
  byId('voxel-download').addEventListener('click', () => {
    const mesh = store.state.voxels?.value.surface;
    if (mesh) void saveMesh(page, mesh, 'voxels');
  });
  store.on(['voxels'], ({ voxels }) => {
    byId<HTMLButtonElement>('voxel-download').disabled = !voxels;
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
    if (voxels) reveal('voxel-facts');
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
  byId('surface-download').addEventListener('click', () => {
    const mesh = store.state.surface?.value;
    if (mesh) void saveMesh(page, mesh, 'surface');
  });
  store.on(['surface'], ({ surface }) => {
    byId<HTMLButtonElement>('surface-download').disabled = !surface;
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
    if (surface) reveal('surface-facts');
  });
  enableWhenUsable(page, byId<HTMLButtonElement>('surface'));
}

/** A slider whose value is written beside it. */
function slider(id: string): HTMLInputElement {
  const input = byId<HTMLInputElement>(id);
  const show = (): void => {
    byId(`${id}-out`).textContent = input.value;
    paintSlider(input);
  };
  input.addEventListener('input', show);
  show();
  return input;
}

/** How many cubic cells a resolution along the longest side means for the model. */
function cells({ model }: State, resolution: number): string {
  if (!model) return '';
  const { min, max } = model.bounds;
  const sides = [0, 1, 2].map((k) => max[k] - min[k]);
  const cell = Math.max(...sides) / resolution;
  const counts = sides.map((side) => Math.max(1, Math.ceil(side / cell - 1e-9)));
  return `${counts.map(count).join(' × ')} cells of ${cell.toPrecision(3)} mm`;
}
