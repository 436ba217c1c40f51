// A judge without Scarp's code: the error of each triangle's plane at each sample that it covers.

/// Relative rounding error allowed for the judge's arithmetic.
export const ROUNDING = 2 ** -48;

/// `columns`, `rows`: places of vertices in samples, the first row at the top; `z`: their heights.
export function judge(samples, width, height, { columns, rows, z, triangles }) {
  const worst = new Float64Array(width * height).fill(-1);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
    const area = (columns[b] - columns[a]) * (rows[c] - rows[a]) - (rows[b] - rows[a]) * (columns[c] - columns[a]);
    if (area === 0) throw new Error(`triangle ${t / 3} has no area`);
    const corners = [a, b, c];
    const from = list => Math.ceil(Math.min(...corners.map(v => list[v])));
    const to = list => Math.floor(Math.max(...corners.map(v => list[v])));
    for (let y = from(rows); y <= to(rows); ++y) {
      for (let x = from(columns); x <= to(columns); ++x) {
        const v = ((x - columns[a]) * (rows[c] - rows[a]) - (y - rows[a]) * (columns[c] - columns[a])) / area;
        const w = ((columns[b] - columns[a]) * (y - rows[a]) - (rows[b] - rows[a]) * (x - columns[a])) / area;
        if (v < -1e-12 || w < -1e-12 || v + w > 1 + 1e-12) continue;
        const error = Math.abs(z[a] + v * (z[b] - z[a]) + w * (z[c] - z[a]) - samples[y * width + x]);
        if (error > worst[y * width + x]) worst[y * width + x] = error;
      }
    }
  }
  let max = 0;
  let uncovered = 0;
  for (let k = 0; k < worst.length; ++k) {
    if (Number.isNaN(samples[k])) continue;
    if (worst[k] < 0) ++uncovered;
    else max = Math.max(max, worst[k]);
  }
  return { max, uncovered };
}

/// Judges a mesh on the grid: x the column, y the row from the bottom.
export function judgeMesh(samples, width, height, { positions, indices, origin: [x, y, up] }) {
  const vertices = Array.from({ length: positions.length / 3 }, (_, v) => v);
  return judge(samples, width, height, {
    columns: vertices.map(v => positions[3 * v] + x),
    rows: vertices.map(v => height - 1 - (positions[3 * v + 1] + y)),
    z: vertices.map(v => positions[3 * v + 2] + up),
    triangles: indices,
  });
}
