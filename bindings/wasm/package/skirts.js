// Walls below the edges of a mesh, which hide the cracks between tiles.

/// `tops`: for each new vertex, the vertex above it. `indices`: all triangles, with the walls last.
export function buildSkirts(indices, vertexCount) {
  const edges = new Map();
  for (let k = 0; k < indices.length; ++k) {
    const a = indices[k];
    const b = indices[k % 3 === 2 ? k - 2 : k + 1];
    if (!edges.delete(`${b} ${a}`)) edges.set(`${a} ${b}`, [a, b]);
  }
  const tops = [];
  const below = new Map();
  const walls = [];
  const copy = v => {
    if (!below.has(v)) below.set(v, vertexCount + tops.push(v) - 1);
    return below.get(v);
  };
  for (const [a, b] of edges.values()) walls.push(b, a, copy(a), copy(a), copy(b), b);
  const all = new Uint32Array(indices.length + walls.length);
  all.set(indices);
  all.set(walls, indices.length);
  return { tops, indices: all };
}
