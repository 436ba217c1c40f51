import type { Numbers } from './index.js';

/** Other options cause an error that names them; the loader ignores loaders.gl's tesselator and workerUrl. */
export interface TerrainOptions {
  /** West, south, east, north of the mesh. Default: pixels. */
  bounds?: Numbers | null;
  meshMaxError?: number;
  elevationDecoder?: { rScaler: number; gScaler: number; bScaler: number; offset: number } | 'terrarium' | 'mapbox';
  /** Height of walls below the edges. */
  skirtHeight?: number | null;
  effort?: FromSimplify;
}
export interface TerrainMesh {
  loaderData: { header: object };
  header: { vertexCount: number; boundingBox: [number[], number[]] };
  mode: 4;
  indices: { value: Uint32Array; size: 1 };
  attributes: { POSITION: { value: Float32Array; size: 3 }; TEXCOORD_0: { value: Float32Array; size: 2 } };
}
export function makeTerrainMesh(
  image: { data: Uint8ClampedArray | Uint8Array; width: number; height: number },
  options?: TerrainOptions,
): TerrainMesh;
/** For deck.gl: new TerrainLayer({ loaders: [TerrainLoader], ... }). */
export const TerrainLoader: {
  name: string;
  id: string;
  module: string;
  version: string;
  worker: false;
  extensions: string[];
  mimeTypes: string[];
  options: { terrain: TerrainOptions };
  parse(bytes: ArrayBuffer, options?: { terrain?: TerrainOptions }): Promise<TerrainMesh>;
};
