// What surrounds the calls: starting, errors, abort, progress, freeing.
import assert from 'node:assert/strict';
import { cpSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { install } from './install.mjs';
import { box, boxObj, sphere, torus } from './shapes.mjs';

const { home, load } = install();
const { init, WindingError } = await load('node/index.js');
const sync = await load('node/sync.js');
const LONG = { resolution: 500, threshold: 0.25 };

test('init is idempotent, and says what runs', async () => {
  const fw = await init({ threads: 2 });
  assert.equal(await init({ threads: 2 }), fw);
  assert.deepEqual([fw.info.threads, fw.info.simd, fw.info.version], [2, true, '0.1.0']);
  assert.match(fw.info.reason, /^2 threads/);
  const single = await init({ threads: false });
  assert.notEqual(single, fw);
  assert.equal(single.info.threads, 0);
  assert.match(single.info.reason, /^single-threaded: as asked/);
  fw.dispose();
  const next = await init({ threads: 2 });
  assert.notEqual(next, fw);
  await assert.rejects(fw.open(boxObj()), { code: 'Freed' });
  single.dispose();
  next.dispose();
  await assert.rejects(init({ threads: 1.5 }), { code: 'InvalidArgument' });
  await assert.rejects(init({ threads: 2, signal: AbortSignal.abort() }), { code: 'Aborted' });
  (await init({ threads: 2 })).dispose();
  await assert.rejects(init({ threads: false, wasmUrl: 'file:///nowhere/' }), (error) => error instanceof WindingError);
});

const entries = {
  worker: () => init({ threads: 2 }),
  sync: () => sync.init(),
};
for (const [name, start] of Object.entries(entries)) {
  test(`${name}: errors have codes and details`, async () => {
    const fw = await start();
    const fails = (action, code, details = {}) =>
      assert.rejects(async () => action(), (error) => {
        assert.ok(error instanceof Error && error.name === 'WindingError', String(error));
        assert.deepEqual([error.code, { ...error.details, ...details }], [code, error.details]);
        assert.ok(error.message.length > 10);
        return true;
      });
    const text = (string) => new TextEncoder().encode(string);
    await fails(() => fw.open(text('v 0 0 0\nv 1 oops 0\nf 1 1 1\n')), 'ParseError', { format: 'OBJ', line: 2 });
    await fails(() => fw.open(new Uint8Array(0)), 'EmptyInput');
    await fails(() => fw.open(text('%PDF-1.7 no geometry')), 'UnknownFormat');
    await fails(() => fw.open(boxObj(), { unit: 'parsec' }), 'InvalidArgument');
    await fails(() => fw.Cloud.parse(boxObj()), 'InvalidArgument');
    const { positions, indices } = box(0, 1);
    const spoiled = positions.map((x, i) => (i === 4 ? NaN : x));
    const dented = await fw.Soup.from({ positions: spoiled, indices });
    const uses = indices.filter((index) => index === 1).length;
    assert.deepEqual([dented.count, dented.warnings[0].code, dented.warnings[0].count], [12 - uses, 'non-finite-faces', uses]);
    await fails(() => fw.Soup.from({ positions: spoiled, indices: new Uint32Array([0, 1, 2]) }), 'NonFiniteVertex', { vertex: 1 });
    await fails(() => fw.Soup.from({ positions, indices: new Uint32Array([0, 1, 9]) }), 'IndexOutOfRange', { index: 9, vertices: 8 });
    await fails(() => fw.Soup.from({ positions: new Float32Array(0) }), 'EmptyInput');
    await fails(() => fw.Soup.from({ positions: new Float32Array(8) }), 'InvalidArgument');
    await fails(() => fw.Soup.from({ positions: [1, 2, 3] }), 'InvalidArgument');
    const soup = await fw.Soup.from({ positions, indices });
    await fails(() => soup.windingNumbers(new Float64Array(4)), 'InvalidArgument');
    await fails(() => soup.windingNumbers(new Float64Array(3), { order: 3 }), 'InvalidArgument');
    await fails(() => soup.windingNumbers(new Float64Array(3), { tolerance: -1 }), 'InvalidArgument');
    await fails(() => soup.voxelize({ resolution: 2, spacing: 1 }), 'InvalidArgument');
    await fails(() => soup.voxelize({ resolution: 1.5 }), 'InvalidArgument');
    await fails(() => soup.slice({ layerHeight: 0 }), 'InvalidArgument');
    await fails(() => soup.heatMap({ z: NaN }), 'InvalidArgument');
    await fails(() => soup.export('docx'), 'InvalidArgument');
    await fails(() => soup.voxelize({ resolution: 100000 }), 'OutOfMemory');
    await fails(() => soup.voxelize({ counts: [100000, 100000, 100000], format: 'bits' }), 'OutOfMemory', { bytes: 1e15 });
    await fails(() => soup.surface({ resolution: 100000 }), 'OutOfMemory');
    await fails(() => soup.heatMap({ z: 0.5, resolution: 1e6 }), 'OutOfMemory');
    assert.deepEqual(await soup.contains(new Float64Array([0.5, 0.5, 0.5])), new Uint8Array([1]), 'the engine goes on');
    fw.dispose();
  });

  test(`${name}: without the part of the WebAssembly that is loaded later, only what needs it fails`, async () => {
    const folder = mkdtempSync(join(tmpdir(), 'fast-winding-wasm-'));
    for (const build of ['threads', 'single']) {
      const file = `${build}/fast_winding_bg.wasm`;
      cpSync(join(home, 'dist', file), join(folder, file));
    }
    const fw = await (name === 'sync' ? sync.init : init)({ wasmUrl: pathToFileURL(folder).href, threads: 2 });
    const { points } = sphere(500, 1);
    const cloud = await fw.Cloud.from({ points });
    const fails = (action) =>
      assert.rejects(async () => action(), (error) => {
        assert.deepEqual([error.code, error.name], ['LoadFailed', 'WindingError']);
        assert.match(error.message, /for normals, surfaces and layers could not be loaded: .*fast_winding_more\.wasm/);
        return true;
      });
    await fails(() => cloud.orient());
    await fails(() => cloud.orient());
    await fails(() => cloud.noise());
    await fails(() => fw.Cloud.from({ points }, { orient: 'auto' }));
    assert.equal((await cloud.geometry()).positions.length, points.length);
    const soup = await fw.Soup.from(box(0, 1));
    assert.deepEqual([...(await soup.contains(new Float64Array([0.5, 0.5, 0.5])))], [1]);
    await fails(() => soup.surface({ resolution: 4 }));
    if (name === 'worker') {
      cpSync(join(home, 'dist/threads/fast_winding_more.wasm'), join(folder, 'threads/fast_winding_more.wasm'));
      await cloud.orient();
      assert.ok(cloud.hasNormals, 'it is loaded as soon as it is there');
    }
    fw.dispose();
    rmSync(folder, { recursive: true });
  });

  test(`${name}: freed shapes say so`, async () => {
    const fw = await start();
    const soup = await fw.open(boxObj());
    soup.free();
    soup.free();
    await assert.rejects(async () => soup.contains(new Float64Array(3)), { code: 'Freed' });
    assert.equal(soup.count, 12, 'what was known of it still is');
    const other = await fw.open(boxObj());
    other[Symbol.dispose]();
    await assert.rejects(async () => other.prepare(), { code: 'Freed' });
    fw.dispose();
  });

  test(`${name}: progress rises to 1 and names its stage`, async () => {
    const fw = await start();
    const soup = await fw.Soup.from(torus(60));
    const heard = [];
    await soup.voxelize({ resolution: 120, onProgress: (fraction, stage) => heard.push([fraction, stage]) });
    const fractions = heard.map(([fraction]) => fraction);
    assert.ok(heard.length > 1 && heard.every(([, stage]) => stage === 'voxels'), JSON.stringify(heard));
    assert.deepEqual(fractions, fractions.toSorted((a, b) => a - b));
    assert.equal(fractions.at(-1), 1);
    fw.dispose();
  });
}

test('what a progress function throws comes out of the call', async () => {
  const fw = await sync.init();
  const soup = await fw.Soup.from(torus(60));
  const mine = new Error('mine');
  assert.throws(() => soup.voxelize({ resolution: 100, onProgress: () => { throw mine; } }), mine);
  assert.equal(soup.voxelize({ resolution: 4 }).inside.length > 0, true);
  fw.dispose();
});

test('an option that is undefined is one that is not given', async () => {
  const fw = await init({ threads: false });
  const soup = await fw.open(boxObj());
  const { patches } = await soup.orient({ method: undefined });
  const { inside } = await soup.voxelize({ resolution: 4, method: undefined, threshold: undefined });
  assert.deepEqual([patches, inside.length > 0], [1, true]);
  fw.dispose();
});

test('inputs stay the caller’s unless handed over', async () => {
  const fw = await init({ threads: 2 });
  const kept = boxObj();
  await fw.open(kept);
  assert.ok(kept.length > 0);
  const given = boxObj();
  const soup = await fw.open(given, { transfer: true });
  assert.deepEqual([given.length, soup.count], [0, 12]);
  assert.equal((await fw.open(boxObj().buffer)).count, 12, 'an ArrayBuffer will do');
  assert.equal((await fw.open(Buffer.from(boxObj()))).count, 12, 'so will a Buffer, which shares its memory');
  fw.dispose();
});

test('with threads an abort takes effect within 100 ms, and the engine goes on', async () => {
  const fw = await init({ threads: 2 });
  const soup = await fw.Cloud.from(sphere(5000, 1));
  const latencies = [];
  for (let attempt = 0; attempt < 5; attempt++) {
    const controller = new AbortController();
    const call = soup.voxelize({ ...LONG, signal: controller.signal });
    await new Promise((resolve) => setTimeout(resolve, 150));
    const start = performance.now();
    controller.abort('enough');
    await assert.rejects(call, { code: 'Aborted', details: { reason: 'enough' } });
    latencies.push(performance.now() - start);
  }
  assert.ok(latencies.sort((a, b) => a - b)[2] < 100, `median of ${latencies}`);
  assert.deepEqual([(await soup.contains(new Float64Array([0.3, 0, 0])))[0], fw.info.memory], [1, 0]);
  fw.dispose();
});

test('without threads an abort replaces the worker, and shapes live on', async () => {
  const fw = await init({ threads: false });
  const soup = await fw.Cloud.from(sphere(5000, 1));
  const freed = await fw.open(boxObj());
  freed.free();
  const { points } = sphere(500, 10);
  const cloud = await fw.Cloud.from({ points });
  await cloud.orient();
  assert.equal(fw.info.memory, 5000 * 6 * 8 + points.byteLength);
  const controller = new AbortController();
  const long = soup.voxelize({ ...LONG, signal: controller.signal });
  const waiting = soup.contains(new Float64Array([0.3, 0, 0]));
  setTimeout(() => controller.abort(), 100);
  await assert.rejects(long, { code: 'Aborted' });
  assert.deepEqual(await waiting, new Uint8Array([1]), 'a call that waited is answered');
  assert.deepEqual(await cloud.contains(new Float64Array([0, 0, 0])), new Uint8Array([1]), 'the cloud is oriented still');
  fw.dispose();
});

test('calls that wait can be withdrawn, and a call aborted beforehand never starts', async () => {
  const fw = await init({ threads: 2 });
  const soup = await fw.Cloud.from(sphere(5000, 1));
  const controller = new AbortController();
  const first = soup.voxelize({ resolution: 100 });
  const second = soup.voxelize({ resolution: 100, signal: controller.signal });
  controller.abort();
  await assert.rejects(second, { code: 'Aborted' });
  assert.equal((await first).counts[0], 100);
  await assert.rejects(soup.prepare({ signal: AbortSignal.abort() }), { code: 'Aborted' });
  fw.dispose();
});

test('disposing rejects the calls that run', async () => {
  const fw = await init({ threads: 2 });
  const soup = await fw.Cloud.from(sphere(5000, 1));
  const call = soup.voxelize(LONG);
  fw.dispose();
  await assert.rejects(call, { code: 'Freed' });
});
