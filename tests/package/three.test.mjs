// The entry for three.js, with three itself: geometries to soups and clouds and back, contours, planes of the field.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, symlinkSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { test } from 'node:test';
import { npmTool } from '../../pkg-config/tools/npm.mjs';
import { www } from '../../pkg-config/tools/paths.mjs';
import { install } from './install.mjs';
import { area, box, sphere, volume } from './shapes.mjs';

const { folder, load } = install();
const THREE = createRequire(join(www, 'package.json'))('three');
const { soupArrays, cloudArrays, toGeometry, contourGeometry, planeGeometry, planeTexture } = await load('three/index.js');
const fw = await (await load('node/sync.js')).init();

const near = (a, b, tolerance) => assert.ok(Math.abs(a - b) <= tolerance, `${a} is not ${b}`);
const middle = (soup) => soup.windingNumbers(new Float64Array([0, 0, 0]), { tolerance: 0 })[0];
const indexed = ({ positions, indices }) => ({ positions, indices: indices ?? Uint32Array.from({ length: positions.length / 3 }, (_, i) => i) });
const volumeOf = (arrays) => volume(indexed(arrays));

test('geometries with and without an index become closed soups', () => {
  const geometry = new THREE.BoxGeometry(2, 3, 4);
  for (const some of [geometry, geometry.toNonIndexed()]) {
    const arrays = soupArrays(some);
    assert.equal(arrays.positions.constructor, Float32Array);
    assert.notEqual(arrays.positions.buffer, some.attributes.position.array.buffer);
    near(volumeOf(arrays), 24, 1e-12);
    const soup = fw.Soup.from(arrays);
    assert.deepEqual([soup.count, soup.prepare().boundaryEdges], [12, 0]);
    near(middle(soup), 1, 1e-12);
    soup.free();
  }
});

test('quantised and interleaved positions are read as a shader sees them', () => {
  const { positions, indices } = box(-1, 1);
  const whole = Int16Array.from(positions, (x) => 32767 * x);
  const quantised = new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(whole, 3, true));
  const rows = new Float32Array(8 * 5).fill(7);
  for (let i = 0; i < 8; i++) rows.set(positions.slice(3 * i, 3 * i + 3), 5 * i + 1);
  const buffer = new THREE.InterleavedBuffer(rows, 5);
  const interleaved = new THREE.BufferGeometry().setAttribute('position', new THREE.InterleavedBufferAttribute(buffer, 3, 1));
  for (const geometry of [quantised, interleaved]) {
    geometry.setIndex([...indices]);
    assert.deepEqual([...soupArrays(geometry).positions], [...positions]);
  }
});

test('matrixWorld is applied on request, and mirrored meshes keep their outside', () => {
  const geometry = new THREE.BoxGeometry(2, 2, 2);
  const parent = new THREE.Group();
  parent.position.set(10, 0, 0);
  parent.scale.set(-1, 2, 1);
  const mesh = new THREE.Mesh(geometry);
  mesh.position.set(1, 1, 1);
  parent.add(mesh);
  near(volumeOf(soupArrays(mesh)), 8, 1e-12);
  near(volumeOf(soupArrays(parent)), 8, 1e-12);
  const world = fw.Soup.from(soupArrays(mesh, { world: true }));
  assert.deepEqual(world.bounds, { min: [8, 0, 0], max: [10, 4, 2] });
  assert.deepEqual([...world.windingNumbers(new Float64Array([9, 2, 1, -9, 2, 1]), { tolerance: 0 }).map(Math.round)], [1, 0]);
  const inGroup = fw.Soup.from(soupArrays(parent));
  assert.deepEqual(inGroup.bounds, { min: [0, 0, 0], max: [2, 2, 2] });
  const upright = fw.Soup.from(soupArrays(mesh, { world: true, matrix: new THREE.Matrix4().makeRotationX(Math.PI / 2) }));
  near(upright.bounds.max[2], 4, 1e-12);
  near(upright.bounds.min[1], -2, 1e-12);
  assert.throws(() => soupArrays(geometry, { world: true }), { code: 'InvalidArgument', message: /matrixWorld/ });
  assert.throws(() => soupArrays(new THREE.BufferGeometry()), { code: 'InvalidArgument', message: /position/ });
  assert.throws(() => fw.Soup.from(soupArrays(new THREE.Group())), { code: 'EmptyInput' });
});

test('each instance is a part of the soup', () => {
  const instances = new THREE.InstancedMesh(new THREE.BoxGeometry(1, 1, 1), undefined, 3);
  [0, 5, 10].forEach((x, i) => instances.setMatrixAt(i, new THREE.Matrix4().makeTranslation(x, 0, 0)));
  const soup = fw.Soup.from(soupArrays(new THREE.Group().add(instances)));
  assert.deepEqual([soup.count, soup.bounds.max[0]], [36, 10.5]);
  assert.deepEqual([...soup.contains(new Float64Array([0, 0, 0, 2.5, 0, 0, 5, 0, 0, 10, 0, 0]))], [1, 0, 1, 1]);
});

test('points become clouds, their normals turned as three turns them', () => {
  const { points, normals } = sphere(500, 1);
  const geometry = new THREE.BufferGeometry()
    .setAttribute('position', new THREE.Float32BufferAttribute(points, 3))
    .setAttribute('normal', new THREE.Float32BufferAttribute(normals, 3));
  const object = new THREE.Points(geometry);
  object.scale.set(1, -3, 0.5);
  object.rotation.set(0.3, 0.2, 0.1);
  const arrays = cloudArrays(object, { world: true });
  const normalMatrix = new THREE.Matrix3().getNormalMatrix(object.matrixWorld);
  for (let i = 0; i < 500; i += 50) {
    const expected = new THREE.Vector3().fromBufferAttribute(geometry.attributes.normal, i).applyMatrix3(normalMatrix).normalize();
    const place = new THREE.Vector3().fromBufferAttribute(geometry.attributes.position, i).applyMatrix4(object.matrixWorld);
    near(expected.distanceTo(new THREE.Vector3().fromArray(arrays.normals, 3 * i).normalize()), 0, 1e-6);
    near(place.distanceTo(new THREE.Vector3().fromArray(arrays.points, 3 * i)), 0, 1e-6);
  }
  const cloud = fw.Cloud.from(arrays);
  assert.ok(cloud.hasNormals);
  near(middle(cloud), 1, 0.05);
  geometry.deleteAttribute('normal');
  assert.deepEqual(Object.keys(cloudArrays(geometry)), ['points']);
});

test('meshes become geometries where they lie, or relative to their origin', () => {
  const far = box(1e6, 1e6 + 2);
  const soup = fw.Soup.from(far);
  const mesh = soup.geometry();
  const there = toGeometry(THREE, mesh);
  there.computeBoundingBox();
  assert.deepEqual(there.boundingBox.min.toArray(), [1e6, 1e6, 1e6]);
  const here = toGeometry(THREE, mesh, { relative: true });
  const object = new THREE.Mesh(here);
  object.position.fromArray(mesh.origin);
  assert.deepEqual(fw.Soup.from(soupArrays(object, { world: true })).bounds, soup.bounds);
  const surface = fw.Soup.from(box(0, 1)).surface({ resolution: 8 });
  const geometry = toGeometry(THREE, surface);
  assert.equal(geometry.attributes.normal.count, geometry.attributes.position.count);
  near(volumeOf(soupArrays(geometry)), volume(surface), 1e-6);
  const points = toGeometry(THREE, { positions: new Float32Array([1, 2, 3]) });
  assert.deepEqual([points.index, points.attributes.normal], [null, undefined]);
});

test('contours are closed lines at their heights', () => {
  const outer = box(0, 10);
  const hole = box(3, 6);
  const positions = new Float64Array([...outer.positions, ...hole.positions]);
  const indices = new Uint32Array([...outer.indices, ...hole.indices.map((i) => i + 8).reverse()]);
  const layers = fw.Soup.from({ positions, indices }).slice({ layerHeight: 1 });
  const geometry = contourGeometry(THREE, layers);
  const { position } = geometry.attributes;
  const index = geometry.index.array;
  assert.equal(index.length, 2 * position.count);
  // Each vertex begins one side and ends one.
  assert.deepEqual([...index].sort((a, b) => a - b), Array.from({ length: index.length }, (_, i) => i >> 1));
  // By Green's formula, the sides around z = 4.5 enclose the layer's area.
  let twice = 0;
  for (let i = 0; i < index.length; i += 2) {
    const [a, b] = [index[i], index[i + 1]];
    assert.equal(position.getZ(a), position.getZ(b));
    if (Math.abs(position.getZ(a) - 4.5) < 1e-6) twice += position.getX(a) * position.getY(b) - position.getX(b) * position.getY(a);
  }
  const expected = layers[4].polygons.reduce((sum, { outer, holes }) => sum + [outer, ...holes].reduce((s, ring) => s + area(ring), 0), 0);
  near(twice / 2, expected, 1e-9);
  near(expected, 100 - 9, 1e-9);
  const top = contourGeometry(THREE, layers, { at: 'zTop', origin: [0, 0, 10] });
  assert.equal(Math.max(...top.attributes.position.array.filter((_, i) => i % 3 === 2)), 0);
  assert.equal(contourGeometry(THREE, []).attributes.position.count, 0);
});

test('a plane of the field becomes a texture whose texels lie at its samples', () => {
  const map = fw.Soup.from(box(0, 10)).heatMap({ z: 5, resolution: 16 });
  const texture = planeTexture(THREE, map);
  assert.deepEqual([texture.format, texture.type, texture.image.width, texture.image.height], [THREE.RedFormat, THREE.FloatType, ...map.counts]);
  assert.deepEqual([...texture.image.data], [...Float32Array.from(map.values)]);
  const { position, uv } = planeGeometry(THREE, map).attributes;
  const [u, v] = [0, 1].map((axis) => (position.array[6 + axis] - position.array[axis]));
  for (const [i, j] of [[0, 0], [3, 7]]) {
    near(position.getX(0) + (u * (i + 0.5)) / map.counts[0], map.origin[0] + i * map.spacing[0], 1e-5);
    near(position.getY(0) + (v * (j + 0.5)) / map.counts[1], map.origin[1] + j * map.spacing[1], 1e-5);
  }
  assert.deepEqual([[...uv.array.slice(0, 2)], [...uv.array.slice(4, 6)], position.getZ(0)], [[0, 0], [1, 1], 5]);
  near(areaFromAbove(planeGeometry(THREE, map)), u * v, 1e-3);
  const coloured = planeTexture(THREE, map, { colour: (w) => (w > 0.5 ? [255, 0, 0] : [0, 0, 255, 9]) });
  const texel = (i) => [...coloured.image.data.slice(4 * i, 4 * i + 4)];
  const inside = map.values.findIndex((w) => w > 0.5);
  assert.deepEqual([texel(0), texel(inside), coloured.colorSpace], [[0, 0, 255, 9], [255, 0, 0, 255], THREE.SRGBColorSpace]);
});

/** Area of a geometry's triangles as seen from above, negative from below. */
function areaFromAbove(geometry) {
  const { position } = geometry.attributes;
  let sum = 0;
  for (let i = 0; i < geometry.index.count; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => new THREE.Vector3().fromBufferAttribute(position, geometry.index.getX(i + k)));
    sum += b.sub(a).cross(c.sub(a)).z / 2;
  }
  return sum;
}

test('types are those of three', () => {
  mkdirSync(join(folder, 'node_modules/@types'));
  for (const name of ['three', '@types/three']) symlinkSync(join(www, 'node_modules', name), join(folder, 'node_modules', name));
  const program = (at) => `
    import * as THREE from 'three';
    import { init } from 'fast-winding';
    import { contourGeometry, planeTexture, soupArrays, toGeometry } from 'fast-winding/three';
    const soup = await (await init()).Soup.from(soupArrays(new THREE.Mesh(), { world: true, matrix: new THREE.Matrix4() }));
    export const geometry: THREE.BufferGeometry = toGeometry(THREE, await soup.surface());
    export const texture: THREE.DataTexture = planeTexture(THREE, await soup.heatMap({ z: 0 }), { colour: (w) => [w, 0, 0] });
    export const lines = new THREE.LineSegments(contourGeometry(THREE, await soup.slice(), { at: '${at}' }));`;
  const compile = (at) => {
    writeFileSync(join(folder, 'program.ts'), program(at));
    const options = ['--noEmit', '--strict', '--module', 'nodenext', '--target', 'es2022', '--lib', 'es2023,dom,esnext.disposable'];
    execFileSync('node', [npmTool('typescript', 'tsc'), ...options, '--types', '', 'program.ts'], { cwd: folder, stdio: 'pipe' });
  };
  compile('zTop');
  assert.throws(() => compile('zMiddle'), ({ stdout }) => /zMiddle/.test(String(stdout)));
});
