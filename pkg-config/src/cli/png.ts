// Pictures as PNG.
import { deflateSync } from 'node:zlib';

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

/** How a row says that each byte is the difference to the one above; the alternative is none. */
const [UNFILTERED, UP] = [0, 2];

/** A picture, its first row at the top: red, green and blue of each pixel, or its place in `palette`, which holds three for each colour. */
export function png(width: number, height: number, pixels: Uint8Array, palette?: readonly number[]): Uint8Array {
  const bytes = palette ? width : 3 * width;
  // Places in a palette are no amounts, of which differences would be small.
  const filter = palette ? UNFILTERED : UP;
  const rows = Buffer.alloc(height * (bytes + 1));
  for (let y = 0; y < height; y++) {
    const row = pixels.subarray(y * bytes, (y + 1) * bytes);
    const above = filter === UP && y > 0 ? pixels.subarray((y - 1) * bytes, y * bytes) : undefined;
    rows[y * (bytes + 1)] = filter;
    rows.set(above ? row.map((value, k) => value - above[k]!) : row, y * (bytes + 1) + 1);
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width);
  header.writeUInt32BE(height, 4);
  header.set([8, palette ? 3 : 2], 8);
  const colours = palette ? [chunk('PLTE', Uint8Array.from(palette))] : [];
  const chunks = [chunk('IHDR', header), ...colours, chunk('IDAT', deflateSync(rows, { level: 9 })), chunk('IEND', new Uint8Array())];
  return Buffer.concat([Uint8Array.from(SIGNATURE), ...chunks]);
}
