// Scattered points and terrain tiles, too.
import { defaults, findModule, makeMovedWorker } from './ready.js';
import { pool } from './pool.js';

const beside = () => new URL('./full.wasm', import.meta.url);
defaults.source ??= () => findModule(beside());
defaults.worker ??= () => makeMovedWorker(beside()) ?? new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });

export * from './api.js';
export { simplifyPointsSync } from './simplify.js';
export { Tiler } from './tiles.js';

/// As simplifyPointsSync(), in a worker of a pool that all calls share.
export const simplifyPoints = async (points, options) => pool().simplifyPoints(points, options);
