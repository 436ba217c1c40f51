// The WebAssembly module: its start, imports, memory and errors.

import { ScarpError } from './error.js';
import { printNumber } from './number.js';
import { kindOf, show, translate } from './options.js';

const KINDS = ['usage', 'memory', 'input', 'promise', 'output', 'cancelled', 'internal'];

let starting = null; // the promise of start()
let compiled = null;
let functions = null;
let tell = null; // called with progress during a call
let thrown = null; // thrown by it

export const isStarted = () => functions !== null;
export const compiledModule = () => compiled;

/// An array over the module's memory: valid until the next call, which may enlarge the memory.
export const view = (Kind, address, count) => new Kind(functions.memory.buffer, address, count);

function text(address) {
  const bytes = new Uint8Array(functions.memory.buffer, address);
  return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}

/// Few imports: the module opens no file, and its environment is empty.
const IMPORTS = {
  progress(pass, fraction, vertices, maxError) {
    try {
      return tell?.({ pass: text(pass), fraction, vertices, maxError }) === false ? 1 : 0;
    } catch (error) {
      // must not unwind the library
      thrown = { error };
      return 1;
    }
  },
  number(value, isFloat, style, precision, address) {
    const printed = new TextEncoder().encode(printNumber(value, isFloat !== 0, String.fromCharCode(style), precision));
    view(Uint8Array, address, printed.length).set(printed);
    return printed.length;
  },
  clock_time_get(clock, precision, time) {
    new DataView(functions.memory.buffer).setBigUint64(time, BigInt(Math.round(performance.now() * 1e6)), true);
    return 0;
  },
  environ_sizes_get(count, size) {
    view(Uint32Array, count, 1)[0] = 0;
    view(Uint32Array, size, 1)[0] = 0;
    return 0;
  },
  environ_get: () => 0,
  emscripten_notify_memory_growth() {},
};

const ADVICE = "serve the package's .wasm file there, or import 'scarp/inline', which holds it";

/// Checks the bytes from `where`, since a server may send a page instead of a missing file and report success.
function checkBytes(bytes, where) {
  const first = ArrayBuffer.isView(bytes)
    ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength)
    : new Uint8Array(bytes);
  if ([0, 0x61, 0x73, 0x6d].every((byte, k) => first[k] === byte)) return bytes;
  const isPage = /^\s*</.test(new TextDecoder().decode(first.subarray(0, 64)));
  const is = isPage
    ? "a page of HTML, with which a server answers where it has no file; vite's dev server needs " +
      "optimizeDeps: { exclude: ['scarp'] }"
    : `no WebAssembly: ${first.length === 0 ? 'it is empty' : 'it begins with other bytes'}`;
  throw new ScarpError('input', `${where} is ${is}; ${ADVICE}`);
}

function refuse(error) {
  const why = error?.message ?? String(error);
  return new ScarpError(
    'unsupported',
    `WebAssembly is refused here: ${why}; it needs WebAssembly with SIMD and exceptions ` +
      `(Chrome 95, Firefox 100, Safari 16.4, Node 18), and a content policy with 'wasm-unsafe-eval'`,
    { cause: error },
  );
}

/// The bytes at an address; in Node also the bytes of a file, which its fetch() cannot read.
async function fetchBytes(address) {
  let url = address;
  try {
    url = new URL(address, globalThis.location?.href);
    if (url.protocol === 'file:' && globalThis.process?.versions?.node !== undefined) {
      const name = 'node:fs/promises';
      const files = await import(/* webpackIgnore: true */ /* @vite-ignore */ name);
      return await files.readFile(url);
    }
    return await readBytes(await fetch(url));
  } catch (error) {
    if (error instanceof ScarpError) throw error;
    throw new ScarpError(
      'input',
      `${url} cannot be loaded: ${error.message}; ${ADVICE}; a content policy needs it in connect-src`,
      { cause: error },
    );
  }
}

async function readBytes(response) {
  if (response.ok) return response.arrayBuffer();
  throw new ScarpError('input', `${response.url} cannot be loaded: HTTP ${response.status}; ${ADVICE}`);
}

async function takeBytes(source) {
  if (kindOf(source) === 'ArrayBuffer' || ArrayBuffer.isView(source))
    return checkBytes(source, 'what ready() was given');
  if (kindOf(source) === 'Response') return checkBytes(await readBytes(source), source.url || 'the Response');
  if (typeof source !== 'string' && typeof source?.href !== 'string')
    throw new ScarpError(
      'usage',
      `ready() was given ${show(source)}; it takes the module's bytes, their URL or Response, or a WebAssembly.Module`,
    );
  return checkBytes(await fetchBytes(source), source);
}

async function instantiate(source) {
  if (typeof WebAssembly === 'undefined') throw refuse('there is none');
  if (kindOf(source) === 'WebAssembly.Module') compiled = source;
  else {
    const bytes = await takeBytes(source);
    try {
      compiled = await WebAssembly.compile(bytes);
    } catch (error) {
      throw refuse(error);
    }
  }
  if (!WebAssembly.Module.exports(compiled).some(({ name }) => name === 'scarp_version'))
    throw new ScarpError('input', `what ready() was given is a module of WebAssembly, but not Scarp's; ${ADVICE}`);
  const imports = {};
  for (const { module, name } of WebAssembly.Module.imports(compiled)) {
    (imports[module] ??= {})[name] =
      IMPORTS[name] ??
      (() => {
        throw new ScarpError('internal', `the library asked for ${name}; please report it`);
      });
  }
  try {
    ({ exports: functions } = await WebAssembly.instantiate(compiled, imports));
    functions._initialize();
  } catch (error) {
    functions = null;
    throw refuse(error);
  }
}

/// Compiles and starts the module once. `source`: its bytes, their URL or Response, or a module.
export function start(source) {
  starting ??= instantiate(source).catch(error => {
    starting = null;
    throw error;
  });
  return starting;
}

/// Calls a function of the module. `progress` is called meanwhile, and returns false to cancel.
export function call(name, args, progress) {
  if (!functions) throw new ScarpError('usage', 'the library is not loaded yet: await ready() first');
  if (!functions[name]) {
    const { scarp_simplify, scarp_live_create } = functions;
    const loaded = scarp_live_create ? 'scarp/live' : scarp_simplify ? 'scarp' : 'scarp/lite';
    const needed = /points|tiler/.test(name)
      ? 'scarp/full, which has points and tiles'
      : /live/.test(name)
        ? 'scarp/live, which has fields that change'
        : 'scarp, or scarp/full';
    throw new ScarpError(
      'usage',
      `the module of ${loaded} was loaded first, and does not hold that: in place of ${loaded} import ${needed}`,
    );
  }
  const outer = [tell, thrown];
  [tell, thrown] = [progress, null];
  try {
    const result = functions[name](...args);
    if (thrown) throw thrown.error;
    return result;
  } catch (error) {
    if (thrown) throw thrown.error;
    if (!(error instanceof WebAssembly.RuntimeError || error instanceof RangeError)) throw error;
    throw new ScarpError('internal', `the library failed: ${error.message}; please report it`, { cause: error });
  } finally {
    [tell, thrown] = outer;
  }
}

/// The same for a function that returns 0 on failure; throws its message.
export function callOrThrow(name, args, progress) {
  const result = call(name, args, progress);
  if (result) return result;
  throw lastError();
}

export const lastError = () =>
  new ScarpError(KINDS[functions.scarp_error_kind()], translate(text(functions.scarp_error_text())));

export const version = () => text(call('scarp_version', []));

/// Blocks of the module's memory that are freed together.
export class Blocks {
  #addresses = [];
  allocate(bytes) {
    const address = bytes < 2 ** 32 && call('scarp_allocate', [Math.max(bytes, 8)]);
    if (!address) {
      throw new ScarpError(
        'memory',
        `there is no memory for ${bytes} bytes: a module of WebAssembly has 4 GiB at most; ` + 'take a smaller raster',
      );
    }
    this.#addresses.push(address);
    return address;
  }
  /// Copies an array to the module's memory.
  put(array) {
    const address = this.allocate(array.byteLength);
    view(globalThis[kindOf(array)], address, array.length).set(array);
    return address;
  }
  free() {
    for (const address of this.#addresses.splice(0)) call('scarp_release', [address]);
  }
}

/// Runs `work` with blocks that are freed afterwards.
export function withBlocks(work) {
  const blocks = new Blocks();
  try {
    return work(blocks);
  } finally {
    blocks.free();
  }
}
