import type { AsyncOptions, Bytes, Heights, Mesh, Numbers, PointOptions } from './index.js';

export * from './index.js';

/** @param points interleaved x, y, z */
export function simplifyPointsSync(points: Heights, options: PointOptions): Mesh;
export function simplifyPoints(points: Heights, options: PointOptions & AsyncOptions): Promise<Mesh>;

export interface TilerOptions {
  /** West, south, east, north of the raster with its outer pixels, in degrees or in metres of Web Mercator. */
  bounds: Numbers;
  crs?: 'degrees' | 'mercator';
  /** The nodata value, as in Place. */
  nodata?: FromSimplify | null;
  cells?: FromTile;
  /** The finest level, 0 to 23. Default: the first whose nodes are at most 1.1 cells apart. */
  maxZoom?: FromTile;
  /** Max error of the finest level, in metres, above 0. */
  maxError?: FromTile;
  /** A level's max error is the error that clients assume, divided by this factor. */
  quality?: FromTile;
  effort?: FromTile;
  /** Height for nodes without a height. */
  background?: FromTile;
}
export interface Tile {
  /** quantized-mesh 1.0 with normals, not compressed. */
  bytes: Bytes;
  triangleCount: number;
  vertexCount: number;
  /** Largest errors in metres: at the tile's nodes; with the sag of flat triangles; at the source's samples. NaN:
   * unknown. */
  nodeError: number;
  bound: number;
  sourceError: number;
}
/** The contents of layer.json, for JSON.stringify(). */
export interface LayerJson {
  tilejson: string;
  name: string;
  version: string;
  format: 'quantized-mesh-1.0';
  attribution: string;
  schema: 'tms';
  tiles: string[];
  projection: 'EPSG:4326';
  /** West, south, east, north in degrees. */
  bounds: number[];
  minzoom: number;
  maxzoom: number;
  extensions: string[];
  /** Rectangles of tiles for each level. */
  available: { startX: number; startY: number; endX: number; endY: number }[][];
}
export interface Tiler extends Disposable {}
/** Terrain tiles for globes, made on request from heights in metres above the ellipsoid. NaN becomes `background`, as
 * with the program's `--nodata-policy background`; by default the program fills small voids. */
export class Tiler {
  constructor(z: Heights, width: number, height: number, options: TilerOptions);
  readonly maxZoom: number;
  /** Makes tile z/x/y of the geographic grid (EPSG:4326, TMS): y from the south. */
  tile(z: number, x: number, y: number): Tile;
  /** Columns and rows of a level's tiles. */
  list(z: number): [number, number][];
  /** The file that clients read first. `tiles`: templates of the tiles' addresses, '{z}/{x}/{y}.terrain' by default. */
  layerJson(options?: { name?: string; attribution?: string; tiles?: string[] }): LayerJson;
  free(): void;
}
