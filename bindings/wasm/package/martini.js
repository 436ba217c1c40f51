// Replaces @mapbox/martini: the same names, any size, and a guaranteed max error. Needs ready().
import { ScarpError, simplifySync } from './index.js';
import { checkArray, checkLength, checkSide } from './heights.js';
import { takeOptions } from './options.js';
import { buildSkirts } from './skirts.js';

export { ready } from './index.js';

class Tile {
  #terrain;
  #martini;

  constructor(terrain, martini) {
    this.#terrain = terrain;
    this.#martini = martini;
  }

  /// Columns and rows of the vertices, the first row at the top, and the triangles.
  getMesh(maxError = 0) {
    const { width, height, effort } = this.#martini;
    const {
      positions,
      indices,
      origin: [x, y],
    } = simplifySync(this.#terrain, width, height, { maxError, effort, vertices: 'samples' });
    const vertices = new Uint16Array((positions.length / 3) * 2);
    for (let v = 0; v < vertices.length / 2; ++v) {
      vertices[2 * v] = positions[3 * v] + x;
      vertices[2 * v + 1] = height - 1 - (positions[3 * v + 1] + y);
    }
    return { vertices, triangles: Uint32Array.from(indices) };
  }

  /// The same with skirts: a second vertex below each vertex on the sides, and two triangles for each edge along the
  /// sides. Vertices from numVerticesWithoutSkirts on are skirts.
  getMeshWithSkirts(maxError = 0) {
    const { vertices, triangles } = this.getMesh(maxError);
    const count = vertices.length / 2;
    const { tops, indices } = buildSkirts(triangles, count);
    const below = tops.flatMap(v => [vertices[2 * v], vertices[2 * v + 1]]);
    return { vertices: Uint16Array.from([...vertices, ...below]), triangles: indices, numVerticesWithoutSkirts: count };
  }
}

export default class Martini {
  /// `gridSize`: any number of samples a side; `effort`: as in simplifySync().
  constructor(gridSize = 257, options = {}) {
    checkSide('gridSize', gridSize);
    const { height = gridSize, effort = 'normal' } = takeOptions(options, 'martini');
    if (gridSize > 65536 || height > 65536)
      throw new ScarpError('usage', 'columns and rows are Uint16: at most 65536 samples a side');
    this.gridSize = this.width = gridSize;
    this.height = height;
    this.effort = effort;
  }
  createTile(terrain) {
    const given = checkArray('the terrain', terrain, NaN);
    checkLength('the terrain', given, this.width * this.height, `a grid of ${this.width} x ${this.height}`);
    return new Tile(given.slice(), this);
  }
}
