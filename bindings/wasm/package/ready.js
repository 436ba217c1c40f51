// Where the module and the worker come from: each entry of the package says so.
import { start } from './module.js';

export const defaults = { source: null, worker: null };

/// Loads the library, once. `source`: the module's bytes, their URL or Response, or a WebAssembly.Module.
export async function ready(source) {
  await start(source ?? defaults.source());
}
