/** Simple closed models about the origin, their longest side 1. */
export interface Primitive {
  readonly positions: Float64Array;
  readonly indices: Uint32Array;
}

export type PrimitiveName = 'sphere' | 'cube' | 'cylinder';

export const PRIMITIVES: Record<PrimitiveName, { readonly label: string; make(): Primitive }> = {
  sphere: { label: 'A sphere', make: sphere },
  cube: { label: 'A cube', make: cube },
  cylinder: { label: 'A cylinder', make: () => cylinder(64) },
};

/** Times that the faces of the octahedron are divided into four. */
const DIVISIONS = 5;

function cube(): Primitive {
  const positions = Float64Array.from({ length: 24 }, (_, i) => (Math.floor(i / 3) & (1 << i % 3) ? 0.5 : -0.5));
  const sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  return { positions, indices: Uint32Array.from(sides.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])) };
}

/** Stands along z. */
function cylinder(sides: number): Primitive {
  const positions = [0, 0, -0.5, 0, 0, 0.5];
  const indices: number[] = [];
  for (let k = 0; k < sides; k++) {
    const angle = (2 * Math.PI * k) / sides;
    const [x, y] = [0.5 * Math.cos(angle), 0.5 * Math.sin(angle)];
    positions.push(x, y, -0.5, x, y, 0.5);
    const [low, high, nextLow, nextHigh] = [2 + 2 * k, 3 + 2 * k, 2 + ((2 * k + 2) % (2 * sides)), 3 + ((2 * k + 2) % (2 * sides))];
    indices.push(0, nextLow, low, 1, high, nextHigh, low, nextLow, nextHigh, low, nextHigh, high);
  }
  return { positions: Float64Array.from(positions), indices: Uint32Array.from(indices) };
}

/** An octahedron divided. */
function sphere(): Primitive {
  const points = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
  let faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
  const middles = new Map<string, number>();
  const middle = (a: number, b: number): number => {
    const key = a < b ? `${a} ${b}` : `${b} ${a}`;
    const known = middles.get(key);
    if (known !== undefined) return known;
    const sum = points[a].map((value, k) => value + points[b][k]);
    const size = Math.hypot(...sum);
    middles.set(key, points.push(sum.map((value) => value / size)) - 1);
    return points.length - 1;
  };
  for (let round = 0; round < DIVISIONS; round++) {
    faces = faces.flatMap(([a, b, c]) => {
      const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
      return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    });
  }
  return { positions: Float64Array.from(points.flat(), (value) => value / 2), indices: Uint32Array.from(faces.flat()) };
}
