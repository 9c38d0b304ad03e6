// The entry for manifold-3d, with manifold-3d itself.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { manifold } from '../bench/manifold.mjs';
import { install } from './install.mjs';
import { box, volume } from './shapes.mjs';

const { load } = install();
const { manifoldMesh, soupArrays } = await load('manifold.js');
const fw = await (await load('node/sync.js')).init();
const { Manifold, Mesh } = await manifold();
const near = (a, b, tolerance) => assert.ok(Math.abs(a - b) <= tolerance, `${a} is not ${b}`);

/** Three positions for each triangle. */
const looseOf = ({ positions, indices }) => Float64Array.from([...indices].flatMap((vertex) => [...positions.slice(3 * vertex, 3 * vertex + 3)]));

test('a solid of manifold-3d becomes a closed soup, whatever its properties', () => {
  const plain = Manifold.cube([2, 3, 4]);
  // Normals as properties: a cube's corners have three each, which the merge vectors make one.
  const withNormals = plain.calculateNormals(0, 30);
  assert.ok(withNormals.getMesh().numProp > 3 && withNormals.getMesh().mergeFromVert.length > 0);
  for (const solid of [plain, withNormals]) {
    const arrays = soupArrays(solid.getMesh());
    assert.equal(new Set(arrays.indices).size, 8);
    near(volume(arrays), 24, 1e-9);
    const soup = fw.Soup.from(arrays);
    assert.deepEqual([soup.count, soup.prepare().boundaryEdges, soup.bounds], [12, 0, { min: [0, 0, 0], max: [2, 3, 4] }]);
  }
});

test('a soup becomes a solid of manifold-3d, loose triangles and indexed ones alike', () => {
  const { positions, indices } = box(-1, 1);
  for (const arrays of [{ positions, indices }, { positions: looseOf({ positions, indices }) }]) {
    const mesh = manifoldMesh(fw.Soup.from(arrays).geometry());
    const solid = new Manifold(new Mesh(mesh));
    assert.deepEqual([solid.status(), solid.numTri(), solid.numVert(), solid.genus()], ['NoError', 12, 8, 0]);
    near(solid.volume(), 8, 1e-9);
    const direct = new Manifold(new Mesh(manifoldMesh(arrays)));
    near(direct.volume(), 8, 1e-9);
  }
});

test('0 and −0 are one place, and the origin is added', () => {
  const { positions, indices } = box(0, 1);
  const loose = looseOf({ positions, indices }).map((x, i) => (x === 0 && i % 2 ? -0 : x));
  const mesh = manifoldMesh({ positions: loose, origin: [5, 0, -0] });
  assert.equal(mesh.mergeFromVert.length, 36 - 8);
  assert.ok(mesh.mergeToVert.every((to, i) => to < mesh.mergeFromVert[i]));
  const solid = new Manifold(new Mesh(mesh));
  assert.deepEqual([solid.numVert(), solid.boundingBox().min[0], solid.boundingBox().max[0]], [8, 5, 6]);
});

test('solids go to and fro: manifold-3d’s difference and ours agree', () => {
  const a = Manifold.sphere(10, 48);
  const b = Manifold.cube([30, 4, 4], true);
  const theirs = a.subtract(b);
  const [soupA, soupB] = [a, b].map((solid) => fw.Soup.from(soupArrays(solid.getMesh())));
  const { soup } = soupA.boolean('difference', soupB);
  const ours = new Manifold(new Mesh(manifoldMesh(soup.geometry())));
  assert.deepEqual([ours.status(), ours.genus()], ['NoError', theirs.genus()]);
  near(ours.volume(), theirs.volume(), 1e-3);
  near(fw.Soup.from(soupArrays(theirs.getMesh())).check().volume, theirs.volume(), 1e-3);
});

test('what is no mesh is refused by name', () => {
  const { positions, indices } = box(0, 1);
  const mesh = manifoldMesh({ positions, indices });
  assert.throws(() => soupArrays({ ...mesh, numProp: 2 }), { code: 'InvalidArgument', message: /numProp is 2/ });
  assert.throws(() => fw.Soup.from(soupArrays({ ...mesh, triVerts: new Uint32Array([0, 1, 99]) })), { code: 'IndexOutOfRange' });
  // With merges, too.
  const merges = { mergeFromVert: new Uint32Array([1]), mergeToVert: new Uint32Array([0]) };
  assert.throws(() => fw.Soup.from(soupArrays({ ...mesh, ...merges, triVerts: new Uint32Array([0, 1, 99]) })), { code: 'IndexOutOfRange' });
});
