// Runs every test of the project and shows each runner's closing lines; stops at the first step that fails, with its output.
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { assemble, requireBudgets } from './tools/assemble.mjs';
import { browser } from './tools/browser.mjs';
import { npmInstall } from './tools/npm.mjs';
import { references } from './tools/reference.mjs';
import { root, www } from './tools/paths.mjs';
import { program, run, say } from './tools/run.mjs';
import { bindgenTools, requireCargo } from './tools/rust.mjs';
import { QUICK, buildVariant, wasmCargo } from './tools/wasm.mjs';

/** What the runners say at their end: cargo's and wasm-bindgen's, node's. */
const CLOSING_LINES = /^(test result: .*|[#ℹ] (?:tests|pass|fail|skipped|duration_ms) .*|.*built in .*)$/gm;

/** A suite that takes longer hangs: 15 minutes. */
const LIMIT = '--test-timeout=900000';

async function step(name, action) {
  say(name);
  const start = performance.now();
  const output = await action();
  say(`${name}: passed in ${((performance.now() - start) / 1000).toFixed(0)} s`);
  for (const [line] of (output ?? '').matchAll(CLOSING_LINES)) console.log(`  ${line}`);
}

const cargo = (...args) => run('cargo', args, { cwd: root, quiet: true });

function nodeTests(folder, env) {
  const tests = readdirSync(join(root, folder)).filter((name) => name.endsWith('.test.mjs'));
  const paths = tests.map((name) => join(folder, name));
  return run('node', ['--test', '--test-concurrency=1', LIMIT, ...paths], { cwd: root, env, quiet: true });
}

async function wasmTests({ chromedriver }) {
  const { runner } = await bindgenTools();
  return wasmCargo('threads', ['test', '--test', 'wasm', '--features', 'wasm-test', ...QUICK], {
    quiet: true,
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER: runner,
    CHROMEDRIVER: chromedriver,
    WASM_BINDGEN_TEST_WEBDRIVER_JSON: join(root, 'tests/wasm/webdriver.json'),
    WASM_BINDGEN_TEST_TIMEOUT: '300',
  });
}

await program(async () => {
  requireCargo();
  await npmInstall();
  await step('rustfmt', () => cargo('fmt', '--check'));
  await step('clippy', () => cargo('clippy', '--all-targets', '--', '-D', 'warnings'));
  // Either leaves processors idle at times: while a linker or wasm-opt runs.
  await Promise.all([
    step('native tests and doc tests', () => cargo('test', '--no-fail-fast')),
    step('npm package', () => assemble().then(() => requireBudgets())),
  ]);
  await step('API references without warnings', references);
  const found = await browser();
  await step('WebAssembly tests in headless Chromium, two threads', () => wasmTests(found));
  await step('package tests', async () => {
    await buildVariant('faults');
    return nodeTests('tests/package', { CHROMIUM: found.chromium });
  });
  await step('page: types and production build', () => run('npm', ['run', 'build'], { cwd: www, quiet: true }));
  await step('page tests in headless Chromium', () => nodeTests('tests/page', { CHROMIUM: found.chromium }));
  say('every test passed');
});
