// All that the package's callers see, a file for each subject.
export type * from './boolean-api.js';
export type * from './check-api.js';
export type * from './cloud-api.js';
export type * from './common-api.js';
export type * from './distance-api.js';
export type * from './engine-api.js';
export type * from './field-api.js';
export type * from './print-api.js';
export type * from './repair-api.js';
export type * from './shape-api.js';
export type * from './slice-api.js';
export type * from './soup-api.js';
export type * from './texture-api.js';
export type * from './voxels-api.js';
