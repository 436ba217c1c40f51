export { ScarpError, ready, isReady, version, Mesh, Refiner, encodeGlb, decodeTile } from './index.js';
export type { ErrorCode, Heights, Place } from './index.js';
