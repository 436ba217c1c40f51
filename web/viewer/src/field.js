// The raster from which a mesh was made: samples on a grid, NaN for nodata.

/** In float32 if it holds them all. The engine needs the unrounded samples, since its bound includes the rounding. */
function narrow(samples) {
  const stay = samples instanceof Float32Array || !samples.every(z => z !== z || Math.fround(z) === z);
  return stay ? samples : Float32Array.from(samples);
}

export class Field {
  /** `affine`: from column and row of a sample's centre to x and y of the mesh, in GDAL's order of terms; `decoding`:
   * the encoding of heights in colours, or null; `step`: every `step`th sample of the file was read. */
  constructor({ name, cols, rows, affine, samples, unit = '', decoding = null, step = 1 }) {
    Object.assign(this, { name, cols, rows, affine, samples: narrow(samples), unit, decoding, step });
    this.determinant = affine[1] * affine[5] - affine[2] * affine[4];
    this.low = Infinity;
    this.high = -Infinity;
    for (const z of samples) {
      if (z < this.low) this.low = z;
      if (z > this.high) this.high = z;
    }
  }

  /** Triangles of the full grid. */
  get fullTriangles() {
    return 2 * (this.cols - 1) * (this.rows - 1);
  }

  toPlace(col, row) {
    const a = this.affine;
    return [a[0] + a[1] * col + a[2] * row, a[3] + a[4] * col + a[5] * row];
  }

  /** Column and row; snaps vertices that a file rounded to float32 to their samples. */
  toGrid(x, y) {
    const a = this.affine;
    const dx = x - a[0];
    const dy = y - a[3];
    return [snap((a[5] * dx - a[2] * dy) / this.determinant), snap((a[1] * dy - a[4] * dx) / this.determinant)];
  }

  /** Grid positions of all vertices: column, row, column, … */
  toGrids(positions) {
    const grid = new Float64Array((positions.length / 3) * 2);
    for (let v = 0, k = 0; k < grid.length; v += 3, k += 2)
      [grid[k], grid[k + 1]] = this.toGrid(positions[v], positions[v + 1]);
    return grid;
  }

  /** Bilinear between samples; NaN outside and next to nodata. */
  heightAt(x, y) {
    const [col, row] = this.toGrid(x, y);
    if (!(col >= 0 && row >= 0 && col <= this.cols - 1 && row <= this.rows - 1)) return NaN;
    const c = Math.min(Math.floor(col), this.cols - 2);
    const r = Math.min(Math.floor(row), this.rows - 2);
    const u = col - c;
    const v = row - r;
    const at = (dc, dr) => this.samples[(r + dr) * this.cols + c + dc];
    const mix = (a, b, t) => (t === 0 ? a : t === 1 ? b : a + t * (b - a));
    return mix(mix(at(0, 0), at(1, 0), u), mix(at(0, 1), at(1, 1), u), v);
  }
}

/** Vertices of the engine: offsets from an origin. */
export function placeMesh({ positions, origin }) {
  return Float64Array.from(positions, (value, k) => value + origin[k % 3]);
}

function snap(value) {
  const whole = Math.round(value);
  return Math.abs(value - whole) < 1e-4 ? whole : value;
}
