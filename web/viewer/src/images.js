// Images draped over a mesh: their settings in a material of a GLB, and their pixels.

const SLACK = 1e-3; // share of the image's side

const toSrgb = linear => (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);

/** {texture, places, ground, hasNormalMap, isMoved} of a primitive: the texture's index or null, the name of an
 * attribute, the colour without a texture. */
export function surfaceOf(json, primitive) {
  const material = json.materials?.[primitive.material] ?? {};
  const { baseColorTexture: base, baseColorFactor = [] } = material.pbrMetallicRoughness ?? {};
  const places = `TEXCOORD_${base?.texCoord ?? 0}`;
  const hasPlaces = base && primitive.attributes?.[places] !== undefined;
  return {
    texture: hasPlaces ? base.index : null,
    places,
    ground: hasPlaces ? null : [0, 1, 2].map(k => toSrgb(baseColorFactor[k] ?? 1)),
    hasNormalMap: Boolean(material.normalTexture),
    isMoved: Boolean(base?.extensions?.KHR_texture_transform),
  };
}

/** {image: {bitmap, wraps: [along u, along v]}} with glTF's numbers, null for a placeholder of one pixel; or {why}
 * there is none. */
export async function readImage(json, index, bytesOf) {
  const texture = json.textures?.[index] ?? {};
  const source = json.images?.[texture.extensions?.EXT_texture_webp?.source ?? texture.source];
  if (source?.bufferView === undefined) return { why: 'it does not lie in the file' };
  const blob = new Blob([bytesOf(source.bufferView)], { type: source.mimeType });
  try {
    const bitmap = await createImageBitmap(blob, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
    const { wrapS = 10497, wrapT = 10497 } = json.samplers?.[texture.sampler] ?? {};
    return { image: bitmap.width * bitmap.height > 1 ? { bitmap, wraps: [wrapS, wrapT] } : null };
  } catch {
    return { why: `this browser cannot read it (${source.mimeType ?? 'of no type'})` };
  }
}

/** The map from x and y of a mesh to its image, if it is affine: (x, y) => [u, v]; null if it is none. */
export function findPlacing({ positions, uvs }) {
  const count = uvs.length / 2;
  const row = v => [positions[3 * v], positions[3 * v + 1], uvs[2 * v], uvs[2 * v + 1]];
  const mean = [0, 0, 0, 0];
  // Sums of the products of x and of y with each of the four.
  const products = Array.from({ length: 2 }, () => [0, 0, 0, 0]);
  for (let v = 0; v < count; ++v)
    row(v).forEach((value, k) => {
      mean[k] += value / count;
    });
  for (let v = 0; v < count; ++v) {
    const fromMean = row(v).map((value, k) => value - mean[k]);
    for (let j = 0; j < 2; ++j) for (let k = 0; k < 4; ++k) products[j][k] += fromMean[j] * fromMean[k];
  }
  const [[xx, xy], [, yy]] = products;
  const determinant = xx * yy - xy * xy;
  const slopes = [2, 3].map(k =>
    [products[0][k] * yy - products[1][k] * xy, products[1][k] * xx - products[0][k] * xy].map(
      sum => sum / determinant,
    ),
  );
  const place = (x, y) => slopes.map(([a, b], k) => mean[2 + k] + a * (x - mean[0]) + b * (y - mean[1]));
  for (let v = 0; v < count; ++v) {
    const [x, y, u, w] = row(v);
    const [a, b] = place(x, y);
    if (!(Math.abs(a - u) < SLACK && Math.abs(b - w) < SLACK)) return null;
  }
  return place;
}
