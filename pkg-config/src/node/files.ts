import { readFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';
import { type Build, moreFile, fetchBytes, wasmFile } from '../locate.js';

async function bytesOf(url: URL): Promise<ArrayBuffer> {
  return url.protocol === 'file:' ? Uint8Array.from(await readFile(url)).buffer : fetchBytes(url);
}

/** The WebAssembly of a build, under `wasmUrl` or in this package. */
export async function moduleOf(build: Build, wasmUrl: string | undefined): Promise<WebAssembly.Module> {
  const beside = new URL(`../${build}/fast_winding_bg.wasm`, import.meta.url);
  return WebAssembly.compile(await bytesOf(wasmUrl ? new URL(wasmFile(build, wasmUrl), pathToFileURL('./')) : beside));
}

/** The part of it that is loaded when first needed. */
export async function moreOf(build: Build, wasmUrl: string | undefined): Promise<ArrayBuffer> {
  const beside = new URL(`../${build}/fast_winding_more.wasm`, import.meta.url);
  return bytesOf(wasmUrl ? new URL(moreFile(build, wasmUrl), pathToFileURL('./')) : beside);
}
