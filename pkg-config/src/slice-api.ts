// Layers, as the package's callers see them.
import type { CallOptions } from './common-api.js';

/** Rings are xyxy… in millimetres and do not repeat their first point. */
export interface Polygon {
  /** Counter-clockwise seen from +z. */
  outer: Float64Array;
  /** Clockwise seen from +z. */
  holes: Float64Array[];
}

/** One slice: the polygons of {w ≥ 1/2} at `zSample`. Heights in millimetres. */
export interface Layer {
  /** Where the layer begins. */
  zBottom: number;
  /** Where a printer's nozzle lays this layer. */
  zTop: number;
  /** Where the field was asked. */
  zSample: number;
  /** None where the plane meets nothing that is inside. */
  polygons: Polygon[];
}

/** Layers of equal height from the bottom of the shape, or those at `heights`. */
export interface SliceOptions extends CallOptions {
  /** Millimetres: 0.2 unless said otherwise. */
  layerHeight?: number;
  /** Millimetres: as the others unless said otherwise. */
  firstLayerHeight?: number;
  /** Where in its span a layer is sampled: `middle` unless said otherwise. */
  sampleAt?: 'bottom' | 'middle' | 'top';
  /**
   * Layers as thick as slopes allow, in place of `layerHeight`: from `least` to `most`, so that their steps stand off the surface by
   * `deviation` at most; horizontal faces become boundaries of layers. All in millimetres.
   */
  adaptive?: { least: number; most: number; deviation: number };
  /** Heights z to sample instead, in millimetres. */
  heights?: number[] | Float64Array;
  /**
   * What is inside: `winding`, w ≥ 1/2, unless said otherwise; `even-odd`, where w rounded is odd, so that overlaps are left out; or
   * `largest`, the largest outline without its holes, for a vase.
   */
  mode?: 'winding' | 'even-odd' | 'largest';
  /** Vertices are left out where contours stay this near, in millimetres, and hang together as they do: 0 unless said otherwise. */
  simplify?: number;
  /** Of clouds: edge of a cell in the plane, in millimetres: features smaller than it may be missed. Soups have exact contours. */
  tolerance?: number;
  /** Of clouds: cells along the longest side when `tolerance` is not given: 256 unless said otherwise. */
  resolution?: number;
}
