// Every method on a box and on a cloud, in both entries: `.` with two threads and with none, and `./sync`.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { install } from './install.mjs';
import { area, box, boxObj, sphere, volume } from './shapes.mjs';

const { load } = install();
const entries = {
  'two threads': async () => (await load('node/index.js')).init({ threads: 2 }),
  'no threads': async () => (await load('node/index.js')).init({ threads: false }),
  sync: async () => (await load('node/sync.js')).init(),
};
const near = (found, expected, tolerance) =>
  assert.ok(Math.abs(found - expected) <= tolerance, `${found} is not within ${tolerance} of ${expected}`);

for (const [name, start] of Object.entries(entries)) {
  test(`${name}: a box`, async (t) => {
    const fw = await start();
    const soup = await fw.open(boxObj());
    assert.deepEqual([soup.kind, soup.format, soup.count, soup.warnings], ['soup', 'OBJ', 12, []]);
    assert.deepEqual(soup.bounds, { min: [0, 0, 0], max: [10, 10, 10] });

    await t.test('prepare', async () => {
      const { milliseconds, bytes, method, components, boundaryEdges, caps } = await soup.prepare({ leafSize: 4 });
      assert.ok(milliseconds >= 0 && bytes > 0 && method.includes('crossings'));
      assert.deepEqual([components, boundaryEdges, caps], [1, 0, 0]);
    });
    await t.test('winding numbers are 1 inside, 0 outside, and 1/2, 1/4, 1/8 on a face, an edge, a vertex', async () => {
      const points = new Float64Array([5, 5, 5, 5, 5, 50, 5, 5, 10, 0, 5, 10, 10, 10, 10]);
      const w = await soup.windingNumbers(points, { tolerance: 0 });
      assert.ok(w instanceof Float64Array);
      [1, 0, 1 / 2, 1 / 4, 1 / 8].forEach((expected, i) => near(w[i], expected, 1e-12));
      assert.equal(points.length, 15, 'the points are still the caller’s');
      const fast = await soup.windingNumbers(new Float32Array([5, 5, 5, 5, 5, 50]), { order: 2, beta: 2 });
      [1, 0].forEach((expected, i) => near(fast[i], expected, 1e-2));
    });
    await t.test('contains', async () => {
      assert.deepEqual(await soup.contains(new Float32Array([5, 5, 5, 11, 5, 5])), new Uint8Array([1, 0]));
    });
    await t.test('voxelize', async () => {
      const voxels = await soup.voxelize({ resolution: 4, surface: true });
      assert.deepEqual([voxels.counts, voxels.origin, voxels.spacing], [[4, 4, 4], [1.25, 1.25, 1.25], [2.5, 2.5, 2.5]]);
      assert.deepEqual([voxels.count, voxels.volume, voxels.inside], [64, 1000, new Uint8Array(64).fill(1)]);
      assert.equal(voxels.surface.positions.length, 3 * 98, 'corners of a 4 × 4 × 4 block, each once');
      near(volume(voxels.surface), 1000, 1e-3);
      const bits = await soup.voxelize({ counts: [2, 3, 4], format: 'bits', method: 'continuation' });
      assert.deepEqual([bits.inside, bits.surface], [new Uint8Array([255, 255, 255]), undefined]);
      assert.deepEqual((await soup.voxelize({ spacing: 5 })).counts, [2, 2, 2]);
    });
    await t.test('slice', async () => {
      const layers = await soup.slice({ layerHeight: 2, firstLayerHeight: 4, resolution: 8 });
      assert.deepEqual(layers.map((l) => [l.zBottom, l.zSample, l.zTop]), [[0, 2, 4], [4, 5, 6], [6, 7, 8], [8, 9, 10]]);
      for (const { polygons } of layers) {
        assert.deepEqual([polygons.length, polygons[0].holes.length], [1, 0]);
        near(area(polygons[0].outer), 100, 1e-12);
        assert.equal(polygons[0].outer.length, 8, 'four corners');
      }
      const [low, high] = await soup.slice({ heights: new Float64Array([1, 9]), tolerance: 0.5 });
      assert.deepEqual([low.zSample, high.zSample], [1, 9]);
      assert.deepEqual((await soup.slice({ heights: [11], resolution: 8 }))[0].polygons, []);
      const svg = new TextDecoder().decode(await fw.exportLayer(low, 'svg'));
      assert.match(svg, /^<svg [^]*<path [^]*<\/svg>\s*$/);
    });
    await t.test('layers come one by one, as slice gives them', async () => {
      const options = { layerHeight: 0.1, sampleAt: 'top' };
      const all = await soup.slice(options);
      const some = [];
      for await (const layer of soup.layers(options)) some.push(layer);
      assert.equal(some.length, 100);
      assert.deepEqual(some, all);
      for await (const layer of soup.layers(options)) {
        assert.equal(layer.zBottom, 0);
        break;
      }
    });
    await t.test('toolpaths and a program for a printer', async () => {
      const layers = await soup.slice({ layerHeight: 0.2 });
      const paths = await fw.toolpaths(layers, { perimeters: 2, lineWidth: 0.4, topLayers: 0, bottomLayers: 0, density: 0 });
      assert.equal(paths.layers.length, 50);
      const [{ points, starts, kinds, widths, flags, height }] = paths.layers;
      assert.deepEqual([starts.length, Array.from(kinds, (kind) => paths.kinds[kind]).sort()], [3, ['innerWall', 'outerWall']]);
      near(height, 0.2, 1e-12);
      assert.deepEqual([Array.from(widths), flags[0] & 1, points.length], [[0.4, 0.4], 1, 16]);
      const { bytes, estimate, shift, warnings } = await fw.gcode(paths, { bedWidth: 100, bedDepth: 100, placement: 'centered' });
      const text = new TextDecoder().decode(bytes);
      assert.equal(text.match(/^;LAYER:/gm).length, 50);
      // Two squares, half a line and a line and a half inside: 4 (9.6 + 8.8) mm, 0.08 mm² thick, 50 times.
      near(estimate.filamentVolume, 50 * 4 * (9.6 + 8.8) * 0.08, 0.01);
      assert.deepEqual([shift, warnings], [[45, 45, 0], []]);
      const { settings, profile } = await fw.printSettings({ settings: { density: 0.5 }, profile: { speeds: { top: 33 } } });
      assert.deepEqual([settings.density, settings.perimeters, profile.speeds.top, profile.bedWidth], [0.5, 2, 33, 220]);
      const large = async () => fw.printSettings({ size: [260, 10, 10] });
      await assert.rejects(large, { code: 'DoesNotFit', message: 'the model is 260 mm wide, the bed 220 mm' });
      await assert.rejects(async () => fw.gcode(paths, { bedWidth: 8 }), { code: 'DoesNotFit' });
      await assert.rejects(async () => fw.toolpaths(layers, { lineWidth: -1 }), { code: 'InvalidArgument', message: /lineWidth/ });
      await assert.rejects(async () => fw.toolpaths(layers, { linewidth: 1 }), { code: 'InvalidArgument', message: /linewidth/ });
      await assert.rejects(async () => fw.gcode({ layers: [{}] }), { code: 'InvalidArgument', message: /points must be/ });
    });
    await t.test('layers as files', async () => {
      const layers = await soup.slice({ layerHeight: 2 });
      const text = async (format) => new TextDecoder().decode(await fw.exportLayers(layers, format));
      assert.equal((await text('svg')).match(/<g /g).length, 5);
      assert.match(await text('dxf'), /SECTION[^]*EOF\s*$/);
      const [first] = JSON.parse(await text('json'));
      near(area(first.polygons[0].outer.flat()), 100, 1e-12);
      const package3mf = await fw.exportLayers(layers, '3mf', await soup.geometry());
      const again = await fw.open(package3mf);
      assert.deepEqual([again.format, again.count, again.bounds.max], ['3MF', 12, [10, 10, 10]]);
      await assert.rejects(async () => fw.exportLayers(layers, '3mf'), { code: 'InvalidArgument', message: /mesh/ });
      const flat = await soup.slice({ heights: [5] });
      const mesh = await soup.geometry();
      await assert.rejects(async () => fw.exportLayers(flat, '3mf', mesh), { code: 'InvalidArgument', message: /layer 0/ });
      await assert.rejects(async () => fw.exportLayers(layers, 'ps'), { code: 'InvalidArgument', message: /'dxf'/ });
    });
    await t.test('adaptive heights', async () => {
      const adaptive = { least: 0.1, most: 0.5, deviation: 0.05 };
      const layers = await soup.slice({ adaptive });
      assert.equal(layers.length, 20, 'walls are steep: every layer is the thickest');
      near(layers.at(-1).zTop, 10, 1e-9);
      const wrong = { adaptive: { ...adaptive, least: 0.6 } };
      await assert.rejects(async () => soup.slice(wrong), { code: 'InvalidArgument', message: /least layer height of 0.6/ });
      await assert.rejects(async () => soup.slice({ layerHeight: 11 }), { code: 'InvalidArgument', message: /above the shape/ });
    });
    await t.test('modes of slicing', async () => {
      const [{ polygons }] = await soup.slice({ heights: [5], mode: 'largest', simplify: 0.1 });
      assert.deepEqual([polygons.length, polygons[0].outer.length], [1, 8]);
      await assert.rejects(async () => soup.slice({ mode: 'odd' }), { code: 'InvalidArgument', message: /odd/ });
      await assert.rejects(async () => soup.slice({ simplify: -1 }), { code: 'InvalidArgument', message: /simplified/ });
    });
    await t.test('surface', async () => {
      const mesh = await soup.surface({ resolution: 12 });
      near(volume(mesh), 1000, 60);
      assert.deepEqual([mesh.normals.length, mesh.origin], [mesh.positions.length, new Float64Array(3)]);
    });
    await t.test('heat map', async () => {
      const map = await soup.heatMap({ z: 5, resolution: 12 });
      assert.deepEqual([map.counts, map.z, map.values.length], [[12, 12], 5, 144]);
      near(map.values[6 * 12 + 6], 1, 1e-2);
      near(map.values[0], 0, 1e-1);
    });
    await t.test('geometry and boundary edges', async () => {
      const { positions, indices, origin } = await soup.geometry();
      assert.deepEqual([positions, indices, origin], [new Float32Array(box(0, 10).positions), box(0, 10).indices, new Float64Array(3)]);
      assert.equal((await soup.boundaryEdges()).count, 0);
      const { positions: corners, indices: faces } = box(0, 10);
      const open = await fw.Soup.from({ positions: corners, indices: faces.slice(6) });
      const edges = await open.boundaryEdges();
      assert.deepEqual([edges.count, edges.positions.length], [4, 24]);
    });
    await t.test('export, and back', async () => {
      for (const format of ['stl', 'obj', 'ply', 'off', '3mf']) {
        const again = await fw.Soup.parse(await soup.export(format));
        assert.deepEqual([again.count, again.bounds], [12, soup.bounds], format);
      }
    });
    await t.test('a cloud of the same surface', async () => {
      for (const [at, count] of [[undefined, 8], ['barycentres', 12]]) {
        const cloud = await soup.toCloud({ at });
        assert.deepEqual([cloud.kind, cloud.count, cloud.hasNormals, cloud.hasAreas, cloud.warnings], ['cloud', count, true, true, []]);
        near((await cloud.geometry()).areas.reduce((a, b) => a + b), 600, 1e-9);
        assert.deepEqual(await cloud.contains(new Float64Array([5, 5, 5, 50, 5, 5])), new Uint8Array([1, 0]));
      }
      await assert.rejects(async () => soup.toCloud({ at: 'edges' }), { code: 'InvalidArgument', message: /'vertices' and 'barycentres'/ });
    });
    await t.test('far from the origin, positions are relative', async () => {
      const far = await fw.Soup.from(box(1e7, 1e7 + 1));
      const { positions, origin } = await far.geometry();
      assert.deepEqual([origin[0], Math.max(...positions)], [1e7 + 0.5, 0.5]);
    });
    fw.dispose();
  });

  test(`${name}: a cloud`, async (t) => {
    const fw = await start();
    const { points, normals } = sphere(2000, 10);
    const cloud = await fw.Cloud.from({ points, normals });
    assert.deepEqual([cloud.kind, cloud.format, cloud.count, cloud.hasNormals, cloud.hasAreas], ['cloud', 'arrays', 2000, true, false]);

    await t.test('winding numbers, voxels, layers, surface', async () => {
      assert.ok((await cloud.prepare()).method.includes('points'));
      const w = await cloud.windingNumbers(new Float64Array([0, 0, 0, 30, 0, 0]), { tolerance: 0 });
      near(w[0], 1, 1e-2);
      near(w[1], 0, 1e-2);
      assert.deepEqual(await cloud.contains(new Float64Array([0, 0, 0, 30, 0, 0])), new Uint8Array([1, 0]));
      const exact = (4 / 3) * Math.PI * 1000;
      near((await cloud.voxelize({ resolution: 30, method: 'continuation' })).volume, exact, 0.03 * exact);
      const [layer] = await cloud.slice({ heights: [0], resolution: 64 });
      near(area(layer.polygons[0].outer), 100 * Math.PI, 6);
      near(volume(await cloud.surface({ resolution: 24 })), exact, 0.02 * exact);
      assert.equal((await cloud.heatMap({ z: 0, resolution: 4 })).values.length, 16);
    });
    await t.test('without normals it needs to be oriented', async () => {
      const bare = await fw.Cloud.from({ points });
      await assert.rejects(async () => bare.contains(points.slice(0, 3)), { code: 'MissingNormals' });
      assert.equal(bare.hasNormals, false);
      await bare.orient();
      assert.deepEqual([bare.hasNormals, bare.hasAreas, bare.warnings[0].code], [true, true, 'estimated-normals']);
      assert.deepEqual(await bare.contains(new Float64Array([0, 0, 0])), new Uint8Array([1]));
      const { normals: estimated, areas } = await bare.geometry();
      near(areas.reduce((a, b) => a + b), 400 * Math.PI, 10);
      near(estimated[0] * normals[0] + estimated[1] * normals[1] + estimated[2] * normals[2], 1, 0.05);
      const auto = await fw.Cloud.from({ points }, { orient: 'auto' });
      assert.equal(auto.hasNormals, true);
    });
    await t.test('normals may be watched while they settle, and methods chosen', async () => {
      const watched = await fw.Cloud.from({ points });
      const seen = [];
      await watched.orient({ method: 'consistency', noiseLevel: 1, onNormals: (settling) => seen.push(settling) });
      assert.ok(seen.length > 0 && seen.every((settling) => settling instanceof Float32Array && settling.length === 6000));
      const { normals: settled } = await watched.geometry();
      const good = (found) => found.filter((_, i) => i % 3 === 0 && found[i] * normals[i] + found[i + 1] * normals[i + 1] + found[i + 2] * normals[i + 2] > 0).length;
      assert.equal(good(settled), 2000);
      for (const [method, most] of [['propagation', 6000], ['stochastic', 900]]) {
        const other = await fw.Cloud.from({ points: points.filter((_, i) => Math.floor(i / 3) % Math.ceil(6000 / most) === 0) });
        await other.orient({ method });
        const { positions, normals: found } = await other.geometry();
        const outward = found.filter((_, i) => i % 3 === 0 && found[i] * positions[i] + found[i + 1] * positions[i + 1] + found[i + 2] * positions[i + 2] > 0);
        assert.equal(outward.length, other.count, method);
      }
      const bare = await fw.Cloud.from({ points });
      await assert.rejects(async () => bare.orient({ method: 'guess' }), { code: 'InvalidArgument', message: /'stochastic' and 'propagation'/ });
      await assert.rejects(async () => bare.orient({ noiseLevel: 6 }), { code: 'InvalidArgument', message: /noiseLevel/ });
    });
    await t.test('noise around each point', async () => {
      let seed = 1;
      const random = () => (2 * (seed = (48271 * seed) % 2147483647)) / 2147483647 - 1;
      const rough = points.map((x, i) => x + (points[i - (i % 3)] > 0 ? 0.05 * random() : 0));
      const noise = await (await fw.Cloud.from({ points: rough })).noise();
      const mean = (wanted) => {
        const chosen = noise.filter((_, i) => wanted(points[3 * i]));
        return chosen.reduce((a, b) => a + b) / chosen.length;
      };
      assert.equal(noise.length, 2000);
      near(mean((x) => x > 3), 0.05 / Math.sqrt(3), 0.005);
      assert.ok(mean((x) => x < -3) < 0.005);
    });
    await t.test('bounded, no point adds more than a half', async () => {
      const above = points.slice(0, 3).map((x) => (1 - 1e-6) * x);
      const [plain] = await cloud.windingNumbers(above);
      const bounded = await fw.Cloud.from({ points, normals });
      assert.match((await bounded.prepare({ bounded: true })).method, /bounded/);
      const [w] = await bounded.windingNumbers(above);
      assert.ok(plain > 10, `${plain}`);
      near(w, 1, 0.05);
    });
    await t.test('export, and back', async () => {
      for (const format of ['ply', 'xyz']) {
        const again = await fw.Cloud.parse(await cloud.export(format));
        assert.deepEqual([again.count, again.hasNormals], [2000, true], format);
      }
    });
    fw.dispose();
  });
}

test('one thread, two threads and none give equal bits', async () => {
  const { init } = await load('node/index.js');
  const { points, normals } = sphere(3000, 10);
  const queries = new Float64Array(30000).map((_, i) => 20 * ((i * 0.618034) % 1) - 10);
  const results = [];
  for (const threads of [1, 2, false]) {
    const fw = await init({ threads });
    const soup = await fw.Soup.from({ positions: points.slice(0, 8991) });
    const cloud = await fw.Cloud.from({ points, normals });
    const parts = [];
    for (const shape of [soup, cloud]) {
      parts.push(await shape.windingNumbers(queries), await shape.windingNumbers(queries, { order: 1, beta: 1.5 }));
      parts.push((await shape.surface({ resolution: 16 })).positions, (await shape.voxelize({ resolution: 24 })).inside);
      parts.push(...(await shape.slice({ heights: [0.5], resolution: 40 }))[0].polygons.map((p) => p.outer));
    }
    results.push(parts);
    fw.dispose();
  }
  assert.deepEqual(results[1], results[0]);
  assert.deepEqual(results[2], results[0]);
});
