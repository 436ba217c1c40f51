// The time of the viewer to its first picture, and to answer its slider: node bench/viewer/run.mjs PAGE.html [RUNS]
// [CHROMIUM]
//
// PAGE: what `scarp view MESH RASTER` wrote with the engine inside. Each run is a new Chromium, which draws by
// software. Wall clock, pixels read back: from the page's navigation to its first picture, and from an input of the
// slider to the picture of its mesh. Needs playwright-core.
import os from 'node:os';
import { pathToFileURL } from 'node:url';
import { openPage } from '../../tests/js/browser.mjs';

const [file, runs = '5', program] = process.argv.slice(2);
/// Steps of an eighth of an octave: finer ones continue from the mesh before, a coarser one begins again.
const DRAG = [16, 18, 20, 22, 24, 26, 28, 21, 25];

/// In the page, before its script: `first`, and `drag(step)`.
function watch() {
  const picture = () => {
    // waits for what was drawn
    const gl = document.getElementById('canvas').getContext('webgl2');
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now();
  };
  const until = isThere =>
    new Promise(done => {
      const look = () => (isThere() ? done(picture()) : setTimeout(look, 1));
      look();
    });
  window.bench = {
    first: until(() => window.scarpPage?.drawn > 0),
    async drag(step) {
      const page = window.scarpPage;
      const slider = document.getElementById('error');
      const { drawn } = page;
      const start = performance.now();
      slider.value = String(step);
      slider.dispatchEvent(new Event('input'));
      return (
        (await until(
          () => page.drawn > drawn && !page.scene.asked && page.shown[0] === page.live.meshes.get(`greedy ${step}`),
        )) - start
      );
    },
  };
}

const median = values => values.sort((a, b) => a - b)[values.length >> 1];
const took = { first: [], drag: [] };
let about;
for (let run = 0; run < Number(runs); ++run) {
  const { browser, page, errors } = await openPage(pathToFileURL(file).href, { width: 1100, height: 700 }, program);
  await page.addInitScript(watch);
  await page.goto(pathToFileURL(file).href);
  took.first.push(await page.evaluate(() => window.bench.first));
  about = await page.evaluate(() =>
    (({ field, levels }) => `${field.cols}x${field.rows},${levels[0].triangles}`)(window.scarpPage.document),
  );
  await page.evaluate(step => window.bench.drag(step), DRAG[0] - 2); // the engine starts
  for (const step of DRAG) took.drag.push(await page.evaluate(step => window.bench.drag(step), step));
  await browser.close();
  if (errors.length > 0) throw new Error(errors.join('\n'));
}
console.log('what,samples,triangles,runs,median_ms,least_ms,most_ms,load');
for (const [name, times] of Object.entries(took)) {
  console.log(
    [
      name === 'first' ? 'first picture' : 'slider',
      about,
      times.length,
      median(times).toFixed(0),
      Math.min(...times).toFixed(0),
      Math.max(...times).toFixed(0),
      os.loadavg()[0].toFixed(1),
    ].join(),
  );
}
