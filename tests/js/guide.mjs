// Opens pages that show a globe as window.viewer: guide.mjs PLACE SHOTS CHROMIUM ADDRESS...
//
// PLACE: longitude,latitude. Prints JSON: for each page the console errors and the drawn height at the place. Writes
// SHOTS/guide_0.png and so on.
import { openPage } from './browser.mjs';

const [where, shots, program, ...addresses] = process.argv.slice(2);
const place = where.split(',').map(Number);
const answers = [];
for (const [k, address] of addresses.entries()) {
  const { browser, page, errors } = await openPage(address, { width: 640, height: 400 }, program);
  await page.goto(address);
  await page
    .waitForFunction(() => window.viewer !== undefined)
    .catch(error => {
      throw new Error([error, ...errors].join('\n'));
    });
  const height = await page.evaluate(async place => {
    const { scene } = window.viewer;
    const drawn = () =>
      new Promise(done => {
        const stop = scene.postRender.addEventListener(() => {
          stop();
          done();
        });
      });
    for (let left = 3; left > 0; left = scene.globe.tilesLoaded ? left - 1 : 3) {
      await drawn();
    }
    const origin = Cesium.Cartesian3.fromDegrees(...place, 1e5);
    const down = Cesium.Cartesian3.negate(scene.globe.ellipsoid.geodeticSurfaceNormal(origin), new Cesium.Cartesian3());
    const hit = scene.globe.pick(new Cesium.Ray(origin, down), scene);
    return hit ? Cesium.Cartographic.fromCartesian(hit).height : null;
  }, place);
  await page.screenshot({ path: `${shots}/guide_${k}.png` });
  answers.push({ height, errors });
  await browser.close();
}
console.log(JSON.stringify(answers));
