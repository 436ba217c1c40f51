import type { Heights } from './index.js';
export { ready } from './index.js';

/** Replaces delatin. Needs ready(). */
export default class Delatin {
  constructor(data: Heights, width: number, height?: number);
  readonly width: number;
  readonly height: number;
  run(maxError?: number): void;
  refine(): void;
  getMaxError(): number;
  getRMSD(): number;
  heightAt(x: number, y: number): number;
  /** x, y of each vertex: columns and rows from the top. The same array until vertices are inserted. */
  readonly coords: number[];
  readonly triangles: number[];
  free(): void;
}
