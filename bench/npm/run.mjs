// The npm package compared with delatin and martini: node bench/npm/run.mjs RASTER...
//
// RASTER: name=file:columns:rows:errors, float32 samples, such as everest=everest.f32:513:513:20,80; martini needs 2^n
// + 1 a side. They are made by gdal_translate -of ENVI -ot Float32 -srcwin 400 300 513 513 N27E086.hgt everest.f32
// Milliseconds are CPU time, the least of several runs after one that warms up; true errors are those of the judge of
// the tests. Needs scarp, delatin and @mapbox/martini in node_modules.
import fs from 'node:fs';
import Delatin from 'delatin';
import Martini from '@mapbox/martini';
import { ready, simplifySync } from 'scarp';
import { judge, judgeMesh } from '../../tests/js/npm/judge.mjs';

const cpu = () => {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
};
function best(work) {
  let result = work();
  let least = Infinity;
  for (let spent = 0, runs = 0; runs < 3 || (spent < 1500 && runs < 12); ++runs) {
    const start = cpu();
    result = work();
    least = Math.min(least, cpu() - start);
    spent += least;
  }
  return [least.toFixed(1), result];
}
/// Judges coordinates in samples, the first row at the top.
function judgeCoords(z, width, height, coords, triangles) {
  const vertices = Array.from({ length: coords.length / 2 }, (_, v) => v);
  return judge(z, width, height, {
    columns: vertices.map(v => coords[2 * v]),
    rows: vertices.map(v => coords[2 * v + 1]),
    z: vertices.map(v => z[coords[2 * v + 1] * width + coords[2 * v]]),
    triangles,
  });
}

await ready();
console.log('raster,columns,rows,asked,program,milliseconds,triangles,true_error');
for (const argument of process.argv.slice(2)) {
  const [name, rest] = argument.split('=');
  const [file, columns, lines, errors] = rest.split(':');
  const [width, height] = [columns, lines].map(Number);
  const z = new Float32Array(new Uint8Array(fs.readFileSync(file)).buffer);
  for (const error of errors.split(',').map(Number)) {
    const tell = (program, [milliseconds, { triangles, max }]) =>
      console.log([name, width, height, error, program, milliseconds, triangles, max.toPrecision(6)].join());
    if (width === height && Number.isInteger(Math.log2(width - 1))) {
      const [time, { vertices, triangles }] = best(() => new Martini(width).createTile(z).getMesh(error));
      tell('martini', [
        time,
        { triangles: triangles.length / 3, max: judgeCoords(z, width, height, vertices, triangles).max },
      ]);
    }
    const [time, tin] = best(() => {
      const made = new Delatin(z, width, height);
      made.run(error);
      return made;
    });
    tell('delatin', [
      time,
      { triangles: tin.triangles.length / 3, max: judgeCoords(z, width, height, tin.coords, tin.triangles).max },
    ]);
    for (const effort of ['fast', 'normal', 'high']) {
      const [took, mesh] = best(() => simplifySync(z, width, height, { maxError: error, effort }));
      tell(`scarp ${effort}`, [took, { triangles: mesh.triangleCount, max: judgeMesh(z, width, height, mesh).max }]);
    }
  }
}
