// The package with scattered points and terrain tiles.
import { defaults } from './ready.js';
import { pool } from './pool.js';

defaults.source ??= () => new URL('./full.wasm', import.meta.url);
defaults.worker ??= () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });

export * from './api.js';
export { simplifyPointsSync } from './simplify.js';
export { Tiler } from './tiles.js';

/// Like simplifyPointsSync(), in a worker of a common pool.
export const simplifyPoints = async (points, options) => pool().simplifyPoints(points, options);
