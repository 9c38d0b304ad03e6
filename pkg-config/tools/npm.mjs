// The development tools that come from npm: all of them are listed in www/package.json.
import { cpSync, existsSync, mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { cache, pkg, source, www } from './paths.mjs';
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

/** A folder with packages that only some commands need, installed under the user's cache the first time. */
export async function npmExtra(packages) {
  const folder = join(cache, 'tools', packages.join('-'));
  const done = join(folder, '.installed');
  await onceFor(done, packages.join(' '), [join(folder, 'node_modules')], async () => {
    say(`installing ${packages.join(', ')}`);
    mkdirSync(folder, { recursive: true });
    await run('npm', ['install', '--prefix', folder, '--ignore-scripts', '--no-audit', '--no-fund', ...packages], { cwd: folder, quiet: true });
  });
  return join(folder, 'node_modules');
}
