// The results of the viewer's page for GeoTIFFs: geotiffs.mjs SOURCES NPM_PACKAGE ERROR FILES. Prints a line of JSON
// for each: its message (`sentence`), or the mesh with that error and its place.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [sources, engine, error, ...files] = process.argv.slice(2);
const load = path => import(pathToFileURL(resolve(path)));
const [{ readGeotiff }, { ready, simplifySync }] = await Promise.all([
  load(`${sources}/geotiff.js`),
  load(`${engine}/inline.js`),
]);
await ready();

for (const file of files) {
  const bytes = readFileSync(file);
  try {
    const { cols, rows, samples, frame, unit, notes } = await readGeotiff(
      file,
      bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length),
      2 ** 24,
    );
    const mesh = simplifySync(samples, cols, rows, { maxError: Number(error), effort: 'fast' });
    console.log(
      JSON.stringify({
        file,
        vertices: mesh.vertexCount,
        triangles: mesh.triangleCount,
        max_error: mesh.maxError,
        unit,
        notes,
        ...frame.extras,
      }),
    );
  } catch (thrown) {
    console.log(
      JSON.stringify({
        file,
        sentence: thrown.message,
        is_told: thrown.constructor.name === 'Sentence' || thrown.code === 'input',
      }),
    );
  }
}
