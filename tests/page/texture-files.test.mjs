/** Pictures for textures, and the files that other programs read. */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { describe, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { dropFile, fact, outside, picture, saved, sharedModel } from './page.mjs';
import { served } from './site.mjs';
import { BOX, makeTexture, withTexture as withTextureOn, atlas } from './textures.mjs';

const require = createRequire(new URL('../../www/package.json', import.meta.url));
const { unzipSync } = await import(pathToFileURL(require.resolve('three/examples/jsm/libs/fflate.module.js')));

const site = served();

const withTexture = (...how) => withTextureOn(site, ...how);

/** A PNG of one colour. */
async function png(page, width, height, colour) {
  const url = await page.evaluate(
    ([width, height, colour]) => {
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [width, height];
      const context = canvas.getContext('2d');
      context.fillStyle = colour;
      context.fillRect(0, 0, width, height);
      return canvas.toDataURL('image/png');
    },
    [width, height, colour],
  );
  return Buffer.from(url.slice(url.indexOf(',') + 1), 'base64');
}

/** The JSON chunk of a binary glTF. */
function gltfOf(bytes) {
  assert.equal(bytes.subarray(0, 4).toString('latin1'), 'glTF');
  assert.equal(bytes.readUInt32LE(4), 2);
  assert.equal(bytes.readUInt32LE(8), bytes.length);
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
}

/** The texture coordinates of a binary glTF. */
function coordinatesOf(bytes) {
  const { meshes, accessors, bufferViews } = gltfOf(bytes);
  const { bufferView, byteOffset = 0, count } = accessors[meshes[0].primitives[0].attributes.TEXCOORD_0];
  const { byteOffset: start = 0, byteStride = 8 } = bufferViews[bufferView];
  const first = 20 + bytes.readUInt32LE(12) + 8 + start + byteOffset;
  return Array.from({ length: count }, (_, k) => [0, 4].map((next) => bytes.readFloatLE(first + k * byteStride + next)));
}

describe('the picture of a texture', () => {
  const onTexture = sharedModel(site, BOX, { unfolded: ['texture-block'] }, (page) => makeTexture(page));

  test('is an image that is dropped, and a checker again', () =>
    onTexture(async (page) => {
      const checker = await picture(page);
      const plain = await atlas(page);
      await dropFile(page, 'red.png', await png(page, 64, 32, '#c03020'), '#texture-drop');
      await page.waitForFunction(() => document.getElementById('texture-picture').textContent === 'red.png');
      assert.notEqual(await picture(page), checker);
      assert.notEqual(await atlas(page), plain);
      assert.equal(await fact(page, 'facts', 'Triangles'), '12', 'the model is the same');
      await page.click('#texture-checker');
      assert.equal(await page.textContent('#texture-picture'), 'a checker');
      assert.equal(await picture(page), checker);
    }));

  test('is no file of another kind, which is told', () =>
    onTexture(async (page) => {
      await dropFile(page, 'words.txt', Buffer.from('no picture'), '#texture-drop');
      await page.waitForSelector('#problem:not([hidden])');
      assert.equal(await page.textContent('#problem-title'), 'words.txt is no picture');
      assert.equal(await page.textContent('#texture-picture'), 'a checker');
    }));
});

describe('a textured model', () => {
  const onTexture = sharedModel(site, BOX, { unfolded: ['texture-block'] }, (page) => makeTexture(page));

  test('is saved as binary glTF: in metres, y up, its picture inside', () =>
    onTexture(async (page) => {
      const { name, bytes } = await saved(page, '#texture-download');
      assert.equal(name, 'box-textured.glb');
      const gltf = gltfOf(bytes);
      const { attributes } = gltf.meshes[0].primitives[0];
      const position = gltf.accessors[attributes.POSITION];
      assert.equal(position.count, 36);
      assert.deepEqual([...position.min, ...position.max], [-20, -15, -10, 20, 15, 10]);
      assert.deepEqual(gltf.nodes[0].scale, [0.001, 0.001, 0.001]);
      assert.deepEqual(gltf.nodes[0].translation.map((value) => Number(value.toPrecision(6))), [0.02, 0.01, -0.015]);
      const place = gltf.accessors[attributes.TEXCOORD_0];
      assert.equal(place.type, 'VEC2');
      assert.equal(place.count, 36);
      assert.equal(gltf.images[0].mimeType, 'image/png');
      const { byteOffset, byteLength } = gltf.bufferViews[gltf.images[0].bufferView];
      const start = 20 + bytes.readUInt32LE(12) + 8 + (byteOffset ?? 0);
      assert.equal(bytes.subarray(start, start + byteLength).subarray(1, 4).toString('latin1'), 'PNG');
      assert.equal(gltf.materials[0].pbrMetallicRoughness.baseColorTexture.index, 0);
    }));

  test('is saved as OBJ with its material and its picture, by the names that they have for each other', () =>
    onTexture(async (page) => {
      await page.selectOption('#texture-download-format', 'zip');
      const { name, bytes } = await saved(page, '#texture-download');
      assert.equal(name, 'box-textured.zip');
      const files = unzipSync(bytes);
      assert.deepEqual(Object.keys(files).sort(), ['box-textured.mtl', 'box-textured.obj', 'box-textured.png']);
      const text = (file) => Buffer.from(files[file]).toString();
      assert.match(text('box-textured.obj'), /^mtllib box-textured\.mtl$/m);
      assert.equal(text('box-textured.obj').match(/^f \d+\/\d+ \d+\/\d+ \d+\/\d+$/gm).length, 12);
      const places = text('box-textured.obj').match(/^vt .*$/gm).flatMap((line) => line.split(' ').slice(1).map(Number));
      assert.ok(places.every(Number.isFinite));
      assert.match(text('box-textured.mtl'), /^map_Kd box-textured\.png$/m);
      // The same places as in glTF, where v goes downward.
      await page.selectOption('#texture-download-format', 'glb');
      const glb = (await saved(page, '#texture-download')).bytes;
      const corners = [...text('box-textured.obj').matchAll(/ \d+\/(\d+)/g)].map(([, place]) => Number(place) - 1);
      coordinatesOf(glb).forEach(([u, v], k) => {
        const [x, y] = [places[2 * corners[k]], places[2 * corners[k] + 1]];
        assert.ok(Math.abs(u - x) < 1e-6 && Math.abs(1 - v - y) < 1e-6, `corner ${k}: ${u}, ${v} for ${x}, ${y}`);
      });
    }));

  test('fits a narrow page', () =>
    withTexture(
      async (page) => {
        await page.click('#seam-draw:enabled');
        assert.deepEqual(await outside(page), []);
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
      },
      { width: 390, height: 844 },
    ));
});
