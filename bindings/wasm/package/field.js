// A field that changes many times a second, and its mesh: an update remakes only the cells that it touches.
import { ScarpError } from './error.js';
import { call, callOrThrow, view, withBlocks } from './module.js';
import { checkLength, checkSide, putDoubles, putField, refuse, takeBeside, takeRaster, takeWindow } from './heights.js';
import { takeMesh } from './mesh.js';
import { choose, show, takeOptions } from './options.js';

const STATE = 8;
const CELL = 9;
const forgotten = new FinalizationRegistry(handle => call('scarp_live_free', [handle]));

function checkWhole(name, value) {
  if (!Number.isInteger(value) || Math.abs(value) > 2 ** 31 - 1)
    refuse(`${name} is ${show(value)}; it is a whole number below 2^31 in size`);
}

export class Live {
  #held;
  #nodata;

  constructor(z, width, height, options) {
    const taken = takeOptions(options, 'live');
    const {
      maxTriangles,
      maxError = maxTriangles && 0,
      effort = 'fast',
      cell = 0,
      tolerance,
      place = [0, 0],
      level = NaN,
      nodata,
      transform,
      degrees,
    } = taken;
    if (maxError === undefined) refuse('maxError is missing: give { maxError: 0.05 }');
    for (const value of place) checkWhole('place', value);
    this.#nodata = nodata;
    this.#held = withBlocks(blocks => {
      const { address } = putField(blocks, takeRaster(z, width, height, nodata), width, height, { transform, degrees });
      const bounds = tolerance ? blocks.put(takeBeside('tolerance', tolerance, width, height)) : 0;
      const asked = putDoubles(
        blocks,
        maxError,
        choose('effort', effort),
        cell,
        bounds,
        Array.from(place),
        maxTriangles ?? 0,
        level,
      );
      return callOrThrow('scarp_live_create', [address, asked]);
    });
    forgotten.register(this, this.#held, this);
  }

  get #handle() {
    if (!this.#held) throw new ScarpError('usage', 'the Live field was freed');
    return this.#held;
  }

  get #state() {
    return withBlocks(blocks => {
      const out = blocks.allocate(8 * STATE);
      call('scarp_live_state', [this.#handle, out]);
      const [width, height, col, row, maxError, triangleCount, slotCount, level] = view(Float64Array, out, STATE);
      return { width, height, place: [col, row], maxError, triangleCount, slotCount, level };
    });
  }

  /// Replaces the samples of a window, row by row. A failed call changes nothing.
  update(window, z, options = {}) {
    const { tolerance } = takeOptions(options, 'update');
    const { col, row, cols, rows } = window ?? {};
    for (const [name, value] of Object.entries({ col, row })) checkWhole(`the window's ${name}`, value);
    for (const [name, value] of Object.entries({ cols, rows })) checkSide(`the window's ${name}`, value, 1);
    const samples = takeWindow(z, cols, rows, this.#nodata);
    withBlocks(blocks => {
      const bounds = tolerance ? blocks.put(takeBeside('tolerance', tolerance, cols, rows)) : 0;
      callOrThrow('scarp_live_update', [this.#handle, col, row, cols, rows, blocks.put(samples), bounds]);
    });
  }
  set(col, row, z) {
    this.update({ col, row, cols: 1, rows: 1 }, [z]);
  }
  /// Moves the field over the ground; new samples are voids.
  scroll(cols, rows) {
    for (const [name, value] of Object.entries({ cols, rows })) checkWhole(name, value);
    callOrThrow('scarp_live_scroll', [this.#handle, cols, rows]);
  }

  /// The cells that changed after the version `since`; for 0, all cells with a surface.
  changes(since = 0) {
    if (!Number.isSafeInteger(since) || since < 0)
      refuse(`since is ${show(since)}; it is the version of earlier changes`);
    const changes = callOrThrow('scarp_live_changes', [this.#handle, since]);
    try {
      return withBlocks(blocks => {
        const out = blocks.allocate(8 * CELL);
        const cells = Array.from({ length: call('scarp_changes_count', [changes]) }, (_, k) => {
          call('scarp_changes_cell', [changes, k, out]);
          const [slot, version, col, row, maxError, vertices, positions, triangles, corners] = view(
            Float64Array,
            out,
            CELL,
          );
          return {
            slot,
            version,
            col,
            row,
            maxError,
            positions: view(Float32Array, positions, 3 * vertices).slice(),
            indices: view(Uint16Array, corners, 3 * triangles).slice(),
          };
        });
        return { version: call('scarp_changes_version', [changes]), cells };
      });
    } finally {
      call('scarp_changes_free', [changes]);
    }
  }
  /// All cells as one mesh, without a report.
  mesh() {
    const mesh = withBlocks(blocks => takeMesh(blocks, callOrThrow('scarp_live_mesh', [this.#handle])));
    delete mesh.report;
    delete mesh.rmse;
    return mesh;
  }
  heights() {
    const { width, height } = this.#state;
    return withBlocks(blocks => {
      const out = blocks.allocate(4 * width * height);
      callOrThrow('scarp_live_heights', [this.#handle, out]);
      return view(Float32Array, out, width * height).slice();
    });
  }
  get width() {
    return this.#state.width;
  }
  get height() {
    return this.#state.height;
  }
  get place() {
    return this.#state.place;
  }
  get maxError() {
    return this.#state.maxError;
  }
  get triangleCount() {
    return this.#state.triangleCount;
  }
  get level() {
    return this.#state.level;
  }
  get slotCount() {
    return this.#state.slotCount;
  }
  free() {
    if (!this.#held) return;
    forgotten.unregister(this);
    call('scarp_live_free', [this.#held]);
    this.#held = null;
  }
}
if (Symbol.dispose) Live.prototype[Symbol.dispose] = Live.prototype.free;
