// The packed package in an application that a bundler has built, as the package's README says: Vite, developing and built, webpack, esbuild.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { cache, www } from '../../pkg-config/tools/paths.mjs';
import { launch } from '../page/browser.mjs';
import { install } from './install.mjs';
import { ISOLATED, answers, ask, serve } from './pages.mjs';

/** No dependencies of the project: they lie in the user's cache. */
const PEERS = ['webpack@5.113.0', 'esbuild@0.28.2'];
const { folder } = install();
const peers = createRequire(join(cache, 'bundlers', 'package.json'));
const { build, createServer } = await import(pathToFileURL(createRequire(join(www, 'package.json')).resolve('vite')).href);

let chromium;
let server;
before(async () => {
  if (!PEERS.every((peer) => existsSync(join(cache, 'bundlers', 'node_modules', peer.split('@')[0])))) {
    mkdirSync(join(cache, 'bundlers'), { recursive: true });
    execFileSync('npm', ['install', '--silent', '--no-save', '--no-audit', '--no-fund', '--prefix', join(cache, 'bundlers'), ...PEERS]);
  }
  chromium = await launch();
  server = await serve(folder, ISOLATED);
});
after(async () => {
  await chromium.close();
  server.close();
});

/** An application that asks for `ask`'s answer, in a folder of its own. */
function application(name, options) {
  const root = join(folder, name);
  mkdirSync(root);
  const script = `import * as module from 'fast-winding';\nglobalThis.answered = (${ask})(module, ${JSON.stringify(options)});\n`;
  writeFileSync(join(root, 'main.js'), script);
  writeFileSync(join(root, 'index.html'), '<!doctype html><script type="module" src="./main.js"></script>');
  return root;
}

/** Opens the application, and holds its answer against what is known. */
async function hasThreads(url) {
  const page = await chromium.newPage();
  const failures = [];
  page.on('pageerror', (error) => failures.push(String(error)));
  try {
    await page.goto(url);
    await page.waitForFunction(() => 'answered' in globalThis);
    const { threads, reason, ...rest } = await page.evaluate(() => globalThis.answered);
    assert.deepEqual([rest, failures], [{ ...answers, isolated: true }, []]);
    assert.ok(threads >= 1, reason);
  } finally {
    await page.close();
  }
}

const vite = (root) => ({
  root, configFile: false, logLevel: 'error', base: './', cacheDir: join(root, '.vite'),
  worker: { format: 'es' }, optimizeDeps: { exclude: ['fast-winding'] }, build: { target: 'esnext' },
});

test('Vite, developing', async () => {
  const developing = await createServer({ ...vite(application('vite-dev')), server: { host: '127.0.0.1', headers: ISOLATED, fs: { allow: [folder] } } });
  await developing.listen();
  try {
    await hasThreads(developing.resolvedUrls.local[0]);
  } finally {
    await developing.close();
  }
});

test('Vite, built', async () => {
  await build(vite(application('vite')));
  await hasThreads(`${server.origin}/vite/dist/index.html`);
});

test('webpack', async () => {
  const root = application('webpack');
  const built = join(root, 'built');
  const config = {
    mode: 'production', context: root, entry: './main.js', performance: false, optimization: { minimize: false },
    experiments: { outputModule: true }, output: { module: true, path: built, publicPath: 'auto' },
  };
  const stats = await new Promise((resolve, reject) => peers('webpack')(config, (error, done) => (error ? reject(error) : resolve(done))));
  assert.deepEqual(stats.toJson({ all: false, errors: true, warnings: true }).errors, []);
  writeFileSync(join(built, 'index.html'), '<!doctype html><script type="module" src="./main.mjs"></script>');
  await hasThreads(`${server.origin}/webpack/built/index.html`);
});

test('esbuild, with the worker served as it is', async () => {
  const root = application('esbuild', { workerUrl: '/node_modules/fast-winding/dist/worker.js' });
  await peers('esbuild').build({ entryPoints: [join(root, 'main.js')], bundle: true, format: 'esm', outfile: join(root, 'built', 'main.js'), logLevel: 'silent' });
  writeFileSync(join(root, 'built', 'index.html'), '<!doctype html><script type="module" src="./main.js"></script>');
  await hasThreads(`${server.origin}/esbuild/built/index.html`);
});
