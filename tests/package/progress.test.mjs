// Each long call tells how far it is, and stops when it is told to; its engine goes on.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { install } from './install.mjs';
import { sphere, torus } from './shapes.mjs';

const { load } = install();
const places = new Float64Array(300_000).map((_, i) => 40 * Math.sin(i));

/** A torus without some of its faces, so that fields are fractional and repairs have something to do. */
function openTorus() {
  const { positions, indices } = torus(100);
  return { positions, indices: indices.slice(3000) };
}

const ofSoups = {
  check: (soup, options) => soup.check(options),
  orient: (soup, options) => soup.orient(options),
  'repair, keeping faces': (soup, options) => soup.repair({ method: 'conserve', ...options }),
  'repair, remade': (soup, options) => soup.repair({ method: 'remesh', ...options }),
  signedDistance: (soup, options) => soup.signedDistance(places, options),
  'signedDistance on a lattice': (soup, options) => soup.signedDistance({ resolution: 96, ...options }),
  closestPoints: (soup, options) => soup.closestPoints(places, options),
  offset: (soup, options) => soup.offset({ distance: 1, resolution: 128, ...options }),
  hollow: (soup, options) => soup.hollow({ thickness: 2, resolution: 128, ...options }),
  boolean: (soup, options) => soup.boolean('union', soup, { transform: SHIFT, ...options }),
  voxelBricks: (soup, options) => soup.voxelBricks({ resolution: 256, ...options }),
  slice: (soup, options) => soup.slice({ layerHeight: 0.2, ...options }),
  surface: (soup, options) => soup.surface({ resolution: 96, ...options }),
};
const ofSmallSoups = {
  texture: (soup, options) => soup.texture({ offset: 3, ...options }),
  suggestOffset: (soup, options) => soup.suggestOffset(options),
  remap: async (soup, options) => (await soup.texture({ offset: 3, steps: 10 })).remap({ offset: 2, ...options }),
};
const ofClouds = {
  prepare: (cloud, options) => cloud.prepare(options),
  voxelize: (cloud, options) => cloud.voxelize({ resolution: 64, ...options }),
  surface: (cloud, options) => cloud.surface({ resolution: 64, ...options }),
};
const ofUnorientedClouds = {
  orient: (cloud, options) => cloud.orient(options),
  'orient by consistency': (cloud, options) => cloud.orient({ method: 'consistency', ...options }),
};
const SHIFT = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 2, 1, 1];

for (const [name, calls, shape] of [
  ['soups', ofSoups, (fw) => fw.Soup.from(openTorus())],
  ['small soups', ofSmallSoups, (fw) => fw.Soup.from(torus(40))],
  ['clouds', ofClouds, (fw) => fw.Cloud.from(sphere(20_000, 10))],
  ['clouds without normals', ofUnorientedClouds, (fw) => fw.Cloud.from({ points: sphere(20_000, 10).points })],
]) {
  test(`each long call of ${name} tells its progress, and stops when aborted`, async (t) => {
    const { init } = await load('node/index.js');
    const fw = await init({ threads: 2 });
    for (const [call, ask] of Object.entries(calls)) {
      await t.test(call, async () => {
        const made = await shape(fw);
        const controller = new AbortController();
        const asked = ask(made, { signal: controller.signal, onProgress: () => controller.abort('enough') });
        await assert.rejects(asked, { code: 'Aborted', details: { reason: 'enough' } });
        const heard = [];
        await ask(made, { onProgress: (fraction, stage) => heard.push([fraction, stage]) });
        assert.ok(heard.length > 1, 'it tells more than that it is done');
        assert.ok(heard.every(([fraction, stage]) => fraction >= 0 && fraction <= 1 && stage.length > 2), JSON.stringify(heard));
        const fractions = heard.map(([fraction]) => fraction);
        assert.deepEqual(fractions, fractions.toSorted((a, b) => a - b), `${call} goes back: ${JSON.stringify(heard)}`);
        assert.equal(fractions.at(-1), 1);
        made.free();
      });
    }
    fw.dispose();
  });
}
