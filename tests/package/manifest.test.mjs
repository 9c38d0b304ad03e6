// The package as a dependency: its manifest, its types, and what importing it touches.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { npmTool } from '../../pkg-config/tools/npm.mjs';
import { www } from '../../pkg-config/tools/paths.mjs';
import { install, pack } from './install.mjs';

const { folder, home } = install();
const development = (name) => import(pathToFileURL(createRequire(join(www, 'package.json')).resolve(name)).href);

test('publint has nothing to say', async () => {
  const { publint } = await development('publint');
  const { messages } = await publint({ pkgDir: home, strict: true });
  assert.deepEqual(messages, []);
});

test('types resolve as the code does', async () => {
  const { checkPackage, createPackageFromTarballData } = await development('@arethetypeswrong/core');
  const packed = mkdtempSync(join(tmpdir(), 'fast-winding-pack-'));
  const { problems } = await checkPackage(createPackageFromTarballData(readFileSync(pack(packed))));
  rmSync(packed, { recursive: true });
  // It is ESM only: require() finds ESM, and the oldest resolution knows no exports map.
  const expected = new Set(['CJSResolvesToESM', 'NoResolution']);
  assert.deepEqual(problems.filter(({ kind, resolutionKind }) => !(expected.has(kind) && resolutionKind !== 'node16-esm' && resolutionKind !== 'bundler')), []);
});

test('a program that uses the types compiles, and one that misuses them does not', () => {
  const good = `
    import { init, WindingError, type Layer } from 'fast-winding';
    import { init as initSync } from 'fast-winding/sync';
    const fw = await init({ threads: 2 });
    const shape = await fw.open(new Uint8Array());
    if (shape.kind === 'cloud') await shape.orient(); else (await shape.boundaryEdges()).count.toFixed();
    const layers: Layer[] = await shape.slice({ layerHeight: 0.2 });
    const inside: Uint8Array = (await initSync()).open(new ArrayBuffer(0)).contains(new Float32Array(3));
    try { layers[0]!.polygons[0]!.outer.at(0); } catch (error) { if (error instanceof WindingError) error.code satisfies string; }
    export { inside };`;
  const bad = `
    import { init } from 'fast-winding';
    (await (await init()).open('part.stl')).voxelize({ resolutoin: 4 });`;
  const compile = (name, text) => {
    writeFileSync(join(folder, name), text);
    const options = ['--noEmit', '--strict', '--module', 'nodenext', '--target', 'es2022', '--lib', 'es2023,dom,esnext.disposable'];
    execFileSync('node', [npmTool('typescript', 'tsc'), ...options, '--types', '', name], { cwd: folder, stdio: 'pipe' });
  };
  compile('good.ts', good);
  assert.throws(() => compile('bad.ts', bad), ({ stdout }) => {
    assert.match(String(stdout), /'string' is not assignable/);
    assert.match(String(stdout), /resolutoin/);
    return true;
  });
});

test('a program ends by itself when it has nothing left to ask', () => {
  writeFileSync(join(folder, 'ends.mjs'), "import { init } from 'fast-winding'; await init({ threads: 2 }); console.log('ran');");
  assert.equal(execFileSync('node', ['ends.mjs'], { cwd: folder, encoding: 'utf8', timeout: 30_000 }), 'ran\n');
});

test('importing the browser’s entries on a server touches neither window nor Worker', () => {
  const script = ['index.js', 'sync.js', 'three/index.js', 'manifold.js'].map((name) => `await import(${JSON.stringify(pathToFileURL(join(home, 'dist', name)).href)});`);
  const traps = `for (const name of ['window', 'document', 'Worker', 'location', 'navigator', 'fetch', 'crossOriginIsolated'])
    Object.defineProperty(globalThis, name, { get() { throw new Error(name + ' was touched'); } });`;
  writeFileSync(join(folder, 'server.mjs'), `${traps}\n${script.join('\n')}\nconsole.log('imported');`);
  assert.equal(execFileSync('node', ['server.mjs'], { cwd: folder, encoding: 'utf8' }), 'imported\n');
});

test('nothing but the package’s own files is packed', () => {
  const files = readdirSync(home, { recursive: true, withFileTypes: true }).filter((f) => f.isFile()).map((f) => f.name);
  assert.ok(files.includes('LICENSE-MIT') && files.includes('LICENSE-APACHE') && files.includes('README.md'));
  assert.deepEqual(files.filter((name) => !/\.(js|d\.ts|wasm)$|^(LICENSE-.*|README\.md|package\.json)$/.test(name)), []);
});

test('it depends on nothing, and editors are told units and shapes', () => {
  const { dependencies, bundledDependencies } = JSON.parse(readFileSync(join(home, 'package.json'), 'utf8'));
  assert.deepEqual([dependencies, bundledDependencies], [undefined, undefined]);
  assert.match(readFileSync(join(home, 'dist', 'api.d.ts'), 'utf8'), /export type \* from '\.\/common-api\.js';/);
  assert.match(readFileSync(join(home, 'dist', 'common-api.d.ts'), 'utf8'), /\/\*\* xyzxyz… in millimetres, relative to `origin`\. \*\/\n\s*positions: Float32Array;/);
});
