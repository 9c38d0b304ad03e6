// Drawings of how the engine works.
import { ball, lots, without } from './models.mjs';
import { ACCENTS, INK, arrow, box, circle, page, path, text } from './svg.mjs';

/** A closed curve with an opening, the cap that closes it, and rays that count crossings. */
export function crossings() {
  const [cx, cy, radius] = [300, 165, 125];
  const at = (degrees, r = radius) => [cx + r * Math.cos((degrees * Math.PI) / 180), cy - r * Math.sin((degrees * Math.PI) / 180)];
  const arc = Array.from({ length: 121 }, (_, k) => at(20 + (k / 120) * 300));
  const [first, last] = [arc[0], arc.at(-1)];
  const inside = [cx + 30, cy + 25];
  const beyond = [cx + 200, cy - 5];
  const crossing = [cx - Math.sqrt(radius ** 2 - 25 ** 2), cy + 25];
  const cap = [last[0] + ((first[0] - last[0]) * (beyond[1] - last[1])) / (first[1] - last[1]), beyond[1]];
  const other = [cx - Math.sqrt(radius ** 2 - 5 ** 2), beyond[1]];
  const mark = (p, colour) => circle(p, 5, { fill: colour });
  return page(720, 340, [
    path(arc, { width: 3 }), path([last, first], { stroke: ACCENTS.orange, width: 3, dash: '7 5' }),
    arrow(inside, [60, inside[1]], ACCENTS.blue), arrow(beyond, [60, beyond[1]], ACCENTS.green),
    mark(inside, ACCENTS.blue), mark(beyond, ACCENTS.green), circle(crossing, 6, { stroke: ACCENTS.blue, width: 2 }),
    circle(other, 6, { stroke: ACCENTS.green, width: 2 }), circle(cap, 6, { stroke: ACCENTS.green, width: 2 }),
    text([cx - 60, cy - radius - 12], 'the soup M', { anchor: 'middle' }),
    text([first[0] + 14, first[1] - 12], 'the closure C', { colour: ACCENTS.orange }),
    text([inside[0] - 128, inside[1] + 22], 'q: one crossing, N = 1', { colour: ACCENTS.blue }),
    text([beyond[0] + 12, beyond[1] + 5], 'q: in by the cap,\nout by the soup, N = 0', { colour: ACCENTS.green }),
    text([480, 270], 'w(q) = N(q) − w_C(q)', { size: 18 }),
    text([480, 294], 'an integer, less a few small triangles', { colour: ACCENTS.grey }),
  ]);
}

/** Boxes over points, split at the middle of their longer side, until few are left. */
function treeOf(points, depth = 0) {
  const low = [0, 1].map((axis) => Math.min(...points.map((p) => p[axis])));
  const high = [0, 1].map((axis) => Math.max(...points.map((p) => p[axis])));
  const middle = low.map((x, axis) => (x + high[axis]) / 2);
  const radius = Math.max(...points.map((p) => Math.hypot(p[0] - middle[0], p[1] - middle[1])));
  const node = { points, low, high, middle, radius, depth };
  if (points.length <= 4) return node;
  const axis = high[0] - low[0] > high[1] - low[1] ? 0 : 1;
  const sorted = points.toSorted((p, q) => p[axis] - q[axis]);
  const half = sorted.length / 2;
  return { ...node, children: [treeOf(sorted.slice(0, half), depth + 1), treeOf(sorted.slice(half), depth + 1)] };
}

/** Which clusters a query takes as a whole, and which points singly. */
export function hierarchy() {
  const pick = lots(5);
  const points = Array.from({ length: 128 }, (_, k) => {
    const angle = (k / 128) * 2 * Math.PI;
    const r = 110 + 22 * Math.sin(3 * angle) + 4 * pick();
    return [260 + 1.5 * r * Math.cos(angle), 170 - r * Math.sin(angle)];
  });
  const query = [424, 122];
  const [far, near] = [[], []];
  const walk = (node) => {
    if (Math.hypot(node.middle[0] - query[0], node.middle[1] - query[1]) > 2 * node.radius) far.push(node);
    else if (node.children) node.children.forEach(walk);
    else near.push(...node.points);
  };
  walk(treeOf(points));
  return page(720, 340, [
    ...far.map(({ low, high }) => box(low[0] - 3, low[1] - 3, high[0] - low[0] + 6, high[1] - low[1] + 6, { stroke: ACCENTS.blue, fill: '#edf2f9' })),
    ...far.map(({ middle }) => path([middle, query], { stroke: ACCENTS.blue, width: 0.6 })),
    ...near.map((p) => path([p, query], { stroke: ACCENTS.orange, width: 0.6 })),
    ...points.map((p) => circle(p, 2.2, { fill: near.includes(p) ? ACCENTS.orange : INK })),
    circle(query, 5, { fill: ACCENTS.red }),
    text([490, 60], `q asks ${points.length} sources:`),
    text([490, 84], `${near.length} near ones singly,`, { colour: ACCENTS.orange }),
    text([490, 106], `${far.length} clusters by their moments,`, { colour: ACCENTS.blue }),
    text([490, 128], 'each farther away than β = 2\ntimes its radius', { colour: ACCENTS.grey }),
  ]);
}

/** How far the series of orders 0, 1 and 2 are from the exact sum, against the distance. */
export function expansion(fw) {
  const patch = fw.Soup.from(without(ball(24, 10), ([, , z]) => z < 7));
  const exactAt = (points) => patch.windingNumbers(points, { tolerance: 0 });
  const { min, max } = patch.bounds;
  const middle = min.map((x, k) => (x + max[k]) / 2);
  const radius = Math.hypot(...min.map((x, k) => max[k] - x)) / 2;
  const ratios = Array.from({ length: 24 }, (_, k) => 1.5 * (8 / 1.5) ** (k / 23));
  const ring = Array.from({ length: 60 }, (_, k) => [Math.PI * ((k + 0.5) / 60), 2.4 * k]);
  const errors = (order) => ratios.map((ratio) => {
    const onSphere = ([polar, around]) => [Math.sin(polar) * Math.cos(around), Math.sin(polar) * Math.sin(around), Math.cos(polar)];
    const points = Float64Array.from(ring.flatMap((place) => onSphere(place).map((x, k) => middle[k] + ratio * radius * x)));
    const exact = exactAt(points);
    const found = patch.windingNumbers(points, { order, beta: 1 });
    return Math.sqrt(found.reduce((sum, w, k) => sum + (w - exact[k]) ** 2, 0) / found.length);
  });
  const [left, right, top, bottom] = [80, 480, 30, 290];
  const across = (ratio) => left + ((right - left) * Math.log(ratio / 1.5)) / Math.log(8 / 1.5);
  const up = (error) => top + ((bottom - top) * (-1 - Math.log10(error))) / 7;
  const lines = [0, 1, 2].map((order) => ({ order, found: errors(order), colour: [ACCENTS.grey, ACCENTS.orange, ACCENTS.blue][order] }));
  return page(620, 340, [
    ...[1, 2, 3, 4, 5, 6, 7, 8].map((k) => path([[left, up(10 ** -k)], [right, up(10 ** -k)]], { stroke: ACCENTS.pale, width: 1 })),
    ...[1, 3, 5, 7].map((k) => text([left - 8, up(10 ** -k) + 4], `1e-${k}`, { anchor: 'end', size: 12 })),
    ...[1.5, 2, 3, 4, 6, 8].flatMap((r) => [
      text([across(r), bottom + 18], String(r), { anchor: 'middle', size: 12 }), path([[across(r), bottom], [across(r), bottom + 4]], { width: 1 }),
    ]),
    path([[left, top], [left, bottom], [right, bottom]], { width: 1.2 }),
    ...lines.flatMap(({ order, found, colour }) => [
      path(ratios.map((ratio, k) => [across(ratio), Math.min(bottom, up(Math.max(1e-9, found[k])))]), { stroke: colour, width: 2.2 }),
      text([right + 10, up(found.at(-1)) + 4], `order ${order}`, { colour }),
    ]),
    text([(left + right) / 2, bottom + 38], 'distance of q, in radii of the cluster', { anchor: 'middle' }),
    text([left + 6, top - 10], 'error of w (root mean square)', {}),
  ]);
}

const labelled = (x, y, width, height, title, words, colour = INK, fill = '#fff') => [
  box(x, y, width, height, { stroke: colour, fill }), text([x + 12, y + 22], title, { weight: 'bold', colour }), text([x + 12, y + 42], words, { size: 12 }),
].join('\n');

/** Page, worker, pool, and what they share. */
export function threads() {
  return page(760, 350, [
    labelled(20, 60, 180, 150, 'your page', 'init(), shapes, promises:\none call at a time goes\nto the worker, the others\nwait and can still be\nwithdrawn', INK),
    labelled(290, 60, 180, 150, 'worker', 'the engine: reads, builds,\nasks; posts progress;\nresults are copied out of\nthe memory and handed\nover', ACCENTS.blue),
    ...[0, 1, 2].map((k) => labelled(570, 30 + 74 * k, 170, 62, k === 2 ? 'thread n' : `thread ${k + 1}`, 'a worker of the pool', ACCENTS.green)),
    arrow([200, 105], [290, 105]), arrow([290, 140], [200, 140]),
    text([245, 96], 'arrays', { anchor: 'middle', size: 12 }), text([245, 158], 'arrays', { anchor: 'middle', size: 12 }),
    ...[0, 1, 2].map((k) => arrow([470, 130], [570, 61 + 74 * k], ACCENTS.grey)),
    box(290, 265, 450, 62, { stroke: ACCENTS.orange, fill: '#fdf4ea' }),
    text([302, 288], 'shared memory of the WebAssembly', { weight: 'bold', colour: ACCENTS.orange }),
    text([302, 308], 'geometry, trees, the queue of tasks; the flag that stops a call', { size: 12 }),
    arrow([380, 210], [380, 265], ACCENTS.orange), arrow([655, 240], [655, 265], ACCENTS.orange),
    arrow([110, 210], [290, 295], ACCENTS.orange, '5 4'), text([92, 268], 'abort', { size: 12, colour: ACCENTS.orange }),
  ]);
}

/** The two files of WebAssembly. */
export function parts() {
  const first = [
    'loaded by init()', '', 'STL, OBJ, PLY, OFF, XYZ', 'winding numbers, inside tests, voxels,', 'heat maps', '', 'a stub for each function that is elsewhere',
  ];
  const second = [
    'loaded when first asked for', '', 'slices, surfaces, checks, repairs, booleans,', 'distances, normals, prints, textures, 3MF', '',
    'imports memory, table and globals of the first',
  ];
  return page(760, 270, [
    labelled(20, 40, 300, 190, 'fast_winding_bg.wasm', first.join('\n'), ACCENTS.blue, '#f3f6fb'),
    labelled(440, 40, 300, 190, 'fast_winding_more.wasm', second.join('\n'), ACCENTS.orange, '#fdf4ea'),
    arrow([320, 110], [440, 110]), text([380, 100], 'call by table', { anchor: 'middle', size: 12 }),
    arrow([440, 170], [320, 170]), text([380, 190], 'places its functions', { anchor: 'middle', size: 12 }),
  ]);
}
