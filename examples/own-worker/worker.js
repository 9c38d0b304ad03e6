import { init } from './node_modules/fast-winding/dist/sync.js';

const ready = init();

self.addEventListener('message', async ({ data: { radius, resolution } }) => {
  const fw = await ready;
  // An octahedron: each of its faces has a corner on every axis.
  const positions = new Float64Array([1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1].map((x) => radius * x));
  const indices = new Uint32Array([0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5]);
  const soup = fw.Soup.from({ positions, indices });
  const { inside, count, volume } = soup.voxelize({ resolution });
  soup.free();
  self.postMessage({ inside, count, volume }, [inside.buffer]);
});
