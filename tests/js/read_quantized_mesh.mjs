// Decodes all tiles of a folder with @here/quantized-mesh-decoder and loaders.gl: read_quantized_mesh.mjs FOLDER OUTPUT
//
// Writes the first one's results, like decode_tiles.cpp; fails if the second finds other vertices or triangles.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import zlib from 'node:zlib';
import { parseSync } from '@loaders.gl/core';
import { QuantizedMeshLoader } from '@loaders.gl/terrain';

const decode = createRequire(import.meta.url)('@here/quantized-mesh-decoder').default;
const [folder, output] = process.argv.slice(2);

/// A list as a count and little-endian numbers.
function bytesOf(list, Type) {
  return [Uint32Array.of(list.length), Type.from(list)].map(array => Buffer.from(array.buffer));
}

/// loaders.gl has positions of float32, x and y from 0 to 1.
function compare(name, bytes, { header, vertexData, triangleIndices }) {
  const count = vertexData.length / 3;
  const { minHeight: low, maxHeight: high } = header;
  const mesh = parseSync(bytes, QuantizedMeshLoader, { 'quantized-mesh': { bounds: [0, 0, 1, 1] } });
  const { value } = mesh.attributes.POSITION;
  if (value.length !== 3 * count || mesh.indices.value.length !== triangleIndices.length)
    throw new Error(`${name}: counts`);
  for (let k = 0; k < count; ++k) {
    const [u, v, h] = [0, 1, 2].map(part => vertexData[part * count + k] / 32767);
    const want = [u, v, h * (high - low) + low].map(Math.fround);
    if (want.some((number, part) => number !== value[3 * k + part])) throw new Error(`${name}: vertex ${k}`);
  }
  if (!mesh.indices.value.every((index, k) => index === triangleIndices[k])) throw new Error(`${name}: triangles`);
}

const out = [];
const names = fs
  .readdirSync(folder, { recursive: true })
  .filter(name => name.endsWith('.terrain'))
  .sort();
for (const name of names) {
  const file = zlib.gunzipSync(fs.readFileSync(`${folder}/${name}`));
  // Both decode in place, so each gets a copy.
  const copy = () => file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
  const tile = decode(copy());
  compare(name, copy(), tile);
  const { header } = tile;
  out.push(
    Buffer.from(name + '\n'),
    Buffer.from(
      Float64Array.of(
        header.centerX,
        header.centerY,
        header.centerZ,
        header.minHeight,
        header.maxHeight,
        header.boundingSphereCenterX,
        header.boundingSphereCenterY,
        header.boundingSphereCenterZ,
        header.boundingSphereRadius,
        header.horizonOcclusionPointX,
        header.horizonOcclusionPointY,
        header.horizonOcclusionPointZ,
      ).buffer,
    ),
  );
  out.push(...bytesOf(tile.vertexData, Uint16Array), ...bytesOf(tile.triangleIndices, Uint32Array));
  for (const edge of ['west', 'south', 'east', 'north']) out.push(...bytesOf(tile[edge + 'Indices'], Uint32Array));
  out.push(...bytesOf(tile.extensions.vertexNormals ?? [], Uint8Array));
  out.push(...bytesOf(new Uint8Array(tile.extensions.waterMask ?? []), Uint8Array));
}
fs.writeFileSync(output, Buffer.concat(out));
console.log(names.length);
