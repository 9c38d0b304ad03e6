// Names what is large in the WebAssembly of the package: KiB of code by module, before wasm-opt, by twiggy.
import { join } from 'node:path';
import { assemble } from './tools/assemble.mjs';
import { StepFailed, output, program, which } from './tools/run.mjs';
import { wasmTarget } from './tools/paths.mjs';

const VARIANT = 'single';
/** Smaller ones are counted together. */
const LEAST_KIB = 8;

/** The module of the crate that a mangled or demangled name belongs to, or the other crate. */
function ownerOf(name) {
  if (/^"?(data|custom|elem|type|import|export|memory|global|table|code)\b/.test(name) || /^"?\.?rodata/.test(name)) return 'tables and constants';
  const own = name.match(/fast_winding(?:\[[0-9a-f]+\])?::(\w+)/);
  if (own) return own[1];
  const crate = name.match(/\b([a-z_][a-z0-9_]*)\[[0-9a-f]+\]/)?.[1] ?? name.match(/^"?<?([a-z_]\w*)::/)?.[1];
  if (!crate) return 'glue and the rest';
  return ['core', 'alloc', 'std'].includes(crate) ? 'standard library' : `crate ${crate}`;
}

await program(async () => {
  if (!which('twiggy')) throw new StepFailed('twiggy is missing: cargo install twiggy');
  await assemble();
  const file = join(wasmTarget(VARIANT), `${VARIANT}-with-names.wasm`);
  const rows = output('twiggy', ['top', '-n', '1000000', '-f', 'csv', file], { maxBuffer: 1 << 28 });
  if (rows === undefined) throw new StepFailed(`twiggy cannot read ${file}`);
  const sizes = new Map();
  for (const line of rows.split('\n').slice(1)) {
    const match = line.match(/^(.*),(\d+),[\d.]+$/);
    if (match) sizes.set(ownerOf(match[1]), (sizes.get(ownerOf(match[1])) ?? 0) + Number(match[2]) / 1024);
  }
  const sorted = [...sizes].sort((a, b) => b[1] - a[1]);
  const rest = sorted.filter(([, size]) => size < LEAST_KIB);
  const shown = [...sorted.filter(([, size]) => size >= LEAST_KIB), [`${rest.length} others`, rest.reduce((sum, [, size]) => sum + size, 0)]];
  for (const [owner, size] of shown) console.log(`${size.toFixed(0).padStart(6)} KiB  ${owner}`);
});
