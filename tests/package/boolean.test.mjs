// Booleans through the package, in both entries: boxes, a cloud, moved operands, empty results, and wrong arguments.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { install } from './install.mjs';
import { box, sphere, volume } from './shapes.mjs';

const { load } = install();
const entries = {
  'two threads': async () => (await load('node/index.js')).init({ threads: 2 }),
  'no threads': async () => (await load('node/index.js')).init({ threads: false }),
  sync: async () => (await load('node/sync.js')).init(),
};
const near = (found, expected, tolerance) =>
  assert.ok(Math.abs(found - expected) <= tolerance, `${found} is not within ${tolerance} of ${expected}`);
const shift = (x, y, z) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1];
const volumeOf = async (soup) => volume(await soup.geometry());

/** What a call that fails says; in `./sync` it throws. */
async function failure(call) {
  try {
    await call();
  } catch (error) {
    return error.code;
  }
  return undefined;
}

for (const [name, start] of Object.entries(entries)) {
  test(`${name}: booleans`, async (t) => {
    const fw = await start();
    const a = await fw.Soup.from(box(0, 2));
    const b = await fw.Soup.from(box(1, 3));

    await t.test('volumes of two boxes', async () => {
      for (const [operation, expected] of [['union', 15], ['intersection', 1], ['difference', 7]]) {
        const { soup, faces, operands, warnings } = await a.boolean(operation, b);
        near(await volumeOf(soup), expected, 1e-6);
        assert.deepEqual([faces.length, operands.length, warnings], [soup.count, soup.count, []]);
        assert.ok(faces instanceof Uint32Array && faces.every((face) => face < 12));
        assert.ok(operands instanceof Uint8Array && operands.includes(0) && operands.includes(1));
        assert.deepEqual(await soup.contains(new Float64Array([1.5, 1.5, 1.5, 0.5, 0.5, 0.5])), {
          union: new Uint8Array([1, 1]), intersection: new Uint8Array([1, 0]), difference: new Uint8Array([0, 1]),
        }[operation]);
        soup.free();
      }
    });
    await t.test('the result goes on to further booleans', async () => {
      const { soup } = await a.boolean('difference', b);
      const whole = await soup.boolean('union', b);
      near(await volumeOf(whole.soup), 15, 1e-6);
    });
    await t.test('a moved operand, also by a mirror, and a shape with itself', async () => {
      const moved = await a.boolean('intersection', a, { transform: shift(1.5, 0, 0) });
      near(await volumeOf(moved.soup), 2, 1e-6);
      const mirrored = await a.boolean('intersection', a, { transform: new Float32Array([-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1]) });
      near(await volumeOf(mirrored.soup), 4, 1e-6);
      const same = await a.boolean('union', a);
      assert.equal(same.soup.count, 12);
    });
    await t.test('nothing is left', async () => {
      const { soup, faces, warnings } = await a.boolean('intersection', b, { transform: shift(9, 9, 9) });
      assert.deepEqual([soup, faces.length, warnings.map(({ code }) => code)], [null, 0, ['empty-result']]);
    });
    await t.test('a box and a cloud', async () => {
      const cloud = await fw.Cloud.from(sphere(2000, 1));
      const { soup, operands } = await a.boolean('union', cloud);
      near(await volumeOf(soup), 8 + (7 / 8) * (4 / 3) * Math.PI, 0.2);
      assert.ok(operands.includes(1));
      const first = await cloud.boolean('difference', a);
      near(await volumeOf(first.soup), (7 / 8) * (4 / 3) * Math.PI, 0.2);
    });
    await t.test('wrong arguments', async () => {
      assert.equal(await failure(() => a.boolean('minus', b)), 'InvalidArgument');
      assert.equal(await failure(() => a.boolean('union', {})), 'InvalidArgument');
      assert.equal(await failure(() => a.boolean('union', b, { tolerance: -1 })), 'InvalidArgument');
      assert.equal(await failure(() => a.boolean('union', b, { transform: [1, 2, 3] })), 'InvalidArgument');
      assert.equal(await failure(() => a.boolean('union', b, { transform: new Array(16).fill(0) })), 'InvalidArgument');
      b.free();
      assert.equal(await failure(() => a.boolean('union', b)), 'Freed');
    });
    fw.dispose();
  });
}

test('a boolean hears of progress and can be stopped', async () => {
  const fw = await (await load('node/index.js')).init({ threads: 2 });
  const a = await fw.Soup.from(box(0, 2));
  const stages = new Set();
  await a.boolean('union', a, { transform: shift(1, 1, 1), onProgress: (fraction, stage) => stages.add(stage) });
  assert.ok(stages.size > 0);
  const stop = AbortSignal.abort();
  assert.equal(await failure(() => a.boolean('union', a, { signal: stop })), 'Aborted');
  fw.dispose();
});
