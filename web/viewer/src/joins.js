// Joins vertices at one position, which files separate where parts, tiles or images meet.

/** The first power of two above twice the count. */
function slotsFor(count) {
  return 2 ** Math.ceil(Math.log2(2 * count + 1));
}

/** For each vertex the first one at its position. `places`: x, y, z in single precision. */
export function joinPlaces(places) {
  const count = places.length / 3;
  const bits = new Int32Array(places.buffer, places.byteOffset, places.length);
  const mask = slotsFor(count) - 1;
  const slots = new Int32Array(mask + 1).fill(-1);
  const firsts = new Uint32Array(count);
  for (let v = 0; v < count; ++v) {
    const [x, y, z] = [bits[3 * v], bits[3 * v + 1], bits[3 * v + 2]];
    let hash = Math.imul(x, 0x9e3779b1) ^ Math.imul(y, 0x85ebca6b) ^ Math.imul(z, 0xc2b2ae35);
    let at = (hash ^= hash >>> 15) & mask;
    for (; slots[at] >= 0; at = (at + 1) & mask) {
      const other = 3 * slots[at];
      if (bits[other] === x && bits[other + 1] === y && bits[other + 2] === z) break;
    }
    if (slots[at] < 0) slots[at] = v;
    firsts[v] = slots[at];
  }
  return firsts;
}

/** Each edge once, as pairs of vertices. */
export function listEdges(indices, firsts) {
  const begins = new Uint32Array(firsts.length + 1);
  const eachSide = use => {
    for (let k = 0; k < indices.length; ++k) {
      const a = firsts[indices[k]];
      const b = firsts[indices[k % 3 === 2 ? k - 2 : k + 1]];
      if (a !== b) use(Math.min(a, b), Math.max(a, b));
    }
  };
  eachSide(low => {
    ++begins[low + 1];
  });
  for (let v = 0; v < firsts.length; ++v) begins[v + 1] += begins[v];
  const ends = begins.slice();
  const highs = new Uint32Array(begins[firsts.length]);
  const seen = new Uint32Array(firsts.length).fill(firsts.length);
  const pairs = new Uint32Array(2 * highs.length);
  eachSide((low, high) => {
    highs[ends[low]++] = high;
  });
  let count = 0;
  for (let low = 0; low < firsts.length; ++low) {
    for (let at = begins[low]; at < ends[low]; ++at) {
      if (seen[highs[at]] === low) continue;
      seen[highs[at]] = low;
      pairs[count++] = low;
      pairs[count++] = highs[at];
    }
  }
  return pairs.subarray(0, count);
}

/** Edges sorted roughly by length: {pairs, countFrom}, the longest first, and the least number of edges from a length
 * on. */
export function rankEdges(pairs, places) {
  const SHIFT = 21;
  const ranks = 2 ** (31 - SHIFT);
  const count = pairs.length / 2;
  const squares = new Float32Array(count);
  const bits = new Int32Array(squares.buffer);
  const ends = new Uint32Array(ranks + 1);
  const ranked = new Uint32Array(pairs.length);
  for (let k = 0; k < count; ++k) {
    const a = 3 * pairs[2 * k];
    const b = 3 * pairs[2 * k + 1];
    const x = places[a] - places[b];
    const y = places[a + 1] - places[b + 1];
    const z = places[a + 2] - places[b + 2];
    squares[k] = x * x + y * y + z * z;
    ++ends[ranks - (bits[k] >> SHIFT)];
  }
  for (let rank = 1; rank <= ranks; ++rank) ends[rank] += ends[rank - 1];
  const next = ends.slice();
  for (let k = 0; k < count; ++k) {
    const at = 2 * next[ranks - 1 - (bits[k] >> SHIFT)]++;
    ranked[at] = pairs[2 * k];
    ranked[at + 1] = pairs[2 * k + 1];
  }
  return {
    pairs: ranked,
    countFrom: length => ends[ranks - (new Int32Array(Float32Array.of(length * length).buffer)[0] >> SHIFT)],
  };
}

/** For each vertex the area-weighted sum of the normals of all triangles at its position. */
export function sumNormals(places, indices, firsts) {
  const sums = new Float64Array(places.length);
  const normals = new Float32Array(places.length);
  for (let k = 0; k < indices.length; k += 3) {
    const [a, b, c] = [3 * firsts[indices[k]], 3 * firsts[indices[k + 1]], 3 * firsts[indices[k + 2]]];
    const ux = places[b] - places[a];
    const uy = places[b + 1] - places[a + 1];
    const uz = places[b + 2] - places[a + 2];
    const vx = places[c] - places[a];
    const vy = places[c + 1] - places[a + 1];
    const vz = places[c + 2] - places[a + 2];
    const x = uy * vz - uz * vy;
    const y = uz * vx - ux * vz;
    const z = ux * vy - uy * vx;
    for (const at of [a, b, c]) {
      sums[at] += x;
      sums[at + 1] += y;
      sums[at + 2] += z;
    }
  }
  for (let v = 0; v < firsts.length; ++v) {
    const at = 3 * firsts[v];
    const length = Math.hypot(sums[at], sums[at + 1], sums[at + 2]) || 1;
    for (let k = 0; k < 3; ++k) normals[3 * v + k] = sums[at + k] / length;
  }
  return normals;
}
