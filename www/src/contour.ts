import type { Layer } from 'fast-winding';

/** Every ring of a layer, outer ones first in each region. */
export function ringsOf(layer: Layer): Float64Array[] {
  return layer.polygons.flatMap(({ outer, holes }) => [outer, ...holes]);
}

/** Area between the outer rings and their holes, in mm². */
export function areaOf(layer: Layer): number {
  return ringsOf(layer).reduce((sum, ring) => sum + signedArea(ring), 0);
}

/** Length of all rings, in mm. */
export function perimeterOf(layer: Layer): number {
  let length = 0;
  for (const ring of ringsOf(layer)) {
    forEachEdge(ring, (ax, ay, bx, by) => {
      length += Math.hypot(bx - ax, by - ay);
    });
  }
  return length;
}

/** The rings as one SVG path, y pointing up turned to y pointing down. */
export function pathOf(layer: Layer): string {
  return ringsOf(layer).map(ringPath).join('');
}

/** Calls for each edge of a closed ring that does not repeat its first point. */
export function forEachEdge(ring: Float64Array, call: (ax: number, ay: number, bx: number, by: number) => void): void {
  for (let i = 0; i < ring.length; i += 2) {
    const j = (i + 2) % ring.length;
    call(ring[i], ring[i + 1], ring[j], ring[j + 1]);
  }
}

/** Positive for a counter-clockwise ring. */
function signedArea(ring: Float64Array): number {
  let twice = 0;
  const [x, y] = ring;
  forEachEdge(ring, (ax, ay, bx, by) => {
    twice += (ax - x) * (by - y) - (bx - x) * (ay - y);
  });
  return twice / 2;
}

function ringPath(ring: Float64Array): string {
  let path = '';
  for (let i = 0; i < ring.length; i += 2) path += `${i ? 'L' : 'M'}${ring[i].toFixed(5)} ${(-ring[i + 1]).toFixed(5)}`;
  return `${path}Z`;
}
