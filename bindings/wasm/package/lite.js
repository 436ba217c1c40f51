// The Refiner alone, with a module of a third of the size.
import { defaults } from './ready.js';
import { hills, SIDE } from './hills.js';
import { Refiner } from './refiner.js';

defaults.source ??= () => new URL('./lite.wasm', import.meta.url);
defaults.warm ??= () => {
  const refiner = new Refiner(hills(), SIDE, SIDE);
  refiner.run({ maxError: 1 });
  refiner.free();
};

export { ScarpError } from './error.js';
export { isStarted as isReady, version } from './module.js';
export { Mesh } from './mesh.js';
export { Refiner } from './refiner.js';
export { encodeGlb } from './glb.js';
export { decodeTile } from './decode.js';
export { ready } from './ready.js';
