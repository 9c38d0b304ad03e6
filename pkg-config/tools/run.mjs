// Runs commands and says so.
import { spawn, spawnSync } from 'node:child_process';
import { delimiter, join } from 'node:path';
import { existsSync } from 'node:fs';

/** A step failed in a way its message explains: no stack trace is needed. */
export class StepFailed extends Error {}

export function say(message) {
  console.log(`\x1b[1m▸ ${message}\x1b[0m`);
}

/** The path of a program on PATH, or undefined. */
export function which(program) {
  const folders = (process.env.PATH ?? '').split(delimiter);
  return folders.map((folder) => join(folder, program)).find(existsSync);
}

/** Standard output of a command, trimmed; undefined when it fails or is missing. */
export function output(command, args, options = {}) {
  const result = spawnSync(command, args, { encoding: 'utf8', ...options });
  return result.status === 0 ? result.stdout.trim() : undefined;
}

/** What runs. When this program ends before it, as another step has failed, it is ended too. */
const running = new Set();
process.on('exit', () => running.forEach((child) => child.kill()));

/**
 * Runs a command with its output shown, or kept quiet until it fails.
 * Resolves to what it printed; rejects with StepFailed when it fails.
 */
export function run(command, args, { cwd, env, quiet = false, timeout } = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(command, args, { cwd, env: { ...process.env, ...env }, stdio: ['ignore', 'pipe', 'pipe'], timeout });
    running.add(child);
    const chunks = [];
    for (const [stream, shown] of [[child.stdout, process.stdout], [child.stderr, process.stderr]]) {
      stream.on('data', (chunk) => {
        chunks.push(chunk);
        if (!quiet) shown.write(chunk);
      });
    }
    const fail = (why) => {
      if (quiet) process.stderr.write(Buffer.concat(chunks));
      reject(new StepFailed(`${command} ${args.join(' ')}: ${why}`));
    };
    child.on('error', (error) => {
      running.delete(child);
      fail(error.message);
    });
    child.on('close', (code, signal) => {
      running.delete(child);
      if (code === 0) resolve(Buffer.concat(chunks).toString());
      else fail(signal ? `ended by ${signal}` : `exit code ${code}`);
    });
  });
}

/** Runs `main` as a program: a StepFailed ends it with its message and exit code 1. */
export async function program(main) {
  try {
    await main();
  } catch (error) {
    console.error(`\n✗ ${error instanceof StepFailed ? error.message : error.stack}`);
    process.exit(1);
  }
}
