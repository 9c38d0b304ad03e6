// The engine's worker in a browser.
import { fetchModule, wasmFile } from './locate.js';
import { serve } from './serve.js';

const answer = serve({
  post: (message, transfer) => self.postMessage(message, { transfer }),
  load: (build, wasmUrl) => {
    if (wasmUrl) return fetchModule(wasmFile(build, wasmUrl));
    // Written out, so that bundlers find the files.
    if (build === 'threads') return fetchModule(new URL('./threads/fast_winding_bg.wasm', import.meta.url));
    return fetchModule(new URL('./single/fast_winding_bg.wasm', import.meta.url));
  },
});
self.addEventListener('message', ({ data }) => answer(data));
