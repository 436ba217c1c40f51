// A terrain to dig in: each stroke updates a window of the field, and the cells that it touches are drawn anew.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Live, ready } from 'scarp/live';
import module from 'scarp/live.wasm';

const SIDE = 513; // samples
const element = id => document.getElementById(id);

/// Hills with ridges, in metres.
function makeGround() {
  const ridge = (x, y) => 1 - Math.abs(Math.sin(x + 1.7 * Math.sin(0.6 * y)));
  return Float32Array.from({ length: SIDE * SIDE }, (_, k) => {
    const [x, y] = [(k % SIDE) / 60, Math.floor(k / SIDE) / 60];
    return 18 * ridge(x, y) * ridge(0.7 * y, x) + 6 * Math.sin(2.3 * x + y) + 1.5 * ridge(5 * y, 4 * x);
  });
}

const renderer = new THREE.WebGLRenderer({ canvas: element('canvas'), antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xdfe7ea);
const camera = new THREE.PerspectiveCamera(45, 1, 1, 3000);
camera.position.set(SIDE / 2, 230, 1.25 * SIDE);
const controls = new OrbitControls(camera, renderer.domElement);
controls.target.set(SIDE / 2, 0, SIDE / 2);
controls.mouseButtons = { LEFT: null, MIDDLE: THREE.MOUSE.DOLLY, RIGHT: THREE.MOUSE.ROTATE };
controls.touches = { ONE: null, TWO: THREE.TOUCH.DOLLY_ROTATE };
controls.maxPolarAngle = 1.5;
const sun = new THREE.DirectionalLight(0xfff4e0, 2.4);
sun.position.set(-2, 2, 1);
scene.add(sun, new THREE.HemisphereLight(0xdfefff, 0x8a7f6a, 1.2));
// The library's z is up, three.js's y.
const ground = new THREE.Group();
ground.rotation.x = -Math.PI / 2;
scene.add(ground);
const surface = new THREE.MeshLambertMaterial({
  color: 0xa8b58c,
  flatShading: true,
  polygonOffset: true,
  polygonOffsetFactor: 1,
  polygonOffsetUnits: 1,
});
const ink = new THREE.MeshBasicMaterial({ color: 0x33402a, wireframe: true, transparent: true, opacity: 0.5 });

let live;
let heights; // the same samples, for the brush
let version;
let isAsked = false;
const slots = new Map();

function draw() {
  if (isAsked) return;
  isAsked = true;
  requestAnimationFrame(() => {
    isAsked = false;
    const { clientWidth, clientHeight } = renderer.domElement;
    renderer.setSize(clientWidth, clientHeight, false);
    camera.aspect = clientWidth / clientHeight;
    camera.updateProjectionMatrix();
    renderer.render(scene, camera);
  });
}

/// Uploads the cells that changed; returns the number of their triangles.
function follow() {
  const { cells, version: now } = live.changes(version);
  version = now;
  for (const { slot, col, row, positions, indices } of cells) {
    let mesh = slots.get(slot);
    if (!mesh) {
      mesh = new THREE.Mesh(undefined, surface);
      mesh.add(new THREE.Mesh(undefined, ink));
      ground.add(mesh);
      slots.set(slot, mesh);
    }
    mesh.geometry.dispose();
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    mesh.geometry = mesh.children[0].geometry = geometry;
    mesh.position.set(col, -row, 0);
  }
  draw();
  return cells.reduce((sum, { indices }) => sum + indices.length / 3, 0);
}

function tell(milliseconds, changed) {
  const texts = {
    milliseconds: `${milliseconds.toFixed(2)} ms`,
    changed: changed.toLocaleString('en'),
    triangles: live.triangleCount.toLocaleString('en'),
    samples: (SIDE * SIDE).toLocaleString('en'),
    largest: `${live.maxError.toFixed(3)} m`,
  };
  for (const [id, text] of Object.entries(texts)) element(id).textContent = text;
}

/// A field from the current heights; from the first ones with `anew`.
function start(anew) {
  if (anew) heights = makeGround();
  live?.free();
  for (const mesh of slots.values()) {
    mesh.geometry.dispose();
    ground.remove(mesh);
  }
  slots.clear();
  version = 0;
  const begin = performance.now();
  live = new Live(heights, SIDE, SIDE, { maxError: Number(element('error').value), effort: element('effort').value });
  tell(performance.now() - begin, follow());
}

/// Moves the ground around a place by up to `metres`; 0 flattens it.
function stroke(x, y, radius, metres) {
  const first = [x, y].map(at => Math.max(0, Math.ceil(at - radius)));
  const last = [x, y].map(at => Math.min(SIDE - 1, Math.floor(at + radius)));
  const [cols, rows] = [0, 1].map(k => last[k] - first[k] + 1);
  if (cols < 1 || rows < 1) return;
  const level = heights[Math.min(SIDE - 1, Math.round(y)) * SIDE + Math.min(SIDE - 1, Math.round(x))];
  const window = new Float32Array(cols * rows);
  for (let row = 0; row < rows; ++row) {
    for (let col = 0; col < cols; ++col) {
      const at = (first[1] + row) * SIDE + first[0] + col;
      const far = Math.hypot(first[0] + col - x, first[1] + row - y) / radius;
      const weight = far < 1 ? (1 - far * far) ** 2 : 0;
      heights[at] += metres === 0 ? 0.3 * weight * (level - heights[at]) : metres * weight;
      window[row * cols + col] = heights[at];
    }
  }
  const begin = performance.now();
  live.update({ col: first[0], row: first[1], cols, rows }, window);
  const milliseconds = performance.now() - begin;
  tell(milliseconds, follow());
}

const ray = new THREE.Raycaster();
function dig(event) {
  const { clientWidth, clientHeight } = renderer.domElement;
  const at = new THREE.Vector2((2 * event.offsetX) / clientWidth - 1, 1 - (2 * event.offsetY) / clientHeight);
  ray.setFromCamera(at, camera);
  const [hit] = ray.intersectObjects([...slots.values()], false);
  if (hit) stroke(hit.point.x, hit.point.z, Number(element('radius').value), 0.6 * Number(element('tool').value));
}

const fingers = new Set();
renderer.domElement.addEventListener('pointerdown', event => {
  fingers.add(event.pointerId);
  if (event.button === 0 && fingers.size === 1) dig(event);
});
renderer.domElement.addEventListener('pointermove', event => {
  if ((event.buttons & 1) !== 0 && fingers.size === 1) dig(event);
});
for (const end of ['pointerup', 'pointercancel']) {
  addEventListener(end, event => fingers.delete(event.pointerId));
}
controls.addEventListener('change', draw);
addEventListener('resize', draw);
element('edges').addEventListener('change', () => {
  ink.visible = element('edges').checked;
  draw();
});
for (const id of ['error', 'effort']) element(id).addEventListener('change', () => start(false));
element('reset').addEventListener('click', () => start(true));

await ready(module);
controls.update();
start(true);
window.digPage = { stroke, heights: () => heights, live: () => live };
