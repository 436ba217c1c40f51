// deck.gl in Chromium: deck_browser.mjs CHROMIUM SHOTS. TerrainLayer draws the same with this package's loader as with
// its own, without cliffs at the last row and column.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { build } from 'esbuild';
import { openPage } from './open_page.mjs';
import { serve } from './serve.mjs';

const [program, shots] = process.argv.slice(2);
await build({ entryPoints: ['deck.mjs'], bundle: true, format: 'esm', outdir: 'deck', logLevel: 'error' });
fs.copyFileSync('node_modules/scarp/scarp.wasm', 'deck/scarp.wasm');
fs.writeFileSync(
  'deck/index.html',
  '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><title>deck</title>' +
    '<canvas width="500" height="300"></canvas><script type="module" src="deck.js"></script>\n',
);
const server = await serve(process.cwd());
const told = {};
try {
  for (const name of ['ours', 'theirs']) {
    const { browser, page, errors, elsewhere } = await openPage(server.address, { width: 520, height: 320 }, program);
    try {
      await page.goto(`${server.address}/deck/index.html#${name}`);
      await page.waitForFunction(() => window.told !== undefined);
      told[name] = await page.evaluate(() => window.told);
      await page.screenshot({ path: `${shots}/deck_${name}.png` });
      assert.equal(told[name].failed, undefined);
      assert.deepEqual([errors, elsewhere], [[], []]);
    } finally {
      await browser.close();
    }
  }
} finally {
  server.close();
}
console.log(JSON.stringify(told));
for (const view of ['one', 'tiles']) {
  const { low, high, [view]: ours } = told.ours;
  const theirs = told.theirs[view];
  assert.ok(
    ours.drawn > 0.1 && Math.abs(ours.drawn - theirs.drawn) < 0.1,
    `${view}: ${ours.drawn} of the canvas is drawn, and ${theirs.drawn}`,
  );
  assert.equal(ours.meshes.length, theirs.meshes.length);
  for (const mesh of ours.meshes)
    assert.ok(mesh.low >= low && mesh.high <= high && mesh.triangles > 500, JSON.stringify(mesh));
  assert.ok(
    theirs.meshes.every(mesh => mesh.low < low),
    'loaders.gl has its cliffs no more: this test compares nothing',
  );
}
