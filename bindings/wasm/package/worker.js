// A worker of the pool: simplifies one raster after the other, and tells of progress.
import { holdLock } from './alive.js';
import { start } from './module.js';
import { simplifyPointsSync, simplifySync } from './simplify.js';

const WORKS = { simplify: simplifySync, simplifyPoints: simplifyPointsSync };

/// Compilers of WebAssembly optimise what has run: a small raster, so that the first of the caller's is not slow.
function warmUp() {
  const side = 65;
  const z = Float32Array.from({ length: side * side }, (_, k) => {
    const x = k % side, y = Math.floor(k / side);
    return 20 * Math.sin(x / 7) * Math.cos(y / 5) + ((x * 7919 + y * 104729) % 97) / 20;
  });
  for (const effort of ['fast', 'normal']) simplifySync(z, side, side, { maxError: 1, effort });
}

async function answer({ id, work, module, args, flag, tells }, post) {
  try {
    if (module) {
      post({ lock: await holdLock() });
      await start(module);
      warmUp();
      post({ id });
      return;
    }
    const options = args.at(-1);
    if (tells) options.onProgress = progress => post({ id, progress });
    const mesh = WORKS[work](...args, flag && new Int32Array(flag));
    post({ id, mesh: { ...mesh } }, mesh.transferables());
  } catch (error) {
    post({ id, error: { code: error.code ?? 'internal', message: error.message } });
  }
}

if (typeof postMessage === 'function') {
  onmessage = event => answer(event.data, (data, moved = []) => postMessage(data, moved));
} else {  // Node's
  const name = 'node:worker_threads';
  import(/* webpackIgnore: true */ /* @vite-ignore */ name).then(({ parentPort }) => {
    parentPort.on('message', message => answer(message, (data, moved = []) => parentPort.postMessage(data, moved)));
  });
}
