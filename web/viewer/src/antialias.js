// Antialiasing: draws four samples a pixel off the canvas, then copies them. Without a graphics processor, many small
// triangles would need three times as long, and are not antialiased.
import * as THREE from 'three';

const MANY = 200_000;

function drawsBySoftware(gl) {
  const words = gl.getExtension('WEBGL_debug_renderer_info');
  return (
    words !== null &&
    /swiftshader|llvmpipe|softpipe|software|basic render/i.test(gl.getParameter(words.UNMASKED_RENDERER_WEBGL))
  );
}

export class Antialias {
  constructor(renderer) {
    this.renderer = renderer;
    this.isSlow = drawsBySoftware(renderer.getContext());
    this.target = new THREE.WebGLRenderTarget(1, 1, { samples: 4 });
    this.target.scissorTest = true;
    this.camera = new THREE.Camera();
    this.sheet = new THREE.Mesh(
      new THREE.PlaneGeometry(2, 2),
      new THREE.ShaderMaterial({
        uniforms: { picture: { value: this.target.texture } },
        depthTest: false,
        depthWrite: false,
        vertexShader: 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0., 1.); }',
        fragmentShader:
          'uniform sampler2D picture; varying vec2 at; void main() { gl_FragColor = texture2D(picture, at); }',
      }),
    );
    this.sheet.frustumCulled = false;
  }

  fit(width, height) {
    this.target.setSize(Math.max(1, Math.floor(width)), Math.max(1, Math.floor(height)));
  }

  /** Returns the target of viewports, in CSS pixels. */
  begin(triangles) {
    const { renderer, target } = this;
    const ratio = renderer.getPixelRatio();
    this.isOn = !(this.isSlow && triangles > MANY);
    if (!this.isOn) return renderer;
    renderer.setRenderTarget(target);
    const place =
      area =>
      (...sides) => {
        area.set(...sides.map(side => Math.round(side * ratio)));
        renderer.setRenderTarget(target); // also applies earlier settings
      };
    return { setViewport: place(target.viewport), setScissor: place(target.scissor) };
  }

  end() {
    if (!this.isOn) return;
    const { renderer, target } = this;
    const ratio = renderer.getPixelRatio();
    const whole = [0, 0, target.width / ratio, target.height / ratio];
    renderer.setRenderTarget(null);
    renderer.setViewport(...whole);
    renderer.setScissor(...whole);
    renderer.render(this.sheet, this.camera);
  }
}
