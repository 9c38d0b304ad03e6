import type { Layer, Soup, Voxels } from 'fast-winding';
import { download, stem } from '../download.ts';
import type { Page } from '../page.ts';
import { placed } from '../results.ts';
import type { Triangles } from '../results.ts';
import type { MeshFormat } from '../state.ts';
import { fail } from './fail.ts';

const TYPES: Record<MeshFormat, string> = { stl: 'model/stl', obj: 'model/obj', ply: 'application/octet-stream', '3mf': 'model/3mf' };

export async function saveMesh(page: Page, mesh: Triangles, suffix: string, format: MeshFormat): Promise<void> {
  await told(page, async () => {
    const soup = await page.engine.Soup.from({ positions: placed(mesh), indices: mesh.indices });
    try {
      download(await soup.export(format), `${nameOf(page)}-${suffix}.${format}`, TYPES[format]);
    } finally {
      soup.free();
    }
  });
}

export async function saveSoup(page: Page, soup: Soup, suffix: string, format: MeshFormat): Promise<void> {
  await told(page, async () => download(await soup.export(format), `${nameOf(page)}-${suffix}.${format}`, TYPES[format]));
}

export async function saveVoxels(page: Page, voxels: Voxels, format: 'vox' | 'nrrd'): Promise<void> {
  await told(page, async () => download(await page.engine.exportVoxels(voxels, format), `${nameOf(page)}-voxels.${format}`, 'application/octet-stream'));
}

/** The model with its field, which need not be built again when it is opened. */
export async function saveField(page: Page): Promise<void> {
  const shape = page.store.state.model?.shape;
  if (shape) await told(page, async () => download(await shape.save(), `${nameOf(page)}.field`, 'application/octet-stream'));
}

/** What the check found, every list as far as it goes. */
export function saveReport(page: Page): void {
  const report = page.store.state.report?.value;
  if (!report) return;
  const text = JSON.stringify(report, (_, value: unknown) => (ArrayBuffer.isView(value) ? [...(value as Uint32Array)] : value), 1);
  download(new TextEncoder().encode(`${text}\n`), `${nameOf(page)}-check.json`, 'application/json');
}

export async function saveLayer(page: Page, layer: Layer): Promise<void> {
  await told(page, async () => {
    const svg = await page.engine.exportLayer(layer, 'svg');
    download(svg, `${nameOf(page)}-z${layer.zSample.toFixed(3)}.svg`, 'image/svg+xml');
  });
}

/** All layers of the print that is ready: as 3MF slices beside the mesh that they are of, or as one drawing where there is none. */
export async function saveLayers(page: Page): Promise<void> {
  const { model, print } = page.store.state;
  if (!model || !print) return;
  const layers = [...print.value.layers];
  await told(page, async () => {
    if (model.shape.kind === 'soup') {
      const slices = await page.engine.exportLayers(layers, '3mf', await model.shape.geometry());
      download(slices, `${nameOf(page)}-layers.3mf`, 'model/3mf');
    } else {
      download(await page.engine.exportLayers(layers, 'svg'), `${nameOf(page)}-layers.svg`, 'image/svg+xml');
    }
  });
}

/** The printer's program of the print that is ready. */
export function saveGCode(page: Page): void {
  const print = page.store.state.print?.value;
  if (print) download(print.gcode.bytes, `${nameOf(page)}.gcode`, 'text/x.gcode');
}

/** The printer's profile, to be loaded again. */
export function saveProfile({ store }: Page): void {
  const profile = store.state.recipe?.profile;
  if (!profile) return;
  const text = `${JSON.stringify(profile, null, 2)}\n`;
  download(new TextEncoder().encode(text), `${profile.name.replace(/[^\w-]+/g, '-') || 'printer'}.json`, 'application/json');
}

function nameOf({ store }: Page): string {
  return stem(store.state.model?.name ?? 'model');
}

async function told(page: Page, save: () => Promise<void>): Promise<void> {
  try {
    await save();
  } catch (error) {
    await fail(page, 'The file could not be saved', error);
  }
}
