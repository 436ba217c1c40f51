import type { AsyncOptions, Heights, Mesh, PointOptions } from './index.js';

export * from './index.js';

/** @param points x, y, z in turn */
export function simplifyPointsSync(points: Heights, options: PointOptions): Mesh;
export function simplifyPoints(points: Heights, options: PointOptions & AsyncOptions): Promise<Mesh>;

export interface TilerOptions {
  /** West, south, east, north of the raster, its outer pixels included: degrees, or metres of web Mercator. */
  bounds: ArrayLike<number>;
  crs?: 'degrees' | 'mercator';
  nodata?: number;
  /** Nodes' cells a side of the finest tiles: a power of two, 16 to 256. */
  cells?: number;
  maxZoom?: number;
  /** Of the finest level, in metres. */
  maxError?: number;
  /** A level's max error is the error that clients assume over this. */
  quality?: number;
  effort?: 'fast' | 'normal' | 'high';
  /** Height where there is none. */
  background?: number;
}
export interface Tile {
  /** quantized-mesh 1.0 with normals, not compressed. */
  bytes: Uint8Array;
  triangleCount: number;
  vertexCount: number;
  /** Largest errors in metres: at the tile's nodes; with the sag of flat triangles; at the source's samples. NaN: not known. */
  nodeError: number;
  bound: number;
  sourceError: number;
}
/** Terrain tiles for globes, made as they are asked for, of heights in metres above the ellipsoid. */
export class Tiler {
  constructor(z: Heights, width: number, height: number, options: TilerOptions);
  readonly maxZoom: number;
  /** Tile z/x/y of the geographic grid (EPSG:4326, TMS): y from the south. */
  tile(z: number, x: number, y: number): Tile;
  /** Columns and rows of a level's tiles. */
  list(z: number): [number, number][];
  free(): void;
}
