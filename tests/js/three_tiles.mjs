// A set of 3D Tiles in 3d-tiles-renderer (three.js), a client besides CesiumJS, without a screen: three_tiles.mjs
//   FOLDER PLACES.json
// PLACES.json: [[longitude, latitude], …] in degrees, near each other. Views the first from 60 km above until all
// visible tiles of the finest level are loaded. Prints JSON: heights above the ellipsoid where a ray straight down
// meets tiles (null: none), the drawn tiles, and failed loads.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const [folder, placesFile] = process.argv.slice(2);
const places = JSON.parse(readFileSync(placesFile, 'utf8')).map(place =>
  place.map(degrees => (degrees * Math.PI) / 180),
);

// The parts of a browser that the renderer uses.
globalThis.self = globalThis.window = globalThis;
globalThis.location = new URL('http://localhost/');
globalThis.requestAnimationFrame = callback => setTimeout(callback, 0);
globalThis.cancelAnimationFrame = clearTimeout;
globalThis.fetch = async url => {
  try {
    return new Response(readFileSync(join(folder, new URL(url).pathname)));
  } catch {
    return new Response('', { status: 404 });
  }
};
console.warn = () => {};
const { PerspectiveCamera, Raycaster, Vector3 } = await import('three');
const { MeshoptDecoder } = await import('three/addons/libs/meshopt_decoder.module.js');
const { TilesRenderer } = await import('3d-tiles-renderer');
const { GLTFExtensionsPlugin, ImplicitTilingPlugin } = await import('3d-tiles-renderer/plugins');

await MeshoptDecoder.ready;
const tiles = new TilesRenderer('http://localhost/tileset.json');
tiles.registerPlugin(new ImplicitTilingPlugin());
tiles.registerPlugin(new GLTFExtensionsPlugin({ meshoptDecoder: MeshoptDecoder, metadata: false }));
tiles.errorTarget = 0.01;
const failed = [];
tiles.addEventListener('load-error', event => failed.push(`${event.url}: ${event.error}`));
const at = (place, height) => tiles.ellipsoid.getCartographicToPosition(place[1], place[0], height, new Vector3());
const camera = new PerspectiveCamera(60, 1, 1, 1e8);
camera.position.copy(at(places[0], 60000));
camera.up.set(0, 0, 1);
camera.lookAt(0, 0, 0);
camera.updateMatrixWorld();
tiles.setCamera(camera);
tiles.setResolution(camera, 1000, 1000);
for (let idle = 0; idle < 20;) {
  tiles.update();
  await new Promise(done => setTimeout(done, 5));
  const { queued, downloading, parsing } = tiles.stats;
  idle = queued + downloading + parsing === 0 && tiles.root ? idle + 1 : 0;
  if (failed.length > 0) break;
}
tiles.group.updateMatrixWorld(true);
const ray = new Raycaster();
const heights = places.map(place => {
  const down = tiles.ellipsoid.getCartographicToNormal(place[1], place[0], new Vector3()).negate();
  ray.set(at(place, 20000), down);
  const met = ray.intersectObject(tiles.group, true).map(hit => 20000 - hit.distance);
  return met.length > 0 ? Math.max(...met) : null;
});
const drawn = [...tiles.visibleTiles].filter(tile => tile.content?.uri).map(tile => tile.content.uri);
console.log(JSON.stringify({ heights, drawn, failed }));
process.exit(0);
