// Workers that simplify one raster each, which is faster than several threads for one raster.
import { watchLock } from './alive.js';
import { ScarpError } from './error.js';
import { compiledModule } from './module.js';
import { defaults, explainAddress, ready } from './ready.js';
import { Mesh } from './mesh.js';
import { checkHeights, refuse, takeBeside } from './heights.js';
import { kindOf, show, takeOptions } from './options.js';
import { checkPoints, checkSignal } from './simplify.js';

/// Messages where no worker can be created: in a page with Trusted Types, and for a script without an address.
function makeHere(make) {
  try {
    return make();
  } catch (cause) {
    if (!/TrustedScriptURL/.test(cause?.message)) throw make === defaults.worker ? explainAddress(cause) : cause;
    throw new ScarpError(
      'unsupported',
      `the page's policy require-trusted-types-for refuses the worker's address (${cause.message}): give ` +
        'createPool({ worker: () => new Worker(policy.createScriptURL(address)) }) with a policy of your own',
      { cause },
    );
  }
}

/// Node's workers are in a module. Bundlers recognise only `new Worker()` with the global name, which is set during the
/// call.
async function makeInNode(make) {
  const name = 'node:worker_threads';
  const threads = await import(/* webpackIgnore: true */ /* @vite-ignore */ name);
  const had = globalThis.Worker;
  globalThis.Worker = threads.Worker;
  try {
    return makeHere(make);
  } finally {
    if (had) globalThis.Worker = had;
    else delete globalThis.Worker;
  }
}

/// A worker of the browser or of Node, with the same two functions.
async function openWorker(make, onMessage, onFailure) {
  const worker = typeof Worker === 'undefined' ? await makeInNode(make) : makeHere(make);
  if (typeof worker?.postMessage !== 'function')
    throw new ScarpError('usage', `createPool({ worker }) made ${show(worker)}, and no Worker`);
  if (worker.on) {
    worker.on('message', onMessage);
    worker.on('error', onFailure);
    worker.on('exit', () => onFailure(new Error('it has ended')));
  } else {
    worker.onmessage = event => onMessage(event.data);
    worker.onerror = event => onFailure(new Error(event.message ?? 'its script cannot be loaded'));
    worker.onmessageerror = () => onFailure(new Error('a message to it cannot be read'));
  }
  return worker;
}

const WORKER_ADVICE =
  'its script is scarp/worker, which a bundler may not have found, or a content policy refuses: it needs ' +
  "worker-src 'self'; give createPool({ worker }), or import 'scarp/inline'";
const mayShare = () => typeof SharedArrayBuffer !== 'undefined' && globalThis.crossOriginIsolated !== false;
const cancelled = signal => new ScarpError('cancelled', 'the call was cancelled', { cause: signal?.reason });

/// One worker and its job.
class Hand {
  isBusy = false;
  #isOver = false;
  #make;
  #worker = null;
  #running = null;
  #serial = 0;
  #hear = null;
  #lose = null;

  constructor(make) {
    this.#make = make;
  }

  /// Sends a message, and receives progress until the answer arrives.
  #exchange(message, moved, onProgress) {
    return new Promise((resolve, reject) => {
      const id = ++this.#serial;
      this.#lose = reject;
      this.#hear = answer => {
        if (answer.id !== id) return;
        if (answer.progress) onProgress(answer.progress);
        else if (answer.error) reject(new ScarpError(answer.error.code, answer.error.message));
        else resolve(answer.mesh);
      };
      this.#worker.postMessage({ id, ...message }, moved);
    });
  }

  /// Starts the worker, and warms it up; not after close().
  async #open() {
    await ready();
    if (this.#isOver) return;
    const fail = error => {
      if (worker === this.#worker) this.end(error);
    };
    const worker = await openWorker(
      this.#make,
      answer => {
        if (answer.lock === undefined) this.#hear(answer);
        else if (answer.lock) {
          watchLock(answer.lock, () =>
            fail(
              new ScarpError(
                'memory',
                'the browser ended a worker, most likely for lack of memory: take a ' +
                  'smaller raster or a larger error, or fewer workers by createPool({ size })',
              ),
            ),
          );
        }
      },
      cause =>
        fail(
          new ScarpError('internal', `a worker failed: ${cause.message}; ${defaults.workerAdvice ?? WORKER_ADVICE}`, {
            cause,
          }),
        ),
    );
    if (this.#isOver) return void worker.terminate();
    this.#worker = worker;
    await this.#exchange({ module: compiledModule() }, []);
  }

  async run(job) {
    this.isBusy = true;
    try {
      if (!this.#worker) await this.#open();
      if (job.isOver) return;
      this.#worker.ref?.();
      this.#running = job;
      job.flag = mayShare() ? new SharedArrayBuffer(4) : null;
      const { work, args, flag, moved, onProgress } = job;
      const mesh = await this.#exchange({ work, args, flag, tells: Boolean(onProgress) }, moved, job.tell);
      job.resolve(new Mesh(mesh));
    } catch (error) {
      job.reject(error);
    } finally {
      this.#running = null;
      this.isBusy = false;
      this.#worker?.unref?.();
    }
  }

  /// A busy worker receives no message: it checks shared memory, or is replaced.
  stop(job) {
    if (job !== this.#running) return;
    if (job.flag) Atomics.store(new Int32Array(job.flag), 0, 1);
    else this.end(cancelled());
  }

  end(error) {
    const worker = this.#worker;
    this.#worker = null;
    worker?.terminate();
    this.#lose?.(error);
  }

  close(error) {
    this.#isOver = true;
    this.end(error);
  }
}

/// The values for a worker: a copy, or the array itself, whose buffer is moved away from the caller.
function take(array, isMoved) {
  if (!isMoved) return array.slice();
  if (kindOf(array.buffer) === 'SharedArrayBuffer')
    refuse(
      'transfer moves the buffer of the heights, and theirs is a SharedArrayBuffer, which cannot be moved: ' +
        'leave transfer out',
    );
  try {
    return globalThis.structuredClone ? structuredClone(array, { transfer: [array.buffer] }) : array;
  } catch (cause) {
    throw new ScarpError('usage', `the buffer of the heights cannot be moved (${cause.message}): leave transfer out`, {
      cause,
    });
  }
}

const cores = () => globalThis.navigator?.hardwareConcurrency ?? 4;

class Pool {
  #hands;
  #waiting = [];
  #jobs = new Set();
  #isOver = false;

  constructor(options = {}) {
    const { size = Math.min(4, Math.max(1, cores() - 1)), worker = defaults.worker } = takeOptions(options, 'pool');
    this.#hands = Array.from({ length: size }, () => new Hand(worker));
  }

  get size() {
    return this.#hands.length;
  }

  #next() {
    const hand = this.#hands.find(free => !free.isBusy);
    if (!hand || this.#waiting.length === 0) return;
    const job = this.#waiting.shift();
    job.hand = hand;
    hand.run(job).finally(() => this.#next());
    this.#next();
  }

  /// `given`: the arguments, which no other code changes; buffers of `moved` are moved to the worker.
  #add(work, given, moved, { signal, onProgress, transfer, ...options }) {
    return new Promise((resolve, reject) => {
      checkSignal(signal);
      const job = { work, args: [...given, options], moved, onProgress, isOver: false };
      const settle = end => value => {
        if (job.isOver) return;
        job.isOver = true;
        signal?.removeEventListener('abort', onAbort);
        this.#jobs.delete(job);
        end(value);
      };
      job.resolve = settle(resolve);
      job.reject = settle(reject);
      job.cancel = error => {
        job.reject(error);
        if (job.hand) job.hand.stop(job);
        else this.#waiting = this.#waiting.filter(other => other !== job);
      };
      job.tell = progress => {
        if (job.isOver) return;
        try {
          if (onProgress(progress) === false) job.cancel(cancelled());
        } catch (error) {
          job.cancel(error);
        }
      };
      const onAbort = () => job.cancel(cancelled(signal));
      signal?.addEventListener('abort', onAbort);
      this.#jobs.add(job);
      this.#waiting.push(job);
      this.#next();
    });
  }

  #check() {
    if (this.#isOver) throw new ScarpError('usage', 'the pool was terminated');
  }

  /// Like simplifySync(), in a worker. Inputs are copied during the call, so the caller may change them afterwards;
  /// `transfer`: the heights' buffer is moved, not copied.
  async simplify(z, width, height, options = {}) {
    const taken = takeOptions(options, 'simplify');
    const { given, samples, rounding, nodata } = checkHeights(z, width, height, taken.nodata);
    checkSignal(taken.signal);
    this.#check();
    for (const name of ['mask', 'tolerance']) {
      const beside = takeBeside(name, taken[name], width, height);
      if (beside) taken[name] = beside;
    }
    if (taken.transform) taken.transform = Array.from(taken.transform);
    // Float64 is sent unchanged: the worker rounds it to float32, and finds nodata.
    if (!rounding) taken.nodata = nodata;
    const own = samples === z ? take(z, taken.transfer) : rounding ? Float64Array.from(given) : samples;
    return this.#add('simplify', [own, width, height], [own.buffer], taken);
  }

  async simplifyPoints(points, options = {}) {
    const taken = takeOptions(options, 'simplifyPoints');
    const given = checkPoints(points);
    checkSignal(taken.signal);
    this.#check();
    const own = kindOf(given) === 'Float64Array' ? take(given, taken.transfer) : Float64Array.from(given);
    return this.#add('simplifyPoints', [own], [own.buffer], taken);
  }

  /// Ends the workers, and rejects their jobs.
  terminate() {
    this.#isOver = true;
    const error = new ScarpError('cancelled', 'the pool was terminated');
    for (const job of [...this.#jobs]) job.cancel(error);
    for (const hand of this.#hands) hand.close(error);
  }
}

export const createPool = options => new Pool(options);

let common = null;
/// The pool for calls that have no pool of their own.
export const pool = () => (common ??= createPool());
