/** Small models made for the tests, as the bytes of files. */

/** The eight corners of a box are numbered by bits: 1 is high x, 2 high y, 4 high z. */
const BOX_FACES = [
  [0, 2, 3, 1], [4, 5, 7, 6], // bottom, top
  [0, 1, 5, 4], [2, 6, 7, 3], // front, back
  [0, 4, 6, 2], [1, 3, 7, 5], // left, right
];

function boxCorner(min, max, bits) {
  return [0, 1, 2].map((k) => (bits & (1 << k) ? max[k] : min[k]));
}

/** A closed box of six quadrilaterals as OBJ, from `min` to `max`. */
export function boxObj(min, max) {
  const vertices = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) => `v ${boxCorner(min, max, bits).join(' ')}`);
  const faces = BOX_FACES.map((face) => `f ${face.map((corner) => corner + 1).join(' ')}`);
  return Buffer.from([...vertices, ...faces, ''].join('\n'));
}

/** The sides of a box, in the order of their faces: two triangles each. */
export const SIDES = { bottom: [0, 1], top: [2, 3], front: [4, 5], back: [6, 7], left: [8, 9], right: [10, 11] };

/**
 * A box of 12 triangles as binary STL, from `min` to `max`; closed, but `without` those triangles, and with those `flipped` whose front
 * looks inward.
 */
export function boxStl(min, max, { without = [], flipped = [] } = {}) {
  const all = BOX_FACES.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]);
  const triangles = all.map(([a, b, c], k) => (flipped.includes(k) ? [a, c, b] : [a, b, c])).filter((_, k) => !without.includes(k));
  return stl(triangles.map((corners) => corners.map((bits) => boxCorner(min, max, bits))));
}

/** The triangles of several binary STL files in one. */
export function together(...files) {
  const count = Buffer.alloc(4);
  count.writeUInt32LE(files.reduce((sum, file) => sum + file.readUInt32LE(80), 0));
  return Buffer.concat([Buffer.alloc(80), count, ...files.map((file) => file.subarray(84))]);
}

/** Binary STL of triangles given by their corners. */
function stl(triangles) {
  const bytes = Buffer.alloc(84 + 50 * triangles.length);
  bytes.writeUInt32LE(triangles.length, 80);
  triangles.forEach((corners, i) => {
    corners.flat().forEach((value, k) => bytes.writeFloatLE(value, 84 + 50 * i + 12 + 4 * k));
  });
  return bytes;
}

/** Points spread evenly over a sphere about the origin, without normals, as XYZ text. */
export function sphereXyz(count, radius) {
  const lines = [];
  for (let i = 0; i < count; i++) {
    const z = 1 - (2 * i + 1) / count;
    const ring = Math.sqrt(1 - z * z);
    const angle = i * Math.PI * (3 - Math.sqrt(5));
    lines.push([ring * Math.cos(angle), ring * Math.sin(angle), z].map((value) => (radius * value).toFixed(6)).join(' '));
  }
  return Buffer.from(lines.join('\n'));
}

/** A closed sphere about the origin as binary STL, in so many rings from pole to pole, each of twice as many quadrilaterals. */
export function sphereStl(radius, rings) {
  const at = (i, j) => {
    const [down, around] = [(Math.PI * i) / rings, (Math.PI * j) / rings];
    return [Math.sin(down) * Math.cos(around), Math.sin(down) * Math.sin(around), Math.cos(down)].map((value) => radius * value);
  };
  const triangles = [];
  for (let i = 0; i < rings; i++) {
    for (let j = 0; j < 2 * rings; j++) {
      const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      if (i < rings - 1) triangles.push([a, b, c]);
      if (i > 0) triangles.push([a, c, d]);
    }
  }
  return stl(triangles);
}
