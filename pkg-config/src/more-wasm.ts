// Written out, so that bundlers find the files; apart, so that they are named only where they are loaded.
export const moreWasm = {
  threads: new URL('./threads/fast_winding_more.wasm', import.meta.url),
  single: new URL('./single/fast_winding_more.wasm', import.meta.url),
};
