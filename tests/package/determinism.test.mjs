// The same input gives the same bits, whatever the number of threads, and in both entries.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { test } from 'node:test';
import { install } from './install.mjs';
import { sphere, torus } from './shapes.mjs';

const { load } = install();
const { init } = await load('node/index.js');
const sync = await load('node/sync.js');
const engines = {
  'one thread': () => init({ threads: 1 }),
  'two threads': () => init({ threads: 2 }),
  'no threads': () => init({ threads: false }),
  sync: () => sync.init(),
};

const SHIFT = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 2, 1, 1];

/** Digests of every result that holds floats or classifications. */
async function digests(fw) {
  const digest = (...arrays) => {
    const hash = createHash('sha256');
    for (const a of arrays) hash.update(new Uint8Array(a.buffer, a.byteOffset, a.byteLength));
    return hash.digest('hex');
  };
  const { positions, indices } = torus(60);
  const soup = await fw.Soup.from({ positions, indices: indices.subarray(0, indices.length - 600) });
  const { points } = sphere(3000, 10);
  const cloud = await fw.Cloud.from({ points }, { orient: 'auto' });
  const queries = positions.map((x, i) => x * (0.9 + 0.01 * (i % 7)));
  const results = {};
  for (const [kind, shape] of Object.entries({ soup, cloud })) {
    results[`${kind}: fast`] = digest(await shape.windingNumbers(queries));
    results[`${kind}: exact`] = digest(await shape.windingNumbers(queries.subarray(0, 300), { tolerance: 0 }));
    results[`${kind}: voxels`] = digest((await shape.voxelize({ resolution: 40 })).inside);
    const layers = await shape.slice({ layerHeight: 1 });
    results[`${kind}: layers`] = digest(...layers.flatMap((l) => l.polygons.flatMap((p) => [p.outer, ...p.holes])));
    const mesh = await shape.surface({ resolution: 24 });
    results[`${kind}: surface`] = digest(mesh.positions, mesh.normals, mesh.indices);
    results[`${kind}: distances`] = digest(await shape.signedDistance(queries));
    const grown = await shape.offset({ distance: 2, resolution: 32 });
    results[`${kind}: offset`] = digest(grown.positions, grown.indices);
    const remade = await (await shape.repair({ method: 'remesh', resolution: 32, check: false })).soup.geometry();
    results[`${kind}: remade`] = digest(remade.positions, remade.indices);
  }
  for (const [name, other] of Object.entries({ soup, cloud })) {
    const joined = await soup.boolean('union', other, { transform: SHIFT, resolution: 24 });
    const { positions: places, indices: corners } = await joined.soup.geometry();
    results[`union of soup and ${name}`] = digest(places, corners, joined.faces, joined.operands);
  }
  const kept = await (await soup.repair({ check: false })).soup.geometry();
  results['repaired'] = digest(kept.positions, kept.indices);
  results['checked'] = digest(new TextEncoder().encode(JSON.stringify(await soup.check())));
  results['oriented'] = digest((await soup.orient()).flipped);
  const texture = await (await fw.Soup.from(torus(24))).texture({ offset: 3, resolution: 40 });
  const [textured, proxy, lines] = [await texture.geometry(), await texture.proxy(), await texture.lines()];
  results['texture'] = digest(textured.uvs, textured.charts, proxy.positions, proxy.uvs, proxy.seams, lines.points);
  const { normals, areas } = await cloud.geometry();
  results['estimates'] = digest(normals, areas);
  return results;
}

test('any number of threads gives the same bits', async () => {
  const all = {};
  for (const [name, start] of Object.entries(engines)) {
    const fw = await start();
    all[name] = await digests(fw);
    fw.dispose();
  }
  for (const name of Object.keys(engines)) assert.deepEqual(all[name], all['one thread'], name);
});
