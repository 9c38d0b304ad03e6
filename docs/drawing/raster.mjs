// Triangles, lines and dots in a picture of pixels: seen in parallel, lit from beside the viewer, what is nearer in front.
import { png } from '../../pkg/dist/cli/png.js';

/** Pixels of the picture are means of so many by so many. */
const FINER = 3;
/** Colours come in steps of so much: the file becomes smaller, and the eye does not see it. */
const STEP = 4;
const WHITE = [255, 255, 255];

export const COLOURS = {
  grey: [196, 202, 208], blue: [74, 122, 188], orange: [232, 134, 46], red: [214, 60, 60], green: [92, 160, 96], dark: [60, 66, 74], light: [226, 230, 234],
};

/** The bounds of points xyzxyz…: their middle, and half of their diagonal. */
export function ballAround(positions) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  positions.forEach((x, k) => {
    low[k % 3] = Math.min(low[k % 3], x);
    high[k % 3] = Math.max(high[k % 3], x);
  });
  return { middle: low.map((x, k) => (x + high[k]) / 2), radius: Math.hypot(...low.map((x, k) => high[k] - x)) / 2 };
}

export class Picture {
  constructor(width, height) {
    [this.width, this.height] = [width, height];
    [this.columns, this.rows] = [width * FINER, height * FINER];
    this.colours = new Uint8Array(3 * this.columns * this.rows).fill(255);
    this.depths = new Float32Array(this.columns * this.rows).fill(-Infinity);
  }

  /** A view into the part of the picture from `left` to `right`, shares of its width: of a ball, from an azimuth and a height in degrees. */
  view({ left = 0, right = 1, ball: { middle, radius }, azimuth = -60, elevation = 20, zoom = 1 }) {
    const [a, e] = [azimuth, elevation].map((degrees) => (degrees * Math.PI) / 180);
    const toViewer = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    const across = [-Math.sin(a), Math.cos(a), 0];
    const up = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)];
    const centre = [((left + right) / 2) * this.columns, this.rows / 2];
    const scale = (zoom * Math.min((right - left) * this.columns, this.rows)) / (2 * radius);
    const dot = (u, p) => u[0] * p[0] + u[1] * p[1] + u[2] * p[2];
    const place = (p) => {
      const d = p.map((x, k) => x - middle[k]);
      return [centre[0] + scale * dot(across, d), centre[1] - scale * dot(up, d), dot(toViewer, d)];
    };
    const light = [0, 1, 2].map((k) => toViewer[k] + 0.5 * up[k] - 0.4 * across[k]);
    const size = Math.hypot(...light);
    return { place, toViewer, light: light.map((x) => x / size) };
  }

  set(x, y, depth, colour) {
    if (x < 0 || y < 0 || x >= this.columns || y >= this.rows) return;
    const k = y * this.columns + x;
    if (depth < this.depths[k]) return;
    this.depths[k] = depth;
    this.colours.set(colour, 3 * k);
  }

  /** Triangles; `colour(t, weights, isFront)` is their colour before it is lit. */
  mesh(view, { positions, indices }, colour) {
    const corner = (k) => Array.from(positions.subarray(3 * indices[k], 3 * indices[k] + 3));
    for (let t = 0; 3 * t < indices.length; t++) {
      const [a, b, c] = [0, 1, 2].map((k) => corner(3 * t + k));
      const [u, v] = [b.map((x, k) => x - a[k]), c.map((x, k) => x - a[k])];
      const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const size = Math.hypot(...normal);
      if (size === 0) continue;
      const cosine = (d) => (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / size;
      const isFront = cosine(view.toViewer) > 0;
      const brightness = 0.42 + 0.58 * Math.max(0, (isFront ? 1 : -1) * cosine(view.light));
      this.fill([a, b, c].map(view.place), (weights) => colour(t, weights, isFront).map((x) => Math.min(255, x * brightness)));
    }
  }

  fill([p, q, r], colour) {
    const double = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    if (double === 0) return;
    const range = (k, most) => [Math.max(0, Math.ceil(Math.min(p[k], q[k], r[k]))), Math.min(most - 1, Math.floor(Math.max(p[k], q[k], r[k])))];
    const [[x0, x1], [y0, y1]] = [range(0, this.columns), range(1, this.rows)];
    for (let y = y0; y <= y1; y++) {
      for (let x = x0; x <= x1; x++) {
        const second = ((x - p[0]) * (r[1] - p[1]) - (y - p[1]) * (r[0] - p[0])) / double;
        const third = ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / double;
        const first = 1 - second - third;
        if (first < 0 || second < 0 || third < 0) continue;
        const depth = first * p[2] + second * q[2] + third * r[2];
        if (depth > this.depths[y * this.columns + x]) this.set(x, y, depth, colour([first, second, third]));
      }
    }
  }

  /** A round dot at a point; `nearer` lifts it off the surface that it lies on. */
  dot(view, point, radius, colour, nearer = 0) {
    this.disc(view.place(point), radius * FINER, colour, nearer);
  }

  disc([x, y, depth], radius, colour, nearer) {
    for (let dy = -Math.floor(radius); dy <= radius; dy++) {
      for (let dx = -Math.floor(radius); dx <= radius; dx++) {
        if (dx * dx + dy * dy <= radius * radius) this.set(Math.round(x) + dx, Math.round(y) + dy, depth + nearer, colour);
      }
    }
  }

  /** A line from point to point. */
  line(view, points, radius, colour, nearer = 0) {
    for (let k = 0; k + 1 < points.length; k++) {
      const [p, q] = [view.place(points[k]), view.place(points[k + 1])];
      const steps = Math.max(1, Math.ceil(Math.hypot(q[0] - p[0], q[1] - p[1])));
      for (let s = 0; s <= steps; s++) this.disc(p.map((x, axis) => x + ((q[axis] - x) * s) / steps), radius * FINER, colour, nearer);
    }
  }

  png() {
    const pixels = new Uint8Array(3 * this.width * this.height);
    pixels.forEach((_, k) => {
      const [x, y, channel] = [Math.floor(k / 3) % this.width, Math.floor(k / 3 / this.width), k % 3];
      let sum = 0;
      for (let j = 0; j < FINER; j++) {
        for (let i = 0; i < FINER; i++) sum += this.colours[3 * ((y * FINER + j) * this.columns + x * FINER + i) + channel];
      }
      const mean = sum / FINER ** 2;
      pixels[k] = mean > 255 - STEP / 2 ? 255 : STEP * Math.round(mean / STEP);
    });
    return png(this.width, this.height, pixels);
  }
}

/** Between two colours. */
export const mix = (one, other, share) => one.map((x, k) => x + (other[k] - x) * share);
export { WHITE };
