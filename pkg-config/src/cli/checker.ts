// A picture of squares, as PNG: they show how a texture stretches, their colours which part of it is where.
import { deflateSync } from 'node:zlib';

const CELLS = 32;
const PIXELS_OF_CELL = 32;
/** Cells along each side of a field of one hue. */
const CELLS_OF_HUE = 4;
const FIELDS = CELLS / CELLS_OF_HUE;

const SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
/** Reversed polynomial of the checksum that PNG asks for. */
const POLYNOMIAL = 0xedb88320;

function checksum(bytes: Uint8Array): number {
  let sum = 0xffffffff;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 ? POLYNOMIAL : 0);
  }
  return (sum ^ 0xffffffff) >>> 0;
}

function chunk(type: string, data: Uint8Array): Buffer {
  const whole = Buffer.alloc(12 + data.length);
  whole.writeUInt32BE(data.length);
  whole.write(type, 4, 'latin1');
  whole.set(data, 8);
  whole.writeUInt32BE(checksum(whole.subarray(4, 8 + data.length)), 8 + data.length);
  return whole;
}

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
  // Each row begins with a byte that says how it is filtered: not at all.
  const rows = Buffer.alloc(side * (side + 1));
  for (let y = 0; y < side; y++) {
    for (let x = 0; x < side; x++) {
      const [i, j] = [Math.floor(x / PIXELS_OF_CELL), Math.floor(y / PIXELS_OF_CELL)];
      const field = Math.floor(i / CELLS_OF_HUE) + FIELDS * Math.floor(j / CELLS_OF_HUE);
      rows[y * (side + 1) + 1 + x] = 2 * field + ((i + j) % 2);
    }
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(side);
  header.writeUInt32BE(side, 4);
  header.set([8, 3], 8);
  const chunks = [chunk('IHDR', header), chunk('PLTE', Uint8Array.from(palette())), chunk('IDAT', deflateSync(rows)), chunk('IEND', new Uint8Array())];
  return Buffer.concat([Uint8Array.from(SIGNATURE), ...chunks]);
}
