import type { Rgb } from './ramp.ts';

/** Values over a plane z = constant: w, or distances. */
export interface PlaneMap {
  /** Samples along x and y. */
  readonly counts: readonly [number, number];
  /** The first sample. */
  readonly origin: readonly [number, number];
  readonly spacing: readonly [number, number];
  readonly z: number;
  /** x fastest. */
  readonly values: Float64Array | Float32Array;
}

/** The rectangle that the samples' cells cover, in the model's x and y. */
export interface Rectangle {
  readonly min: readonly [number, number];
  readonly max: readonly [number, number];
}

export function rectangleOf({ origin, spacing, counts }: PlaneMap): Rectangle {
  const min = [origin[0] - spacing[0] / 2, origin[1] - spacing[1] / 2] as const;
  return { min, max: [min[0] + counts[0] * spacing[0], min[1] + counts[1] * spacing[1]] };
}

/** The value at the sample nearest to (x, y), undefined outside the map. */
export function valueAt(map: PlaneMap, x: number, y: number): number | undefined {
  const i = Math.round((x - map.origin[0]) / map.spacing[0]);
  const j = Math.round((y - map.origin[1]) / map.spacing[1]);
  if (i < 0 || j < 0 || i >= map.counts[0] || j >= map.counts[1]) return undefined;
  return map.values[j * map.counts[0] + i];
}

/** A canvas of one pixel a sample, its first row the largest y, as pictures have it. */
export function paintMap({ counts: [width, height], values }: PlaneMap, colour: (value: number) => Rgb): HTMLCanvasElement {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext('2d')!;
  const image = context.createImageData(width, height);
  for (let j = 0; j < height; j++) {
    for (let i = 0; i < width; i++) {
      const pixel = 4 * ((height - 1 - j) * width + i);
      image.data.set(colour(values[j * width + i]), pixel);
      image.data[pixel + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
  return canvas;
}
