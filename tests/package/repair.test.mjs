// Repair in both entries: a shape of its own, what was changed, checks before and after.
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

/** A box of 10 mm without its first two triangles. */
function openBox() {
  const { positions, indices } = box(0, 10);
  return { positions, indices: indices.slice(6) };
}

for (const [name, start] of Object.entries(entries)) {
  test(`${name}: an open box is closed with its own triangles`, async () => {
    const fw = await start();
    const open = await fw.Soup.from(openBox());
    const { soup, report, sources, before, after } = await open.repair();
    assert.deepEqual([soup.kind, soup.count, report.method, report.holes, report.closed], ['soup', 12, 'conserve', 1, true]);
    assert.deepEqual([...sources], [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 4294967295, 4294967295]);
    assert.deepEqual([before.boundary.loops.count, after.boundary.loops.count], [1, 0]);
    near(report.volume, 1000, 1e-9);
    near(volume(await soup.geometry()), 1000, 1e-3);
    open.free();
    assert.deepEqual(await soup.contains(new Float64Array([5, 5, 5, 5, 5, 11])), new Uint8Array([1, 0]));
    soup.free();
    fw.dispose();
  });

  test(`${name}: boxes that overlap are united, or made anew`, async () => {
    const fw = await start();
    const [one, other] = [box(0, 10), box(5, 15)];
    const positions = new Float64Array([...one.positions, ...other.positions]);
    const indices = new Uint32Array([...one.indices, ...other.indices.map((v) => v + 8)]);
    const both = await fw.Soup.from({ positions, indices });
    const united = await both.repair({ check: false });
    near(united.report.volume, 1875, 1e-9);
    assert.deepEqual([united.before, united.after], [undefined, undefined]);
    const anew = await both.repair({ method: 'remesh', resolution: 30, check: false });
    assert.deepEqual([anew.report.method, anew.sources.length], ['remesh', 0]);
    near(anew.report.volume, 1875, 20);
    assert.equal(anew.soup.count, anew.report.new);
    fw.dispose();
  });

  test(`${name}: a cloud is remeshed, and what cannot be is said`, async () => {
    const fw = await start();
    const cloud = await fw.Cloud.from(sphere(2000, 10));
    const { soup, report, before, after } = await cloud.repair();
    assert.equal(before, undefined);
    assert.equal(after.boundary.loops.count, 0);
    near(report.volume / ((4 / 3) * Math.PI * 1000), 1, 0.02);
    assert.equal(soup.kind, 'soup');
    const fails = async (call, code) => {
      try {
        await call();
      } catch (error) {
        return assert.equal(error.code, code);
      }
      assert.fail(`no ${code}`);
    };
    await fails(() => cloud.repair({ method: 'conserve' }), 'InvalidArgument');
    const sheet = await fw.Soup.from({ positions: new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0]) });
    await fails(() => sheet.repair({ fallback: false }), 'EmptyInput');
    await fails(() => sheet.repair({ tolerance: -1 }), 'InvalidArgument');
    fw.dispose();
  });
}
