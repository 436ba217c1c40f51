// Judges a globe in a real browser: globe.mjs ADDRESS POINTS.json SHOT.png [CHROMIUM]
//
// POINTS.json: a list of [longitude, latitude, height]. Prints JSON: for each level of the set with heights there the
// largest |height that CesiumJS samples - height|, the page's text, console errors, and requests to other addresses.
import { readFileSync } from 'node:fs';
import { openPage } from './browser.mjs';

const [address, pointsFile, shot, program] = process.argv.slice(2);
const points = JSON.parse(readFileSync(pointsFile, 'utf8'));
const { browser, page, errors, elsewhere } = await openPage(address, { width: 900, height: 600 }, program);
await page.goto(address);
await page.waitForFunction(() => window.viewer !== undefined);
const result = await page.evaluate(async points => {
  const levels = {};
  for (let z = 0; z <= window.layer.maxzoom; ++z) {
    const at = points.map(([lon, lat]) => Cesium.Cartographic.fromDegrees(lon, lat));
    if (
      !at.every(p => {
        const tile = window.terrain.tilingScheme.positionToTileXY(p, z);
        return window.terrain.availability.isTileAvailable(z, tile.x, tile.y);
      })
    )
      continue;
    const found = await Cesium.sampleTerrain(window.terrain, z, at);
    levels[z] = Math.max(...found.map((p, k) => Math.abs(p.height - points[k][2])));
  }
  return { levels, says: document.getElementById('says').textContent };
}, points);
await page.waitForTimeout(2000);
await page.waitForFunction(() => window.viewer.scene.globe.tilesLoaded);
await page.waitForTimeout(1000);
await page.screenshot({ path: shot });
// A ray straight down from 20 km hits the drawn ground.
await page.evaluate(
  ([lon, lat]) =>
    window.viewer.camera.setView({
      destination: Cesium.Cartesian3.fromDegrees(lon, lat, 20000),
      orientation: { heading: 0, pitch: -Math.PI / 2, roll: 0 },
    }),
  points[0],
);
await page.waitForTimeout(500);
await page.waitForFunction(() => window.viewer.scene.globe.tilesLoaded);
await page.waitForTimeout(500);
result.picked = await page.evaluate(() => {
  const { scene, camera } = window.viewer;
  const hit = scene.globe.pick(new Cesium.Ray(camera.position, camera.direction), scene);
  return hit ? Cesium.Cartographic.fromCartesian(hit).height : null;
});
result.expected = points[0][2];
console.log(JSON.stringify({ ...result, errors, elsewhere }));
await browser.close();
