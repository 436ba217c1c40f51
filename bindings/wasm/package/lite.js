// The Refiner alone, behind a module of a third of the size.
import { defaults } from './ready.js';

defaults.source ??= () => new URL('./lite.wasm', import.meta.url);

export { ScarpError, isStarted as isReady, version } from './module.js';
export { Mesh } from './mesh.js';
export { Refiner } from './refiner.js';
export { encodeGlb } from './glb.js';
export { decodeTile } from './decode.js';
export { ready } from './ready.js';
