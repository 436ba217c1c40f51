export { ScarpError, ready, isReady, version, Mesh, Refiner, encodeGlb, decodeTile } from './index.js';
export type { Bytes, Corners, Doubles, ErrorCode, Floats, Heights, Numbers, Place } from './index.js';
