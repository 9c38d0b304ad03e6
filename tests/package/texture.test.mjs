// Textures through the package, in both entries: a box, a sphere, one triangle; other proxies and atlases, seams, files, projections, and
// what is refused.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { install } from './install.mjs';
import { ball, box, sphere, torus } from './shapes.mjs';

const { load } = install();
const entries = {
  'two threads': async () => (await load('node/index.js')).init({ threads: 2 }),
  'no threads': async () => (await load('node/index.js')).init({ threads: false }),
  sync: async () => (await load('node/sync.js')).init(),
};
const SMALL = { resolution: 24, steps: 40 };
const near = (found, expected, tolerance) =>
  assert.ok(Math.abs(found - expected) <= tolerance, `${found} is not within ${tolerance} of ${expected}`);
const points = (numbers, size) => Array.from({ length: numbers.length / size }, (_, i) => [...numbers.slice(size * i, size * (i + 1))]);
const distance = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));

/** What a call that fails says; in `./sync` it throws. */
async function failure(call) {
  try {
    await call();
  } catch (error) {
    assert.equal(error.name, 'WindingError', String(error));
    return error.code;
  }
  return undefined;
}

/** Twice the area of a triangle in the plane, positive if it is not flipped. */
const doubled = ([ax, ay, bx, by, cx, cy]) => (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);

/** Whether a place of the texture is in one of some triangles, or within `margin` of it. */
function isIn([u, v], triangles, margin) {
  return triangles.some((t) => {
    const side = (a, b) => ((t[b] - t[a]) * (v - t[a + 1]) - (t[b + 1] - t[a + 1]) * (u - t[a])) / Math.hypot(t[b] - t[a], t[b + 1] - t[a + 1]);
    return doubled(t) > 0 && Math.min(side(0, 2), side(2, 4), side(4, 0)) > -margin;
  });
}

for (const [name, start] of Object.entries(entries)) {
  test(`${name}: textures`, async (t) => {
    const fw = await start();
    const round = await fw.Soup.from(ball(16, 10));
    const texture = await round.texture({ offset: 2, ...SMALL });

    await t.test('a sphere: no triangle is flipped, and each lies in its chart', async () => {
      const { offset, charts, proxyComponents, coverage, lines, mapping, proxyDistortion, warnings } = texture.report;
      assert.deepEqual([offset, proxyComponents, mapping.triangles, mapping.flipped, mapping.lostLines], [2, 1, round.count, 0, 0]);
      assert.ok(charts >= 2 && coverage > 0.3 && coverage < 1, JSON.stringify(texture.report));
      assert.equal(proxyDistortion.flipped, 0);
      assert.deepEqual([mapping.warnings, warnings.filter(({ code, message }) => !code || !message)], [undefined, []]);
      const { positions, indices, uvs, charts: of, sources } = await texture.geometry();
      const given = ball(16, 10);
      assert.deepEqual([positions, indices, sources.length], [given.positions, given.indices, 0]);
      assert.equal(lines, new Set(points(positions, 3).map(String)).size, 'one for each vertex');
      assert.ok(uvs instanceof Float32Array && uvs.every((x) => x >= 0 && x <= 1));
      assert.deepEqual([uvs.length, of.length], [6 * round.count, round.count]);
      const proxy = await texture.proxy();
      const places = points(proxy.uvs, 6);
      const inChart = (corners, k) => {
        const chart = places.filter((_, t) => proxy.charts[t] === of[k]);
        return [0, 2, 4].every((c) => isIn(corners.slice(c, c + 2), chart, 1e-4));
      };
      const apart = points(uvs, 6).filter((corners, k) => !inChart(corners, k)).length;
      assert.ok(apart <= mapping.unfolded, `${apart} triangles reach beyond their charts, ${mapping.unfolded} may`);
      assert.ok(points(uvs, 6).every((corners) => doubled(corners) > 0));
    });
    await t.test('lists of triangles are as long as the report says, and tell which', async () => {
      const { mapping } = texture.report;
      const affected = await texture.affected();
      const { across, moved, folded, squashed, unfolded, flipped, torn, lost, tangential, weak } = affected;
      const lengths = [across, moved, folded, squashed, unfolded, flipped, torn, weak].map((list) => list.length);
      const { acrossCharts, weakField } = mapping;
      assert.deepEqual(lengths, [acrossCharts, mapping.moved, mapping.folded, mapping.squashed, mapping.unfolded, 0, mapping.torn, weakField]);
      assert.deepEqual([lost.length, tangential.length], [0, 0]);
      for (const list of Object.values(affected)) assert.ok(list instanceof Uint32Array && list.every((t, k) => t < round.count && !(list[k - 1] >= t)));
      // Each of those across has a corner next to a seam: no farther than its longest edge.
      const { positions, seams } = await texture.proxy();
      const ends = [...seams].map((vertex) => [...positions.slice(3 * vertex, 3 * vertex + 3)].map((x) => x / 1.2));
      const given = ball(16, 10);
      for (const t of across) {
        const corners = [0, 1, 2].map((k) => given.indices[3 * t + k]).map((v) => [...given.positions.slice(3 * v, 3 * v + 3)]);
        const longest = Math.max(...[0, 1, 2].map((k) => distance(corners[k], corners[(k + 1) % 3])));
        assert.ok(corners.some((p) => ends.some((end) => distance(p, end) < longest)), `triangle ${t}`);
      }
      assert.ok(across.length > 0);
    });
    await t.test('its proxy: closed, an offset away, cut along seams', async () => {
      const { positions, indices, uvs, charts, seams } = await texture.proxy();
      for (const p of points(positions, 3)) near(Math.hypot(...p), 12, 0.2);
      const triangles = points(indices, 3);
      const edges = new Map();
      triangles.forEach(([a, b, c], k) => {
        for (const [from, to] of [[a, b], [b, c], [c, a]]) {
          const key = [from, to].sort((x, y) => x - y).join();
          edges.set(key, [...(edges.get(key) ?? []), k]);
        }
      });
      assert.ok([...edges.values()].every((sides) => sides.length === 2));
      assert.deepEqual([uvs.length, charts.length, new Set(charts).size], [2 * indices.length, triangles.length, texture.report.charts]);
      const cut = new Set(points(seams, 2).map(([a, b]) => `${a},${b}`));
      for (const [key, [one, other]] of edges) if (charts[one] !== charts[other]) assert.ok(cut.has(key), key);
      const place = (vertex) => [...positions.slice(3 * vertex, 3 * vertex + 3)];
      const length = points(seams, 2).reduce((sum, [a, b]) => sum + distance(place(a), place(b)), 0);
      near(length / texture.report.seamLength, 1, 1e-9);
    });
    await t.test('its lines are radial, and end where they meet the proxy', async () => {
      const { points: all, offsets } = await texture.lines();
      assert.equal(offsets.length, texture.report.lines + 1);
      const places = points(all, 3);
      for (let i = 0; i + 1 < offsets.length; i++) {
        const [from, to] = [places[offsets[i]], places[offsets[i + 1] - 1]];
        near(Math.hypot(...from), 10, 1e-9);
        near(Math.hypot(...to), 12, 0.2);
        near(distance(from.map((x) => x / 10), to.map((x) => x / Math.hypot(...to))), 0, 0.02);
      }
      const some = await texture.lines({ count: 20 });
      assert.ok(some.offsets.length > 15 && some.offsets.length <= 21, `${some.offsets.length - 1} lines`);
      const starts = [...some.offsets.slice(0, -1)].map((k) => [...some.points.slice(3 * k, 3 * k + 3)]);
      for (const axis of [0, 1, 2]) assert.ok(starts.some((p) => p[axis] > 3) && starts.some((p) => p[axis] < -3), `all sides of axis ${axis}`);
      assert.deepEqual((await texture.lines({ count: 0 })).points.length, 0);
    });
    await t.test('what the proxy has goes to the soup', async () => {
      const { positions } = await texture.proxy();
      const values = await texture.transfer(positions);
      assert.equal(values.length, 9 * round.count);
      for (const p of points(values, 3)) near(Math.hypot(...p), 12, 0.2);
      assert.equal(await failure(() => texture.transfer(positions.subarray(3))), 'InvalidArgument');
    });
    await t.test('files', async () => {
      const { obj, mtl } = await texture.export('obj', { name: 'ball' });
      const text = new TextDecoder().decode(obj);
      const rows = (letter) => text.split('\n').filter((line) => line.startsWith(`${letter} `));
      assert.deepEqual([rows('mtllib'), rows('f').length], [['mtllib ball.mtl'], round.count]);
      assert.match(new TextDecoder().decode(mtl), /map_Kd ball\.png/);
      const { uvs } = await texture.geometry();
      const coordinates = rows('vt').map((line) => line.split(' ').slice(1).map(Number));
      const corners = rows('f').flatMap((line) => line.split(' ').slice(1).map((corner) => coordinates[corner.split('/')[1] - 1]));
      corners.forEach((uv, k) => near(distance(uv, [uvs[2 * k], uvs[2 * k + 1]]), 0, 1e-7));
      assert.equal((await fw.open(obj)).count, round.count);
      assert.match(new TextDecoder().decode((await texture.export('obj', { image: 'wood.jpg' })).mtl), /map_Kd wood\.jpg/);
      assert.equal(await failure(() => texture.export('glb')), 'InvalidArgument');
      assert.equal(await failure(() => texture.export('obj', { name: 'a\nb' })), 'InvalidArgument');
    });
    await t.test('another atlas with a seam that was drawn', async () => {
      const before = await texture.proxy();
      const top = points(before.positions, 3).reduce((best, p, k, all) => (p[2] > all[best][2] ? k : best), 0);
      const bottom = points(before.positions, 3).reduce((best, p, k, all) => (p[2] < all[best][2] ? k : best), 0);
      const chain = await texture.seam(top, bottom);
      assert.deepEqual([chain.at(0), chain.at(-1)], [top, bottom]);
      const key = (a, b) => `${Math.min(a, b)},${Math.max(a, b)}`;
      const sides = new Set(points(before.indices, 3).flatMap(([a, b, c]) => [key(a, b), key(b, c), key(c, a)]));
      const links = [...chain.slice(1)].map((vertex, k) => key(chain[k], vertex));
      assert.ok(links.every((link) => sides.has(link)), 'along edges');
      const around = await texture.seam(top, bottom, top);
      const back = [...around.slice(1)].map((vertex, k) => key(around[k], vertex));
      assert.equal(new Set(back).size, back.length, 'no edge is used twice');
      assert.deepEqual([...(await texture.seam(top, top))], [top]);
      const report = await texture.remap({ seams: [chain] });
      assert.equal(texture.report, report);
      const after = await texture.proxy();
      assert.deepEqual([after.positions, after.indices], [before.positions, before.indices]);
      const cut = new Set(points(after.seams, 2).map(([a, b]) => key(a, b)));
      assert.ok(links.every((link) => cut.has(link)));
      const same = await texture.remap({ texels: 512, offset: 2 });
      assert.ok(points((await texture.proxy()).seams, 2).length >= links.length);
      assert.equal(same.seamLength, report.seamLength, 'the proxy stays, and so do its seams');
      assert.equal(await failure(() => texture.seam(0, 1e6)), 'InvalidArgument');
      assert.equal(await failure(() => texture.seam(0, -1)), 'InvalidArgument');
      assert.equal(await failure(() => texture.remap({ seams: [[0, 1e6]] })), 'InvalidArgument');
    });
    await t.test('another proxy for the same lines', async () => {
      const starts = async () => {
        const { points: all, offsets } = await texture.lines();
        return [...offsets.slice(0, -1)].map((k) => [...all.slice(3 * k, 3 * k + 6)]);
      };
      const [before, proxy] = [await starts(), await texture.proxy()];
      const report = await texture.remap({ offset: 1 });
      assert.deepEqual([report.offset, report.mapping.flipped, report.mapping.lostLines], [1, 0, 0]);
      assert.deepEqual(await starts(), before, 'the first steps of all lines are as they were');
      const nearer = await texture.proxy();
      assert.notDeepEqual(nearer.positions, proxy.positions);
      for (const p of points(nearer.positions, 3)) near(Math.hypot(...p), 11, 0.2);
      const kept = await texture.geometry();
      assert.equal(await failure(() => texture.remap({ offset: -1 })), 'InvalidArgument');
      assert.equal(await failure(() => texture.remap({ cone: 5 })), 'InvalidArgument');
      assert.deepEqual(await texture.geometry(), kept, 'what fails changes nothing');
      assert.equal(texture.report, report);
    });
    await t.test('a box: six charts of squares, and parts that overlap when refined', async () => {
      const cube = await fw.Soup.from(box(0, 10));
      const { report } = await cube.texture({ offset: 1, ...SMALL });
      assert.deepEqual([report.charts, report.mapping.triangles, report.mapping.flipped, report.mapping.lostLines], [6, 12, 0, 0]);
      assert.equal(report.seams.pieces, 6);
      near(report.seams.length, 120, 1e-9);
      const [one, other] = [box(0, 10), box(5, 15)];
      const both = await fw.Soup.from({
        positions: new Float64Array([...one.positions, ...other.positions]),
        indices: new Uint32Array([...one.indices, ...other.indices.map((v) => v + 8)]),
      });
      const refined = await both.texture({ refine: true, offset: 2, ...SMALL });
      const { indices, sources, uvs } = await refined.geometry();
      assert.ok(sources.length > 24 && sources.every((source) => source < 24));
      assert.deepEqual([3 * sources.length, 6 * sources.length], [indices.length, uvs.length]);
    });
    await t.test('projections, to compare with', async () => {
      const soup = await fw.Soup.from(box(0, 10));
      const axes = await soup.project();
      assert.deepEqual([axes.seams, axes.turn, axes.distortion.flipped], [{ pieces: 6, length: 120 }, undefined, 0]);
      near(axes.distortion.meanRatio, 1, 1e-12);
      assert.ok(axes.uvs instanceof Float32Array && axes.uvs.length === 72 && axes.uvs.every((x) => x >= 0 && x <= 1));
      near(doubled(axes.uvs.subarray(0, 6)) / axes.scale ** 2, 100, 1e-4);
      const flat = await soup.project({ method: 'planar' });
      assert.deepEqual([flat.distortion.flipped + flat.distortion.flat, flat.seams.pieces], [10, 1]);
      for (const method of ['cylindrical', 'spherical']) assert.ok((await soup.project({ method })).turn > 0, method);
      assert.equal(await failure(() => soup.project({ method: 'conformal' })), 'InvalidArgument');
    });
    await t.test('one triangle, and parts far apart', async () => {
      const one = await fw.Soup.from({ positions: new Float64Array([0, 0, 0, 10, 0, 0, 0, 10, 0]) });
      const { report, ...made } = await one.texture({ offset: 1, ...SMALL });
      assert.deepEqual([report.mapping.triangles, report.mapping.flipped, report.proxyComponents], [1, 0, 1]);
      const far = await fw.Soup.from({ positions: new Float64Array([0, 0, 0, 10, 0, 0, 0, 10, 0, 20, 0, 0, 30, 0, 0, 20, 10, 0]) });
      const two = await far.texture({ offset: 1, resolution: 60 });
      assert.deepEqual([two.report.proxyComponents, two.report.warnings[0].code], [2, 'several-proxies']);
      const suggested = await far.suggestOffset({ sides: 'both' });
      near(suggested, 5, 0.5);
      const joined = await far.texture({ offset: suggested, sides: 'both', resolution: 40 });
      assert.equal(joined.report.proxyComponents, 1);
      void made;
    });
    await t.test('what is refused', async () => {
      const cloud = await fw.Cloud.from(sphere(200, 1));
      assert.equal(await failure(() => cloud.texture()), 'InvalidArgument');
      assert.equal(await failure(() => cloud.suggestOffset()), 'InvalidArgument');
      assert.equal(await failure(() => fw.Soup.from({ positions: new Float64Array(0) })), 'EmptyInput');
      const flat = await fw.Soup.from({ positions: new Float64Array([0, 0, 0, 1, 0, 0, 2, 0, 0]) });
      assert.equal(await failure(() => flat.texture({ offset: 0.5 })), 'EmptyInput');
      const small = await fw.Soup.from(box(0, 1));
      const refused = [
        { offset: 0 }, { offset: NaN }, { offset: -1 }, { offset: Infinity }, { offset: '1' }, { resolution: 1 }, { resolution: 2.5 },
        { sides: 'inner' }, { smoothing: -1 }, { cone: 90 }, { cone: NaN }, { texels: 4 }, { seams: [[0, 1e6]] }, { seams: 3 },
        { solver: 'jacobi' }, { tolerance: 0 }, { integrator: 'verlet' }, { step: -1 }, { startOffset: 0 }, { largestTurn: NaN },
        { steps: 1e9 }, { steps: -1 },
      ];
      for (const options of refused) {
        assert.equal(await failure(() => small.texture({ ...SMALL, ...options })), 'InvalidArgument', JSON.stringify(options));
      }
      await assert.rejects(async () => small.texture({ largestTurn: -20 }), /-20 degrees/);
      assert.equal(await failure(() => cloud.project()), 'InvalidArgument');
      assert.equal(await failure(() => small.texture({ texels: 32, margin: 16, ...SMALL })), 'DoesNotFit');
      assert.equal(await failure(() => small.texture({ resolution: 100_000 })), 'OutOfMemory');
      assert.equal(await failure(() => texture.lines({ count: -1 })), 'InvalidArgument');
      assert.deepEqual(await small.contains(new Float64Array([0.5, 0.5, 0.5])), new Uint8Array([1]), 'the engine goes on');
    });
    await t.test('it outlives its soup, and says when it is freed itself', async () => {
      round.free();
      assert.equal((await texture.geometry()).indices.length, 3 * round.count);
      texture.free();
      assert.equal(await failure(() => texture.geometry()), 'Freed');
      assert.equal(await failure(() => texture.remap({ offset: 2 })), 'Freed');
      assert.equal(texture.report.offset, 1);
    });
    fw.dispose();
  });
}

for (const threads of [2, false]) {
  test(`a texture lives on when the next one is aborted, threads: ${threads}`, async () => {
    const fw = await (await load('node/index.js')).init({ threads });
    const soup = await fw.Soup.from(torus(40));
    const texture = await soup.texture({ offset: 3, ...SMALL });
    await texture.remap({ offset: 2 });
    const before = await texture.geometry();
    const stop = new AbortController();
    const aborted = texture.remap({ offset: 0.5, signal: stop.signal, onProgress: () => stop.abort('enough') });
    await assert.rejects(aborted, { code: 'Aborted', details: { reason: 'enough' } });
    assert.equal(texture.report.offset, 2);
    assert.deepEqual(await texture.geometry(), before);
    fw.dispose();
  });
}
