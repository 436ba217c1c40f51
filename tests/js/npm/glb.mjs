// Writes GLBs for foreign readers: glb.mjs NAME WIDTH HEIGHT ERROR. Prints triangles, and the bytes of each.
import fs from 'node:fs';
import { encodeGlb, measure, ready, simplifySync } from 'scarp';

const [name, ...words] = process.argv.slice(2);
const [width, height, maxError] = words.map(Number);
await ready();
const z = new Float32Array(new Uint8Array(fs.readFileSync(`${name}.f32`)).buffer);
const options = { maxError, normals: true, uvs: true, effort: 'high' };
const [plain, lattice] = [
  simplifySync(z, width, height, options),
  simplifySync(z, width, height, { ...options, lattice: true }),
];
if (measure(z, width, height, lattice).maxError > maxError) throw new Error('the lattice breaks the bound');
const files = {
  'plain.glb': encodeGlb(plain),
  'packed.glb': encodeGlb(lattice, { compress: true }),
  'loose.glb': encodeGlb(plain, { compress: true }),
};
for (const [file, bytes] of Object.entries(files)) fs.writeFileSync(file, bytes);
// A cell whose multiples are not exact in float32.
const fine = simplifySync(z, width, height, {
  maxError,
  effort: 'high',
  lattice: true,
  transform: [400000, 0.1, 0, 5000000, 0, -0.1],
});
fs.writeFileSync('fine.glb', encodeGlb(fine, { compress: true }));
console.log(
  fine.maxError,
  plain.triangleCount,
  lattice.triangleCount,
  ...Object.values(files).map(bytes => bytes.length),
);
