declare global {
  /** Empty before TypeScript 5.2, or without its library for disposables. */
  interface Disposable {}
}

/** Accepted arrays of numbers, of any realm. */
export type Numbers =
  | Float32Array
  | Float64Array
  | Int8Array
  | Uint8Array
  | Uint8ClampedArray
  | Int16Array
  | Uint16Array
  | Int32Array
  | Uint32Array
  | readonly number[];
/**
 * Heights. Numbers of up to 24 bits and float32 are exact. Others (float64, large int32) are rounded to float32, and
 * every maxError includes the largest rounding. Heights beyond float32's range (3.4e38) fail. null in an array is
 * nodata, like NaN.
 */
export type Heights = Numbers | readonly (number | null)[];

/** A compiled WebAssembly.Module, a type without members. */
export type Compiled = object;
/** The parts of a Response, a URL, an AbortSignal and a Worker that the package uses, for programs that lack
 * their types. */
export interface ResponseLike {
  readonly ok: boolean;
  readonly status: number;
  readonly url: string;
  arrayBuffer(): Promise<ArrayBuffer>;
}
export interface UrlLike {
  readonly href: string;
}
export interface SignalLike {
  readonly aborted: boolean;
  addEventListener(type: 'abort', listener: () => void): void;
  removeEventListener(type: 'abort', listener: () => void): void;
}
export interface WorkerLike {
  postMessage(message: any, transfer: any[]): void;
  terminate(): unknown;
}

/** Arrays made by the package, never in shared memory, which TypeScript 5.7 and later distinguish. */
export type Bytes = ReturnType<typeof Uint8Array.of>;
export type Floats = ReturnType<typeof Float32Array.of>;
export type Doubles = ReturnType<typeof Float64Array.of>;
export type Corners = ReturnType<typeof Uint32Array.of> | ReturnType<typeof Uint16Array.of>;

export type ErrorCode = 'usage' | 'memory' | 'input' | 'promise' | 'output' | 'cancelled' | 'internal' | 'unsupported';
/** An error of one sentence, which names the cause and the remedy. */
export class ScarpError extends Error {
  constructor(code: ErrorCode, message: string, options?: { cause?: unknown });
  readonly code: ErrorCode;
}

/**
 * Loads the library once. Asynchronous functions call it themselves. After the first success, later calls change
 * nothing, even with another source.
 * @param source The bytes of scarp.wasm, their URL or Response, or a compiled module. Default: the file next to the
 * script.
 * @param options warm: also simplifies small rasters, in a quarter of a second, so that engines optimise the library.
 * The first call otherwise needs up to seven times as long as later ones. Workers of a pool always do so.
 */
export function ready(
  source?: ArrayBuffer | ArrayBufferView | string | UrlLike | ResponseLike | Compiled,
  options?: { warm?: boolean },
): Promise<void>;
export function isReady(): boolean;
export function version(): string;

/** The position of samples. Without a transform x is the column, and y counts rows upwards from the last one. */
export interface Place {
  /** The nodata value, compared with the given heights; for Float32Array its nearest float32. NaN and infinities are
   * always nodata. */
  nodata?: FromSimplify | null;
  /** GDAL's geotransform of pixel corners: x = t[0] + t[1] column + t[2] row, y = t[3] + t[4] column + t[5] row. */
  transform?: Numbers | null;
  /** The transform is in degrees of WGS 84: the mesh is in metres around the raster's centre. */
  degrees?: boolean;
}

export interface Progress {
  pass: string;
  /** 0 to 1 of this pass. */
  fraction: number;
  vertices: number;
  maxError: number;
}

/** At least one goal; the first one reached ends the run. */
export interface Goals {
  /** Largest vertical error at any sample, in the units of the heights. */
  maxError?: FromSimplify;
  maxTriangles?: FromSimplify;
  maxVertices?: FromSimplify;
}

export interface Work {
  /** fast: the mesh of insertion. normal: about half the triangles of fast. high: about a third, in some eight
   * times the time of normal. */
  effort?: FromSimplify;
  /** Positions of vertices: at samples, or also between them (free; not with effort 'fast'). DEFAULT: free with 'high' and 'max'. */
  vertices?: FromSimplify;
  /** The quantity that a budget minimises: the largest or the RMS error. */
  objective?: FromSimplify;
  minShape?: FromSimplify;
}

export interface Options extends Goals, Work, Place {
  /** Next sample to insert. With 'greedy', the default effort is 'fast'. */
  order?: FromSimplify;
  outlineTolerance?: FromSimplify;
  normals?: FromSimplify;
  uvs?: FromSimplify;
  /**
   * Rounds heights to multiples of a power of two, so that encodeGlb(mesh, { compress: true }) can store positions in
   * 16 bits. Positions are float64, as with doubles: WebGL needs Float32Array.from(mesh.positions), which rounds them.
   */
  lattice?: boolean;
  /** Makes positions float64. A GLB without compress rounds them to float32: measure that file, or omit doubles and
   * lattice. */
  doubles?: FromSimplify;
  /** Each edge of the raster depends only on its own samples, so neighbours that share it match. */
  lockBorder?: FromSimplify;
  /** A weight for each sample: weight * |error| is bounded. 0: no bound. Rounded up to float32. */
  mask?: FromSimplify;
  /** A bound for each sample; Infinity: none. Rounded down to float32. */
  tolerance?: FromSimplify;
  /** Called at most a few times a second; return false to cancel. */
  onProgress?: (progress: Progress) => boolean | void;
}

/** Inputs are copied during the call: the caller may change them afterwards. */
export interface AsyncOptions {
  signal?: SignalLike | null;
  /** Moves the buffer of Float32Array heights (of points: Float64Array) instead of copying it. */
  transfer?: boolean;
}

/** Errors are vertical, mesh minus sample, in the units of the heights. */
export interface Report {
  vertexCount: number;
  triangleCount: number;
  /** Number of samples judged. */
  samples: number;
  /** Valid samples of the surface that no triangle covers. Their errors are not counted: check this before maxError. */
  uncovered: number;
  /** Valid samples in no cell with three valid corners: no mesh covers them. */
  stray: number;
  /** Largest error for the given heights: that for the float32 heights, plus sampleRounding. */
  maxError: number;
  /** The largest rounding of a height to float32; 0 if all heights fit. All other errors refer to the float32
   * heights. */
  sampleRounding: number;
  /** Column and row. */
  maxErrorAt: [number, number] | null;
  rmse: number;
  meanError: number;
  meanAbsError: number;
  p50: number;
  p95: number;
  p99: number;
  /** The goal that ended the run. */
  stop?: 'maxError' | 'maxTriangles' | 'maxVertices' | 'exact';
  effort?: 'fast' | 'normal' | 'high' | 'max';
  /** From measure(): no flipped, overlapping or degenerate triangles, no cracks. A mesh away from the samples can be
   * sound: see uncovered. */
  isSound?: boolean;
}

/** x east, y north, z up; vertex v lies at origin + positions[3v .. 3v + 2]. */
export class Mesh {
  /** Float32Array; Float64Array with lattice or doubles, and for a Refiner whose transform exceeds float32. */
  positions: Floats | Doubles;
  /** Counter-clockwise from above. */
  indices: Corners;
  normals?: Floats;
  uvs?: Floats;
  origin: [number, number, number];
  /** Sides of the raster's cell along x and y, of either sign; 0 if there is no cell. */
  cell: [number, number];
  /** The largest error, proven on this mesh. */
  maxError: number;
  /** Missing for a Refiner's mesh. */
  rmse?: number;
  report?: Report;
  readonly vertexCount: number;
  readonly triangleCount: number;
  /** Buffers that postMessage() may move instead of copying. */
  transferables(): ArrayBuffer[];
}

/** Simplifies on this thread. Needs ready(). */
export function simplifySync(z: Heights, width: number, height: number, options: Options): Mesh;
/** Simplifies in a worker of a common pool. */
export function simplify(z: Heights, width: number, height: number, options: Options & AsyncOptions): Promise<Mesh>;

/** Judges a mesh by brute force, regardless of how it was made. */
export function measure(
  z: Heights,
  width: number,
  height: number,
  mesh: { positions: Numbers; indices: Numbers; origin?: Numbers },
  place?: Place,
): Report;

export interface PointOptions extends Goals, Work {
  duplicates?: FromSimplify;
  /** Makes positions float64. */
  doubles?: FromSimplify;
  onProgress?: (progress: Progress) => boolean | void;
}
export interface PoolOptions {
  /** Number of workers. Default: one less than the number of cores, at most 4. */
  size?: number;
  /** Creates a worker from the script scarp/worker, for bundlers that do not find it. */
  worker?: (() => WorkerLike) | null;
}
export interface Pool {
  readonly size: number;
  simplify(z: Heights, width: number, height: number, options: Options & AsyncOptions): Promise<Mesh>;
  /** With scarp/full. */
  simplifyPoints(points: Heights, options: PointOptions & AsyncOptions): Promise<Mesh>;
  terminate(): void;
}
export function createPool(options?: PoolOptions): Pool;

export interface Refiner extends Disposable {}
/** A mesh that grows by one vertex at a time, the worst sample first. */
export class Refiner {
  constructor(z: Heights, width: number, height: number, place?: Place);
  /** Inserts until maxError holds, or there are maxVertices, or all samples are exact. Returns the number inserted. */
  run(goals?: { maxError?: FromSimplify; maxVertices?: FromSimplify }): number;
  /** False once every sample is exact. */
  insertWorst(): boolean;
  readonly maxError: number;
  readonly vertexCount: number;
  readonly triangleCount: number;
  mesh(): Mesh;
  /** Frees its memory at once. The garbage collector frees it late, since it does not know the size. */
  free(): void;
}

/**
 * Encodes a GLB file (glTF 2.0, y up) with float32 positions: float64 positions are rounded. compress: by
 * meshoptimizer's codec (EXT_meshopt_compression); positions of simplify() with lattice keep their values, with 16 bits
 * each.
 */
export function encodeGlb(
  mesh: { positions: Numbers; indices: Numbers; normals?: Numbers; uvs?: Numbers; origin?: Numbers; cell?: Numbers },
  options?: { compress?: FromSimplify },
): Bytes;

/** Decodes heights in metres from a tile's pixels, four bytes each; NaN where a pixel is transparent. */
export function decodeTile(
  rgba: Uint8ClampedArray | Uint8Array,
  width: number,
  height: number,
  encoding?: 'terrarium' | 'mapbox' | { rScaler: number; gScaler: number; bScaler: number; offset: number },
): Floats;
