/** The stack of layers, and the plane that cuts one of them. */
import type { Bounds } from 'fast-winding';
import { sizeOf } from './bounds.ts';
import { niceBelow } from './format.ts';
import type { Plane } from './state.ts';

/** The stack is cut into about this many layers unless a layer height is given. */
const LAYERS = 200;

/** A plane through the middle of a stack of layers over the bounds. */
export function planeFor(bounds: Bounds, layerHeight = defaultLayerHeight(bounds)): Plane {
  const count = Math.max(1, Math.ceil(sizeOf(bounds)[2] / layerHeight - 1e-9));
  return { index: Math.floor(count / 2), count, layerHeight };
}

/** The plane at about the same height in a stack of other layers. */
export function withLayerHeight(plane: Plane, bounds: Bounds, layerHeight: number): Plane {
  const { count } = planeFor(bounds, layerHeight);
  const index = Math.floor(((plane.index + 0.5) * plane.layerHeight) / layerHeight);
  return { index: Math.min(count - 1, index), count, layerHeight };
}

/** Height of the plane, in the model's coordinates. */
export function heightOf({ index, layerHeight }: Plane, { min }: Bounds): number {
  return min[2] + (index + 0.5) * layerHeight;
}

function defaultLayerHeight(bounds: Bounds): number {
  const [, , height] = sizeOf(bounds);
  return height > 0 ? niceBelow(height / LAYERS) : 1;
}
