/** What is made of a model, and of two. */
import type { CheckReport, Mesh, RepairReport, Soup, Warning } from 'fast-winding';

export type SurfaceMesh = Mesh;

/** Triangles relative to `origin`. */
export interface Triangles {
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
  readonly origin: Float64Array;
}

/** A model put right, and what was wrong with it before and is afterwards. */
export interface Repair {
  readonly soup: Soup;
  readonly triangles: Triangles;
  readonly report: RepairReport;
  /** Absent for a cloud, which has no faces to check. */
  readonly before?: CheckReport;
  readonly after: CheckReport;
}

/** The surface at a distance, or walls of a thickness. */
export interface Offset {
  readonly mesh: Mesh;
  readonly kind: 'offset' | 'hollow';
}

/** What two models give together. */
export interface Combined {
  readonly soup: Soup;
  readonly triangles: Triangles;
  /** The operand of each triangle: 0 the model, 1 the second one. */
  readonly operands: Uint8Array;
  readonly warnings: readonly Warning[];
}

/** Positions with the origin added, in double precision. */
export function placed({ positions, origin }: Triangles): Float64Array {
  return Float64Array.from(positions, (value, i) => value + origin[i % 3]);
}

/** Cubic millimetres that a closed surface encloses. */
export function volumeOf({ positions, indices }: Triangles): number {
  let six = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i], 3 * indices[i + 1], 3 * indices[i + 2]];
    const [bx, by, bz] = [positions[b], positions[b + 1], positions[b + 2]];
    const [cx, cy, cz] = [positions[c], positions[c + 1], positions[c + 2]];
    six += positions[a] * (by * cz - bz * cy) + positions[a + 1] * (bz * cx - bx * cz) + positions[a + 2] * (bx * cy - by * cx);
  }
  return six / 6;
}

/** Square millimetres of a surface. */
export function areaOf({ positions, indices }: Triangles): number {
  let twice = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i], 3 * indices[i + 1], 3 * indices[i + 2]];
    const u = [0, 1, 2].map((k) => positions[b + k] - positions[a + k]);
    const v = [0, 1, 2].map((k) => positions[c + k] - positions[a + k]);
    twice += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }
  return twice / 2;
}
