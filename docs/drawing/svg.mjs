// Drawings as SVG: a white page, shapes and words on it.

const round = (x) => String(Math.round(10 * x) / 10);
const dashes = (dash) => (dash ? ` stroke-dasharray="${dash}"` : '');
const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');

export const INK = '#333b44';
export const ACCENTS = { blue: '#3f6fb0', orange: '#d9741f', green: '#4c9257', red: '#c73e3e', grey: '#8b949e', pale: '#e7ebef' };

export function page(width, height, parts) {
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}"`,
    'font-family="sans-serif" font-size="13" fill="none" stroke-linejoin="round">',
    `<rect width="${width}" height="${height}" rx="6" fill="#fff"/>`,
    ...parts,
    '</svg>\n',
  ].join('\n');
}

/** Points [[x, y], …] joined; closed if asked for. */
export function path(points, style, isClosed = false) {
  return rings([points], style, isClosed);
}

export function rings(all, { fill = 'none', stroke = INK, width = 1.5, dash }, isClosed = true) {
  const d = all.map((points) => points.map((p, k) => `${k ? 'L' : 'M'}${p.map(round).join(' ')}`).join('') + (isClosed ? 'Z' : '')).join('');
  return `<path d="${d}" fill="${fill}" fill-rule="evenodd" stroke="${stroke}" stroke-width="${width}"${dashes(dash)}/>`;
}

export const circle = ([x, y], radius, { fill = 'none', stroke = 'none', width = 1.5 } = {}) =>
  `<circle cx="${round(x)}" cy="${round(y)}" r="${round(radius)}" fill="${fill}" stroke="${stroke}" stroke-width="${width}"/>`;

export const box = (x, y, width, height, { fill = 'none', stroke = INK } = {}) =>
  `<rect x="${round(x)}" y="${round(y)}" width="${round(width)}" height="${round(height)}" rx="4" fill="${fill}" stroke="${stroke}" stroke-width="1.2"/>`;

/** Words; several lines below each other. */
export function text([x, y], words, { size = 13, anchor = 'start', colour = INK, weight = 'normal', lead = 1.35 } = {}) {
  const style = `font-size="${size}" text-anchor="${anchor}" fill="${colour}" font-weight="${weight}"`;
  return words.split('\n').map((line, k) => `<text x="${round(x)}" y="${round(y + k * lead * size)}" ${style}>${escaped(line)}</text>`).join('\n');
}

/** A line with a head at its end. */
export function arrow(from, to, colour = INK, dash) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  const [ux, uy] = [dx / length, dy / length];
  const wing = (side) => [to[0] - 8 * ux - side * 4 * uy, to[1] - 8 * uy + side * 4 * ux];
  return path([from, to], { stroke: colour, dash }) + path([wing(1), to, wing(-1)], { stroke: colour, fill: colour }, true);
}

/** Values over a rectangle as rows of squares of one colour each: `colour(value)` of few colours, so that rows fall into long pieces. */
export function field({ counts: [columns, rows], values }, { left, top, cell }, colour) {
  const runs = new Map();
  for (let j = 0; j < rows; j++) {
    for (let i = 0, start = 0; i < columns; i = start) {
      const here = colour(values[j * columns + i]);
      start = i + 1;
      while (start < columns && colour(values[j * columns + start]) === here) start++;
      const list = runs.get(here) ?? [];
      list.push(`M${round(left + i * cell)} ${round(top + (rows - j - 0.5) * cell)}h${round((start - i) * cell)}`);
      runs.set(here, list);
    }
  }
  return [...runs].map(([name, list]) => `<path d="${list.join('')}" stroke="${name}" stroke-width="${round(cell + 0.6)}"/>`).join('\n');
}
