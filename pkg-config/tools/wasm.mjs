// The two WebAssembly builds, from one source: `threads` (shared memory, atomics, SIMD) and `single` (SIMD).
import { cpSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { npmTool } from './npm.mjs';
import { fingerprint, onceFor } from './inputs.mjs';
import { root, wasmTarget } from './paths.mjs';
import { StepFailed, run, say } from './run.mjs';
import { bindgenTools, wasmEnvironment, wasmToolchain } from './rust.mjs';
import { split } from './split.mjs';

/** The file beside `fast_winding_bg.wasm` with what is loaded when first needed: all but fields, voxels and files. */
export const MORE = 'fast_winding_more.wasm';
const IN_MORE = new RegExp(
  [
    String.raw`fast_winding\[[0-9a-f]+\]::(${[
      String.raw`arrangement|check(?!::(boundary|components)\b)|distance|estimate|orient|polygon|print|repair|surface|charge|texture`,
      'data::(bricks|directory|edges|topology)|bvh::(disc|first_hit|narrow|overlaps)|io::write::(dxf|json|nrrd|svg|textured|threemf|vox)|io::threemf',
      'levelset::(cubes|cube_cases|bricks|blur|roots|sampling|squares)|math::(closest|random|ray|triangles_meet)',
      'solid::(boolean|continuation|difference|distance|voxel_surface)|treecode::mutual|winding::baselines',
      'wasm::(boolean|checking|distance|layers|printing|repairing|texture_(failure|options)|texturing|projecting|voxels)',
    ].join('|')})::`,
    String.raw`fast_winding\[[0-9a-f]+\]::(slice::(?!heat_map)|solid::voxels::voxelize_(by_rays|bricks))`,
    String.raw`fast_winding\[[0-9a-f]+\]::(winding|treecode|wasm|data)::[\w:]+(<.*>)?>::(save|load)\b`,
    String.raw`\b(i_(overlay|float|shape|tree|key_sort)|spade)\[|\b(quick_xml|flate2|miniz_oxide|crc32fast)\[`,
    `^(toolpaths|gcode|printSettings|exportLayers?|exportVoxels|compareVoxels|voxelSurface)$`,
    `^handle_(slice|layerSpans|surface|noise|save|voxelBricks|check|orientFaces|signedDistance|distanceLattice|closestPoints|offset|hollow|repair|boolean|texture|suggestOffset|project)$`,
    '^(__wbg_)?texturehandle_',
  ].join('|'),
);

const RUST_INPUTS = ['Cargo.toml', 'Cargo.lock', 'src', 'pkg-config/tools'];
/**
 * A panic's place in the source would cost a tenth of the download; its message stays. Less inlining than LLVM's 225 saves
 * another twentieth; the kernels, which matter for speed, ask for theirs in the source. Newer compilers unwind by exnref,
 * which Node 20 does not know: the older instructions run everywhere. Functions that are equal by chance stay apart: one name
 * for two of them would put into the part that is loaded later what is needed sooner.
 */
const LLVM = ['-inline-threshold=60', '-wasm-use-legacy-eh=true'].map((option) => `-C llvm-args=${option}`).join(' ');
const COMMON = `-C panic=unwind -Z location-detail=none -Z merge-functions=disabled ${LLVM}`;
const SIMD = `${COMMON} -C target-feature=+bulk-memory,+mutable-globals,+simd128`;
const THREADS = [
  `${COMMON} -C target-feature=+atomics,+bulk-memory,+mutable-globals,+simd128`,
  ...['shared-memory', 'max-memory=4294967296', 'import-memory'].map((a) => `-C link-arg=--${a}`),
  ...['__wasm_init_tls', '__tls_size', '__tls_align', '__tls_base', '__heap_base'].map((s) => `-C link-arg=--export=${s}`),
].join(' ');

/** With ssa-nomerge (binaryen 132) the threads build hangs for ever when its pool is made; no other pass of -O3 does that. */
const OPTIMISATION = ['-O3', '--skip-pass=ssa-nomerge'];
/** Follows constants and types through the whole program: half a KiB less. */
const SMALL_OPTIMISATION = [...OPTIMISATION, '-O3', '--gufa', '-O3'];

/** What reads archives and XML, for once a file. */
const SMALL_PACKAGES = ['quick-xml', 'flate2', 'miniz_oxide', 'crc32fast', 'memchr', 'serde-wasm-bindgen', 'robust'];
const small = (name) => ['--config', `profile.release.package.${name}.opt-level="s"`];

/**
 * What makes the build without threads smaller: the library alone (together with an rlib, cargo leaves out the optimisation
 * across crates), small sorts and formatting in place of fast ones (what is hot here sorts by buckets, and formats nothing),
 * and small readers of archives. The threads build has room without them; with them its pool of one thread sometimes never starts.
 */
const SMALL = {
  command: ['rustc', '--lib', '--crate-type', 'cdylib', ...SMALL_PACKAGES.flatMap(small)],
  environment: { CARGO_UNSTABLE_BUILD_STD_FEATURES: 'panic-unwind,optimize_for_size' },
  optimisation: SMALL_OPTIMISATION,
};
/** For builds that only tests use: the crate itself is compiled in less time, what it takes from others is as it was. */
export const QUICK = ['--config', 'profile.release.package.fast-winding.opt-level=1'];
const PLAIN = { command: ['build', '--lib'], environment: {}, optimisation: OPTIMISATION };

/** Each build by name: its flags, the target directory it shares, features of the crate, how it is compiled and optimised. */
const VARIANTS = {
  threads: { flags: THREADS, target: 'threads', features: ['pieces'], ...PLAIN },
  single: { flags: SIMD, target: 'single', features: ['pieces'], ...SMALL },
  /** Not part of the package: the threads build with calls that panic and trap on purpose, compiled in less time. */
  faults: { flags: THREADS, target: 'threads', features: ['pieces', 'faults'], command: ['build', '--lib', ...QUICK], environment: {}, optimisation: ['-O1'] },
};

/** Runs cargo for wasm32 with the flags of `variant`; `args` begin with the command. Resolves to what it printed. */
export async function wasmCargo(variant, args, { quiet = false, ...environment } = {}) {
  const { flags, target } = VARIANTS[variant];
  const env = {
    ...wasmEnvironment(await wasmToolchain()),
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS: flags,
    CARGO_TARGET_DIR: wasmTarget(target),
    ...environment,
  };
  return run('cargo', [...args, '--target', 'wasm32-unknown-unknown', '--release'], { cwd: root, env, quiet });
}

/** Folder of the finished build of a variant: fast_winding.js, fast_winding_bg.wasm, perhaps snippets/. */
export function wasmOutput(variant) {
  return join(wasmTarget(VARIANTS[variant].target), `out-${variant}`);
}

/** Replaces the one place of `file` that `pattern` describes. */
function replaceOnce(file, pattern, replacement) {
  const before = readFileSync(file, 'utf8');
  if (before.split(pattern).length !== 2) throw new StepFailed(`wasm-bindgen's ${file} is not as expected: ${pattern}`);
  writeFileSync(file, before.replace(pattern, replacement));
}

/**
 * The thread pool's JavaScript is ours (src/pool.ts): the one that wasm-bindgen-rayon brings imports a folder, which only
 * some bundlers resolve, and lets a trap in a pool worker go unheard. Where the WebAssembly lies is said by
 * src/threads-wasm.ts alone: if the workers of the pool named it too, webpack would split it off and fail to load it.
 */
function replacePoolHelpers(folder) {
  const glue = join(folder, 'fast_winding.js');
  replaceOnce(glue, /'\.\/snippets\/wasm-bindgen-rayon-[^']+'/, "'../pool.js'");
  replaceOnce(glue, /new URL\('fast_winding_bg\.wasm', import\.meta\.url\)/, "'fast_winding_bg.wasm'");
  rmSync(join(folder, 'snippets'), { recursive: true });
}

/**
 * The least size of the shared memory, in pages of 64 KiB, for the client, which makes that memory itself; and how many
 * bytes the part that is loaded later has, which goes to all threads in shared memory.
 */
function writeSizes(folder) {
  const pages = readFileSync(join(folder, 'fast_winding.js'), 'utf8').match(/Memory\(\{\s*initial:\s*(\d+)/)?.[1];
  if (!pages) throw new StepFailed(`wasm-bindgen's output in ${folder} does not say how large its memory starts`);
  const sizes = { initialPages: pages, moreBytes: statSync(join(folder, MORE)).size };
  const lines = Object.entries(sizes).map(([name, size]) => `export const ${name} = ${size};\n`);
  writeFileSync(join(folder, 'memory.js'), lines.join(''));
  writeFileSync(join(folder, 'memory.d.ts'), Object.keys(sizes).map((name) => `export declare const ${name}: number;\n`).join(''));
}

async function bindAndOptimise(variant) {
  const { target, optimisation } = VARIANTS[variant];
  const folder = wasmOutput(variant);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const compiled = join(wasmTarget(target), 'wasm32-unknown-unknown/release/fast_winding.wasm');
  const { bindgen } = await bindgenTools();
  // So that `./sync`, whose engine lives as long as its module, can begin anew after a crash.
  const reset = target === 'single' ? ['--experimental-reset-state-function'] : [];
  await run(bindgen, ['--target', 'web', ...reset, '--out-dir', folder, '--out-name', 'fast_winding', compiled]);
  if (target === 'threads') replacePoolHelpers(folder);
  const wasm = join(folder, 'fast_winding_bg.wasm');
  cpSync(wasm, join(wasmTarget(target), `${variant}-with-names.wasm`));
  say(`${variant}: splitting and wasm-opt`);
  await split(wasm, join(folder, MORE), IN_MORE, optimisation);
  if (target === 'threads') writeSizes(folder);
  await run('node', [npmTool('binaryen', 'wasm-opt'), ...optimisation, wasm, '-o', wasm]);
}

/** Builds one variant unless its sources are as they were. Answers whether anything had to be done. */
export async function buildVariant(variant) {
  const { target, features, command, environment } = VARIANTS[variant];
  const stamp = join(wasmTarget(target), `built-${variant}`);
  const results = ['fast_winding_bg.wasm', MORE].map((name) => join(wasmOutput(variant), name));
  return onceFor(stamp, fingerprint(RUST_INPUTS, [variant]), results, async () => {
    say(`${variant}: compiling the WebAssembly build (some minutes the first time)`);
    await wasmCargo(variant, [...command, ...(features.length ? ['--features', features.join()] : [])], environment);
    await bindAndOptimise(variant);
  });
}
