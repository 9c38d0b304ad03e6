// Interop with three.js. Nothing of three is imported but its types: what makes its objects is handed its module.
export { type ReadGeometryOptions, cloudArrays, soupArrays } from './read.js';
export { type ThreeGeometry, type ThreeTexture } from './module.js';
export { type ContourOptions, contourGeometry } from './contours.js';
export type { MeshArrays } from '../mesh-arrays.js';
export { toGeometry } from './mesh.js';
export { type PlaneTextureOptions, planeGeometry, planeTexture } from './plane.js';
