// Names what is large in the WebAssembly of the package: KiB of code by module, before wasm-opt, by twiggy.
import { join } from 'node:path';
import { assemble } from './tools/assemble.mjs';
import { StepFailed, output, program, which } from './tools/run.mjs';
import { wasmTarget } from './tools/paths.mjs';

const VARIANT = 'single';
/** Smaller ones are counted together. */
const LEAST_KIB = 8;

/** A row of twiggy's table: its name, which may hold commas, and its bytes; the last two columns stay empty. */
const ROW = /^(.*),(\d+),[\d.]+,,$/;

/** Whose code or data an item is: a module of the crate, another crate, or one of the calls it exports. Names of functions are not shipped. */
function ownerOf(item) {
  if (/subsection|^"*custom section/.test(item)) return undefined;
  if (/^"*data segment/.test(item)) return 'constants';
  const own = item.match(/fast_winding\[[0-9a-f]+\]::(\w+)/)?.[1];
  if (own) return own;
  const crate = item.match(/\b([a-z]\w*)\[[0-9a-f]+\]/)?.[1];
  if (!crate) return 'calls from JavaScript';
  return ['core', 'alloc', 'std'].includes(crate) ? 'standard library' : `${crate} (crate)`;
}

await program(async () => {
  if (!which('twiggy')) throw new StepFailed('twiggy is missing: cargo install twiggy');
  await assemble();
  const file = join(wasmTarget(VARIANT), `${VARIANT}-with-names.wasm`);
  const rows = output('twiggy', ['top', '-n', '1000000', '-f', 'csv', file], { maxBuffer: 1 << 28 });
  if (rows === undefined) throw new StepFailed(`twiggy cannot read ${file}`);
  const sizes = new Map();
  for (const line of rows.split('\n')) {
    const [, item, bytes] = line.match(ROW) ?? [];
    const owner = item && ownerOf(item);
    if (owner) sizes.set(owner, (sizes.get(owner) ?? 0) + Number(bytes) / 1024);
  }
  const sorted = [...sizes].sort((a, b) => b[1] - a[1]);
  const rest = sorted.filter(([, size]) => size < LEAST_KIB);
  const shown = [...sorted.filter(([, size]) => size >= LEAST_KIB), [`${rest.length} others`, rest.reduce((sum, [, size]) => sum + size, 0)]];
  for (const [owner, size] of shown) console.log(`${size.toFixed(0).padStart(6)} KiB  ${owner}`);
});
