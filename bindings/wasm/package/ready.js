// Where the module and the worker come from: each entry of the package says so.
import { start } from './module.js';
import { takeOptions } from './options.js';

export const defaults = { source: null, worker: null, warm: null };

/// vite's dev server moves scripts of node_modules/scarp to node_modules/.vite/deps, and leaves there what lies beside them: the
/// package's place then. `beside`: the address of a file beside a script.
const findPackage = beside => {
  const [moved] = /\/\.vite\/(?:\w+\/)?deps\w*\//.exec(beside.pathname) ?? [];
  return moved && new URL(`${beside.href.slice(0, beside.href.indexOf(moved))}/scarp/`);
};
/// Of the module beside a script.
export const findModule = beside => {
  const home = findPackage(beside);
  return home ? new URL(beside.pathname.split('/').pop(), home) : beside;
};
/// Undefined where the bundler's is the right one.
export const makeMovedWorker = beside => {
  const home = findPackage(beside);
  return home && new Worker(new URL('worker.js', home), { type: 'module' });
};

/// Loads the library, once. `source`: the module's bytes, their URL or Response, or a WebAssembly.Module.
export async function ready(source, options = {}) {
  const { warm } = takeOptions(options, 'ready');
  await start(source ?? defaults.source());
  // The pauses are for compilers, which work beside this thread.
  for (let round = 0; warm && round < 3; ++round) {
    defaults.warm();
    await new Promise(done => setTimeout(done, 30));
  }
}
