// The Rust tool chain for WebAssembly: Debian's rustc-web with rust-web-src, or a nightly of rustup with rust-src.
// Both rebuild the standard library (-Zbuild-std), for threads need one compiled with atomics.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { cache, root, toolsBin } from './paths.mjs';
import { StepFailed, output, run, say, which } from './run.mjs';

const DEBIAN_RUSTC = '/usr/bin/rustc';
const DEBIAN_SOURCE = '/usr/lib/rustlib/src/rust/library';
/** Pinned (Rust 1.97): with 1.101 of 2026-10-29 the threads crash now and then, "memory access out of bounds". */
const NIGHTLY = 'nightly-2026-05-20';
const RUSTUP_TIME_LIMIT = 5 * 60_000;

function sysroot(toolchain) {
  return output('rustc', [`+${toolchain}`, '--print', 'sysroot']);
}

function host() {
  return output('rustc', ['-vV'])?.match(/^host: (.+)$/m)?.[1];
}

function nightlyIsComplete() {
  const folder = sysroot(NIGHTLY);
  return folder !== undefined && existsSync(join(folder, 'lib/rustlib/src/rust/library/Cargo.lock'));
}

/** The lowest Rust this crate accepts, as [major, minor]. */
function leastRust() {
  const version = readFileSync(join(root, 'Cargo.toml'), 'utf8').match(/^rust-version = "(\d+)\.(\d+)/m);
  return [Number(version[1]), Number(version[2])];
}

function debianIsComplete() {
  const version = output(DEBIAN_RUSTC, ['-V'])?.match(/(\d+)\.(\d+)/);
  if (!version || !existsSync(DEBIAN_SOURCE)) return false;
  const [major, minor] = leastRust();
  return Number(version[1]) > major || (Number(version[1]) === major && Number(version[2]) >= minor);
}

async function installWithRustup() {
  say(`installing a Rust nightly with its source: rustup toolchain install ${NIGHTLY}`);
  const args = ['toolchain', 'install', NIGHTLY, '--profile', 'minimal', '--no-self-update'];
  args.push('--component', 'rust-src', '--target', 'wasm32-unknown-unknown');
  await run('rustup', args, { timeout: RUSTUP_TIME_LIMIT, quiet: true }).catch(() => {
    say('rustup could not fetch it');
  });
}

async function installFromDebian() {
  if (!which('apt-get')) return;
  const sudo = process.getuid() === 0 ? [] : ['sudo', '-n'];
  say('installing Debian packages: rustc-web rust-web-src');
  const apt = async (...args) => {
    const [command, ...rest] = [...sudo, 'apt-get', ...args];
    await run(command, rest, { quiet: true, env: { DEBIAN_FRONTEND: 'noninteractive' } });
  };
  try {
    await apt('update');
    await apt('install', '-y', '--no-install-recommends', 'rustc-web', 'rust-web-src');
  } catch (error) {
    say(`apt-get could not install them: ${error.message}`);
  }
}

/** Cargo itself, for native code and as the driver of the wasm builds. */
export function requireCargo() {
  if (which('cargo') && which('rustc')) return;
  throw new StepFailed(
    "cargo is missing. Install Rust: curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh -s -- -y",
  );
}

/** Finds or installs a compiler that can rebuild std for wasm32: 'rustup' or 'debian'. */
export async function wasmToolchain() {
  requireCargo();
  const ready = () => (debianIsComplete() ? 'debian' : nightlyIsComplete() ? 'rustup' : undefined);
  if (ready()) return ready();
  await installFromDebian();
  if (ready()) return ready();
  if (which('rustup')) await installWithRustup();
  if (ready()) return ready();
  throw new StepFailed(
    'no Rust that can build WebAssembly with threads. Either\n' +
      `    rustup toolchain install ${NIGHTLY} --component rust-src --target wasm32-unknown-unknown\n` +
      'or, on Debian,\n' +
      '    apt-get update && apt-get install -y --no-install-recommends rustc-web rust-web-src',
  );
}

/** The variables that make cargo build for wasm32 with that tool chain. Never to be set for a native build. */
export function wasmEnvironment(toolchain) {
  const environment = {
    CARGO_UNSTABLE_BUILD_STD: 'panic_unwind,std',
    CARGO_PROFILE_RELEASE_PANIC: 'unwind',
    CARGO_PROFILE_RELEASE_LTO: 'fat',
    CARGO_PROFILE_RELEASE_CODEGEN_UNITS: '1',
  };
  if (toolchain === 'rustup') environment.RUSTUP_TOOLCHAIN = NIGHTLY;
  if (toolchain === 'debian') {
    if (sysroot('nightly')) environment.RUSTUP_TOOLCHAIN = 'nightly';
    const linkerHome = sysroot('nightly') ?? output('rustc', ['--print', 'sysroot']);
    environment.RUSTC = DEBIAN_RUSTC;
    environment.RUSTDOC = '/usr/bin/rustdoc';
    environment.RUSTC_BOOTSTRAP = '1';
    environment.CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER = join(linkerHome, 'lib/rustlib', host(), 'bin/rust-lld');
  }
  return environment;
}

/** The version of wasm-bindgen in Cargo.lock: its command-line tools must be the same. */
function bindgenVersion() {
  return readFileSync(join(root, 'Cargo.lock'), 'utf8').match(/name = "wasm-bindgen"\nversion = "([^"]+)"/)[1];
}

/** Installs wasm-bindgen and its test runner into the user's cache, unless that version is there. */
export async function bindgenTools() {
  const version = bindgenVersion();
  const found = output(join(toolsBin, 'wasm-bindgen'), ['--version'])?.split(' ')[1];
  if (found !== version) {
    say(`installing wasm-bindgen ${version} into ${cache} (once, some minutes)`);
    const args = ['install', 'wasm-bindgen-cli', '--version', version, '--root', join(cache, 'tools'), '--force'];
    await run('cargo', args, { quiet: true, env: { CARGO_TARGET_DIR: join(cache, 'build') } });
  }
  return { bindgen: join(toolsBin, 'wasm-bindgen'), runner: join(toolsBin, 'wasm-bindgen-test-runner') };
}
