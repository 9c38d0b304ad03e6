import { CanvasTexture, DoubleSide, Mesh, MeshBasicMaterial, PlaneGeometry, Shape, ShapeGeometry, SRGBColorSpace, Vector2 } from 'three';
import type { Object3D } from 'three';
import type { Layer } from 'fast-winding';
import { forEachEdge, ringsOf } from '../contour.ts';
import { distanceColour, isoline, levelsOf, scaleOf } from '../distances.ts';
import type { PlaneDistances } from '../distances.ts';
import { token } from '../dom.ts';
import { rectangleOf, paintMap } from '../plane-map.ts';
import type { PlaneMap, Rectangle } from '../plane-map.ts';
import type { Rgb } from '../ramp.ts';
import { thickLines, thinLines } from './lines.ts';
import type { Surroundings } from './part.ts';

/** The plane reaches this part of the model's width beyond it. */
const PLANE_MARGIN = 0.08;
const CONTOUR_PIXELS = 2.5;

/** The cutting plane: a frame and a faint pane. */
export function planePane(bounds: Rectangle, z: number, origin: Float64Array): Object3D[] {
  const margin = PLANE_MARGIN * Math.max(bounds.max[0] - bounds.min[0], bounds.max[1] - bounds.min[1]);
  const [x0, y0] = [bounds.min[0] - margin - origin[0], bounds.min[1] - margin - origin[1]];
  const [x1, y1] = [bounds.max[0] + margin - origin[0], bounds.max[1] + margin - origin[1]];
  const h = z - origin[2];
  const ends = new Float32Array([x0, y0, h, x1, y0, h, x1, y0, h, x1, y1, h, x1, y1, h, x0, y1, h, x0, y1, h, x0, y0, h]);
  const frame = thinLines(ends, '--view-layer', [], 0.55);
  const pane = new Mesh(
    new PlaneGeometry(x1 - x0, y1 - y0),
    new MeshBasicMaterial({ color: token('--view-layer'), transparent: true, opacity: 0.07, side: DoubleSide, depthWrite: false }),
  );
  pane.position.set((x0 + x1) / 2, (y0 + y1) / 2, h);
  return [frame, pane];
}

/** The contours of a layer as lines, and the region they enclose. */
export function contourLines(layer: Layer, { origin }: Surroundings, isOnHeat: boolean): Object3D[] {
  const z = layer.zSample - origin[2];
  const ends: number[] = [];
  for (const ring of ringsOf(layer)) {
    forEachEdge(ring, (ax, ay, bx, by) => {
      ends.push(ax - origin[0], ay - origin[1], z, bx - origin[0], by - origin[1], z);
    });
  }
  if (ends.length === 0) return [];
  const lines = thickLines(new Float32Array(ends), isOnHeat ? '--view-on-heat' : '--view-layer', CONTOUR_PIXELS);
  lines.renderOrder = 2;
  return isOnHeat ? [lines] : [lines, section(layer, origin)];
}

/** The distances, coloured, and lines along which they are equal. */
export function distancePane(map: PlaneDistances, surroundings: Surroundings): Object3D[] {
  const scale = scaleOf(map);
  const { origin } = surroundings;
  const ends: number[] = [];
  for (const level of levelsOf(scale)) {
    const line = isoline(map, level);
    for (let i = 0; i < line.length; i += 2) ends.push(line[i] - origin[0], line[i + 1] - origin[1], map.z - origin[2]);
  }
  const lines = thinLines(new Float32Array(ends), '--view-on-heat', [], 0.7);
  lines.renderOrder = 2;
  return [mapPane(map, (value) => distanceColour(value, scale), surroundings), lines];
}

/** A map of the plane, coloured, lying at its height. */
export function mapPane(map: PlaneMap, colour: (value: number) => Rgb, { origin }: Surroundings): Mesh {
  const { min, max } = rectangleOf(map);
  const texture = new CanvasTexture(paintMap(map, colour));
  texture.colorSpace = SRGBColorSpace;
  const pane = new Mesh(
    new PlaneGeometry(max[0] - min[0], max[1] - min[1]),
    new MeshBasicMaterial({ map: texture, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
  );
  pane.position.set((min[0] + max[0]) / 2 - origin[0], (min[1] + max[1]) / 2 - origin[1], map.z - origin[2]);
  return pane;
}

function section(layer: Layer, origin: Float64Array): Mesh {
  const path = (ring: Float64Array): Vector2[] =>
    Array.from({ length: ring.length / 2 }, (_, i) => new Vector2(ring[2 * i] - origin[0], ring[2 * i + 1] - origin[1]));
  const shapes = layer.polygons.map(({ outer, holes }) => {
    const shape = new Shape(path(outer));
    shape.holes = holes.map((hole) => new Shape(path(hole)));
    return shape;
  });
  const fill = new Mesh(
    new ShapeGeometry(shapes),
    new MeshBasicMaterial({ color: token('--view-section'), side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
  );
  fill.position.z = layer.zSample - origin[2];
  return fill;
}
