// Small shapes with known answers.

const FACES = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/** A box from `low` to `high` on every axis: bit k of a corner's number says which on axis k. */
export function box(low, high) {
  const corners = Array.from({ length: 8 }, (_, c) => [1, 2, 4].map((bit) => (c & bit ? high : low)));
  const indices = FACES.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);
  return { positions: new Float64Array(corners.flat()), indices: new Uint32Array(indices) };
}

/** A box of 10 mm as OBJ text. */
export function boxObj() {
  const { positions, indices } = box(0, 10);
  const rows = (array, letter, shift) =>
    Array.from({ length: array.length / 3 }, (_, i) => `${letter} ${[0, 1, 2].map((k) => array[3 * i + k] + shift).join(' ')}`);
  return new TextEncoder().encode([...rows(positions, 'v', 0), ...rows(indices, 'f', 1)].join('\n'));
}

/** Points spread evenly over a sphere of radius `radius`, with outward normals. */
export function sphere(count, radius) {
  const points = new Float64Array(3 * count);
  const normals = new Float64Array(3 * count);
  for (let i = 0; i < count; i++) {
    const z = 1 - (2 * i + 1) / count;
    const angle = i * Math.PI * (3 - Math.sqrt(5));
    const ring = Math.sqrt(1 - z * z);
    normals.set([ring * Math.cos(angle), ring * Math.sin(angle), z], 3 * i);
    points.set([radius * normals[3 * i], radius * normals[3 * i + 1], radius * z], 3 * i);
  }
  return { points, normals };
}

/** The triangles of a sphere: 2 `n` around, `n` from pole to pole. */
export function ball(n, radius) {
  const positions = [0, 0, radius];
  const indices = [];
  for (let i = 1; i < n; i++) {
    for (let j = 0; j < 2 * n; j++) {
      const [polar, around] = [(Math.PI * i) / n, (Math.PI * j) / n];
      positions.push(radius * Math.sin(polar) * Math.cos(around), radius * Math.sin(polar) * Math.sin(around), radius * Math.cos(polar));
    }
  }
  positions.push(0, 0, -radius);
  const at = (i, j) => (i === 0 ? 0 : i === n ? 1 + 2 * n * (n - 1) : 1 + 2 * n * (i - 1) + (j % (2 * n)));
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < 2 * n; j++) {
      if (i < n - 1) indices.push(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      if (i > 0) indices.push(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return { positions: new Float64Array(positions), indices: new Uint32Array(indices) };
}

/** A soup of `n` × `n` × 2 triangles: a bumpy torus, for calls that take a while. */
export function torus(n) {
  const positions = [];
  const indices = [];
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      const [u, v] = [(2 * Math.PI * i) / n, (2 * Math.PI * j) / n];
      const r = 30 + (10 + Math.sin(9 * u)) * Math.cos(v);
      positions.push(r * Math.cos(u), r * Math.sin(u), 10 * Math.sin(v));
      const at = (a, b) => ((i + a) % n) * n + ((j + b) % n);
      indices.push(at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1));
    }
  }
  return { positions: new Float64Array(positions), indices: new Uint32Array(indices) };
}

/** Area of a ring xyxy…, positive when it runs counter-clockwise. */
export function area(ring) {
  let twice = 0;
  for (let i = 0; i < ring.length; i += 2) {
    const j = (i + 2) % ring.length;
    twice += ring[i] * ring[j + 1] - ring[j] * ring[i + 1];
  }
  return twice / 2;
}

/** Volume that a mesh encloses. */
export function volume({ positions, indices }) {
  let six = 0;
  const at = (i, k) => positions[3 * indices[i] + k];
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [i, i + 1, i + 2].map((j) => [0, 1, 2].map((k) => at(j, k)));
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}
