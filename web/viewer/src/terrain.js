// A positioned mesh: in metres from the page's centre for drawing, in columns and rows for judging.
import { judgeBeside } from './judging.js';
import { findPlacing } from './images.js';
import { joinPlaces, listEdges, rankEdges, sumNormals } from './joins.js';

/** The position of the page's scene: `metres` for a unit of x, y and z. */
export class Place {
  constructor(positions, metres) {
    this.metres = metres;
    this.low = [Infinity, Infinity, Infinity];
    this.high = [-Infinity, -Infinity, -Infinity];
    for (let c = 0; c < 3; ++c) {
      let low = Infinity;
      let high = -Infinity;
      for (let k = c; k < positions.length; k += 3) {
        low = Math.min(low, positions[k]);
        high = Math.max(high, positions[k]);
      }
      [this.low[c], this.high[c]] = [low, high];
    }
    this.center = this.low.map((low, k) => (low + this.high[k]) / 2);
    this.radius = Math.max(1e-9, Math.hypot(...[0, 1, 2].map(k => ((this.high[k] - this.low[k]) / 2) * metres[k])));
  }

  /** A scale of heights, 0.1 to 1, that keeps them below a quarter of the width if possible. */
  get lowExaggeration() {
    const [wide, deep, high] = [0, 1, 2].map(k => (this.high[k] - this.low[k]) * this.metres[k]);
    return Math.min(1, Math.max(0.1, Number((Math.max(wide, deep) / 4 / Math.max(high, 1e-9)).toPrecision(2))));
  }

  toScene(x, y, z) {
    const [cx, cy, cz] = this.center;
    const [mx, my, mz] = this.metres;
    return [(x - cx) * mx, (y - cy) * my, (z - cz) * mz];
  }

  fromScene(x, y, z) {
    const [cx, cy, cz] = this.center;
    const [mx, my, mz] = this.metres;
    return [x / mx + cx, y / my + cy, z / mz + cz];
  }
}

export class Terrain {
  /**
   * `positions`: x, y, z of the mesh's own frame, as are `normals`; these, `uvs` and `field` may be null. `sheets`:
   * runs of indices under one image, or of one ground. `extras`: metadata of its file; `goal`: the request to the
   * engine; `judged`: the result of judge(), if it is known: of every sample; null without a raster.
   * */
  constructor(
    {
      name,
      positions,
      indices,
      bytes = null,
      told = null,
      extras = {},
      goal = null,
      judged = null,
      normals = null,
      uvs = null,
      sheets = [{ image: null, ground: null, start: 0, count: indices.length }],
    },
    place,
    field,
  ) {
    Object.assign(this, { name, positions, indices, bytes, told, extras, goal, place, field, judged, uvs, sheets });
    this.scene = new Float32Array(positions.length);
    let reach = 0;
    for (let k = 0; k < positions.length; k += 3) {
      const [x, y, z] = place.toScene(positions[k], positions[k + 1], positions[k + 2]);
      this.scene[k] = x;
      this.scene[k + 1] = y;
      this.scene[k + 2] = z;
      reach = Math.max(reach, x * x + y * y + z * z);
    }
    // Distance from the scene's middle: other levels may be wider than the first.
    this.reach = Math.max(place.radius, Math.sqrt(reach));
    this.givenNormals = normals && Float32Array.from(normals, (value, k) => value / place.metres[k % 3]);
  }

  get triangles() {
    return this.indices.length / 3;
  }

  get isJudged() {
    return !this.field || this.judged !== null;
  }

  /** Judges the mesh once, in the background. */
  judge() {
    return (this.judging ??= judgeBeside(this.field, this).then(judged => {
      this.judged = judged;
    }));
  }

  /** Positions of vertices in the raster, as fractions of its columns and rows. */
  get sampled() {
    const { cols, rows } = this.field;
    return Float32Array.from(this.field.toGrids(this.positions), (value, k) => (value + 0.5) / (k % 2 ? rows : cols));
  }

  get hasImage() {
    return this.sheets.some(({ image }) => image);
  }

  /** The map from x and y to the image; null unless it is affine and there is one image. */
  get placing() {
    if (this.knownPlacing === undefined)
      this.knownPlacing = this.sheets.length === 1 && this.hasImage ? findPlacing(this) : null;
    return this.knownPlacing;
  }

  /** Normals of the file, else of the triangles around each position. */
  get normals() {
    return (this.givenNormals ??= sumNormals(this.scene, this.indices, this.firsts));
  }

  get firsts() {
    return (this.knownFirsts ??= joinPlaces(this.scene));
  }

  /** Edges from rankEdges(), the longest first. */
  edges() {
    return rankEdges(listEdges(this.indices, this.firsts), this.scene);
  }

  /** Height of the mesh at a position in its frame; NaN outside. */
  heightAt(x, y) {
    this.cells ??= new Cells(this);
    return this.cells.heightAt(x, y);
  }
}

/** Triangles in square cells, to find the one at a position. */
class Cells {
  constructor({ positions, indices, place }) {
    Object.assign(this, { positions, indices, place });
    this.side = Math.max(1, Math.min(1024, Math.ceil(Math.sqrt(indices.length / 6))));
    this.lists = new Map();
    for (let t = 0; t < indices.length; t += 3) {
      const corners = [0, 1, 2].map(k => this.cellOf(positions[3 * indices[t + k]], positions[3 * indices[t + k] + 1]));
      const [x0, x1] = [Math.min(...corners.map(c => c[0])), Math.max(...corners.map(c => c[0]))];
      const [y0, y1] = [Math.min(...corners.map(c => c[1])), Math.max(...corners.map(c => c[1]))];
      for (let y = y0; y <= y1; ++y) {
        for (let x = x0; x <= x1; ++x) {
          const key = y * this.side + x;
          const list = this.lists.get(key);
          if (list) list.push(t);
          else this.lists.set(key, [t]);
        }
      }
    }
  }

  cellOf(x, y) {
    const { low, high } = this.place;
    return [
      [x, 0],
      [y, 1],
    ].map(([value, k]) =>
      Math.min(this.side - 1, Math.max(0, Math.floor(((value - low[k]) / (high[k] - low[k] || 1)) * this.side))),
    );
  }

  heightAt(x, y) {
    const [cx, cy] = this.cellOf(x, y);
    const p = this.positions;
    for (const t of this.lists.get(cy * this.side + cx) ?? []) {
      const [a, b, c] = [0, 1, 2].map(k => 3 * this.indices[t + k]);
      const area = (p[b] - p[a]) * (p[c + 1] - p[a + 1]) - (p[b + 1] - p[a + 1]) * (p[c] - p[a]);
      if (area === 0) continue;
      const v = ((x - p[a]) * (p[c + 1] - p[a + 1]) - (y - p[a + 1]) * (p[c] - p[a])) / area;
      const w = ((p[b] - p[a]) * (y - p[a + 1]) - (p[b + 1] - p[a + 1]) * (x - p[a])) / area;
      if (v > -1e-9 && w > -1e-9 && v + w < 1 + 1e-9)
        return p[a + 2] + v * (p[b + 2] - p[a + 2]) + w * (p[c + 2] - p[a + 2]);
    }
    return NaN;
  }
}
