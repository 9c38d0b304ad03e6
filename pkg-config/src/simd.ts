/** A module whose one function splats a number into a vector. */
// prettier-ignore
const SPLAT = [
  0, 97, 115, 109, 1, 0, 0, 0, // magic, version
  1, 5, 1, 96, 0, 1, 123,      // type: () -> v128
  3, 2, 1, 0,                  // function 0 has it
  10, 8, 1, 6, 0, 65, 0, 253, 15, 11, // i32.const 0, i8x16.splat
];

/** Whether WebAssembly has SIMD here. */
export function hasSimd(): boolean {
  return typeof WebAssembly === 'object' && WebAssembly.validate(new Uint8Array(SPLAT));
}
