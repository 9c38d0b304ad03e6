/** The file of a build under `wasmUrl`: a folder that holds both builds, or one file. */
export function wasmFile(build: 'threads' | 'single', wasmUrl: string): string {
  if (/\.wasm(\?|#|$)/.test(wasmUrl)) return wasmUrl;
  return `${wasmUrl.replace(/\/?$/, '/')}${build}/fast_winding_bg.wasm`;
}

/** Fetches and compiles WebAssembly. */
export async function fetchModule(url: string | URL): Promise<WebAssembly.Module> {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url} could not be fetched: ${response.status} ${response.statusText}`);
  // Some servers do not know the media type that streaming demands.
  if (response.headers.get('content-type')?.startsWith('application/wasm')) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}
