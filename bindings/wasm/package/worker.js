// A worker of the pool: simplifies rasters sequentially, and reports progress.
import { holdLock } from './alive.js';
import { start } from './module.js';
import { simplifyPointsSync, simplifySync } from './simplify.js';
import { simplifyHills } from './warm.js';

const WORKS = { simplify: simplifySync, simplifyPoints: simplifyPointsSync };

async function answer({ id, work, module, args, flag, tells }, post) {
  try {
    if (module) {
      post({ lock: await holdLock() });
      await start(module);
      simplifyHills();
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
} else {
  // Node's
  const name = 'node:worker_threads';
  import(/* webpackIgnore: true */ /* @vite-ignore */ name).then(({ parentPort }) => {
    parentPort.on('message', message => answer(message, (data, moved = []) => parentPort.postMessage(data, moved)));
  });
}
