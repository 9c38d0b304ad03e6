// Layers beside manifold-3d (npm) and trimesh (PyPI): times on models that are closed, areas of each layer, and what each makes of
// models that are broken. Run by `npm --prefix www run bench layers [-- --quick]`.
import { execFileSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { init } from '../../pkg/dist/node/index.js';
import { init as initSync } from '../../pkg/dist/node/sync.js';
import { model } from './models.mjs';
import { manifold, peersFolder } from './manifold.mjs';
import { markdown, median, milliseconds, modelsFolder, repeat } from './measuring.mjs';

const isQuick = process.argv.includes('--quick');
const LAYERS = isQuick ? 10 : 100;
/** What is to be reached beside manifold-3d: parsing to layers, layers alone; of areas; of the second thread; open to closed. */
const GOALS = { whole: 4, alone: 1, area: 1e-6, gain: 1.7, open: 3 };


/** What manifold-3d makes of a mesh: its layers' areas, and how long it took; or why it refuses it. */
function slicedByManifold({ Manifold, Mesh }, { positions, indices, heights, merge }) {
  const start = performance.now();
  const mesh = new Mesh({ numProp: 3, vertProperties: positions, triVerts: indices });
  if (merge) mesh.merge();
  let solid;
  try {
    solid = new Manifold(mesh);
  } catch (error) {
    return { refusal: error.message };
  }
  if (solid.status() !== 'NoError') return { refusal: solid.status() };
  const built = performance.now();
  const sections = heights.map((z) => solid.slice(z));
  const polygons = sections.map((section) => section.toPolygons());
  const end = performance.now();
  const areas = sections.map((section) => section.area());
  sections.forEach((section) => section.delete());
  solid.delete();
  return { construct: built - start, slice: end - built, areas, count: polygons.flat().length };
}

/** The same by ours: the time of the whole, and of the layers alone once the field is built. */
async function slicedByOurs(fw, { positions, indices, layerHeight }) {
  const start = performance.now();
  const soup = await fw.Soup.from({ positions, indices });
  const layers = await soup.slice({ layerHeight });
  const whole = performance.now() - start;
  const again = performance.now();
  await soup.slice({ layerHeight });
  const slice = performance.now() - again;
  soup.free();
  return { whole, slice, layers };
}

const areaOf = (ring) => {
  let twice = 0;
  for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2) twice += ring[j] * ring[i + 1] - ring[i] * ring[j + 1];
  return twice / 2;
};
const areaOfLayer = ({ polygons }) =>
  polygons.reduce((sum, { outer, holes }) => sum + [outer, ...holes].reduce((s, ring) => s + areaOf(ring), 0), 0);

/** Area of each layer of a closed mesh without overlaps, by the definition: the sum over all triangles of what their segments span. */
function areasOfSections({ positions, indices, heights, layerHeight }) {
  const areas = new Float64Array(heights.length);
  for (let t = 0; t < indices.length; t += 3) {
    const corners = [0, 1, 2].map((k) => [...positions.subarray(3 * indices[t + k], 3 * indices[t + k] + 3)]);
    const [low, high] = [Math.min, Math.max].map((pick) => pick(...corners.map((p) => p[2])));
    let k = Math.max(0, Math.floor((low - heights[0]) / layerHeight) - 1);
    for (; k < heights.length && heights[k] < high; k++) {
      if (heights[k] < low) continue;
      const ends = [];
      for (let c = 0; c < 3; c++) {
        const [p, q] = [corners[c], corners[(c + 1) % 3]];
        if (p[2] <= heights[k] === q[2] <= heights[k]) continue;
        const share = (heights[k] - p[2]) / (q[2] - p[2]);
        ends[p[2] <= heights[k] ? 1 : 0] = [0, 1].map((axis) => p[axis] + share * (q[axis] - p[axis]));
      }
      areas[k] += (ends[0][0] * ends[1][1] - ends[0][1] * ends[1][0]) / 2;
    }
  }
  return areas;
}

async function opened(fw, name) {
  const soup = await fw.Soup.parse(await readFile(model(modelsFolder, name)));
  const { positions, indices, origin } = await soup.geometry();
  const exact = Float64Array.from(positions, (x, i) => x + origin[i % 3]);
  soup.free();
  // Manifold takes single precision: both slice what that holds.
  const single = Float32Array.from(exact);
  const z = single.filter((_, i) => i % 3 === 2);
  const [low, high] = [z.reduce((a, b) => Math.min(a, b)), z.reduce((a, b) => Math.max(a, b))];
  const layerHeight = (high - low) / LAYERS;
  const heights = Array.from({ length: LAYERS }, (_, k) => low + (k + 0.5) * layerHeight);
  return { positions: single, indices, heights, layerHeight };
}

async function compareClosed(fw, threaded, peer) {
  const rows = [];
  for (const name of ['bumpy70k', 'knot124k', 'bumpy1m'].slice(0, isQuick ? 1 : 3)) {
    const mesh = await opened(fw, name);
    let theirs, ours;
    const theirWhole = await repeat(async () => {
      theirs = slicedByManifold(peer, mesh);
      if (theirs.refusal) throw new Error(`${name}: ${theirs.refusal}`);
      return theirs.construct + theirs.slice;
    });
    const theirSlices = await repeat(async () => slicedByManifold(peer, mesh).slice);
    const alone = [];
    const whole = await repeat(async () => {
      ours = await slicedByOurs(fw, mesh);
      alone.push(ours.slice);
      return ours.whole;
    });
    const withThreads = async (engine) => {
      const slices = [];
      const whole = await repeat(async () => {
        const made = await slicedByOurs(engine, mesh);
        slices.push(made.slice);
        return made.whole;
      });
      return [whole, median(slices)];
    };
    const [threadedWhole, threadedAlone] = await withThreads(threaded);
    const [oneThreadWhole, oneThreadAlone] = await withThreads(one);
    const truth = areasOfSections(mesh);
    const worst = (areas) => Math.max(...areas.map((area, k) => Math.abs(area / truth[k] - 1)).filter(Number.isFinite)).toExponential(1);
    rows.push({
      model: `${name}, ${mesh.indices.length / 3} triangles`,
      'construct + slice': milliseconds(theirWhole),
      'ours whole': milliseconds(whole),
      ratio: `${(theirWhole / whole).toFixed(1)} × (${GOALS.whole})`,
      'slice alone': milliseconds(theirSlices),
      'ours alone': milliseconds(median(alone)),
      'ratio alone': `${(theirSlices / median(alone)).toFixed(2)} × (${GOALS.alone})`,
      'gain of 2 threads': `${(oneThreadWhole / threadedWhole).toFixed(2)} × (${GOALS.gain})`,
      'gain in layers alone': `${(oneThreadAlone / threadedAlone).toFixed(2)} × (${GOALS.gain})`,
      'worst area beside the sum of the segments, theirs': worst(theirs.areas),
      'ours': `${worst(ours.layers.map(areaOfLayer))} (${GOALS.area})`,
    });
  }
  return rows;
}

/** A sphere of 2·n² triangles, and what may be wrong with it. */
function broken(n) {
  const at = (i, j) => {
    const [u, v] = [(Math.PI * i) / n, (2 * Math.PI * j) / n];
    return [10 * Math.sin(u) * Math.cos(v), 10 * Math.sin(u) * Math.sin(v), 10 * Math.cos(u)];
  };
  const corners = [];
  const triangles = [];
  for (let i = 0; i <= n; i++) for (let j = 0; j < n; j++) corners.push(at(i, j));
  const vertex = (i, j) => (i === 0 ? 0 : i === n ? n * n : i * n + (j % n));
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      const [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
      if (a !== d) triangles.push([a, b, d]);
      if (b !== c) triangles.push([b, c, d]);
    }
  }
  const mesh = (faces, points = corners) => ({ positions: Float32Array.from(points.flat()), indices: Uint32Array.from(faces.flat()) });
  const shifted = corners.map(([x, y, z]) => [x + 7, y, z]);
  const every = (k) => (_, index) => index % k === 0;
  return {
    'closed': mesh(triangles),
    'each triangle on its own': mesh(triangles.map((_, t) => [3 * t, 3 * t + 1, 3 * t + 2]), triangles.flat().map((v) => corners[v])),
    'a fiftieth of its triangles missing': mesh(triangles.filter((_, t) => t % 50)),
    'a fiftieth turned over': mesh(triangles.map((t, k) => (every(50)(t, k) ? [t[0], t[2], t[1]] : t))),
    'a fiftieth twice': mesh([...triangles, ...triangles.filter(every(50))]),
    'two that overlap': mesh([...triangles, ...triangles.map((t) => t.map((v) => v + corners.length))], [...corners, ...shifted]),
  };
}

async function compareBroken(fw, peer) {
  const heights = [-6.03, 0.11, 5.07];
  const rows = [];
  for (const [name, { positions, indices }] of Object.entries(broken(40))) {
    const soup = await fw.Soup.from({ positions, indices });
    const layers = await soup.slice({ heights });
    soup.free();
    const theirs = slicedByManifold(peer, { positions, indices, heights, merge: true });
    const total = (areas) => areas.reduce((sum, area) => sum + area, 0).toFixed(2);
    rows.push({
      'a sphere, three layers': name,
      ours: total(layers.map(areaOfLayer)),
      'manifold-3d': theirs.refusal ?? total(theirs.areas),
      trimesh: byTrimesh(positions, indices, heights),
    });
  }
  return rows;
}

const TRIMESH = `
import json, sys, warnings
warnings.filterwarnings("ignore")
import numpy, trimesh
data = json.load(sys.stdin)
mesh = trimesh.Trimesh(numpy.reshape(data["positions"], (-1, 3)), numpy.reshape(data["indices"], (-1, 3)), process=True)
total, broken = 0.0, 0
for z in data["heights"]:
    section = mesh.section(plane_origin=[0, 0, z], plane_normal=[0, 0, 1])
    if section is None:
        continue
    flat = section.to_2D()[0]
    broken += not flat.is_closed
    total += sum(polygon.area for polygon in flat.polygons_full)
print(f"{total:.2f}" + (f", {broken} of 3 not closed" if broken else ""))
`;

/** Total area by trimesh's sections, in an environment of its own; or that there is none. */
function byTrimesh(positions, indices, heights) {
  const environment = join(peersFolder, 'python');
  const python = join(environment, 'bin/python');
  try {
    if (!existsSync(join(environment, 'bin/trimesh-ready'))) {
      execFileSync('python3', ['-m', 'venv', environment]);
      execFileSync(python, ['-m', 'pip', 'install', '--quiet', 'trimesh==4.9.0', 'shapely', 'networkx', 'scipy', 'rtree', 'mapbox_earcut']);
      execFileSync('touch', [join(environment, 'bin/trimesh-ready')]);
    }
    const input = JSON.stringify({ positions: [...positions], indices: [...indices], heights });
    return execFileSync(python, ['-c', TRIMESH], { input, stdio: ['pipe', 'pipe', 'pipe'] }).toString().trim();
  } catch (error) {
    return `fails: ${String(error.stderr ?? error.message).trim().split('\n').at(-1)}`;
  }
}

/** The bunny with its holes beside a closed model of its size. */
async function compareOpen(fw) {
  const times = [];
  for (const name of ['bunny', 'bumpy70k']) {
    const mesh = await opened(fw, name);
    times.push(await repeat(async () => (await slicedByOurs(fw, mesh)).whole));
  }
  const [open, closed] = times;
  return [{ 'the bunny with its holes': milliseconds(open), 'closed, as many triangles': milliseconds(closed), ratio: `${(open / closed).toFixed(1)} (${GOALS.open})` }];
}

const peer = await manifold();
const [fw, one, threaded] = [await initSync(), await init({ threads: 1 }), await init({ threads: 2 })];
console.log(`${LAYERS} layers, WebAssembly in Node ${process.version}, one thread where nothing else is said; goals in brackets\n`);
console.log(markdown(await compareClosed(fw, threaded, peer)));
console.log(`\n${markdown(await compareOpen(fw))}`);
console.log(`\nareas in square millimetres\n\n${markdown(await compareBroken(fw, peer))}`);
[one, threaded].forEach((engine) => engine.dispose());
