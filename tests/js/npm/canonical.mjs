// A hash of a mesh, independent of the order of triangles and their corners. Runs in Node and in browsers.

const NODE = 'node:crypto';

/// `origin`, `positions`: z up.
export async function hashOf({ positions, indices, origin }) {
  const corner = v => [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
  const compare = (a, b) => {
    for (let k = 0; k < a.length; ++k) if (a[k] !== b[k]) return a[k] - b[k];
    return 0;
  };
  const triangles = [];
  for (let t = 0; t < indices.length; t += 3) {
    const corners = [corner(indices[t]), corner(indices[t + 1]), corner(indices[t + 2])];
    const first = [0, 1, 2].reduce((least, k) => (compare(corners[k], corners[least]) < 0 ? k : least), 0);
    triangles.push([0, 1, 2].flatMap(k => corners[(first + k) % 3]));
  }
  triangles.sort(compare);
  const numbers = Float64Array.from([...origin, ...triangles.flat()].map(value => value + 0));
  // Node 18 has no global `crypto`.
  const { subtle } = globalThis.crypto ?? (await import(/* webpackIgnore: true */ /* @vite-ignore */ NODE)).webcrypto;
  const hash = new Uint8Array(await subtle.digest('SHA-256', numbers));
  return `${triangles.length} ${Array.from(hash.subarray(0, 8), byte => byte.toString(16).padStart(2, '0')).join('')}`;
}
