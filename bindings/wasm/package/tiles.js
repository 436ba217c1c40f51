// Terrain tiles for globes: quantized-mesh, made on request from one raster.
import { ScarpError } from './error.js';
import { Blocks, call, callOrThrow, view, withBlocks } from './module.js';
import { putDoubles, putField } from './heights.js';
import { choose, takeOptions } from './options.js';

const VIEW = 7;
const forgotten = new FinalizationRegistry(({ handle, blocks }) => {
  call('scarp_tiler_free', [handle]);
  blocks.free();
});

/// The geotransform from the outer edges of the raster's pixels: west, south, east, north.
function placeBounds([west, south, east, north], width, height) {
  return [west, (east - west) / width, 0, north, 0, (south - north) / height];
}

/// `degrees`: the bounds in degrees, for any CRS. Centres of pixels must lie on the globe; their edges may lie beyond.
function checkBounds(bounds, degrees, width, height) {
  const refuse = why => {
    throw new ScarpError('usage', `bounds is ${bounds ? `[${bounds.join(', ')}]` : 'not given'}, ${why}`);
  };
  if (!bounds) refuse('and a globe needs [west, south, east, north]');
  const [west, south, east, north] = degrees;
  if (!(east > west && north > south))
    refuse('and is [west, south, east, north] with east above west, and north above south');
  const half = (north - south) / height / 2;
  if ((east - west) * (1 - 1 / width) > 360 + 1e-9)
    refuse(`which are ${east - west} degrees of longitude, and a globe has 360`);
  if (south + half < -90 - 1e-9 || north - half > 90 + 1e-9)
    refuse("and latitudes go from -90 to 90: take crs: 'mercator' if they are its metres");
}

/// West, south, east, north in degrees, from metres of Web Mercator.
function degreesOf([west, south, east, north]) {
  const radius = 6378137;
  const degrees = 180 / Math.PI;
  const latitude = y => Math.atan(Math.sinh(y / radius)) * degrees;
  return [(west / radius) * degrees, latitude(south), (east / radius) * degrees, latitude(north)];
}

/// Rectangles of tiles given row by row: a run that repeats in the next row extends its rectangle.
function findRanges(tiles) {
  const ranges = [];
  let open = [];
  for (let k = 0; k < tiles.length;) {
    const [, y] = tiles[k];
    const row = [];
    for (; k < tiles.length && tiles[k][1] === y; ++k) {
      const [x] = tiles[k];
      const last = row[row.length - 1];
      if (last?.endX + 1 === x) last.endX = x;
      else row.push({ startX: x, startY: y, endX: x, endY: y });
    }
    for (const run of row) {
      const below = open.findIndex(one => one.startX === run.startX && one.endX === run.endX && one.endY + 1 === y);
      if (below >= 0) [{ startY: run.startY }] = open.splice(below, 1);
    }
    ranges.push(...open);
    open = row;
  }
  return [...ranges, ...open];
}

export class Tiler {
  #held;
  #bounds;

  /// The tiler for heights in metres above the ellipsoid.
  constructor(z, width, height, options = {}) {
    const {
      bounds,
      crs = 'degrees',
      nodata,
      cells,
      maxZoom = -1,
      maxError = 0,
      quality,
      effort,
      background,
    } = takeOptions(options, 'tiler');
    const corners = bounds && Array.from(bounds);
    this.#bounds = corners && crs === 'mercator' ? degreesOf(corners) : corners;
    checkBounds(corners, this.#bounds, width, height);
    const transform = placeBounds(corners, width, height);
    const blocks = new Blocks();
    try {
      const { address } = putField(blocks, z, width, height, { nodata, transform });
      const settings = putDoubles(
        blocks,
        Number(crs === 'mercator'),
        cells,
        maxZoom,
        maxError,
        quality,
        choose('effort', effort),
        background,
      );
      this.#held = { handle: callOrThrow('scarp_tiler_create', [address, settings]), blocks };
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

  /// The bytes of tile z/x/y, y from the south, and its proven errors in metres; NaN where not examined.
  tile(z, x, y) {
    if (![z, x, y].every(Number.isSafeInteger) || x < 0 || y < 0 || x >= 2 ** (z + 1) || y >= 2 ** z)
      throw new ScarpError(
        'usage',
        `there is no tile ${z}/${x}/${y}: x goes to 2^(z + 1) - 1, and y to 2^z - 1, from the south`,
      );
    return this.#take('scarp_tiler_tile', [z, x, y]);
  }
  /// Columns and rows of the tiles of a level: those with heights, and those that clients need to reach them.
  list(z) {
    if (!Number.isInteger(z) || z < 0 || z > this.maxZoom)
      throw new ScarpError('usage', `there is no level ${z}: levels go from 0 to ${this.maxZoom}`);
    const numbers = new Uint32Array(this.#take('scarp_tiler_list', [z]).bytes.buffer);
    return Array.from({ length: numbers.length / 2 }, (_, k) => [numbers[2 * k], numbers[2 * k + 1]]);
  }
  /// The file that clients read first: layer.json. `tiles`: templates of the tiles' addresses.
  layerJson(options = {}) {
    const { name = 'terrain', attribution = '', tiles = ['{z}/{x}/{y}.terrain'] } = takeOptions(options, 'layerJson');
    const { maxZoom } = this;
    return {
      tilejson: '2.1.0',
      name,
      version: '1.0.0',
      format: 'quantized-mesh-1.0',
      attribution,
      schema: 'tms',
      tiles,
      projection: 'EPSG:4326',
      bounds: this.#bounds,
      minzoom: 0,
      maxzoom: maxZoom,
      extensions: ['octvertexnormals'],
      available: Array.from({ length: maxZoom + 1 }, (_, z) => findRanges(this.list(z))),
    };
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
