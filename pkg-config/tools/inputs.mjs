// One number for everything a build step reads, so that it is skipped when nothing changed.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { root } from './paths.mjs';

function* files(path) {
  if (!existsSync(path)) return;
  if (statSync(path).isFile()) return yield path;
  for (const name of readdirSync(path).sort()) {
    if (name !== 'node_modules') yield* files(join(path, name));
  }
}

/** A hash over the names and contents of files and folders (relative to the repository) and some more words. */
export function fingerprint(paths, words = []) {
  const hash = createHash('sha256');
  for (const word of words) hash.update(`${word}\0`);
  for (const path of paths) {
    for (const file of files(join(root, path))) {
      hash.update(`${relative(root, file)}\0`).update(readFileSync(file)).update('\0');
    }
  }
  return hash.digest('hex');
}

/** Runs `step` unless the stamp at `stampFile` says that the same inputs were done and `results` exist. */
export async function onceFor(stampFile, inputs, results, step) {
  const isDone = existsSync(stampFile) && readFileSync(stampFile, 'utf8') === inputs && results.every(existsSync);
  if (isDone) return false;
  await step();
  mkdirSync(dirname(stampFile), { recursive: true });
  writeFileSync(stampFile, inputs);
  return true;
}
