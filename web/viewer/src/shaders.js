// Shaders for surfaces and edges.
export const SURFACE_VERTEX = `
attribute vec2 sampled;
varying vec2 at;
varying vec3 seen;
varying float height;
varying vec3 facing;
varying vec2 inImage;
void main() {
  at = sampled;
  facing = normalMatrix * normal;
  inImage = uv;
  height = position.z;
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  seen = view.xyz;
  gl_Position = projectionMatrix * view;
}`;

// The error map is shaded by at most 28 %: a dark slope would hide the sign. Transparent parts of an image show the
// relief.
export const SURFACE_FRAGMENT = `
uniform sampler2D errors;
uniform bool showsErrors;
uniform sampler2D image;
uniform bool showsImage;
uniform bool showsGround;
uniform vec3 ground;
uniform bool isSmooth;
uniform float scale;
uniform vec2 range;
uniform vec3 sun;
varying vec2 at;
varying vec3 seen;
varying float height;
varying vec3 facing;
varying vec2 inImage;
vec3 ramp(float t) {
  vec3 a = vec3(.36, .47, .35), b = vec3(.66, .63, .47), c = vec3(.62, .55, .49), d = vec3(.97, .97, .98);
  return t < .35 ? mix(a, b, t / .35) : t < .7 ? mix(b, c, (t - .35) / .35) : mix(c, d, (t - .7) / .3);
}
vec3 diverge(float t) {
  return t < 0. ? mix(vec3(.95), vec3(.13, .40, .67), -t) : mix(vec3(.95), vec3(.70, .09, .17), t);
}
void main() {
  vec3 normal = normalize(isSmooth ? facing : cross(dFdx(seen), dFdy(seen)));
  vec3 up = (viewMatrix * vec4(0., 0., 1., 0.)).xyz;
  if (dot(normal, up) < 0.) normal = -normal;
  float lit = max(dot(normal, (viewMatrix * vec4(sun, 0.)).xyz), 0.);
  vec3 color;
  if (showsErrors) {
    float error = texture2D(errors, at).r;
    color = abs(error) > 1e29 ? vec3(.55) : diverge(clamp(error / scale, -1., 1.));
    color *= .72 + .28 * lit;
  } else {
    color = ramp(clamp((height - range.x) / max(range.y - range.x, 1e-9), 0., 1.)) * (.34 + .90 * lit);
    vec4 texel = showsGround ? vec4(ground, 1.) : texture2D(image, inImage);
    if (showsImage || showsGround) color = mix(color, texel.rgb * (.5 + .6 * lit), texel.a);
  }
  gl_FragColor = vec4(color, 1.);
}`;

// Edges are at most a pixel wide, opaque from 12 pixels of length on, and invisible below 4.
export const EDGE_VERTEX = `
attribute vec3 other;
uniform vec2 pixels;
varying float shown;
void main() {
  vec4 here = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vec4 there = projectionMatrix * modelViewMatrix * vec4(other, 1.0);
  vec2 apart = (here.xy / here.w - there.xy / there.w) * .5 * pixels;
  float lengthOnScreen = there.w <= 0. || here.w <= 0. ? 1e4 : length(apart);
  shown = smoothstep(4., 12., lengthOnScreen);
  gl_Position = shown > 0. ? here : vec4(0., 0., 2., 1.);
}`;

export const EDGE_FRAGMENT = `
uniform vec3 ink;
uniform float weight;
varying float shown;
void main() {
  gl_FragColor = vec4(ink, weight * shown);
}`;
