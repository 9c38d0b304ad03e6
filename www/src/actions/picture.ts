import { download, stem } from '../download.ts';
import { glbOf } from '../glb.ts';
import type { Page } from '../page.ts';
import { checker, encoded, readPicture } from '../picture.ts';
import { fail } from './fail.ts';

export const TEXTURE_FORMATS = { glb: 'GLB', zip: 'OBJ + MTL' } as const;
export type TextureFormat = keyof typeof TEXTURE_FORMATS;

/** Takes an image for the texture; what is none is told. */
export async function takePicture(page: Page, file: File): Promise<void> {
  const { store } = page;
  store.set({ problem: undefined });
  try {
    store.set({ picture: await readPicture(file) });
  } catch {
    store.set({ problem: { title: `${file.name} is no picture`, detail: 'Choose an image that the browser can show: PNG, JPEG, WebP …' } });
  }
}

/** Saves the model with its texture and the picture. */
export async function saveTexture(page: Page, format: TextureFormat): Promise<void> {
  const { model, texture } = page.store.state;
  if (!model || !texture) return;
  const name = `${stem(model.name)}-textured`;
  try {
    const picture = await encoded(page.store.state.picture ?? checker());
    if (format === 'glb') return download(await glbOf(texture.value.soup, picture, name), `${name}.glb`, 'model/gltf-binary');
    const { obj, mtl } = await texture.value.handle.export('obj', { name, image: `${name}.${picture.extension}` });
    const { zipSync } = await import('three/examples/jsm/libs/fflate.module.js');
    const files = { [`${name}.obj`]: obj, [`${name}.mtl`]: mtl, [`${name}.${picture.extension}`]: picture.bytes };
    download(zipSync(files), `${name}.zip`, 'application/zip');
  } catch (error) {
    await fail(page, 'The file could not be saved', error);
  }
}
