// Makes the pictures of docs/pictures from the package: all, or those named. `npm --prefix www run pictures [NAME...]`
import { mkdirSync, writeFileSync } from 'node:fs';
import { init } from '../../pkg/dist/node/sync.js';
import * as engine from './engine.mjs';
import * as planes from './planes.mjs';
import * as solids from './solids.mjs';

const folder = new URL('../pictures/', import.meta.url);
const PICTURES = {
  'winding.svg': planes.winding, 'distances.svg': planes.distances, 'offsets.svg': planes.offsets, 'prints.svg': planes.prints,
  'clouds.png': solids.clouds, 'voxels.png': solids.voxels, 'surfaces.png': solids.surfaces, 'repairs.png': solids.repairs,
  'orientation.png': solids.orientation, 'booleans.png': solids.booleans, 'textures.png': solids.textures, 'interop.png': solids.interop,
  'crossings.svg': engine.crossings, 'hierarchy.svg': engine.hierarchy, 'expansion.svg': engine.expansion, 'threads.svg': engine.threads,
  'parts.svg': engine.parts,
};

const wanted = process.argv.slice(2);
const fw = await init();
mkdirSync(folder, { recursive: true });
for (const [name, make] of Object.entries(PICTURES)) {
  if (wanted.length > 0 && !wanted.some((word) => name.startsWith(word))) continue;
  const picture = make(fw);
  writeFileSync(new URL(name, folder), picture);
  console.log(`${name}  ${(picture.length / 1024).toFixed(0)} KiB`);
}
