// Signed distances, nearest points, offset surfaces and hollow shapes of a box and of a cloud, in both entries.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { install } from './install.mjs';
import { boxObj, sphere, volume } from './shapes.mjs';

const { load } = install();
const entries = {
  'two threads': async () => (await load('node/index.js')).init({ threads: 2 }),
  'no threads': async () => (await load('node/index.js')).init({ threads: false }),
  sync: async () => (await load('node/sync.js')).init(),
};
const near = (found, expected, tolerance) =>
  assert.ok(Math.abs(found - expected) <= tolerance, `${found} is not within ${tolerance} of ${expected}`);
const failsWith = async (code, call) =>
  assert.rejects(async () => call(), (error) => error.name === 'WindingError' && error.code === code);

for (const [name, start] of Object.entries(entries)) {
  test(`${name}: distances`, async (t) => {
    const fw = await start();
    // From 0 to 10.
    const soup = await fw.open(boxObj());
    await t.test('at points', async () => {
      const points = new Float64Array([5, 5, 5, 5, 5, 13, 13, 14, 5, 5, 5, 10, NaN, 0, 0]);
      assert.deepEqual(await soup.signedDistance(points), new Float64Array([-5, 3, 5, 0, NaN]));
      assert.equal(points.length, 15, 'the points are still the caller’s');
      assert.deepEqual(await soup.signedDistance(new Float32Array([5, 5, 5]), { sign: 'none' }), new Float64Array([5]));
      assert.deepEqual(await soup.signedDistance(points.slice(0, 6), { band: 4 }), new Float64Array([-4, 3]));
      near((await soup.signedDistance(points.slice(3, 6), { sign: 'smooth' }))[0], 3, 1e-2);
    });
    await t.test('on a lattice', async () => {
      const found = await soup.signedDistance({ counts: [2, 3, 4], padding: 1 });
      assert.deepEqual([found.counts, found.origin, found.spacing], [[2, 3, 4], [2, 1, 0.5], [6, 4, 3]]);
      assert.ok(found.values instanceof Float32Array && found.values.length === 24);
      assert.deepEqual([...found.values.slice(0, 4)], [-0.5, -0.5, -0.5, -0.5]);
      assert.deepEqual((await soup.signedDistance({ resolution: 4 })).counts, [4, 4, 4]);
      assert.deepEqual((await soup.signedDistance({ spacing: 5, band: 1 })).values, new Float32Array(8).fill(-1));
    });
    await t.test('nearest points', async () => {
      const found = await soup.closestPoints(new Float64Array([5, 4, 13, 13, 14, 5, 11, 11, 11]));
      assert.deepEqual([...found.distances], [3, 5, Math.sqrt(3)]);
      assert.deepEqual([...found.points], [5, 4, 10, 10, 10, 5, 10, 10, 10]);
      assert.deepEqual([...found.gradients.slice(0, 6)].map((x) => Math.round(1e9 * x) / 1e9), [0, 0, 1, 0.6, 0.8, 0]);
      assert.ok(found.features[0] === 0 && [1, 2, 3].includes(found.features[1]) && found.features[2] >= 4);
      assert.deepEqual([found.faces.length, found.barycentric.length], [3, 9]);
      for (const k of [0, 1, 2]) near(found.barycentric.slice(3 * k, 3 * k + 3).reduce((a, b) => a + b), 1, 1e-15);
    });
    await t.test('offsets', async () => {
      const grown = await soup.offset({ distance: 2, resolution: 40 });
      near(volume(grown), 1000 + 600 * 2 + 30 * Math.PI * 4 + (4 / 3) * Math.PI * 8, 15);
      near(volume(await soup.offset({ distance: -2, spacing: 0.4, sharp: 35 })), 216, 0.1);
      await failsWith('EmptyResult', () => soup.offset({ distance: -6 }));
      await failsWith('InvalidArgument', () => soup.offset({ distance: Infinity }));
      await failsWith('InvalidArgument', () => soup.signedDistance({ band: 0 }));
    });
    await t.test('hollow', async () => {
      const options = { thickness: 2, spacing: 0.5, sharp: 35 };
      near(volume(await soup.hollow(options)), 1000 - 216, 1);
      const drained = await soup.hollow({ ...options, drains: [{ at: [5, 5, 12], direction: [0, 0, -1], radius: 1 }] });
      near(volume(drained), 1000 - 216 - 2 * Math.PI, 1.5);
      await failsWith('EmptyResult', () => soup.hollow({ thickness: 6 }));
      await failsWith('InvalidArgument', () => soup.hollow({ ...options, drains: [{ at: [5, 5, 12], direction: [0, 0, 1], radius: 1 }] }));
    });
    await t.test('of a cloud', async () => {
      const { points, normals } = sphere(500, 3);
      const cloud = await fw.Cloud.from({ points, normals });
      const [inside, outside] = await cloud.signedDistance(new Float64Array([0, 0, 0, 0, 0, 8]));
      near(inside, -3, 1e-6);
      near(outside, 5, 0.1);
      assert.ok(volume(await cloud.offset({ distance: 1, spacing: 0.25 })) > (4 / 3) * Math.PI * 3.8 ** 3);
      cloud.free();
    });
    soup.free();
    fw.dispose();
  });
}
