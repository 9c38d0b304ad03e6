// A picture of squares, as PNG: they show how a texture stretches, their colours which part of it is where.
import { png } from './png.js';

const CELLS = 32;
const PIXELS_OF_CELL = 32;
/** Cells along each side of a field of one hue. */
const CELLS_OF_HUE = 4;
const FIELDS = CELLS / CELLS_OF_HUE;

/** Red, green and blue, from 0 to 255, of a hue in degrees; saturation and lightness are shares. */
function rgb(hue: number, saturation: number, lightness: number): number[] {
  const spread = saturation * Math.min(lightness, 1 - lightness);
  return [0, 8, 4].map((shift) => {
    const place = (shift + hue / 30) % 12;
    return Math.round(255 * (lightness - spread * Math.max(-1, Math.min(place - 3, 9 - place, 1))));
  });
}

/** Two colours for each field of the picture: of its dark squares, and its light ones. */
function palette(): number[] {
  return Array.from({ length: FIELDS * FIELDS }, (_, field) => {
    const hue = ((field % FIELDS) * 47 + Math.floor(field / FIELDS) * 101) % 360;
    return [...rgb(hue, 0.38, 0.52), ...rgb(hue, 0.28, 0.9)];
  }).flat();
}

/** The picture: 1024 pixels along each side, indices into its palette. */
export function checkerPng(): Uint8Array {
  const side = CELLS * PIXELS_OF_CELL;
  const pixels = new Uint8Array(side * side);
  pixels.forEach((_, k) => {
    const [i, j] = [Math.floor((k % side) / PIXELS_OF_CELL), Math.floor(k / side / PIXELS_OF_CELL)];
    const field = Math.floor(i / CELLS_OF_HUE) + FIELDS * Math.floor(j / CELLS_OF_HUE);
    pixels[k] = 2 * field + ((i + j) % 2);
  });
  return png(side, side, pixels, palette());
}
