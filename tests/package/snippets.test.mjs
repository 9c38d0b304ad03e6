// Every snippet in JavaScript and every command of the documents, with the packed package: the READMEs and docs/. Those in Rust are doc tests.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { delimiter, join } from 'node:path';
import { test } from 'node:test';
import { promisify } from 'node:util';
import { root, www } from '../../pkg-config/tools/paths.mjs';
import { install } from './install.mjs';
import { box, boxObj, sphere, torus } from './shapes.mjs';
import { blocksOf, commandsOf, programOf } from './snippets.mjs';

const { folder, load } = install();
symlinkSync(join(www, 'node_modules', 'three'), join(folder, 'node_modules', 'three'));
const pages = ['README.md', 'pkg-config/README.md', ...readdirSync(join(root, 'docs')).filter((name) => name.endsWith('.md')).map((name) => `docs/${name}`)];
const blocks = Object.fromEntries(pages.map((page) => [page, blocksOf(readFileSync(join(root, page), 'utf8'))]));
const scripts = (page) => blocks[page].filter(({ language, words }) => language === 'js' && words !== 'prelude');
const [prelude] = blocks['docs/README.md'].filter(({ words }) => words === 'prelude');

/** What READMEs take for granted, and what begins the pages of docs/. */
const surroundings = {
  text: `
    const THREE = await import('three');
    const transform = new THREE.Matrix4().makeTranslation(3, 0, 0).elements;
    const mesh = new THREE.Mesh(new THREE.TorusKnotGeometry(10, 3, 64, 8), new THREE.MeshBasicMaterial());
    const [object, material, scene] = [mesh, mesh.material, new THREE.Scene().add(mesh)];`,
};
const withManifold = { text: `const { Manifold, Mesh } = await (await import(${JSON.stringify(join(root, 'tests/bench/manifold.mjs'))})).manifold();` };

/** What more is to be true at the end of a page. */
const FACTS = {
  'README.md': 'assert.deepEqual([inside, layers.length, verdict.rating, soup.count], [new Uint8Array([1, 0]), 50, "clean", 12]);',
  'pkg-config/README.md': `
    assert.deepEqual([inside, numbers.map(Math.round)], [new Uint8Array([1, 0]), new Float64Array([1])]);
    assert.deepEqual([voxels.counts, mesh.indices.length > 0], [[64, 64, 64], true]);
    assert.deepEqual([report.verdict.rating, wider.indices.length > 0, joined.operands.includes(1)], ['clean', true, true]);
    assert.deepEqual([far[0] > 0, saved.length > 100], [true, true]);
    assert.deepEqual([noise.length, scan.hasNormals, skin.indices.length > 0, corners.count], [1000, true, true, 8]);
    assert.deepEqual([uvs.length, threads.offsets.length > 8, chain.length > 5, files.obj.length > 100], [72, true, true, true]);
    assert.equal(scene.children.length, 4);
    assert.ok(scene.children.every(({ geometry }) => geometry.attributes.position.count > 3));`,
};

test('every snippet in JavaScript runs, and prints what it is said to print', async () => {
  writeFileSync(join(folder, 'part.stl'), boxObj());
  const named = pages.filter((page) => scripts(page).length > 0).map((page) => [page, `${page.replaceAll(/\W/g, '-')}.mjs`]);
  for (const [page, file] of named) {
    const before = page.startsWith('docs/') ? [prelude] : [surroundings];
    const peers = scripts(page).some(({ words }) => words === 'manifold') ? [withManifold] : [];
    const all = [...before, ...peers, ...scripts(page)];
    writeFileSync(join(folder, file), programOf(all, FACTS[page]).replaceAll('resolution: 400', 'resolution: 40'));
  }
  const run = named.map(([page, file]) => `await import('./${file}').catch((error) => failures.push(${JSON.stringify(page)}, error));`);
  writeFileSync(join(folder, 'all.mjs'), ['const failures = [];', ...run, 'console.error(...failures);', 'process.exit(failures.length);'].join('\n'));
  await promisify(execFile)('node', ['all.mjs'], { cwd: folder, timeout: 180_000, maxBuffer: 1 << 26 });
  assert.ok(named.length > 12, 'each page of docs/ but those of the engine and the command line has some');
});

test('every command of the documents runs', async () => {
  const fw = await (await load('node/sync.js')).init();
  const stl = (arrays) => fw.Soup.from(arrays).export('stl');
  const pricked = torus(16);
  const ball = sphere(600, 10);
  const files = {
    'part.stl': stl(box(0, 10)), 'hole.stl': stl(box(4, 16)), 'a.stl': stl(box(0, 10)), 'b.stl': stl(box(4, 16)),
    'broken.stl': stl({ ...pricked, indices: pricked.indices.slice(3) }),
    'scan.xyz': Array.from({ length: 600 }, (_, i) => ball.points.slice(3 * i, 3 * i + 3).join(' ')).join('\n'),
  };
  mkdirSync(join(folder, 'broken'));
  for (const [name, bytes] of Object.entries(files)) writeFileSync(join(folder, name), bytes);
  writeFileSync(join(folder, 'broken', 'one.stl'), files['broken.stl']);
  const env = { ...process.env, PATH: `${join(folder, 'node_modules', '.bin')}${delimiter}${process.env.PATH}` };
  const told = pages.flatMap((page) => commandsOf(blocks[page]));
  const commands = new Set(told.map((line) => line.replace(/ +# .*/, '').replace('npx ', '')));
  assert.ok(commands.size >= 18, `${commands.size} different ones`);
  for (const command of commands) {
    await promisify(execFile)('bash', ['-ec', command], { cwd: folder, env });
    for (const [, out] of command.matchAll(/(?:-o|>) (\w+\.\w+)/g)) assert.ok(existsSync(join(folder, out)), command);
  }
  assert.equal(fw.open(readFileSync(join(folder, 'fixed', 'one.stl'))).prepare().boundaryEdges, 0);
});

test('links between documents lead somewhere, and pictures are small', () => {
  const all = [...pages, 'CONTRIBUTING.md', 'examples/README.md'];
  const anchors = (text) => new Set([...text.matchAll(/^#+ (.*)$/gm)].map(([, title]) => title.toLowerCase().replace(/[^\w -]/g, '').replaceAll(' ', '-')));
  for (const page of all) {
    const text = readFileSync(join(root, page), 'utf8');
    for (const [, to] of text.matchAll(/\]\(((?!https?:|mailto:)[^)\s]+)\)/g)) {
      const [path, anchor] = to.split('#');
      const target = path ? join(root, page, '..', path) : join(root, page);
      assert.ok(existsSync(target), `${page}: ${to}`);
      if (to.includes('pictures/')) assert.ok(statSync(target).size < 100 * 1024, `${to} is too large`);
      if (anchor) assert.ok(anchors(readFileSync(target, 'utf8')).has(anchor), `${page}: ${to}`);
    }
  }
});
