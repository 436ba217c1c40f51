// Replacements of delatin, martini and loaders.gl: the same names and shapes, with a bound that holds.
import assert from 'node:assert/strict';
import test from 'node:test';
import TheirDelatin from 'delatin';
import TheirMartini from '@mapbox/martini';
import { measure } from 'scarp';
import Delatin, { ready } from 'scarp/delatin';
import Martini from 'scarp/martini';
import { makeTerrainMesh } from 'scarp/loaders';
import { judge } from './judge.mjs';
import { hills } from './rasters.mjs';

const side = 129;
const z = hills(side, side, 9);
const judged = (samples, width, height, coords, triangles) => {
  const vertices = Array.from({ length: coords.length / 2 }, (_, v) => v);
  const columns = vertices.map(v => coords[2 * v]);
  const rows = vertices.map(v => coords[2 * v + 1]);
  return judge(samples, width, height, {
    columns,
    rows,
    z: vertices.map(v => samples[rows[v] * width + columns[v]]),
    triangles,
  });
};
await ready();

test('delatin: the same names and, but for ties, the same mesh', () => {
  const [mine, theirs] = [Delatin, TheirDelatin].map(Kind => new Kind(z, side, side));
  for (const tin of [mine, theirs]) tin.run(8);
  assert.ok(mine.getMaxError() <= 8);
  const { max, uncovered } = judged(z, side, side, mine.coords, mine.triangles);
  assert.equal(uncovered, 0);
  assert.ok(Math.abs(max - mine.getMaxError()) < 1e-9);
  assert.ok(
    Math.abs(mine.triangles.length / theirs.triangles.length - 1) < 0.01,
    `${mine.triangles.length} and ${theirs.triangles.length}`,
  );
  const { coords, triangles } = mine;
  const positions = Array.from({ length: coords.length / 2 }, (_, v) => [
    coords[2 * v],
    side - 1 - coords[2 * v + 1],
    z[coords[2 * v + 1] * side + coords[2 * v]],
  ]).flat();
  assert.ok(Math.abs(mine.getRMSD() / measure(z, side, side, { positions, indices: triangles }).rmse - 1) < 1e-9);
  assert.ok(mine.coords === mine.coords && mine.triangles === mine.triangles, 'loops over them are not quadratic');
  const before = mine.coords.length;
  mine.refine();
  assert.equal(mine.coords.length, before + 2);
  assert.equal(mine.heightAt(3, 4), z[4 * side + 3]);
});

test('martini: the same names, fewer triangles, and a bound that holds', () => {
  const [mine, theirs] = [Martini, TheirMartini].map(Kind => new Kind(side).createTile(z).getMesh(8));
  assert.equal(mine.vertices.constructor, theirs.vertices.constructor);
  assert.equal(mine.triangles.constructor, theirs.triangles.constructor);
  const [ofMine, ofTheirs] = [mine, theirs].map(({ vertices, triangles }) =>
    judged(z, side, side, vertices, triangles),
  );
  assert.ok(ofMine.max <= 8 + 1e-9 && ofMine.uncovered === 0 && ofTheirs.max > 8);
  assert.ok(mine.triangles.length < theirs.triangles.length / 2);
  const given = hills(50, 40);
  const tile = new Martini(50, { height: 40 }).createTile(given);
  const before = tile.getMesh(8);
  given.fill(0);
  assert.deepEqual(tile.getMesh(8), before, "the array is its caller's");
  const { vertices, triangles, numVerticesWithoutSkirts } = tile.getMeshWithSkirts(8);
  assert.equal(numVerticesWithoutSkirts, tile.getMesh(8).vertices.length / 2);
  assert.ok(vertices.length / 2 > numVerticesWithoutSkirts && triangles.every(v => v < vertices.length / 2));
  assert.throws(() => new Martini(50).createTile(z), /2500/);
  assert.throws(() => new Martini(50).createTile(null), {
    code: 'usage',
    message: /the terrain is no array of numbers, but null/,
  });
  for (const [size, sentence] of [
    [65n, /gridSize is the BigInt 65/],
    [1, /gridSize is 1/],
  ])
    assert.throws(() => new Martini(size), { code: 'usage', message: sentence });
  for (const run of [() => tile.getMesh(Infinity), () => new Delatin(z, side, side).run(Infinity)])
    assert.throws(run, { code: 'usage', message: /maxError is Infinity/ });
});

// A tile of terrarium.
const [width, height] = [64, 48];
const heights = hills(width, height);
const data = new Uint8ClampedArray(4 * width * height);
heights.forEach((value, k) => {
  const code = Math.round((value + 32768) * 256);
  data.set([code >> 16, (code >> 8) & 255, code & 255, 255], 4 * k);
});
const elevationDecoder = { rScaler: 256, gScaler: 1, bScaler: 1 / 256, offset: -32768 };
const options = { meshMaxError: 4, bounds: [10, 20, 74, 68], elevationDecoder, skirtHeight: 0 };

test('loaders.gl: the shape of its terrain, without its cliffs at the last row and column', async () => {
  const file = new URL('node_modules/@loaders.gl/terrain/dist/lib/parse-terrain.js', import.meta.url);
  const { makeTerrainMeshFromImage } = await import(file);
  const [mine, theirs] = [
    makeTerrainMesh({ data, width, height }, options),
    makeTerrainMeshFromImage({ data, width, height }, options),
  ];
  const shape = mesh =>
    JSON.stringify([
      Object.keys(mesh).sort(),
      mesh.mode,
      mesh.indices.size,
      mesh.indices.value.constructor.name,
      Object.entries(mesh.attributes).map(([name, { value, size }]) => [name, size, value.constructor.name]),
    ]);
  assert.equal(shape(mine), shape(theirs));
  const [least, most] = [heights.reduce((a, b) => Math.min(a, b)), heights.reduce((a, b) => Math.max(a, b))];
  const lowest = mesh => mesh.header.boundingBox[0][2];
  assert.ok(lowest(mine) >= least && mine.header.boundingBox[1][2] <= most);
  assert.ok(lowest(theirs) < least, 'loaders.gl has the cliff');
  assert.deepEqual(mine.header.boundingBox[0].slice(0, 2), [10, 20]);
  assert.deepEqual(mine.header.boundingBox[1].slice(0, 2), [74, 68]);
  const skirted = makeTerrainMesh({ data, width, height }, { ...options, skirtHeight: 100 });
  assert.ok(skirted.attributes.POSITION.value.length > mine.attributes.POSITION.value.length);
  assert.equal(lowest(skirted), lowest(mine));
  assert.equal(skirted.indices.value.length % 3, 0);
});

test('loaders.gl: what is refused', () => {
  for (const [given, sentence] of [
    [{ bounds: [0, 0, 1] }, /bounds is an array of 3; it is an array of 4/],
    [{ bounds: 'abcd' }, /bounds is 'abcd'/],
    [{ bounds: [0, 0, 1, NaN] }, /index 3 of bounds is NaN/],
    [{ skirtHeight: 'x' }, /skirtHeight is 'x'/],
    [{ skirtHeight: NaN }, /skirtHeight is NaN/],
    [{ meshMaxerror: 3 }, /meshMaxerror is unknown: did you mean meshMaxError/],
    [{ elevationdecoder: {} }, /did you mean elevationDecoder/],
    [{ elevationDecoder: {} }, /rScaler/],
    [{ elevationDecoder: null }, /elevationDecoder is null/],
    [{ meshMaxError: '4' }, /meshMaxError is '4'/],
  ])
    assert.throws(() => makeTerrainMesh({ data, width, height }, { ...options, ...given }), {
      code: 'usage',
      message: sentence,
    });
  assert.throws(() => makeTerrainMesh(null), {
    code: 'usage',
    message: /the image is null; it is { data, width, height }/,
  });
  assert.throws(() => makeTerrainMesh({ width, height }), {
    code: 'usage',
    message: /the pixels are no array of numbers, but undefined/,
  });
  assert.ok(
    makeTerrainMesh({ data, width, height }, { elevationDecoder, bounds: null, skirtHeight: null }),
    'as deck.gl says none',
  );
});
