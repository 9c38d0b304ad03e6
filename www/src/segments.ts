/** The moves of a print one after the other, as the graphics card takes them, and the way of the nozzle along them. */
import type { Toolpaths } from 'fast-winding';
import type { MoveKind, Nozzle } from './print.ts';

/** Numbers of one move: start (x, y), end (x, y), height of its middle, width, height, place of its kind in `kinds`. */
export const STRIDE = 8;
/** Moves in one row of the texture that holds them: the data is padded to whole rows. */
export const MOVES_IN_ROW = 2048;
/** Thickness of a drawn travel, as a part of the line's width. */
const TRAVEL_WIDTH = 0.2;

export interface Segments {
  readonly count: number;
  /** `STRIDE` numbers for each move in the order of printing, relative to the scene's origin. */
  readonly data: Float32Array;
  /** Place of each layer's first move, and the count of all. */
  readonly starts: Uint32Array;
  readonly kinds: readonly MoveKind[];
  /** Millimetres of each kind. */
  readonly lengths: readonly number[];
}

/** The moves of toolpaths; `origin` is the scene's, `lineWidth` what travels are thin beside. */
export function segmentsOf({ layers, kinds }: Toolpaths, origin: Float64Array, lineWidth: number): Segments {
  const most = layers.reduce((sum, { points, widths }) => sum + points.length / 2 + widths.length, 0);
  const data = new Float32Array(STRIDE * MOVES_IN_ROW * Math.max(1, Math.ceil(most / MOVES_IN_ROW)));
  const starts = new Uint32Array(layers.length + 1);
  const lengths = new Array<number>(kinds.length + 1).fill(0);
  const [travel, thin] = [kinds.length, TRAVEL_WIDTH * lineWidth];
  let count = 0;
  let [x, y] = [NaN, NaN];

  function move(toX: number, toY: number, z: number, width: number, height: number, kind: number): void {
    const length = Math.hypot(toX - x, toY - y);
    if (length > 0) {
      data.set([x - origin[0], y - origin[1], toX - origin[0], toY - origin[1], z - height / 2 - origin[2], width, height, kind], STRIDE * count++);
      lengths[kind] += length;
    }
    // Where the nozzle comes from at first is not known.
    [x, y] = [toX, toY];
  }

  layers.forEach((layer, index) => {
    starts[index] = count;
    layer.widths.forEach((width, path) => {
      const [from, to] = [layer.starts[path], layer.starts[path + 1]];
      if (from === to) return;
      const at = (point: number): [number, number] => [layer.points[2 * point], layer.points[2 * point + 1]];
      move(...at(from), layer.z, thin, thin, travel);
      for (let point = from + 1; point < to; point++) move(...at(point), layer.z, width, layer.height, layer.kinds[path]);
      if (layer.flags[path] & 1) move(...at(from), layer.z, width, layer.height, layer.kinds[path]);
    });
  });
  starts[layers.length] = count;
  return { count, data, starts, kinds: [...kinds, 'travel'], lengths };
}

export function layerCount({ starts }: Segments): number {
  return starts.length - 1;
}

/** How many moves a layer has. */
export function movesIn({ starts }: Segments, layer: number): number {
  return starts[layer + 1] - starts[layer];
}

/** Where the nozzle is when the print is done. */
export function endOf(segments: Segments): Nozzle {
  const layer = Math.max(0, layerCount(segments) - 1);
  return { layer, moves: movesIn(segments, layer) };
}

export function isAtEnd(segments: Segments, { layer, moves }: Nozzle): boolean {
  return layer >= layerCount(segments) - 1 && moves >= movesIn(segments, layer);
}

/** Where the nozzle is so many millimetres later. */
export function advanced(segments: Segments, nozzle: Nozzle, millimetres: number): Nozzle {
  let { layer, moves } = nozzle;
  let left = millimetres;
  while (!isAtEnd(segments, { layer, moves })) {
    const done = Math.floor(moves);
    if (done >= movesIn(segments, layer)) {
      [layer, moves] = [layer + 1, 0];
      continue;
    }
    const length = lengthOf(segments, segments.starts[layer] + done);
    const rest = (done + 1 - moves) * length;
    if (rest > left) return { layer, moves: moves + left / length };
    left -= rest;
    moves = done + 1;
  }
  return { layer, moves };
}

/** The tip of the nozzle in the scene's coordinates. */
export function tipOf({ count, data, starts }: Segments, { layer, moves }: Nozzle): [number, number, number] {
  const place = Math.min(count - 1, starts[layer] + Math.max(0, Math.ceil(moves) - 1));
  const part = moves === 0 ? 0 : moves - Math.ceil(moves) + 1;
  const [ax, ay, bx, by, middle, , height] = data.subarray(STRIDE * place, STRIDE * (place + 1));
  return [ax + part * (bx - ax), ay + part * (by - ay), middle + height / 2];
}

function lengthOf({ data }: Segments, move: number): number {
  const at = STRIDE * move;
  return Math.hypot(data[at + 2] - data[at], data[at + 3] - data[at + 1]);
}
