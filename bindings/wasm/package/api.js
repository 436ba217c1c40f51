// The exports of the entries for rasters.
import { pool } from './pool.js';
import { defaults } from './ready.js';
import { simplifyHills } from './warm.js';

defaults.warm ??= simplifyHills;

export { ScarpError } from './error.js';
export { isStarted as isReady, version } from './module.js';
export { Mesh } from './mesh.js';
export { measure, simplifySync } from './simplify.js';
export { Refiner } from './refiner.js';
export { encodeGlb } from './glb.js';
export { decodeTile } from './decode.js';
export { createPool } from './pool.js';
export { ready } from './ready.js';

/// Like simplifySync(), in a worker of a common pool.
export const simplify = async (z, width, height, options) => pool().simplify(z, width, height, options);
