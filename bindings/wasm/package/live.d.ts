import type { Floats, Heights, Mesh, Numbers, Place } from './index.js';

export * from './index.js';

export interface LiveOptions extends Place {
  /** Bound on the vertical distance of every float32 sample from the mesh after every change. Required without a
   * budget. */
  maxError?: FromSimplify;
  /**
   * A budget: the largest number of triangles after every change. Bounds rise and fall to keep it; the property
   * maxError is the resulting bound. Fields of 50 cells or more mostly use at least 98 % of the budget, unless fewer
   * triangles keep maxError (0 by default here) or reproduce the samples. Not with tolerance.
   */
  maxTriangles?: FromSimplify;
  /** Work to spend on fewer triangles. Default: fast. */
  effort?: FromTile;
  /** Steps between samples along the side of a cell, 8 to 254. Default: 32 with effort 'fast', else 64. */
  cell?: number;
  /** Bounds of samples, as in Options. */
  tolerance?: FromSimplify;
  /** Column and row of the first sample on the lattice of cells. */
  place?: Numbers;
  /** With a budget: the property level of another field of the same size, to get its mesh from its samples. */
  level?: number;
}
/** A rectangle of samples. Columns and rows count from the field's first sample. */
export interface LiveWindow {
  col: number;
  row: number;
  cols: number;
  rows: number;
}
/** The mesh of a cell, ready for a GPU. */
export interface LiveCell {
  /** Its place in a renderer's buffer: at most one cell has this place, also while the field moves. */
  slot: number;
  /** The change that made it. */
  version: number;
  /** Its first sample, on the lattice of cells. */
  col: number;
  row: number;
  maxError: number;
  /** Columns east and rows north of the first sample (so y <= 0), and the height. */
  positions: Floats;
  /** Counter-clockwise from above in these coordinates. Empty: the cell has no surface. */
  indices: ReturnType<typeof Uint16Array.of>;
}
export interface LiveChanges {
  /** For the next call of changes(). */
  version: number;
  /** By slot. */
  cells: LiveCell[];
}

export interface Live extends Disposable {}
/**
 * A field that changes many times a second, and its mesh: an update remakes only the cells that it touches. After any
 * changes, the mesh has the bytes of a mesh made from the final samples at the same place; with maxTriangles, also at
 * the same level. A failed call changes nothing. The constructor fails if another entry of the package was
 * loaded first.
 */
export class Live {
  constructor(z: Heights, width: number, height: number, options: LiveOptions);
  /** Replaces the samples of a window, row by row; also their tolerances, if given to a field that has tolerances. */
  update(window: LiveWindow, z: Heights, options?: { tolerance?: FromSimplify }): void;
  /** Replaces one sample. */
  set(col: number, row: number, z: number | null): void;
  /** Moves the field over the ground, by columns to the east and rows down; new samples are voids. */
  scroll(cols: number, rows: number): void;
  /** The cells that changed after the version `since`, including those that became empty; for 0, all cells with a
   * surface. */
  changes(since?: number): LiveChanges;
  /** All cells as one mesh, without a report. */
  mesh(): Mesh;
  /** A copy of the samples, row by row. */
  heights(): Floats;
  readonly width: number;
  readonly height: number;
  readonly place: [number, number];
  readonly maxError: number;
  readonly triangleCount: number;
  /** The state of the search for the budget. */
  readonly level: number;
  readonly slotCount: number;
  /** Frees its memory at once. The garbage collector frees it late, since it does not know the size. */
  free(): void;
}
