// A mesh that grows by one vertex at a time, the worst sample first.
import { Blocks, ScarpError, call, callOrThrow, lastError, withBlocks } from './module.js';
import { checkOptions, putField } from './heights.js';
import { takeMesh } from './mesh.js';

const forgotten = new FinalizationRegistry(({ handle, blocks }) => {
  call('scarp_refiner_free', [handle]);
  blocks.free();
});

export class Refiner {
  #held;

  constructor(z, width, height, options = {}) {
    checkOptions(options);
    const blocks = new Blocks();
    try {
      this.#held = { handle: callOrThrow('scarp_refiner_create', [putField(blocks, z, width, height, options)]), blocks };
    } catch (error) {
      blocks.free();
      throw error;
    }
    forgotten.register(this, this.#held, this);
  }

  get #handle() {
    if (!this.#held) throw new ScarpError('usage', 'the Refiner was freed');
    return this.#held.handle;
  }

  #insert(maxError, maxVertices, most) {
    const inserted = call('scarp_refiner_run', [this.#handle, maxError, maxVertices, most]);
    if (inserted < 0) throw lastError();
    return inserted;
  }

  /// Inserts until the largest error is at most maxError, or there are maxVertices. Returns how many were inserted.
  run({ maxError = 0, maxVertices = 0 } = {}) {
    if (!(maxError >= 0)) throw new ScarpError('usage', `maxError is ${maxError}; it is a number, at least 0`);
    return this.#insert(maxError, maxVertices, Infinity);
  }
  /// False once every sample is exact.
  insertWorst() {
    return this.#insert(-1, 0, 1) === 1;
  }
  get maxError() {
    return call('scarp_refiner_max_error', [this.#handle]);
  }
  get vertexCount() {
    return call('scarp_refiner_vertices', [this.#handle]);
  }
  get triangleCount() {
    return call('scarp_refiner_triangles', [this.#handle]);
  }
  /// Without a report: nobody has measured it but the refiner, which knows its largest error.
  mesh() {
    const mesh = withBlocks(blocks => takeMesh(blocks, callOrThrow('scarp_refiner_mesh', [this.#handle])));
    delete mesh.report;
    delete mesh.rmse;
    return mesh;
  }
  free() {
    if (!this.#held) return;
    forgotten.unregister(this);
    call('scarp_refiner_free', [this.#held.handle]);
    this.#held.blocks.free();
    this.#held = null;
  }
}
if (Symbol.dispose) Refiner.prototype[Symbol.dispose] = Refiner.prototype.free;
