// What the pictures show: models of npm packages that the tests use too, and shapes made here.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from '../../pkg-config/tools/paths.mjs';
import { model } from '../../tests/bench/models.mjs';
import { ball, box } from '../../tests/package/shapes.mjs';

export { ball, box };

/** A soup of the bench's models, by name, which have y up: turned upright, its longest side 100 mm. */
export function open(fw, name) {
  const soup = fw.open(readFileSync(model(join(root, 'target/bench-models'), name)));
  const { positions, indices } = placed(soup.geometry());
  const size = Math.max(...[0, 1, 2].map((axis) => soup.bounds.max[axis] - soup.bounds.min[axis]));
  const upright = positions.map((_, k) => ([positions[k], -positions[k + 1], positions[k - 1]][k % 3] * 100) / size);
  return fw.Soup.from({ positions: upright, indices });
}

/** Positions of a mesh in the model's frame. */
export function placed({ positions, indices, origin }) {
  return { positions: Float64Array.from(positions, (x, k) => x + origin[k % 3]), indices };
}

/** Several meshes as one. */
export function together(...meshes) {
  const starts = meshes.map((_, k) => meshes.slice(0, k).reduce((sum, { positions }) => sum + positions.length / 3, 0));
  return {
    positions: Float64Array.from(meshes.flatMap(({ positions }) => [...positions])),
    indices: Uint32Array.from(meshes.flatMap(({ indices }, k) => [...indices].map((i) => i + starts[k]))),
  };
}

export function moved({ positions, indices }, [x, y, z]) {
  return { positions: positions.map((value, k) => value + [x, y, z][k % 3]), indices };
}

/** Without the triangles whose middle `isGone` is true of. */
export function without({ positions, indices }, isGone) {
  const kept = [];
  for (let t = 0; t < indices.length; t += 3) {
    const corners = [0, 1, 2].map((k) => indices[t + k]);
    const middle = [0, 1, 2].map((axis) => corners.reduce((sum, corner) => sum + positions[3 * corner + axis], 0) / 3);
    if (!isGone(middle)) kept.push(...corners);
  }
  return { positions, indices: Uint32Array.from(kept) };
}

/** Numbers from 0 to 1 that look as if drawn by lot, always the same ones. */
export function lots(seed = 1) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}
