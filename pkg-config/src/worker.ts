// The engine's worker in a browser.
import { moreFile, fetchBytes, fetchModule, wasmFile } from './locate.js';
import { serve } from './serve.js';

const answer = serve({
  post: (message, transfer) => self.postMessage(message, { transfer }),
  load: async (build, wasmUrl) => {
    if (wasmUrl) return fetchModule(wasmFile(build, wasmUrl));
    return build === 'threads' ? fetchModule((await import('./threads-wasm.js')).threadsWasm) : undefined;
  },
  more: async (build, wasmUrl) =>
    fetchBytes(wasmUrl ? moreFile(build, wasmUrl) : (await import('./more-wasm.js')).moreWasm[build]),
});
self.addEventListener('message', ({ data }) => answer(data));
