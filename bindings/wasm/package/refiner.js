// A mesh that grows by one vertex at a time, the worst sample first.
import { ScarpError } from './error.js';
import { Blocks, call, callOrThrow, lastError, withBlocks } from './module.js';
import { putField } from './heights.js';
import { takeMesh } from './mesh.js';
import { takeOptions } from './options.js';

const forgotten = new FinalizationRegistry(({ handle, blocks }) => {
  call('scarp_refiner_free', [handle]);
  blocks.free();
});

export class Refiner {
  #held;
  #rounding; // largest rounding of the heights, added to each error

  constructor(z, width, height, options = {}) {
    const place = takeOptions(options, 'place');
    const blocks = new Blocks();
    try {
      const { address, rounding } = putField(blocks, z, width, height, place);
      this.#rounding = rounding;
      this.#held = { handle: callOrThrow('scarp_refiner_create', [address]), blocks };
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

  /// Inserts until the largest error is at most maxError, or there are maxVertices. Returns the number inserted.
  run(goals = {}) {
    const { maxError, maxVertices = 0 } = takeOptions(goals, 'refine');
    const rounding = this.#rounding;
    if (maxError < rounding) {
      throw new ScarpError(
        'promise',
        `a maxError of ${maxError} cannot be kept: the heights do not fit float32 and are rounded by up to ` +
          `${rounding}; ask for that or more, or subtract a base from the heights`,
      );
    }
    // Slightly less, so that bound + rounding is not rounded above maxError.
    const bound = rounding > 0 ? Math.max(0, maxError * (1 - 2 ** -52) - rounding) : maxError;
    return this.#insert(maxError === undefined ? 0 : bound, maxVertices, Infinity);
  }
  /// False once every sample is exact.
  insertWorst() {
    return this.#insert(-1, 0, 1) === 1;
  }
  get maxError() {
    return call('scarp_refiner_max_error', [this.#handle]) + this.#rounding;
  }
  get vertexCount() {
    return call('scarp_refiner_vertices', [this.#handle]);
  }
  get triangleCount() {
    return call('scarp_refiner_triangles', [this.#handle]);
  }
  /// Has no report: the refiner knows only its largest error.
  mesh() {
    const mesh = withBlocks(blocks =>
      takeMesh(blocks, callOrThrow('scarp_refiner_mesh', [this.#handle]), { rounding: this.#rounding }),
    );
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
