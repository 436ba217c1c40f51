import type { Heights } from './index.js';
export { ready } from './index.js';

export interface Tile {
  /** Vertices as columns and rows from the top, within maxError. */
  getMesh(maxError?: number): { vertices: Uint16Array; triangles: Uint32Array };
  /** Vertices from numVerticesWithoutSkirts on lie below the vertices of the sides. */
  getMeshWithSkirts(maxError?: number): {
    vertices: Uint16Array;
    triangles: Uint32Array;
    numVerticesWithoutSkirts: number;
  };
}
/** Replaces @mapbox/martini. Needs ready(). */
export default class Martini {
  constructor(gridSize?: number, options?: { height?: number; effort?: FromSimplify });
  readonly gridSize: number;
  createTile(terrain: Heights): Tile;
}
