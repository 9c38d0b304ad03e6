// Pictures of planes: the winding number, distances, offsets, layers and toolpaths.
import { ball, moved, open, together, without } from './models.mjs';
import { ACCENTS, INK, field, page, path, rings, text } from './svg.mjs';

/** The ring xyxy… in the picture. */
const pointsOf = (ring, toPage) => Array.from({ length: ring.length / 2 }, (_, k) => toPage([ring[2 * k], ring[2 * k + 1]]));
const ringsOf = ({ polygons }, toPage) => polygons.flatMap(({ outer, holes }) => [outer, ...holes]).map((ring) => pointsOf(ring, toPage));

/** The middles of square cells of a plane, x fastest. */
function cellsOf(origin, spacing, [columns, rows], z) {
  const points = new Float64Array(3 * columns * rows);
  for (let k = 0; k < columns * rows; k++) {
    points.set([origin[0] + ((k % columns) + 0.5) * spacing, origin[1] + (Math.floor(k / columns) + 0.5) * spacing, z], 3 * k);
  }
  return points;
}

/** A colour between two, as #rrggbb. */
const between = (one, other, share) => `#${one.map((x, c) => Math.round(x + (other[c] - x) * share).toString(16).padStart(2, '0')).join('')}`;

/** One of the colours from white over blue to orange, by w in tenths. */
function windingColour(w) {
  const stops = [[-1, [120, 90, 160]], [0, [255, 255, 255]], [0.5, [170, 200, 232]], [1, [74, 122, 188]], [2, [226, 120, 40]]];
  const tenth = Math.min(2, Math.max(-1, Math.round(12 * w) / 12));
  const k = Math.min(stops.length - 2, stops.findLastIndex(([at]) => at <= tenth));
  const [[from, one], [to, other]] = [stops[k], stops[k + 1]];
  return between(one, other, (tenth - from) / (to - from));
}

/** Two balls that overlap, one without a cap. */
export function winding(fw) {
  const opened = without(ball(24, 10), ([x, , z]) => x < -7.2 && z > -20);
  const soup = fw.Soup.from(together(opened, moved(ball(24, 7), [11, 0, 0])));
  const [width, height, cells] = [640, 420, 160];
  const spacing = 36 / cells;
  const counts = [cells, Math.round((cells * height) / width)];
  const origin = [-15, (-spacing * counts[1]) / 2];
  const values = soup.windingNumbers(cellsOf(origin, spacing, counts, 0.01), { tolerance: 0 });
  const cell = width / counts[0];
  const toPage = ([x, y]) => [((x - origin[0]) / spacing) * cell, height - ((y - origin[1]) / spacing) * cell];
  const [layer] = soup.slice({ heights: [0.01] });
  const note = (at, words, colour = INK) => text(toPage(at), words, { anchor: 'middle', colour, size: 15 });
  return page(width, height, [
    field({ counts, values }, { left: 0, top: height - counts[1] * cell, cell }, windingColour),
    rings(ringsOf(layer, toPage), { stroke: INK, width: 2 }),
    note([-1, 0], 'w = 1', '#fff'), note([7, -0.3], '2', '#fff'), note([13.8, 0], '1', '#fff'), note([-12.3, -6.5], 'w = ½'), note([17.5, 6], 'w = 0'),
    path([[-11.5, -5.4], [-7.6, -2]].map(toPage), { stroke: INK, width: 1 }),
  ]);
}

/** Bands of distance, pale outside and blue inside, with a line where it is 0. */
function distanceColour(d) {
  const band = Math.floor(Math.abs(d) / 2) % 2;
  const near = Math.max(0, 1 - Math.abs(d) / 45);
  const [base, strong] = d < 0 ? [[222, 232, 244], [74, 122, 188]] : [[252, 246, 238], [226, 140, 60]];
  return between(base, strong, 0.15 + (Math.round(12 * near) / 12) * (band ? 0.55 : 0.75));
}

export function distances(fw) {
  const bunny = open(fw, 'bunny');
  const { min, max } = bunny.bounds;
  const [width, cells, padding] = [460, 130, 18];
  const spacing = (max[0] - min[0] + 2 * padding) / cells;
  const counts = [cells, Math.ceil((max[1] - min[1] + 2 * padding) / spacing)];
  const z = min[2] + 0.35 * (max[2] - min[2]);
  const origin = [min[0] - padding, min[1] - padding];
  const values = bunny.signedDistance(cellsOf(origin, spacing, counts, z));
  const cell = width / cells;
  const height = Math.round(counts[1] * cell);
  const toPage = ([x, y]) => [((x - origin[0]) / spacing) * cell, height - ((y - origin[1]) / spacing) * cell];
  const [layer] = bunny.slice({ heights: [z], simplify: 0.05 });
  return page(width, height, [
    field({ counts, values }, { left: 0, top: 0, cell }, distanceColour),
    rings(ringsOf(layer, toPage), { stroke: INK, width: 2 }),
  ]);
}

export function offsets(fw) {
  const bunny = open(fw, 'bunny');
  const { min, max } = bunny.bounds;
  const size = Math.max(...max.map((x, k) => x - min[k]));
  const z = min[2] + 0.3 * (max[2] - min[2]);
  const section = (shape) => shape.slice({ heights: [z], simplify: 0.05 })[0];
  const meshOf = ({ positions, indices, origin }) => fw.Soup.from({ positions: Float64Array.from(positions, (x, k) => x + origin[k % 3]), indices });
  const resolution = 80;
  const [wide, narrow] = [0.05 * size, -0.05 * size].map((distance) => section(meshOf(bunny.offset({ distance, resolution }))));
  const walls = section(meshOf(bunny.hollow({ thickness: 0.04 * size, resolution })));
  const [scale, gap, height] = [300 / size, 40, 330];
  const at = (left) => ([x, y]) => [left + (x - min[0]) * scale, height - 40 - (y - min[1]) * scale];
  const [one, other] = [at(30), at(30 + 300 + gap + 20)];
  return page(720, height, [
    rings(ringsOf(wide, one), { stroke: ACCENTS.blue, width: 2 }),
    rings(ringsOf(section(bunny), one), { stroke: INK, width: 2 }),
    rings(ringsOf(narrow, one), { stroke: ACCENTS.orange, width: 2 }),
    rings(ringsOf(walls, other), { stroke: INK, width: 1.5, fill: '#c9d6e6' }),
    text([one([max[0], 0])[0] / 2 + 15, height - 12], 'offset: outward, as it is, inward', { anchor: 'middle' }),
    text([other([(min[0] + max[0]) / 2, 0])[0], height - 12], 'hollow', { anchor: 'middle' }),
  ]);
}

const LINES = {
  outerWall: '#d9741f', innerWall: '#e9a64e', thinWall: '#c73e3e', gap: '#c73e3e', overhang: '#8d4bb0',
  bottom: '#4c9257', top: '#4c9257', solid: '#4c9257', bridge: '#8d4bb0', infill: '#3f6fb0',
};

export function prints(fw) {
  const bunny = open(fw, 'bunny');
  const { min, max } = bunny.bounds;
  const factor = 50 / (max[2] - min[2]);
  const { positions, indices, origin } = bunny.geometry();
  const small = fw.Soup.from({ positions: Float64Array.from(positions, (x, k) => (x + origin[k % 3]) * factor), indices });
  const layers = small.slice({ layerHeight: 0.3, simplify: 0.02 });
  const paths = fw.toolpaths(layers, { perimeters: 2, infill: 'gyroid', density: 0.18, lineWidth: 0.6 });
  const height = 400;
  const [bx, by] = [small.bounds.min[0], small.bounds.min[1]];
  const oblique = (z) => ([x, y]) => [15 + (x - bx) * 5.2 + (y - by) * 1.5, height - 25 - (z - small.bounds.min[2]) * 5.2 - (y - by) * 1.9];
  const stack = layers.filter((_, k) => k % 6 === 0).map((layer) => rings(ringsOf(layer, oblique(layer.zSample)), { stroke: ACCENTS.blue, width: 1, fill: '#eef3f9' }));
  const layer = paths.layers[Math.floor(paths.layers.length * 0.3)];
  const scale = Math.min(330 / (small.bounds.max[0] - bx), 330 / (small.bounds.max[1] - by));
  const flat = ([x, y]) => [380 + (x - bx) * scale, height - 40 - (y - by) * scale];
  const lines = Array.from(layer.kinds, (kind, k) => {
    const points = pointsOf(layer.points.subarray(2 * layer.starts[k], 2 * layer.starts[k + 1]), flat);
    return path(points, { stroke: LINES[paths.kinds[kind]], width: 0.55 * scale * layer.widths[k] }, (layer.flags[k] & 1) === 1);
  });
  return page(740, height, [...stack, ...lines]);
}
