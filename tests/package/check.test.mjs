// Checks and turned faces, in both entries: `.` with two threads and with none, and `./sync`.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { install } from './install.mjs';
import { box } from './shapes.mjs';

const { load } = install();
const entries = {
  'two threads': async () => (await load('node/index.js')).init({ threads: 2 }),
  'no threads': async () => (await load('node/index.js')).init({ threads: false }),
  sync: async () => (await load('node/sync.js')).init(),
};

/** A box of 10 mm without its first triangle, and with another one turned: number 7 of those left. */
function broken() {
  const { positions, indices } = box(0, 10);
  const some = indices.slice(3);
  some.set([some[23], some[22]], 22);
  return { positions, indices: some };
}

for (const [name, start] of Object.entries(entries)) {
  test(`${name}: a check`, async () => {
    const fw = await start();
    const whole = await fw.Soup.from(box(0, 10));
    const clean = await whole.check({ bed: [20, 20, 20] });
    assert.deepEqual([clean.verdict.rating, clean.genus, clean.bed.fits], ['clean', 0, true]);
    assert.deepEqual([clean.triangles, clean.vertices, clean.edges], [12, 8, 18]);
    assert.ok(Math.abs(clean.thickness.minimum - 10) < 1e-9 && Math.abs(clean.field.solidVolume - 1000) < 1e-8);
    assert.deepEqual(clean.selfIntersections, { count: 0, list: new Uint32Array(0) });

    const soup = await fw.Soup.from(broken());
    const report = await soup.check();
    assert.deepEqual([report.boundary.loops.count, report.boundary.loops.list[0].vertices.constructor], [1, Uint32Array]);
    assert.deepEqual(report.flippedFaces, { count: 1, list: new Uint32Array([7]) });
    assert.deepEqual([report.inconsistentEdges.count, report.inconsistentEdges.list.length], [3, 6]);
    assert.equal(report.verdict.reasons[0].kind, 'flippedFaces');
    assert.deepEqual((await soup.check({ limit: 1 })).inconsistentEdges.list.length, 2);

    const before = await soup.geometry();
    const { flipped, patches, closedPatches, method } = await soup.orient();
    assert.deepEqual([flipped, patches, closedPatches], [new Uint32Array([7]), 1, 0]);
    assert.match(method, /rays/);
    assert.deepEqual((await soup.check()).flippedFaces.count, 0);
    assert.notDeepEqual(await soup.geometry(), before);
    assert.deepEqual(await soup.contains(new Float64Array([5, 5, 5])), new Uint8Array([1]));
    assert.deepEqual((await soup.orient({ method: 'visibility', rays: 16 })).flipped, new Uint32Array(0));

    const less = await soup.check({ thickness: false, selfIntersections: false, resolution: 0 });
    assert.deepEqual([less.thickness, less.selfIntersections, less.field, less.triangles], [undefined, undefined, undefined, 11]);

    await assert.rejects(async () => soup.check({ overhangAngle: 91 }), { code: 'InvalidArgument', message: /overhangAngle is 91/ });
    await assert.rejects(async () => soup.check({ samplez: 1 }), { code: 'InvalidArgument', message: /samplez/ });
    await assert.rejects(async () => soup.orient({ method: 'magic' }), { code: 'InvalidArgument' });
    fw.dispose?.();
  });
}
