declare global {
  /** Empty before TypeScript 5.2, or without its library of disposables. */
  interface Disposable {}
}

/** Numbers as the package accepts them, of any realm. */
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
 * Heights: numbers of up to 24 bits and float32 exactly. Others (float64, large int32) are rounded to float32, and
 * every maxError counts the largest rounding. A height beyond float32's range (3.4e38) is refused. null in an array is
 * no height, as NaN is.
 */
export type Heights = Numbers | readonly (number | null)[];

/** A compiled WebAssembly.Module, which has no distinguishing member. */
export type Compiled = object;
/** The parts that the package uses of a Response, a URL, an AbortSignal and a Worker, which not every program has types
 * for. */
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

/** Arrays that the package makes: never in shared memory, which TypeScript distinguishes from 5.7 on. */
export type Bytes = ReturnType<typeof Uint8Array.of>;
export type Floats = ReturnType<typeof Float32Array.of>;
export type Doubles = ReturnType<typeof Float64Array.of>;
export type Corners = ReturnType<typeof Uint32Array.of> | ReturnType<typeof Uint16Array.of>;

export type ErrorCode = 'usage' | 'memory' | 'input' | 'promise' | 'output' | 'cancelled' | 'internal' | 'unsupported';
/** One sentence that names the culprit and the way out. */
export class ScarpError extends Error {
  constructor(code: ErrorCode, message: string, options?: { cause?: unknown });
  readonly code: ErrorCode;
}

/**
 * Loads the library, once. The asynchronous functions call it themselves. The first source that succeeds stays: later
 * calls change nothing, whatever theirs is.
 * @param source The bytes of scarp.wasm, their URL or Response, or a compiled module. Default: the file next to the
 * script.
 * @param options warm: runs small rasters, too, in a quarter of a second, so that engines have optimised the library
 * before the first call, which otherwise needs up to seven times as long as later ones. Workers of a pool do so by
 * themselves.
 * */
export function ready(
  source?: ArrayBuffer | ArrayBufferView | string | UrlLike | ResponseLike | Compiled,
  options?: { warm?: boolean },
): Promise<void>;
export function isReady(): boolean;
export function version(): string;

/** The position of samples. Without a transform x is the column, and y counts rows from the last one up. */
export interface Place {
  /** A value that is no height, compared with the heights as they are given; with Float32Array its nearest float32. NaN
   * and infinities never are. */
  nodata?: number | null;
  /** GDAL's geotransform, of pixel corners: x = t[0] + t[1] column + t[2] row, y = t[3] + t[4] column + t[5] row. */
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

/** At least one; the first that is reached ends the run. */
export interface Goals {
  /** Largest vertical error at any sample, in the units of the heights. */
  maxError?: number;
  maxTriangles?: number;
  maxVertices?: number;
}

export interface Options extends Goals, Place {
  /** fast: the mesh of insertion; normal: about half its triangles; high: about a third, in some ten times the time. */
  effort?: 'auto' | 'fast' | 'normal' | 'high' | 'max';
  vertices?: 'auto' | 'samples' | 'free';
  order?: 'auto' | 'greedy' | 'dominant';
  /** The quantity that a budget minimises: the largest error, or the root of the mean square. */
  objective?: 'max' | 'rms';
  /** Floor of triangles' height over longest edge, 0 to 0.5. */
  minShape?: number;
  /** How far the outline of valid data may move outwards, in samples. */
  outlineTolerance?: number;
  normals?: boolean;
  uvs?: boolean;
  /**
   * Heights become multiples of a power of two, so that encodeGlb(mesh, { compress: true }) can hold positions in 16
   * bits. Positions are float64, as with doubles: WebGL wants Float32Array.from(mesh.positions), which rounds them.
   */
  lattice?: boolean;
  /** Positions are float64. A GLB without compress rounds them to float32: judge that file, or omit doubles and
   * lattice. */
  doubles?: boolean;
  /** Edges of the raster depend on their own samples alone: neighbours that share them fit. */
  lockBorder?: boolean;
  /** A weight for each sample: weight * |error| is bounded. 0: no bound. Held in float32, rounded up. */
  mask?: Numbers | null;
  /** A bound of its own for each sample; Infinity: none. Held in float32, rounded down. */
  tolerance?: Numbers | null;
  /** A few times a second at most; false cancels. */
  onProgress?: (progress: Progress) => boolean | void;
}

/** Inputs are copied at the call: the caller may then change them. */
export interface AsyncOptions {
  signal?: SignalLike | null;
  /** The buffer of Float32Array heights (of points: Float64Array) is moved at the call, not copied. */
  transfer?: boolean;
}

/** Errors are vertical, mesh minus sample, in the units of the heights. */
export interface Report {
  vertexCount: number;
  triangleCount: number;
  /** Samples that were judged. */
  samples: number;
  /** Valid samples of the surface that no triangle covers: their errors are not counted, check this before maxError. */
  uncovered: number;
  /** Valid samples beyond the surface, whose cells all lack three valid corners: no mesh covers them. */
  stray: number;
  /** Error of the heights as they were given: the largest error at the float32 heights, plus sampleRounding. */
  maxError: number;
  /** The most that the heights lost in float32; 0 where they fit. All other errors are of the float32 heights. */
  sampleRounding: number;
  /** Column and row. */
  maxErrorAt: [number, number] | null;
  rmse: number;
  meanError: number;
  meanAbsError: number;
  p50: number;
  p95: number;
  p99: number;
  /** Why the run ended. */
  stop?: 'maxError' | 'maxTriangles' | 'maxVertices' | 'exact';
  effort?: 'fast' | 'normal' | 'high' | 'max';
  /** From measure(): no flipped, overlapping or degenerate triangles, no cracks. A mesh that lies elsewhere can be
   * sound: see uncovered. */
  isSound?: boolean;
}

/** x east, y north, z up; vertex v lies at origin + positions[3v .. 3v + 2]. */
export class Mesh {
  /** Float32Array; Float64Array with lattice or doubles, and of a Refiner whose transform float32 does not hold. */
  positions: Floats | Doubles;
  /** Counter-clockwise from above. */
  indices: Corners;
  normals?: Floats;
  uvs?: Floats;
  origin: [number, number, number];
  /** Sides of the raster's cell along x and y, of either sign; 0 where it has none. */
  cell: [number, number];
  /** The largest error, proven on this mesh. */
  maxError: number;
  /** Not of a Refiner's mesh. */
  rmse?: number;
  report?: Report;
  readonly vertexCount: number;
  readonly triangleCount: number;
  /** Buffers that postMessage() may move instead of copying. */
  transferables(): ArrayBuffer[];
}

/** Simplifies in this thread. Needs ready(). */
export function simplifySync(z: Heights, width: number, height: number, options: Options): Mesh;
/** Simplifies in a worker of a pool that all calls share. */
export function simplify(z: Heights, width: number, height: number, options: Options & AsyncOptions): Promise<Mesh>;

/** Judges a mesh by brute force, without knowing how it was made. */
export function measure(
  z: Heights,
  width: number,
  height: number,
  mesh: { positions: Numbers; indices: Numbers; origin?: Numbers },
  place?: Place,
): Report;

export interface PointOptions extends Goals {
  /** Rule for several points at one place. */
  duplicates?: 'first' | 'last' | 'highest' | 'lowest' | 'mean';
  doubles?: boolean;
  onProgress?: (progress: Progress) => boolean | void;
}
export interface PoolOptions {
  /** Workers. Default: one less than cores, 4 at most. */
  size?: number;
  /** Makes a worker of the script scarp/worker, where a bundler does not find it. */
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
  /** Inserts until maxError holds, or there are maxVertices, or all is exact; returns how many were inserted. */
  run(goals?: { maxError?: number; maxVertices?: number }): number;
  /** False once every sample is exact. */
  insertWorst(): boolean;
  readonly maxError: number;
  readonly vertexCount: number;
  readonly triangleCount: number;
  mesh(): Mesh;
  /** Gives its memory back at once; else the garbage collector does, which runs late: it does not know how much there
   * is. */
  free(): void;
}

/**
 * A GLB file (glTF 2.0, y up), whose positions are float32: float64 ones are rounded. compress: by meshoptimizer's
 * codec (EXT_meshopt_compression); positions of simplify() with lattice keep their values, and have 16 bits each.
 * */
export function encodeGlb(
  mesh: { positions: Numbers; indices: Numbers; normals?: Numbers; uvs?: Numbers; origin?: Numbers; cell?: Numbers },
  options?: { compress?: boolean },
): Bytes;

/** Heights in metres of a tile's pixels, four bytes each; NaN where a pixel is transparent. */
export function decodeTile(
  rgba: Uint8ClampedArray | Uint8Array,
  width: number,
  height: number,
  encoding?: 'terrarium' | 'mapbox' | { rScaler: number; gScaler: number; bScaler: number; offset: number },
): Floats;
