import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from 'three';
import type { Plane } from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { token } from '../dom.ts';

/** Separate segments, `width` pixels wide. */
export function thickLines(ends: Float32Array, colourToken: string, width: number, cut: Plane[] = []): LineSegments2 {
  const geometry = new LineSegmentsGeometry().setPositions(ends);
  const material = new LineMaterial({ color: token(colourToken), linewidth: width, clippingPlanes: cut });
  return new LineSegments2(geometry, material);
}

/** Separate segments, a pixel wide: for thousands of them. */
export function thinLines(ends: Float32Array, colourToken: string, cut: Plane[] = [], opacity = 1): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(ends, 3));
  const material = new LineBasicMaterial({ color: token(colourToken), clippingPlanes: cut, transparent: opacity < 1, opacity });
  return new LineSegments(geometry, material);
}
