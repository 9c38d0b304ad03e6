// Files in and out: read whole, written whole or not at all.
import { randomUUID } from 'node:crypto';
import { link, lstat, mkdir, readFile, rename, rm, writeFile } from 'node:fs/promises';
import { basename, dirname, join } from 'node:path';
import { addAbortSignal } from 'node:stream';

/** A file that could not be read or written. `code` is the system's, such as `ENOENT`. */
export class FileError extends Error {
  constructor(
    readonly code: string,
    message: string,
  ) {
    super(message);
    this.name = 'FileError';
  }
}

const REASONS: Record<string, string> = {
  EEXIST: 'a file is where a folder is needed',
  ENOENT: 'there is no such file or folder',
  EISDIR: 'it is a folder',
  ENOTDIR: 'part of its path is no folder',
  EACCES: 'permission denied',
  EPERM: 'permission denied',
  ENOSPC: 'no space left',
  EROFS: 'the file system is read-only',
};

/** The system's error in words. */
function fileError(error: unknown, doing: string): unknown {
  const { code, message } = error as NodeJS.ErrnoException;
  return typeof code === 'string' && code !== 'ABORT_ERR' ? new FileError(code, `${doing}: ${REASONS[code] ?? message}`) : error;
}

async function standardInput(signal: AbortSignal): Promise<Uint8Array> {
  const chunks: Uint8Array[] = [];
  for await (const chunk of addAbortSignal(signal, process.stdin)) chunks.push(chunk as Uint8Array);
  return Buffer.concat(chunks);
}

/** The bytes of a file, or of standard input for `-`. */
export async function read(path: string, signal: AbortSignal): Promise<Uint8Array> {
  try {
    return path === '-' ? await standardInput(signal) : await readFile(path, { signal });
  } catch (error) {
    throw fileError(error, 'it cannot be read');
  }
}

export async function exists(path: string): Promise<boolean> {
  return lstat(path).then(() => true, () => false);
}

export function refuse(path: string): FileError {
  return new FileError('EEXIST', `${path} exists: --force overwrites it`);
}

/** Gives the file its name, if no other has it. */
async function nameNew(temporary: string, path: string): Promise<void> {
  try {
    await link(temporary, path);
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'EEXIST' || (await exists(path))) throw refuse(path);
    // File systems without hard links.
    await rename(temporary, path);
  }
}

/** Writes a file under another name first, so that it is there whole or not at all; `isForced`, over one that exists. */
export async function writeWhole(path: string, bytes: Uint8Array, isForced: boolean, signal: AbortSignal): Promise<void> {
  const folder = dirname(path);
  const temporary = join(folder, `.${basename(path)}.${randomUUID()}.part`);
  try {
    await mkdir(folder, { recursive: true });
    await writeFile(temporary, bytes, { flag: 'wx', signal });
    await (isForced ? rename(temporary, path) : nameNew(temporary, path));
  } catch (error) {
    throw error instanceof FileError ? error : fileError(error, `${path} cannot be written`);
  } finally {
    await rm(temporary, { force: true }).catch(() => {});
  }
}

/** Writes to standard output, when that can take it. */
export function writeOut(bytes: Uint8Array | string): Promise<void> {
  return new Promise((resolve, reject) => process.stdout.write(bytes, (error) => (error ? reject(error) : resolve())));
}
