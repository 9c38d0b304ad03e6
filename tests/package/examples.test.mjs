// The folders of examples/, each run as a user would run it, with the packed package: in Node, and in Chromium.
import assert from 'node:assert/strict';
import { execFile, spawn } from 'node:child_process';
import { cpSync, readFileSync, readdirSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { promisify } from 'node:util';
import { root, www } from '../../pkg-config/tools/paths.mjs';
import { launch } from '../page/browser.mjs';
import { install } from './install.mjs';

const { folder, load } = install();
const examples = join(folder, 'examples');
cpSync(join(root, 'examples'), examples, { recursive: true, filter: (path) => !path.includes('node_modules') });
symlinkSync(join(www, 'node_modules', 'three'), join(folder, 'node_modules', 'three'));
const names = readdirSync(examples, { withFileTypes: true }).filter((f) => f.isDirectory() && f.name !== 'models').map((f) => f.name);
for (const name of names) symlinkSync(join(folder, 'node_modules'), join(examples, name, 'node_modules'));
const fw = await (await load('node/sync.js')).init();
const open = (...path) => fw.open(readFileSync(join(examples, ...path)));

/** What an example for Node says. */
async function run(name, ...words) {
  const { stdout, stderr } = await promisify(execFile)('node', ['main.mjs', ...words], { cwd: join(examples, name), timeout: 60_000 });
  assert.equal(stderr, '');
  return stdout;
}

const tested = new Set();
const example = (name, title, action) => {
  tested.add(name);
  test(`${name}: ${title}`, action);
};

example('slice-to-gcode', 'a program for a printer', async () => {
  // Of the ridge, the last layer is narrower than a line.
  assert.match(await run('slice-to-gcode'), /^warning: .* too thin .*\n150 layers, \d+ minutes, \d+\.\d g: house\.gcode\n$/);
  const program = readFileSync(join(examples, 'slice-to-gcode', 'house.gcode'), 'utf8');
  const heights = [...program.matchAll(/^G[01] .*Z([\d.]+)/gm)].map(([, z]) => Number(z));
  assert.ok(heights.some((z) => Math.abs(z - 30) < 1e-6) && /^G1 .*E/m.test(program));
});

example('cloud-to-mesh', 'a closed mesh of the points’ volume', async () => {
  assert.match(await run('cloud-to-mesh'), /^4000 points, \d+ triangles, 0 open edges: mesh\.stl\n$/);
  const { volume } = open('cloud-to-mesh', 'mesh.stl').check({ resolution: 0 });
  const ball = (4 / 3) * Math.PI * 30 ** 3;
  assert.ok(Math.abs(volume / ball - 1) < 0.03, `${volume} of ${ball}`);
});

example('boolean', 'the house less the part of the wedge in it', async () => {
  // The house has 30 × 20 + 30 × 10 / 2 = 750 mm² across. Of the wedge, raised by 5, z from 20 to 30 is in the house: there it is
  // 20 - 0.8 (z - 20) wide, and the house 30 - 3 (z - 20).
  const exact = 40 * 750 - (20 * 30 * 10 - ((20 * 3 + 30 * 0.8) * 10 ** 2) / 2 + (0.8 * 3 * 10 ** 3) / 3);
  assert.match(await run('boolean'), new RegExp(`^${exact.toFixed(1)} mm³ in \\d+ triangles, \\d+ of them along the wedge; clean: rest\\.3mf\\n$`));
  assert.equal(open('boolean', 'rest.3mf').prepare().boundaryEdges, 0);
});

example('node-batch', 'a line for each file, a bad one too', async () => {
  writeFileSync(join(examples, 'models', 'empty.stl'), '');
  const reports = (await run('node-batch')).trimEnd().split('\n').map((line) => JSON.parse(line)).sort((a, b) => (a.file < b.file ? -1 : 1));
  assert.deepEqual(reports.map(({ file, rating, error }) => [file, rating ?? error]), [
    ['../models/empty.stl', 'EmptyInput'], ['../models/house.obj', 'printsAsSeen'], ['../models/notch.obj', 'clean'],
  ]);
});

let chromium;
before(async () => (chromium = await launch()));
after(() => chromium.close());

/** Opens an example that is a page, by its own server, and hands it to `action`. */
async function visit(name, action) {
  const server = spawn('node', ['../serve.mjs'], { cwd: join(examples, name), env: { ...process.env, PORT: '0' }, stdio: ['ignore', 'pipe', 'inherit'] });
  const url = await new Promise((resolve) => server.stdout.once('data', (line) => resolve(String(line).trim())));
  const page = await chromium.newPage();
  const failures = [];
  page.on('pageerror', (error) => failures.push(String(error)));
  page.on('response', (response) => response.ok() || failures.push(`${response.status()} ${response.url()}`));
  try {
    await page.goto(url);
    await action(page);
    assert.deepEqual(failures, []);
  } finally {
    await page.close();
    server.kill();
  }
}

/** What the page says when it says something else than `before`. */
async function said(page, before) {
  await page.waitForFunction((text) => document.querySelector('output').value !== text, before);
  return page.locator('output').textContent();
}

example('check-upload', 'a model that prints can be sent, another cannot', () =>
  visit('check-upload', async (page) => {
    const choose = async (path) => {
      await page.setInputFiles('input', path);
      await page.waitForFunction(() => !/looking|STL,/.test(document.querySelector('output').value));
      return [await page.locator('output').textContent(), await page.locator('button').isEnabled()];
    };
    const [text, isEnabled] = await choose(join(examples, 'models', 'house.obj'));
    assert.match(text, /1 hole/);
    assert.equal(isEnabled, true);
    writeFileSync(join(folder, 'bad.obj'), 'v 0 0 0\nv 1 oops 0\nf 1 1 1\n');
    const [reason, isStillEnabled] = await choose(join(folder, 'bad.obj'));
    assert.match(reason, /bad\.obj: .*line 2/);
    assert.equal(isStillEnabled, false);
  }));

example('three-scene', 'as many points inside as the knot’s volume lets expect', () =>
  visit('three-scene', async (page) => {
    const text = await said(page, 'asking…');
    const share = Number(/^([\d.]+) %/.exec(text)[1]) / 100;
    const volume = await page.evaluate(async () => {
      const [{ TorusKnotGeometry }, { soupArrays }, { init }] = await Promise.all(['three', 'fast-winding/three', 'fast-winding'].map((name) => import(name)));
      const soup = await (await init()).Soup.from(soupArrays(new TorusKnotGeometry(10, 3, 200, 24)));
      return (await soup.voxelize({ resolution: 100 })).volume;
    });
    // Five standard deviations of a share of 10,000 points.
    const expected = volume / 32 ** 3;
    assert.ok(Math.abs(share - expected) < 5 * Math.sqrt((expected * (1 - expected)) / 10_000) + 0.001, `${share}, ${expected}`);
    assert.match(text, /threads: one for each processor/);
    await page.waitForSelector('canvas');
  }));

example('own-worker', 'the voxels of an octahedron', () =>
  visit('own-worker', async (page) => {
    const [count, volume] = (await said(page, 'computing…')).match(/[\d.]+/g).map(Number);
    assert.ok(count > 0 && Math.abs(volume / ((4 / 3) * 10 ** 3) - 1) < 0.01, `${volume}`);
  }));

test('each example has a test, a README and a package.json that starts it', () => {
  assert.deepEqual(names.toSorted(), [...tested].toSorted());
  const listed = readFileSync(join(examples, 'README.md'), 'utf8');
  for (const name of names) {
    assert.ok(listed.includes(`[${name}](${name})`));
    assert.match(JSON.parse(readFileSync(join(examples, name, 'package.json'), 'utf8')).scripts.start, /^node (main|\.\.\/serve)\.mjs$/);
    assert.ok(readFileSync(join(examples, name, 'README.md'), 'utf8').includes('npm install && npm start'));
  }
});
