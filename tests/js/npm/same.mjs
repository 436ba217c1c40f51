// WebAssembly makes the program's meshes: same.mjs CASES, a file of lines "NAME WIDTH HEIGHT ERROR EFFORT". NAME.f32
// has the samples, NAME_EFFORT.glb is the program's. Also judges them. Prints the cases, and writes them with hashes to
// cases.json for browsers.
import fs from 'node:fs';
import { ready, simplifySync } from 'scarp';
import { hashOf } from './canonical.mjs';
import { ROUNDING, judgeMesh } from './judge.mjs';
import { heightsOf } from './rasters.mjs';
import { readGlb } from './read_glb.mjs';

await ready();
const cases = [];
for (const line of fs.readFileSync(process.argv[2], 'utf8').trim().split('\n')) {
  const [name, width, height, error, effort] = line
    .split(' ')
    .map((word, k) => (k === 0 || k === 4 ? word : Number(word)));
  const z = heightsOf(new Uint8Array(fs.readFileSync(`${name}.f32`)).buffer);
  const mesh = simplifySync(z, width, height, { maxError: error, effort });
  const { max, uncovered } = judgeMesh(z, width, height, mesh);
  const highest = z.reduce((most, value) => (Math.abs(value) > most ? Math.abs(value) : most), 0);
  if (max > error + ROUNDING * highest || uncovered !== mesh.report.stray)
    throw new Error(`${line}: an error of ${max}, and ${uncovered} samples are not covered`);
  const [mine, theirs] = [
    await hashOf(mesh),
    await hashOf(readGlb(new Uint8Array(fs.readFileSync(`${name}_${effort}.glb`)))),
  ];
  if (mine !== theirs) throw new Error(`${line}: WebAssembly makes ${mine}, and the program ${theirs}`);
  console.log(line, mine);
  cases.push({ name, width, height, error, effort, hash: mine });
}
fs.writeFileSync('cases.json', JSON.stringify(cases));
