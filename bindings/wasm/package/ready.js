// The addresses of the module and the worker: each entry of the package sets them.
import { ScarpError } from './error.js';
import { start } from './module.js';
import { takeOptions } from './options.js';

export const defaults = { source: null, worker: null, warm: null, workerAdvice: null };

/// Bundles in formats other than esm have no import.meta.url.
export function explainAddress(cause) {
  if (!(cause instanceof TypeError && /URL/.test(cause.message))) return cause;
  return new ScarpError(
    'unsupported',
    'the bundle does not know its own address, where its files lie: import.meta.url is undefined in formats ' +
      "other than esm; take --format=esm, or import 'scarp/inline', or give ready(url) and createPool({ worker })",
    { cause },
  );
}

function locate() {
  try {
    return defaults.source();
  } catch (cause) {
    throw explainAddress(cause);
  }
}

/// Loads the library once. `source`: the module's bytes, their URL or Response, or a WebAssembly.Module.
export async function ready(source, options = {}) {
  const { warm } = takeOptions(options, 'ready');
  await start(source ?? locate());
  // The pauses are for compilers, which run in parallel.
  for (let round = 0; warm && round < 3; ++round) {
    defaults.warm();
    await new Promise(done => setTimeout(done, 30));
  }
}
