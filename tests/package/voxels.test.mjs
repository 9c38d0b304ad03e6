// Voxels by all methods, in bricks, compared, drawn and written; fields saved and loaded. In all entries.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { gunzipSync } from 'node:zlib';
import { install } from './install.mjs';
import { box, boxObj, sphere, torus, volume } from './shapes.mjs';

const { load } = install();
const entries = {
  'two threads': async () => (await load('node/index.js')).init({ threads: 2 }),
  'no threads': async () => (await load('node/index.js')).init({ threads: false }),
  sync: async () => (await load('node/sync.js')).init(),
};

async function fails(call, code) {
  await assert.rejects(async () => call(), (error) => error.name === 'WindingError' && error.code === code, `${code} was expected`);
}

/** Whether voxel (i, j, k) of bricks is inside. */
function inBricks({ counts, bricks }, [i, j, k]) {
  const [nx, ny] = counts.map((n) => Math.ceil(n / 8));
  const place = ((k >> 3) * ny + (j >> 3)) * nx + (i >> 3);
  const at = bricks.mixed.indexOf(place);
  if (at < 0) return bricks.full.includes(place);
  return (bricks.bits[64 * at + 8 * (k & 7) + (j & 7)] >> (i & 7)) & 1;
}

for (const [name, start] of Object.entries(entries)) {
  test(`${name}: voxels`, async (t) => {
    const fw = await start();
    const soup = await fw.Soup.from(torus(40));
    const exact = await soup.voxelize({ resolution: 30 });
    const [nx, ny, nz] = exact.counts;

    await t.test('methods', async () => {
      assert.deepEqual((await soup.voxelize({ resolution: 30, method: 'exact' })).inside, exact.inside);
      for (const rays of [{}, { count: 'signed' }, { majority: true }]) {
        const found = await soup.voxelize({ resolution: 30, method: 'rays', rays });
        assert.deepEqual(found.inside, exact.inside, 'a closed surface has no ambiguous rays');
      }
      for (const options of [{ method: 'fast' }, { method: 'fast', order: 1, beta: 3 }, { method: 'cloud' }, { method: 'cloud', points: 'barycentres' }]) {
        const found = await soup.voxelize({ resolution: 30, ...options });
        const { count, intersectionOverUnion } = await fw.compareVoxels(exact, found);
        assert.ok(intersectionOverUnion > 0.9 && count < 0.1 * exact.count, `${JSON.stringify(options)}: ${count}`);
      }
      await fails(() => soup.voxelize({ method: 'guess' }), 'InvalidArgument');
      await fails(() => soup.voxelize({ method: 'fast', beta: -1 }), 'InvalidArgument');
      const cloud = await fw.Cloud.from(sphere(500, 10));
      await fails(() => cloud.voxelize({ resolution: 8, method: 'rays' }), 'InvalidArgument');
    });
    await t.test('bricks', async () => {
      for (const method of ['lattice', 'continuation']) {
        const bricks = await soup.voxelBricks({ resolution: 30, method, surface: true });
        assert.deepEqual([bricks.counts, bricks.count, bricks.volume], [exact.counts, exact.count, exact.volume]);
        for (let index = 0; index < exact.inside.length; index += 7) {
          const at = [index % nx, Math.floor(index / nx) % ny, Math.floor(index / (nx * ny))];
          assert.equal(Boolean(inBricks(bricks, at)), exact.inside[index] === 1);
        }
        assert.equal((await fw.compareVoxels(bricks, exact)).count, 0);
        const surface = await fw.voxelSurface(bricks);
        assert.deepEqual(surface.indices, (await fw.voxelSurface(exact)).indices);
        assert.deepEqual(surface.positions, bricks.surface.positions);
        assert.ok(Math.abs(volume(surface) / exact.volume - 1) < 1e-4);
      }
    });
    await t.test('differences', async () => {
      const other = { ...exact, inside: exact.inside.slice() };
      const inside = exact.inside.indexOf(1);
      other.inside[inside] = 0;
      other.inside[0] = 1;
      const { lost, gained, count, intersectionOverUnion } = await fw.compareVoxels(exact, other);
      assert.deepEqual([lost, gained, count], [new Uint32Array([inside]), new Uint32Array([0]), 2]);
      assert.equal(intersectionOverUnion, (exact.count - 1) / (exact.count + 1));
      await fails(() => fw.compareVoxels(exact, { ...other, spacing: [1, 1, 1] }), 'InvalidArgument');
      await fails(() => fw.compareVoxels(exact, { ...other, inside: new Uint8Array(3) }), 'InvalidArgument');
      await fails(() => fw.compareVoxels(exact, 'voxels'), 'InvalidArgument');
    });
    await t.test('files', async () => {
      const bits = await soup.voxelize({ resolution: 30, format: 'bits' });
      for (const voxels of [exact, bits, await soup.voxelBricks({ resolution: 30 })]) {
        for (const raw of [false, true]) {
          const nrrd = Buffer.from(await fw.exportVoxels(voxels, 'nrrd', { raw }));
          const end = nrrd.indexOf('\n\n');
          const header = nrrd.subarray(0, end).toString();
          assert.ok(header.startsWith('NRRD000') && header.includes(`sizes: ${nx} ${ny} ${nz}\n`), header);
          const data = nrrd.subarray(end + 2);
          assert.deepEqual(new Uint8Array(raw ? data : gunzipSync(data)), exact.inside);
        }
        const vox = Buffer.from(await fw.exportVoxels(voxels, 'vox', { solid: true }));
        assert.equal(vox.subarray(0, 4).toString(), 'VOX ');
        const at = vox.indexOf('XYZI');
        assert.equal(vox.readInt32LE(at + 12), exact.count);
        const shell = Buffer.from(await fw.exportVoxels(voxels, 'vox'));
        assert.ok(shell.length < vox.length);
      }
      await fails(() => fw.exportVoxels(exact, 'png'), 'InvalidArgument');
    });
    fw.dispose();
  });

  test(`${name}: saved fields`, async () => {
    const fw = await start();
    const points = new Float64Array([5, 5, 5, 5, 5, 50, 1, 2, 3, 0.1, -3, 2]);
    const open = box(0, 10);
    const shapes = [
      await fw.open(boxObj()),
      await fw.Soup.from({ ...open, indices: open.indices.subarray(3) }),
      await fw.Cloud.from(sphere(900, 10)),
    ];
    for (const shape of shapes) {
      const bytes = await shape.save();
      for (const loaded of [await fw.open(bytes), await fw.load(bytes)]) {
        assert.deepEqual([loaded.kind, loaded.format, loaded.count], [shape.kind, 'field', shape.count]);
        assert.deepEqual(loaded.bounds, shape.bounds);
        assert.deepEqual(await loaded.save(), bytes);
        assert.deepEqual(await loaded.windingNumbers(points), await shape.windingNumbers(points));
        assert.deepEqual((await loaded.voxelize({ resolution: 12 })).inside, (await shape.voxelize({ resolution: 12 })).inside);
        loaded.free();
      }
      const damaged = bytes.slice();
      damaged[damaged.length - 1] ^= 1;
      await fails(() => fw.open(damaged), 'ParseError');
      await fails(() => fw.open(bytes.slice(0, -9)), 'ParseError');
      const newer = bytes.slice();
      newer[8] = 99;
      await fails(() => fw.load(newer), 'Unsupported');
    }
    await fails(() => fw.load(boxObj()), 'UnknownFormat');
    await fails(async () => fw.Cloud.parse(await shapes[0].save()), 'InvalidArgument');
    fw.dispose();
  });
}
