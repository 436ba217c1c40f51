// The prelude to the lines of a guide: a scene with light and a camera. Draws until something is visible.
import * as THREE from 'three';

const renderer = new THREE.WebGLRenderer();
renderer.setSize(400, 300);
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(50, 4 / 3, 1, 2000);
scene.add(new THREE.HemisphereLight(0xffffff, 0x444444, 3));
Object.assign(window, { scene, camera, drawn: 0 });
const pixels = new Uint8Array(4 * 400 * 300);
const sphere = new THREE.Sphere();
const draw = () => {
  if (window.tiles) {
    // the guide, too, does this in the drawing loop
    if (tiles.getBoundingSphere(sphere)) {
      sphere.applyMatrix4(tiles.group.matrixWorld);
      camera.position.set(0, sphere.radius, sphere.radius).add(sphere.center);
      camera.far = 10 * sphere.radius;
      camera.lookAt(sphere.center);
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld();
    }
    tiles.setCamera(camera);
    tiles.setResolutionFromRenderer(camera, renderer);
    tiles.update();
  }
  renderer.render(scene, camera);
  const gl = renderer.getContext();
  gl.readPixels(0, 0, 400, 300, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let seen = 0;
  for (let k = 0; k < pixels.length; k += 4) seen += pixels[k] + pixels[k + 1] + pixels[k + 2] > 0;
  window.drawn = seen / (400 * 300);
  if (!seen) requestAnimationFrame(draw);
};
requestAnimationFrame(draw);
