export type Build = 'threads' | 'single';

/** The file of a build under `wasmUrl`: a folder that holds both builds, or one file. */
export function wasmFile(build: Build, wasmUrl: string): string {
  if (/\.wasm(\?|#|$)/.test(wasmUrl)) return wasmUrl;
  return `${wasmUrl.replace(/\/?$/, '/')}${build}/fast_winding_bg.wasm`;
}

/** The file beside it with what is loaded when first needed. */
export function moreFile(build: Build, wasmUrl: string): string {
  return wasmFile(build, wasmUrl).replace(/[^/]*\.wasm/, 'fast_winding_more.wasm');
}

async function fetched(url: string | URL): Promise<Response> {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url} could not be fetched: ${response.status} ${response.statusText}`);
  return response;
}

export async function fetchBytes(url: string | URL): Promise<ArrayBuffer> {
  return (await fetched(url)).arrayBuffer();
}

/** Fetches and compiles WebAssembly. */
export async function fetchModule(url: string | URL): Promise<WebAssembly.Module> {
  const response = await fetched(url);
  // Some servers do not know the media type that streaming demands.
  if (response.headers.get('content-type')?.startsWith('application/wasm')) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}
