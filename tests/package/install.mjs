// The package as users get it: packed, then installed in a folder of its own.
import { execFileSync } from 'node:child_process';
import { cpSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { after } from 'node:test';
import { pkg } from '../../pkg-config/tools/paths.mjs';
import { wasmOutput } from '../../pkg-config/tools/wasm.mjs';

const npm = (cwd, ...args) => execFileSync('npm', [...args, '--no-audit', '--no-fund'], { cwd, stdio: 'pipe' });

/** Packs pkg/ into `folder`; returns the tarball's path. */
export function pack(folder) {
  npm(pkg, 'pack', '--pack-destination', folder);
  return join(folder, readdirSync(folder).find((name) => name.endsWith('.tgz')));
}

/** A folder with the packed package installed; it goes when the tests end. */
export function install() {
  const folder = mkdtempSync(join(tmpdir(), 'fast-winding-'));
  after(() => rmSync(folder, { recursive: true, force: true }));
  writeFileSync(join(folder, 'package.json'), '{ "private": true, "type": "module" }\n');
  npm(folder, 'install', '--ignore-scripts', '--offline', pack(folder));
  const home = join(folder, 'node_modules', 'fast-winding');
  return { folder, home, load: (file) => import(pathToFileURL(join(home, 'dist', file)).href) };
}

/** As `install`, with the threads build that panics and traps on demand. */
export function installFaulty() {
  const installed = install();
  cpSync(wasmOutput('faults'), join(installed.home, 'dist', 'threads'), { recursive: true });
  return installed;
}
