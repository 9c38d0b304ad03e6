// Each call as the first of an engine: what it needs of the part of the WebAssembly that comes later has to come by itself.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { install } from './install.mjs';
import { box, boxObj, sphere } from './shapes.mjs';

const { load } = install();
const center = new Float64Array([5, 5, 5]);

/** An open box: it has caps, and something to repair. */
function openBox() {
  const { positions, indices } = box(0, 10);
  return { positions, indices: indices.slice(6) };
}

const ofSoups = {
  prepare: (soup) => soup.prepare(),
  windingNumbers: (soup) => soup.windingNumbers(center),
  contains: (soup) => soup.contains(center),
  voxelize: (soup) => soup.voxelize({ resolution: 8 }),
  'voxelize by rays, with a surface': (soup) => soup.voxelize({ resolution: 8, method: 'rays', surface: true }),
  voxelBricks: (soup) => soup.voxelBricks({ resolution: 8 }),
  heatMap: (soup) => soup.heatMap({ z: 5, resolution: 8 }),
  slice: (soup) => soup.slice({ layerHeight: 2 }),
  surface: (soup) => soup.surface({ resolution: 8 }),
  signedDistance: (soup) => soup.signedDistance(center),
  closestPoints: (soup) => soup.closestPoints(center),
  offset: (soup) => soup.offset({ distance: 1, resolution: 16 }),
  check: (soup) => soup.check(),
  orient: (soup) => soup.orient(),
  repair: (soup) => soup.repair(),
  boolean: (soup) => soup.boolean('union', soup),
  texture: (soup) => soup.texture({ offset: 2, resolution: 10, steps: 20 }),
  suggestOffset: (soup) => soup.suggestOffset(),
  project: (soup) => soup.project(),
  boundaryEdges: (soup) => soup.boundaryEdges(),
  toCloud: (soup) => soup.toCloud(),
  geometry: (soup) => soup.geometry(),
  save: (soup) => soup.save(),
  'export as stl': (soup) => soup.export('stl'),
  'export as 3mf': (soup) => soup.export('3mf'),
};
const ofClouds = {
  prepare: (cloud) => cloud.prepare(),
  contains: (cloud) => cloud.contains(center),
  orient: (cloud) => cloud.orient(),
  surface: (cloud) => cloud.surface({ resolution: 8 }),
};
const ofFiles = {
  'open an OBJ file': (fw) => fw.open(boxObj()),
  'open a 3MF file': async (fw, { archive }) => fw.open(archive),
  'open a saved field': async (fw, { saved }) => fw.open(saved),
};

test('each call works as the first of its engine', async () => {
  const { init } = await load('node/index.js');
  /** What `ask` answers to an engine that nothing was asked before. */
  const first = async (ask) => {
    const fw = await init({ threads: false });
    try {
      return await ask(fw);
    } finally {
      fw.dispose();
    }
  };
  const files = await first(async (fw) => {
    const soup = await fw.Soup.from(openBox());
    return { archive: await soup.export('3mf'), saved: await soup.save() };
  });
  const calls = [
    ...Object.entries(ofSoups).map(([name, ask]) => [`soup: ${name}`, async (fw) => ask(await fw.Soup.from(openBox()))]),
    ...Object.entries(ofClouds).map(([name, ask]) => [`cloud: ${name}`, async (fw) => ask(await fw.Cloud.from(sphere(400, 5)))]),
    ...Object.entries(ofFiles).map(([name, ask]) => [name, (fw) => ask(fw, files)]),
  ];
  const failed = [];
  for (const [name, ask] of calls) await first(ask).catch((error) => failed.push(`${name}: ${error.code} ${error.message}`));
  assert.deepEqual(failed, []);
});
