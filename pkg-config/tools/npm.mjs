// The development tools that come from npm: all of them are listed in www/package.json.
import { cpSync, existsSync, mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pkg, source, www } from './paths.mjs';
import { fingerprint, onceFor } from './inputs.mjs';
import { StepFailed, run, say } from './run.mjs';

const LEAST_NODE = 20;

export function requireNode() {
  if (Number(process.versions.node.split('.')[0]) < LEAST_NODE) {
    throw new StepFailed(`Node ${process.versions.node} is too old: ${LEAST_NODE} or later is needed (https://nodejs.org)`);
  }
}

/** Installs what www/package-lock.json says, unless it is there already. */
export async function npmInstall() {
  requireNode();
  // The page depends on the package by its folder, which must exist before npm links to it.
  if (!existsSync(join(pkg, 'package.json'))) {
    mkdirSync(pkg, { recursive: true });
    cpSync(join(source, 'package.json'), join(pkg, 'package.json'));
  }
  const modules = join(www, 'node_modules');
  const inputs = fingerprint(['www/package.json', 'www/package-lock.json', 'pkg-config/package.json']);
  await onceFor(join(modules, '.installed-for'), inputs, [modules], async () => {
    say('installing npm packages into www/node_modules');
    await run('npm', ['ci', '--ignore-scripts', '--no-audit', '--no-fund'], { cwd: www, quiet: true });
  });
}

/** Path of a program that an npm package of www/ brings, to be run with node. */
export function npmTool(packageName, program) {
  const folder = join(www, 'node_modules', packageName);
  const { bin } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  return join(folder, typeof bin === 'string' ? bin : bin[program]);
}
