// The engine's worker in a browser.
import { cloudsFile, fetchBytes, fetchModule, wasmFile } from './locate.js';
import { serve } from './serve.js';

const answer = serve({
  post: (message, transfer) => self.postMessage(message, { transfer }),
  load: async (build, wasmUrl) => {
    if (wasmUrl) return fetchModule(wasmFile(build, wasmUrl));
    return build === 'threads' ? fetchModule((await import('./threads-wasm.js')).threadsWasm) : undefined;
  },
  clouds: async (build, wasmUrl) =>
    fetchBytes(wasmUrl ? cloudsFile(build, wasmUrl) : (await import('./clouds-wasm.js')).cloudsWasm[build]),
});
self.addEventListener('message', ({ data }) => answer(data));
