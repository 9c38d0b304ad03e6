// manifold-3d (npm), which benches stand beside. It is no dependency of the project: it lies in the user's cache.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync } from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';

const cache = join(process.env.XDG_CACHE_HOME || join(homedir(), '.cache'), 'fast-winding');
/** Where what layers and solids are held against is kept. */
export const peersFolder = join(cache, 'layer-peers');
const PEER = { name: 'manifold-3d', version: '3.5.4' };

/** Its module, ready; installed first where it is missing. */
export async function manifold() {
  const folder = join(peersFolder, 'node_modules', PEER.name);
  if (!existsSync(folder)) {
    mkdirSync(peersFolder, { recursive: true });
    execFileSync('npm', ['install', '--silent', '--no-save', '--prefix', peersFolder, `${PEER.name}@${PEER.version}`]);
  }
  const peer = await (await import(join(folder, 'manifold.js'))).default();
  peer.setup();
  return peer;
}
