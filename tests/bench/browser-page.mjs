// Runs in the page of browser.mjs: our package, and three-mesh-bvh's test by a ray, on the same samples.
const REPEATS = 5;
const ENOUGH = 3000;
const WARM_UP = 20_000;

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
/** Zeros and ones as text: the quickest way out of the page. */
const textOf = (inside) => new TextDecoder().decode(inside.map((answer) => 48 + answer));
const bytesAt = async (url) => new Uint8Array(await (await fetch(url)).arrayBuffer());

/** Milliseconds of a fresh shape's first voxels, which build the field, and of the next, which find it built. */
async function runOurs(fw, bytes, count) {
  const shape = await fw.open(bytes);
  const options = { counts: [count, count, count] };
  const start = performance.now();
  const voxels = await shape.voxelize(options);
  const built = performance.now();
  await shape.voxelize(options);
  const end = performance.now();
  shape.free();
  return { included: built - start, excluded: end - built, voxels };
}

export async function ours(modelUrl, count, threads) {
  const { init } = await import('/dist/index.js');
  const fw = await init({ threads });
  const bytes = await bytesAt(modelUrl);
  const begin = performance.now();
  const runs = [await runOurs(fw, bytes, count)];
  while (runs.length <= REPEATS && performance.now() - begin < ENOUGH) runs.push(await runOurs(fw, bytes, count));
  // The first run does not count: the engine's code is compiled as it runs.
  const counted = runs.length > 1 ? runs.slice(1) : runs;
  const { origin, spacing, inside } = runs[0].voxels;
  const result = {
    included: median(counted.map((run) => run.included)),
    excluded: median(counted.map((run) => run.excluded)),
    threads: fw.info.threads,
    inside: textOf(inside),
    origin: [...origin],
    spacing: [...spacing],
  };
  fw.dispose();
  return result;
}

/** A binary PLY of doubles and triangles, as models.mjs writes it, as a geometry of three. */
function geometryOf(bytes, { BufferGeometry, BufferAttribute }) {
  const start = new TextDecoder('latin1').decode(bytes.subarray(0, 500)).indexOf('end_header\n') + 'end_header\n'.length;
  const head = new TextDecoder().decode(bytes.subarray(0, start));
  const count = (element) => Number(head.match(new RegExp(`element ${element} (\\d+)`))[1]);
  const [vertices, faces] = [count('vertex'), count('face')];
  const view = new DataView(bytes.buffer, bytes.byteOffset + start);
  const positions = Float32Array.from({ length: 3 * vertices }, (_, i) => view.getFloat64(8 * i, true));
  const at = (face, corner) => view.getInt32(24 * vertices + 13 * face + 1 + 4 * corner, true);
  const indices = Uint32Array.from({ length: 3 * faces }, (_, i) => at(Math.floor(i / 3), i % 3));
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(indices, 1));
  return geometry;
}

/** Its documented test: a point is inside when the first face that a ray hits, of either side, looks the ray's way. */
function askByRay(bvh, { Ray, Vector3, DoubleSide }, origin, spacing, count, limit) {
  const ray = new Ray(new Vector3(), new Vector3(0, 0, 1));
  const inside = new Uint8Array(Math.min(count ** 3, limit));
  for (let i = 0; i < inside.length; i++) {
    const [x, y, z] = [i % count, Math.floor(i / count) % count, Math.floor(i / count ** 2)];
    ray.origin.set(origin[0] + spacing[0] * x, origin[1] + spacing[1] * y, origin[2] + spacing[2] * z);
    const hit = bvh.raycastFirst(ray, DoubleSide);
    inside[i] = hit && hit.face.normal.dot(ray.direction) > 0 ? 1 : 0;
  }
  return inside;
}

export async function theirs(modelUrl, count, origin, spacing) {
  const three = await import('three');
  const { MeshBVH } = await import('three-mesh-bvh');
  const bytes = await bytesAt(modelUrl);
  const runs = [];
  const begin = performance.now();
  let inside;
  while (!runs.length || (runs.length < REPEATS && performance.now() - begin < ENOUGH)) {
    const geometry = geometryOf(bytes, three);
    const start = performance.now();
    const bvh = new MeshBVH(geometry);
    const build = performance.now() - start;
    askByRay(bvh, three, origin, spacing, count, WARM_UP);
    const asked = performance.now();
    inside = askByRay(bvh, three, origin, spacing, count, Infinity);
    runs.push({ build, queries: performance.now() - asked });
  }
  const excluded = median(runs.map((run) => run.queries));
  return { excluded, included: excluded + median(runs.map((run) => run.build)), inside: textOf(inside) };
}
