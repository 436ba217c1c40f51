// Terrain tiles for globes: quantized-mesh, made of one raster as they are asked for.
import { Blocks, ScarpError, call, callOrThrow, view, withBlocks } from './module.js';
import { putDoubles, putField } from './heights.js';
import { checkKnown, choose } from './simplify.js';

const VIEW = 7;
const forgotten = new FinalizationRegistry(({ handle, blocks }) => {
  call('scarp_tiler_free', [handle]);
  blocks.free();
});

/// From the corners of the raster's outer pixels, west, south, east, north, to a geotransform.
function placeBounds(bounds, width, height) {
  const [west, south, east, north] = Array.from(bounds ?? []);
  if (!(east > west && north > south)) throw new ScarpError('usage', 'bounds is not [west, south, east, north] with east above west, and north above south');
  return [west, (east - west) / width, 0, north, 0, (south - north) / height];
}

export class Tiler {
  #held;

  /// Of heights in metres above the ellipsoid.
  constructor(z, width, height, options = {}) {
    checkKnown(options, ['bounds', 'crs', 'nodata', 'cells', 'maxZoom', 'maxError', 'quality', 'effort', 'background']);
    const { bounds, crs = 'degrees', nodata, cells = 128, maxZoom = -1, maxError = 0, quality = 2, effort = 'normal', background = 0 } = options;
    if (crs !== 'degrees' && crs !== 'mercator') throw new ScarpError('usage', `crs '${crs}' is neither degrees nor mercator`);
    const transform = placeBounds(bounds, width, height);
    const blocks = new Blocks();
    try {
      const field = putField(blocks, z, width, height, { nodata, transform });
      const settings = putDoubles(blocks, Number(crs === 'mercator'), cells, maxZoom, maxError, quality, choose('effort', effort), background);
      this.#held = { handle: callOrThrow('scarp_tiler_create', [field, settings]), blocks };
    } catch (error) {
      blocks.free();
      throw error;
    }
    forgotten.register(this, this.#held, this);
  }

  get #handle() {
    if (!this.#held) throw new ScarpError('usage', 'the Tiler was freed');
    return this.#held.handle;
  }
  get maxZoom() {
    return call('scarp_tiler_max_zoom', [this.#handle]);
  }

  #take(name, args) {
    return withBlocks(blocks => {
      const out = blocks.allocate(8 * VIEW);
      const handle = callOrThrow(name, [this.#handle, ...args, out]);
      const [address, size, triangleCount, vertexCount, nodeError, bound, sourceError] = view(Float64Array, out, VIEW);
      const bytes = view(Uint8Array, address, size).slice();
      call('scarp_bytes_free', [handle]);
      return { bytes, triangleCount, vertexCount, nodeError, bound, sourceError };
    });
  }

  /// The bytes of tile z/x/y, y from the south, and its proven errors in metres; NaN where nobody has looked.
  tile(z, x, y) {
    if (![z, x, y].every(Number.isSafeInteger) || x < 0 || y < 0 || x >= 2 ** (z + 1) || y >= 2 ** z)
      throw new ScarpError('usage', `there is no tile ${z}/${x}/${y}: x goes to 2^(z + 1) - 1, and y to 2^z - 1, from the south`);
    return this.#take('scarp_tiler_tile', [z, x, y]);
  }
  /// Columns and rows of the tiles of a level: those that have heights, and those that clients need to reach them.
  list(z) {
    if (!Number.isInteger(z) || z < 0 || z > this.maxZoom) throw new ScarpError('usage', `there is no level ${z}: levels go from 0 to ${this.maxZoom}`);
    const numbers = new Uint32Array(this.#take('scarp_tiler_list', [z]).bytes.buffer);
    return Array.from({ length: numbers.length / 2 }, (_, k) => [numbers[2 * k], numbers[2 * k + 1]]);
  }
  free() {
    if (!this.#held) return;
    forgotten.unregister(this);
    call('scarp_tiler_free', [this.#held.handle]);
    this.#held.blocks.free();
    this.#held = null;
  }
}
if (Symbol.dispose) Tiler.prototype[Symbol.dispose] = Tiler.prototype.free;
