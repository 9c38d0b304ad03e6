// The engine's worker, watched: it can be told to limit its memory, to say how large that is, and to end a thread of its pool.
// Loaded by hardening.test.mjs in place of the package's worker, from beside its dist/ folder.
const limit = Number(new URLSearchParams(location.search).get('pages')) || Infinity;
const memories = [];
const threads = [];

const { Memory, instantiate, instantiateStreaming } = WebAssembly;
WebAssembly.Memory = function (limits) {
  const maximum = limits.maximum && Math.min(limits.maximum, limits.initial + limit);
  const memory = new Memory({ ...limits, maximum });
  memories.push(memory);
  return memory;
};
WebAssembly.Memory.prototype = Memory.prototype;
/** Notes the memory that an instance brings along, and hands the instance on. */
const noted = (result) => {
  const { memory } = (result.instance ?? result).exports;
  if (memory) memories.push(memory);
  return result;
};
WebAssembly.instantiate = async (...args) => noted(await instantiate(...args));
WebAssembly.instantiateStreaming = async (...args) => noted(await instantiateStreaming(...args));

const { Worker } = self;
self.Worker = class extends Worker {
  constructor(...args) {
    super(...args);
    threads.push(this);
  }
};

self.addEventListener('message', (event) => {
  const { data } = event;
  if (data.type === 'end-thread') threads[data.thread].terminate();
  else if (data.type === 'memory') data.port.postMessage(Math.max(...memories.map(({ buffer }) => buffer.byteLength)));
  else return;
  event.stopImmediatePropagation();
});
