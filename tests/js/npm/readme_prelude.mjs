// The objects that the lines of the package's README assume.
import * as THREE from 'three';
import { fromUrl } from 'geotiff';
import { decodeTile, simplify } from 'scarp';

const width = 512;
const height = 512;
const heights = Float32Array.from(
  { length: width * height },
  (_, k) => 100 * Math.sin((k % width) / 40) * Math.cos(Math.floor(k / width) / 50),
);
Object.assign(window, {
  THREE,
  fromUrl,
  decodeTile,
  simplify,
  width,
  height,
  heights,
  z: heights,
  scene: new THREE.Scene(),
  url: 'tile.png',
  latitude: 36,
  zoom: 10,
  controller: new AbortController(),
  show: () => {},
});
