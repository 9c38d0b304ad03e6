export type * from './api.js';
export { WindingError, type ErrorCode } from './error.js';
