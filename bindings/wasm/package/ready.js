// Where the module and the worker come from: each entry of the package says so.
import { start } from './module.js';
import { takeOptions } from './options.js';

export const defaults = { source: null, worker: null, warm: null };

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
