// The terrain on the canvas: one view or two side by side, redrawn after changes.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Antialias } from './antialias.js';
import { makePyramid } from './errors.js';
import { EDGE_FRAGMENT, EDGE_VERTEX, SURFACE_FRAGMENT, SURFACE_VERTEX } from './shaders.js';
import { Sentence } from './sentence.js';

THREE.ColorManagement.enabled = false; // colours reach the screen unchanged
const UNCOVERED = 1e30;
const SHORTEST = 4; // pixels of a visible edge, as in shaders.js
const MOST_TEXELS = 4096; // a side; larger maps are reduced by largest errors

function errorTexture(judged, { cols, rows }) {
  let levels = makePyramid(judged.errors, cols, rows);
  while (levels[0].width > MOST_TEXELS || levels[0].height > MOST_TEXELS) levels = levels.slice(1);
  const mipmaps = levels.map(({ data, width, height }) => ({
    data: data.map(error => (error === error ? error : UNCOVERED)),
    width,
    height,
  }));
  const texture = new THREE.DataTexture(
    mipmaps[0].data,
    mipmaps[0].width,
    mipmaps[0].height,
    THREE.RedFormat,
    THREE.FloatType,
  );
  texture.mipmaps = mipmaps;
  texture.minFilter = THREE.NearestMipmapNearestFilter;
  texture.magFilter = THREE.NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

const WRAPS = { 33071: THREE.ClampToEdgeWrapping, 33648: THREE.MirroredRepeatWrapping };
function imageTexture({ bitmap, wraps }) {
  const texture = new THREE.Texture(bitmap);
  texture.flipY = false;
  [texture.wrapS, texture.wrapT] = wraps.map(number => WRAPS[number] ?? THREE.RepeatWrapping);
  texture.anisotropy = 8;
  texture.needsUpdate = true;
  return texture;
}

/** One terrain and its edges. */
class View {
  constructor(shared) {
    this.scene = new THREE.Scene();
    this.group = new THREE.Group();
    this.scene.add(this.group);
    this.uniforms = { ...shared, errors: { value: null } };
    this.materials = []; // kept for the next terrain: a new one would be recompiled
    this.surface = new THREE.Mesh(new THREE.BufferGeometry());
    this.edges = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.ShaderMaterial({
        uniforms: { pixels: shared.pixels, ink: shared.ink, weight: shared.weight },
        vertexShader: EDGE_VERTEX,
        fragmentShader: EDGE_FRAGMENT,
        transparent: true,
        depthWrite: false,
      }),
    );
    this.group.add(this.surface, this.edges);
  }

  /** The material of the k-th image. */
  material(k) {
    return (this.materials[k] ??= new THREE.ShaderMaterial({
      uniforms: {
        ...this.uniforms,
        image: { value: null },
        showsImage: { value: false },
        ground: { value: [1, 1, 1] },
        showsGround: { value: false },
      },
      vertexShader: SURFACE_VERTEX,
      fragmentShader: SURFACE_FRAGMENT,
      side: THREE.DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    }));
  }

  /** The browser compiles shaders while the page reads the mesh. */
  compile(renderer, camera) {
    this.surface.material = this.material(0);
    renderer.compile(this.surface, camera, this.scene);
  }

  show(terrain) {
    if (terrain === this.terrain) return;
    this.terrain = terrain;
    this.surface.geometry.dispose();
    this.edges.geometry.dispose();
    for (const texture of [this.uniforms.errors, ...this.materials.map(({ uniforms }) => uniforms.image)]) {
      texture.value?.dispose();
      texture.value = null;
    }
    this.ranked = null;
    this.edgesThere = 0;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(terrain.scene, 3));
    if (terrain.uvs) geometry.setAttribute('uv', new THREE.BufferAttribute(terrain.uvs, 2));
    geometry.setIndex(new THREE.BufferAttribute(terrain.indices, 1));
    terrain.sheets.forEach(({ start, count }, k) => geometry.addGroup(start, count, k));
    this.surface.material = terrain.sheets.map((_, k) => this.material(k));
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), terrain.reach * 2);
    this.surface.geometry = geometry;
  }

  /** Created when first displayed. */
  prepare(look) {
    const { terrain, uniforms } = this;
    const { geometry } = this.surface;
    if (look.errors && terrain.judged && !uniforms.errors.value) {
      uniforms.errors.value = errorTexture(terrain.judged, terrain.field);
      geometry.setAttribute('sampled', new THREE.BufferAttribute(terrain.sampled, 2));
    }
    terrain.sheets.forEach((sheet, k) => {
      const { image, showsImage, ground, showsGround } = this.materials[k].uniforms;
      showsImage.value = look.image && sheet.image !== null;
      showsGround.value = look.image && sheet.ground !== null;
      if (showsGround.value) ground.value = sheet.ground;
      if (showsImage.value) image.value ??= imageTexture(sheet.image);
    });
    if (look.smooth && !geometry.attributes.normal)
      geometry.setAttribute('normal', new THREE.BufferAttribute(terrain.normals, 3));
    this.edges.visible = look.edges;
  }

  /** Prepares only edges long enough to be visible: `shortest`, in the scene's units. */
  prepareEdges(shortest) {
    const { terrain, edges } = this;
    const { pairs, countFrom } = (this.ranked ??= terrain.edges());
    const count = countFrom(shortest);
    if (count > this.edgesThere) {
      this.edgesThere = Math.min(pairs.length / 2, Math.max(2 * this.edgesThere, count));
      const here = new Float32Array(this.edgesThere * 6);
      const there = new Float32Array(this.edgesThere * 6);
      const { scene } = terrain;
      for (let k = 0; k < 2 * this.edgesThere; ++k) {
        for (let c = 0, from = 3 * pairs[k], to = 3 * pairs[k ^ 1]; c < 3; ++c) {
          here[3 * k + c] = scene[from + c];
          there[3 * k + c] = scene[to + c];
        }
      }
      edges.geometry.dispose();
      edges.geometry = new THREE.BufferGeometry()
        .setAttribute('position', new THREE.BufferAttribute(here, 3))
        .setAttribute('other', new THREE.BufferAttribute(there, 3));
      edges.geometry.boundingSphere = this.surface.geometry.boundingSphere;
    }
    edges.geometry.setDrawRange(0, 2 * count);
    edges.visible = count > 0;
  }
}

export class Scene {
  /** `look`: {errors, image, edges, smooth, exaggeration, sun: {azimuth, altitude}, scale, divider}, which the caller
   * changes. */
  constructor(canvas, look) {
    Object.assign(this, { canvas, look, listeners: [], views: [] });
    const { width, height, ratio } = this.size();
    // Before the buffer exists, which would be created twice.
    Object.assign(canvas, { width: width * ratio, height: height * ratio });
    try {
      this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false, preserveDrawingBuffer: true });
    } catch {
      throw new Sentence('This browser cannot draw WebGL 2: update it, or turn on its hardware acceleration.');
    }
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setScissorTest(true);
    this.antialias = new Antialias(this.renderer);
    this.camera = new THREE.PerspectiveCamera(35, 1, 1, 1e5);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.maxPolarAngle = Math.PI * 0.52;
    this.controls.addEventListener('change', () => this.invalidate());
    this.shared = {
      showsErrors: { value: false },
      isSmooth: { value: false },
      scale: { value: 1 },
      range: { value: new THREE.Vector2() },
      sun: { value: new THREE.Vector3() },
      pixels: { value: new THREE.Vector2() },
      ink: { value: new THREE.Color() },
      weight: { value: 0.5 },
    };
    new ResizeObserver(() => this.size().text === this.drawnSize || this.invalidate()).observe(canvas);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.invalidate());
    canvas.addEventListener('webglcontextrestored', () => this.invalidate());
    this.addView().compile(this.renderer, this.camera);
  }

  /** The size in CSS pixels, and the screen's pixels along the side of a CSS pixel. */
  size() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = Math.min(devicePixelRatio, 2);
    return { width, height, ratio, text: `${width} ${height} ${ratio}` };
  }

  fit() {
    const { width, height, ratio, text } = this.size();
    if (this.drawnSize === text) return;
    this.renderer.setDrawingBufferSize(width, height, ratio);
    this.antialias.fit(width * ratio, height * ratio);
    this.drawnSize = text;
  }

  addView() {
    this.views.push(new View(this.shared));
    return this.views.at(-1);
  }

  onDraw(listener) {
    this.listeners.push(listener);
  }

  /** Resolves when the requested picture is on the screen. */
  nextPicture() {
    return new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done))));
  }

  /** Shows one terrain or two. */
  show(terrains) {
    while (this.views.length < terrains.length) this.addView();
    terrains.forEach((terrain, k) => this.views[k].show(terrain));
    if (this.count !== terrains.length) this.divide(terrains.length);
    this.invalidate();
  }

  /** Keeps the same part of the terrain visible when one view becomes two of equal size. `isForTwo`: the orbit is
   * already for two views. */
  divide(count) {
    const before = this.count && Math.tan(this.fov() / 2);
    const { right, top } = this.look.covered();
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.count = count;
    this.look.divider = top > 0.3 * height ? 0.5 : Math.min(0.8, (1 + right / width) / 2);
    if (before && !this.isForTwo) this.approach(before / Math.tan(this.fov() / 2));
    this.isForTwo = false;
  }

  invalidate() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => this.draw());
  }

  /** Resets the view: from the south-south-west, with the whole terrain visible. */
  reset() {
    const first = { azimuth: -20, altitude: 38, target: [0, 0, 0] };
    this.controls.target.set(0, 0, 0);
    this.setOrbit({ ...first, distance: 1 });
    this.camera.updateMatrixWorld();
    this.setOrbit({ ...first, distance: this.distanceToSee() });
  }

  /** The distance, in the camera's direction, at which each corner of the terrain's box is visible. */
  distanceToSee() {
    const { place } = this.views[0].terrain;
    const half = Math.tan((this.camera.fov * Math.PI) / 360) / Math.max(1, this.canvas.clientHeight);
    const [right, up, back] = [0, 1, 2].map(k => new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, k));
    const reaches = [...Array(this.count).keys()].flatMap(k => {
      const [, , wide, high] = this.free(k);
      return Array.from({ length: 8 }, (_, corner) => {
        const [x, y, z] = place.toScene(...[0, 1, 2].map(c => ((corner >> c) & 1 ? place.high : place.low)[c]));
        const at = new THREE.Vector3(x, y, z * this.look.exaggeration);
        return at.dot(back) + Math.max(Math.abs(at.dot(right)) / (half * wide), Math.abs(at.dot(up)) / (half * high));
      });
    });
    return Math.max(place.radius * 1e-3, 1.04 * Math.max(...reaches));
  }

  /** The smallest free angle among the widths and heights of the views. */
  fov() {
    const half = Math.tan((this.camera.fov * Math.PI) / 360) / Math.max(1, this.canvas.clientHeight);
    const sides = [...Array(this.count).keys()].flatMap(k => this.free(k).slice(2));
    return 2 * Math.atan(half * Math.min(...sides));
  }

  /** The camera's direction in degrees clockwise from north and above the horizon, and its distance in metres. */
  orbit() {
    const { target } = this.controls;
    const away = this.camera.position.clone().sub(target);
    const distance = away.length();
    return {
      azimuth: (Math.atan2(-away.x, -away.y) * 180) / Math.PI,
      altitude: (Math.asin(away.z / distance) * 180) / Math.PI,
      distance,
      target: target.toArray(),
    };
  }

  setOrbit({ azimuth, altitude, distance, target }) {
    const a = (azimuth * Math.PI) / 180;
    const h = (Math.max(0.5, Math.min(89.9, altitude)) * Math.PI) / 180;
    this.controls.target.fromArray(target);
    this.camera.position
      .set(-Math.sin(a) * Math.cos(h), -Math.cos(a) * Math.cos(h), Math.sin(h))
      .multiplyScalar(distance)
      .add(this.controls.target);
    this.controls.update();
    this.invalidate();
  }

  turn(azimuth, altitude) {
    const orbit = this.orbit();
    this.setOrbit({ ...orbit, azimuth: orbit.azimuth + azimuth, altitude: orbit.altitude + altitude });
  }

  /** Moves the camera over the ground, to the right and ahead, by shares of the picture's height. */
  move(right, ahead) {
    const {
      azimuth,
      target: [x, y, z],
      ...orbit
    } = this.orbit();
    const a = (azimuth * Math.PI) / 180;
    const length = this.metresPerPixel() * this.canvas.clientHeight;
    const [east, north] = [right * Math.cos(a) + ahead * Math.sin(a), ahead * Math.cos(a) - right * Math.sin(a)];
    this.setOrbit({ ...orbit, azimuth, target: [x + east * length, y + north * length, z] });
  }

  approach(factor) {
    const orbit = this.orbit();
    this.setOrbit({ ...orbit, distance: orbit.distance * factor });
  }

  /** Left edge and width of a view, in CSS pixels. */
  part(k) {
    const width = this.canvas.clientWidth;
    const middle = Math.round(width * this.look.divider);
    return this.count < 2 ? [0, width] : k === 0 ? [0, middle] : [middle, width - middle];
  }

  /** The part of a view that the panel does not cover: left, top, width and height. */
  free(k) {
    const [left, width] = this.part(k);
    const height = this.canvas.clientHeight;
    const panel = this.look.covered();
    if (panel.top > 0.3 * height) return [0, 0, width, Math.max(1, panel.top)];
    const hidden = Math.min(Math.max(0, panel.right - left), width * 0.6);
    return [hidden, 0, Math.max(1, width - hidden), height];
  }

  /** The camera's target is in the middle of the free area. */
  aim(k) {
    const width = Math.max(1, this.part(k)[1]);
    const height = Math.max(1, this.canvas.clientHeight);
    const [left, top, wide, high] = this.free(k);
    this.camera.aspect = width / height;
    this.camera.setViewOffset(width, height, width / 2 - left - wide / 2, height / 2 - top - high / 2, width, height);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  draw() {
    this.asked = false;
    if (!this.count) return;
    const { canvas, renderer, camera, look, shared } = this;
    const { place } = this.views[0].terrain;
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    this.fit();
    const style = getComputedStyle(document.documentElement);
    const azimuth = (look.sun.azimuth * Math.PI) / 180;
    const altitude = (look.sun.altitude * Math.PI) / 180;
    renderer.setClearColor(style.getPropertyValue('--sky').trim());
    shared.showsErrors.value = look.errors && this.views.slice(0, this.count).every(({ terrain }) => terrain.judged);
    shared.isSmooth.value = look.smooth;
    shared.scale.value = Math.max(look.scale, 1e-12);
    shared.sun.value.set(
      Math.sin(azimuth) * Math.cos(altitude),
      Math.cos(azimuth) * Math.cos(altitude),
      Math.sin(altitude),
    );
    shared.range.value.set(place.toScene(0, 0, place.low[2])[2], place.toScene(0, 0, place.high[2])[2]);
    shared.ink.value.setRGB(0.05, 0.06, 0.08);
    shared.weight.value = look.errors ? 0.3 : 0.5;
    const radius =
      Math.max(...this.views.slice(0, this.count).map(view => view.terrain.reach)) * Math.max(1, look.exaggeration);
    const away = camera.position.length();
    camera.near = Math.max(away - radius * 1.1, radius * 1e-4);
    camera.far = away + radius * 1.1;
    const target = this.antialias.begin(
      this.views.slice(0, this.count).reduce((sum, { terrain }) => sum + terrain.triangles, 0),
    );
    for (let k = 0; k < this.count; ++k) {
      const view = this.views[k];
      const [left, wide] = this.part(k);
      if (wide < 1) continue;
      view.prepare(look);
      if (look.edges)
        view.prepareEdges(
          (SHORTEST * camera.near * 2 * Math.tan((camera.fov * Math.PI) / 360)) /
            height /
            Math.max(1, look.exaggeration),
        );
      view.group.scale.z = look.exaggeration;
      this.aim(k);
      shared.pixels.value.set(wide, height);
      target.setViewport(left, 0, wide, height);
      target.setScissor(left, 0, wide, height);
      renderer.render(view.scene, camera);
    }
    this.antialias.end();
    for (const listener of this.listeners) listener();
  }

  /** The projection of a position in the scene, exaggerated as drawn: CSS pixels in view `k`; null behind the
   * camera. */
  project(point, k = 0) {
    this.aim(k);
    const [left, width] = this.part(k);
    const at = new THREE.Vector3(point[0], point[1], point[2] * this.look.exaggeration).project(this.camera);
    return Math.abs(at.z) > 1 ? null : [left + ((at.x + 1) / 2) * width, ((1 - at.y) / 2) * this.canvas.clientHeight];
  }

  /** The point at a pixel, in the scene's coordinates without exaggeration; null for the sky. */
  pick(x, y) {
    const k = this.count > 1 && x >= this.part(1)[0] ? 1 : 0;
    const [left, width] = this.part(k);
    this.aim(k);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(
      new THREE.Vector2(((x - left) / width) * 2 - 1, 1 - (y / this.canvas.clientHeight) * 2),
      this.camera,
    );
    this.views[k].group.updateMatrixWorld();
    const [hit] = ray.intersectObject(this.views[k].surface);
    return hit ? [hit.point.x, hit.point.y, hit.point.z / this.look.exaggeration] : null;
  }

  /** Metres per pixel in the middle of the scene. */
  metresPerPixel() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360)) / this.canvas.clientHeight;
  }

  png() {
    this.draw();
    return new Promise(done => this.canvas.toBlob(done, 'image/png'));
  }
}
