// Written out, so that bundlers find the file. In a module of its own, loaded when needed: webpack splits so large a file
// off its chunk, and then fails to start a worker whose first chunk was split.
export const threadsWasm = new URL('./threads/fast_winding_bg.wasm', import.meta.url);
