// Pictures of solids: clouds, voxels, surfaces, repairs, turned faces, booleans, textures.
import { readFileSync } from 'node:fs';
import { contourGeometry, soupArrays } from '../../pkg/dist/three/index.js';
import { BufferAttribute, BufferGeometry, TorusKnotGeometry } from '../../www/node_modules/three/build/three.module.js';
import { ball, box, lots, open, placed, together } from './models.mjs';
import { COLOURS, Picture, ballAround, mix } from './raster.mjs';

const VIEW = { azimuth: -70, elevation: 18 };
const even = (colour) => () => colour;
const pointAt = (positions, k) => [positions[3 * k], positions[3 * k + 1], positions[3 * k + 2]];
const positionsOf = (shape) => placed(shape.geometry()).positions;

export function clouds(fw) {
  const bunny = open(fw, 'bunny');
  const all = positionsOf(bunny);
  const pick = lots();
  const chosen = Array.from({ length: 4500 }, () => Math.floor((pick() * all.length) / 3));
  const cloud = fw.Cloud.from({ points: Float64Array.from(chosen.flatMap((k) => pointAt(all, k))) });
  cloud.orient();
  const { positions: points, normals, origin } = cloud.geometry();
  const picture = new Picture(660, 270);
  const round = ballAround(all);
  const looks = [[0, 1 / 3], [1 / 3, 2 / 3], [2 / 3, 1]].map(([left, right]) => picture.view({ left, right, ball: round, ...VIEW, zoom: 1.35 }));
  for (let k = 0; k < cloud.count; k++) {
    const at = pointAt(points, k).map((x, axis) => x + origin[axis]);
    const normal = pointAt(normals, k);
    const facing = normal.reduce((sum, x, axis) => sum + x * looks[0].toViewer[axis], 0);
    picture.dot(looks[0], at, 0.8, COLOURS.dark);
    if (facing > 0) picture.line(looks[1], [at, at.map((x, axis) => x + 0.03 * round.radius * normal[axis])], 0.35, mix(COLOURS.blue, COLOURS.grey, 1 - facing));
  }
  picture.mesh(looks[2], placed(cloud.surface()), even(COLOURS.grey));
  return picture.png();
}

export function voxels(fw) {
  const teapot = open(fw, 'teapot');
  const picture = new Picture(740, 300);
  const round = ballAround(positionsOf(teapot));
  [0, 24, 64].forEach((resolution, k) => {
    const look = picture.view({ left: k / 3, right: (k + 1) / 3, ball: round, azimuth: -60, elevation: 22, zoom: 1.3 });
    const mesh = resolution === 0 ? teapot.geometry() : teapot.voxelize({ resolution, surface: true }).surface;
    picture.mesh(look, placed(mesh), (_, __, isFront) => (isFront ? COLOURS.grey : COLOURS.orange));
  });
  return picture.png();
}

export function surfaces(fw) {
  const house = fw.open(readFileSync(new URL('../../examples/models/house.obj', import.meta.url)));
  const picture = new Picture(740, 250);
  const round = ballAround(positionsOf(house));
  [undefined, {}, { sharp: 35 }].forEach((options, k) => {
    const look = picture.view({ left: k / 3, right: (k + 1) / 3, ball: round, azimuth: -58, elevation: 28 });
    const mesh = placed(options ? house.surface({ resolution: 14, ...options }) : house.geometry());
    picture.mesh(look, mesh, even(COLOURS.grey));
    edges(picture, look, mesh, round.radius);
  });
  return picture.png();
}

function edges(picture, look, { positions, indices }, radius) {
  for (let k = 0; k < indices.length; k++) {
    const [from, to] = [indices[k], indices[k % 3 === 2 ? k - 2 : k + 1]];
    picture.line(look, [pointAt(positions, from), pointAt(positions, to)], 0.2, [120, 128, 138], 0.004 * radius);
  }
}

export function repairs(fw) {
  const bunny = open(fw, 'bunny');
  const report = bunny.check({ selfIntersections: false });
  const { soup, sources } = bunny.repair({ check: false });
  const mesh = placed(bunny.geometry());
  const picture = new Picture(740, 330);
  const round = ballAround(mesh.positions);
  const looks = [[0, 0.5], [0.5, 1]].map(([left, right]) => picture.view({ left, right, ball: round, azimuth: -70, elevation: -50, zoom: 1.35 }));
  picture.mesh(looks[0], mesh, (_, __, isFront) => (isFront ? COLOURS.grey : COLOURS.orange));
  for (const { vertices } of report.boundary.loops.list) {
    const points = [...vertices, vertices[0]].map((k) => pointAt(mesh.positions, k));
    picture.line(looks[0], points, 0.8, COLOURS.red, 0.02 * round.radius);
  }
  picture.mesh(looks[1], placed(soup.geometry()), (t) => (sources[t] === 0xffffffff ? COLOURS.blue : COLOURS.grey));
  return picture.png();
}

export function orientation(fw) {
  const teapot = open(fw, 'teapot');
  const { soup: whole } = teapot.repair();
  const { positions, indices } = placed(whole.geometry());
  const pick = lots(7);
  const turned = indices.slice();
  for (let t = 0; t < turned.length; t += 3) if (pick() < 0.5) turned.subarray(t, t + 3).reverse();
  const soup = fw.Soup.from({ positions, indices: turned });
  soup.orient();
  const picture = new Picture(740, 300);
  const round = ballAround(positions);
  [{ positions, indices: turned }, placed(soup.geometry())].forEach((mesh, k) => {
    const look = picture.view({ left: k / 2, right: (k + 1) / 2, ball: round, azimuth: -55, elevation: 22, zoom: 1.2 });
    picture.mesh(look, mesh, (_, __, isFront) => (isFront ? COLOURS.grey : COLOURS.orange));
  });
  return picture.png();
}

export function booleans(fw) {
  const one = fw.Soup.from(box(-9, 9));
  const other = fw.Soup.from(ball(32, 11.6));
  const round = { ...ballAround(together(placed(one.geometry()), placed(other.geometry())).positions) };
  const picture = new Picture(740, 250);
  ['union', 'intersection', 'difference'].forEach((operation, k) => {
    const { soup, operands } = one.boolean(operation, other);
    const look = picture.view({ left: k / 3, right: (k + 1) / 3, ball: round, azimuth: -50, elevation: 28, zoom: 1.15 });
    picture.mesh(look, placed(soup.geometry()), (t) => (operands[t] === 0 ? COLOURS.grey : COLOURS.orange));
  });
  return picture.png();
}

/** A mesh of three.js, the contours of its layers, and points in it. */
export function interop(fw) {
  const { positions, indices } = soupArrays(new TorusKnotGeometry(10, 3, 200, 24));
  const soup = fw.Soup.from({ positions, indices });
  const lines = contourGeometry({ BufferAttribute, BufferGeometry }, soup.slice({ layerHeight: 0.8 }));
  const places = Array.from(lines.getIndex().array, (k) => pointAt(lines.getAttribute('position').array, k));
  const pick = lots(3);
  const points = Float64Array.from({ length: 60_000 }, () => 34 * (pick() - 0.5));
  const inside = soup.contains(points);
  const picture = new Picture(740, 260);
  const looks = [0, 1, 2].map((k) => picture.view({ left: k / 3, right: (k + 1) / 3, ball: ballAround(positions), azimuth: -70, elevation: 55, zoom: 1.15 }));
  picture.mesh(looks[0], { positions, indices }, even(COLOURS.grey));
  for (let k = 0; k < places.length; k += 2) picture.line(looks[1], places.slice(k, k + 2), 0.35, COLOURS.blue);
  inside.forEach((is, k) => is && picture.dot(looks[2], pointAt(points, k), 1, COLOURS.orange));
  return picture.png();
}

/** A colour for each chart, and squares by the place in the picture. */
function checker(chart, u, v) {
  const hues = [COLOURS.blue, COLOURS.orange, COLOURS.green, COLOURS.red, [140, 100, 180], [90, 170, 180], [190, 160, 70], [200, 120, 160]];
  const isDark = (Math.floor(40 * u) + Math.floor(40 * v)) % 2 === 0;
  return isDark ? hues[chart % hues.length] : mix(hues[chart % hues.length], [255, 255, 255], 0.75);
}

export function textures(fw) {
  const teapot = open(fw, 'teapot');
  const texture = teapot.texture({ offset: 3.5, resolution: 90 });
  const [soup, proxy, lines] = [texture.geometry(), texture.proxy(), texture.lines({ count: 250 })];
  const at = (uvs, t, weights) => [0, 1].map((axis) => weights.reduce((sum, weight, k) => sum + weight * uvs[6 * t + 2 * k + axis], 0));
  const textured = ({ charts, uvs }) => (t, weights) => checker(charts[t], ...at(uvs, t, weights));
  const picture = new Picture(900, 300);
  const round = ballAround(proxy.positions);
  const look = (k) => picture.view({ left: k / 3, right: (k + 1) / 3, ball: round, azimuth: -55, elevation: 24, zoom: 1.15 });
  const [first, second] = [look(0), look(1)];
  picture.mesh(first, soup, even(COLOURS.grey));
  for (let k = 0; k + 1 < lines.offsets.length; k++) {
    const points = Array.from({ length: lines.offsets[k + 1] - lines.offsets[k] }, (_, i) => pointAt(lines.points, lines.offsets[k] + i));
    picture.line(first, points, 0.4, COLOURS.orange);
  }
  picture.mesh(second, soup, textured(soup));
  const corners = proxy.uvs.length / 2;
  const flat = {
    positions: Float64Array.from({ length: 3 * corners }, (_, k) => (k % 3 === 2 ? 0 : proxy.uvs[2 * Math.floor(k / 3) + (k % 3)])),
    indices: Uint32Array.from({ length: corners }, (_, k) => k),
  };
  const above = picture.view({ left: 0.68, right: 1, ball: { middle: [0.5, 0.5, 0], radius: 0.54 }, azimuth: -90, elevation: 90 });
  picture.mesh(above, flat, textured(proxy));
  return picture.png();
}
