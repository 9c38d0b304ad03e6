// Puts the npm package together in pkg/: both WebAssembly builds, the compiled TypeScript, manifest, README, licences.
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';
import { fingerprint, onceFor } from './inputs.mjs';
import { npmInstall, npmTool } from './npm.mjs';
import { pkg, root, source, wasmTarget } from './paths.mjs';
import { StepFailed, run, say } from './run.mjs';
import { MORE, buildVariant, wasmOutput } from './wasm.mjs';

/** Most KiB that a build may weigh after brotli, without what is loaded only when needed. */
const BUDGETS = { single: 250, threads: 300 };
const VARIANTS = ['threads', 'single'];
const GLUE = ['fast_winding.js', 'fast_winding.d.ts', 'fast_winding_bg.wasm', 'fast_winding_bg.wasm.d.ts', MORE, 'memory.js', 'memory.d.ts'];

function copyGlue(variant, dist) {
  const target = join(dist, variant);
  mkdirSync(target, { recursive: true });
  for (const name of GLUE) {
    const from = join(wasmOutput(variant), name);
    if (existsSync(from)) cpSync(from, join(target, name));
  }
}

const wasmOf = (variant, name = 'fast_winding_bg.wasm') => readFileSync(join(pkg, 'dist', variant, name));

function reportSizes() {
  console.log('  build      raw KiB   gzip KiB   brotli KiB   budget');
  const line = (title, wasm, budget) => {
    const sizes = [wasm, gzipSync(wasm, { level: 9 }), brotliCompressSync(wasm)].map((data) => data.length / 1024);
    const [raw, gzip, brotli] = sizes.map((size) => size.toFixed(0));
    console.log(`  ${title.padEnd(8)}${raw.padStart(10)}${gzip.padStart(11)}${brotli.padStart(13)}${budget.padStart(9)}`);
  };
  for (const variant of VARIANTS) {
    line(variant, wasmOf(variant), String(BUDGETS[variant]));
    line('+ later', wasmOf(variant, MORE), '');
  }
}

/** Fails when a build is too large: a matter for the tests, not for somebody who wants to see the page. */
export function requireBudgets() {
  for (const variant of VARIANTS) {
    const size = brotliCompressSync(wasmOf(variant)).length / 1024;
    if (size > BUDGETS[variant]) {
      throw new StepFailed(`the ${variant} build weighs ${size.toFixed(1)} KiB after brotli: at most ${BUDGETS[variant]} are allowed`);
    }
  }
}

async function compileAndCopy() {
  say('assembling pkg/');
  const dist = join(pkg, 'dist');
  rmSync(dist, { recursive: true, force: true });
  for (const variant of VARIANTS) copyGlue(variant, dist);
  await run('node', [npmTool('typescript', 'tsc'), '-p', join(source, 'tsconfig.json')], { cwd: root });
  cpSync(join(source, 'package.json'), join(pkg, 'package.json'));
  cpSync(join(source, 'README.md'), join(pkg, 'README.md'));
  for (const name of ['LICENSE-MIT', 'LICENSE-APACHE']) cpSync(join(root, name), join(pkg, name));
}

/** Builds what is missing and assembles pkg/, unless it is as the sources say. Answers whether anything changed. */
export async function assemble() {
  await npmInstall();
  let isChanged = false;
  for (const variant of VARIANTS) isChanged = (await buildVariant(variant)) || isChanged;
  const stamps = VARIANTS.map((variant) => readFileSync(join(wasmTarget(variant), `built-${variant}`), 'utf8'));
  const own = ['package.json', 'README.md', 'tsconfig.json', 'src', 'tools'].map((name) => `pkg-config/${name}`);
  const inputs = fingerprint([...own, 'LICENSE-MIT', 'LICENSE-APACHE'], stamps);
  const results = [join(pkg, 'dist', 'index.js'), join(pkg, 'README.md')];
  isChanged = (await onceFor(join(pkg, '.assembled-from'), inputs, results, compileAndCopy)) || isChanged;
  if (isChanged) reportSizes();
  else say('pkg/ is up to date');
  return isChanged;
}
