import type { Mesh } from 'fast-winding';
import { download, stem } from '../download.ts';
import type { Page } from '../page.ts';
import { fail } from './fail.ts';

export async function saveMesh(page: Page, mesh: Mesh, suffix: string): Promise<void> {
  await told(page, async () => {
    const soup = await page.engine.Soup.from({ positions: placed(mesh), indices: mesh.indices });
    try {
      download(await soup.export('stl'), `${nameOf(page)}-${suffix}.stl`, 'model/stl');
    } finally {
      soup.free();
    }
  });
}

export async function saveLayer(page: Page): Promise<void> {
  const layer = page.store.state.layer?.value;
  if (!layer) return;
  await told(page, async () => {
    const svg = await page.engine.exportLayer(layer, 'svg');
    download(svg, `${nameOf(page)}-z${layer.zSample.toFixed(3)}.svg`, 'image/svg+xml');
  });
}

/** Positions with the mesh's origin added, in double precision. */
function placed({ positions, origin }: Mesh): Float64Array {
  return Float64Array.from(positions, (value, i) => value + origin[i % 3]);
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
