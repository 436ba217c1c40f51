// Replaces loaders.gl's TerrainLoader, for deck.gl's TerrainLayer: it keeps heights unchanged, adds no border of zeros,
// and guarantees a max error. Loads images of tiles (terrarium, mapbox or any elevationDecoder) as meshes. It needs no
// ready().
import { ScarpError, decodeTile, ready, simplifySync } from './index.js';
import { show, takeOptions } from './options.js';
import { buildSkirts } from './skirts.js';

const DEFAULTS = {
  bounds: undefined,
  meshMaxError: 10,
  elevationDecoder: { rScaler: 1, gScaler: 0, bScaler: 0, offset: 0 },
  skirtHeight: undefined,
  effort: 'fast',
};

/// Samples lie at their pixels' centres. The mesh extends to the pixels' outer edges, where the next tile begins: the
/// outer samples are moved there to form the border. So neighbours differ by half a pixel.
function attributesOf(mesh, width, height, bounds) {
  const [west, south, east, north] = bounds ?? [0, 0, width, height];
  const {
    positions,
    origin: [x0, y0, z0],
  } = mesh;
  const count = positions.length / 3;
  const placed = new Float32Array(3 * count);
  const uvs = new Float32Array(2 * count);
  for (let v = 0; v < count; ++v) {
    const u = (positions[3 * v] + x0) / (width - 1);
    const down = 1 - (positions[3 * v + 1] + y0) / (height - 1);
    placed.set([west + u * (east - west), north - down * (north - south), positions[3 * v + 2] + z0], 3 * v);
    uvs.set([u, down], 2 * v);
  }
  return { POSITION: { value: placed, size: 3 }, TEXCOORD_0: { value: uvs, size: 2 } };
}

/// The mesh with walls of this height below its edges.
function addSkirts(attributes, triangles, height) {
  const { POSITION, TEXCOORD_0 } = attributes;
  const { tops, indices } = buildSkirts(triangles, POSITION.value.length / 3);
  const below = tops.flatMap(v => [
    POSITION.value[3 * v],
    POSITION.value[3 * v + 1],
    POSITION.value[3 * v + 2] - height,
  ]);
  const uvs = tops.flatMap(v => [TEXCOORD_0.value[2 * v], TEXCOORD_0.value[2 * v + 1]]);
  POSITION.value = Float32Array.from([...POSITION.value, ...below]);
  TEXCOORD_0.value = Float32Array.from([...TEXCOORD_0.value, ...uvs]);
  return indices;
}

/// `image`: { data, width, height } with four bytes a pixel. Needs ready().
export function makeTerrainMesh(image, options = {}) {
  const { bounds, meshMaxError, elevationDecoder, skirtHeight, effort } = {
    ...DEFAULTS,
    ...takeOptions(options, 'terrain'),
  };
  if (image === null || typeof image !== 'object')
    throw new ScarpError('usage', `the image is ${show(image)}; it is { data, width, height }`);
  const { data, width, height } = image;
  const z = decodeTile(data, width, height, elevationDecoder);
  const mesh = simplifySync(z, width, height, { maxError: meshMaxError, effort });
  const attributes = attributesOf(mesh, width, height, bounds);
  const box = [
    [Infinity, Infinity, Infinity],
    [-Infinity, -Infinity, -Infinity],
  ];
  attributes.POSITION.value.forEach((value, k) => {
    box[0][k % 3] = Math.min(box[0][k % 3], value);
    box[1][k % 3] = Math.max(box[1][k % 3], value);
  });
  const indices = skirtHeight ? addSkirts(attributes, mesh.indices, skirtHeight) : Uint32Array.from(mesh.indices);
  return {
    loaderData: { header: {} },
    header: { vertexCount: attributes.POSITION.value.length / 3, boundingBox: box },
    mode: 4,
    indices: { value: indices, size: 1 },
    attributes,
  };
}

/// The pixels of an image, in a page or a worker.
async function decodeImage(bytes) {
  if (typeof createImageBitmap === 'undefined')
    throw new ScarpError(
      'unsupported',
      'there is no decoder of pictures here: decode the tile, and call makeTerrainMesh()',
    );
  const bitmap = await createImageBitmap(new Blob([bytes]), { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  const { width, height } = bitmap;
  const canvas = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  canvas.drawImage(bitmap, 0, 0);
  bitmap.close();
  return canvas.getImageData(0, 0, width, height);
}

export const TerrainLoader = {
  name: 'Terrain',
  id: 'terrain',
  module: 'scarp',
  version: 'latest',
  worker: false,
  extensions: ['png', 'pngraw', 'jpg', 'jpeg', 'gif', 'webp', 'bmp'],
  mimeTypes: ['image/png', 'image/jpeg', 'image/gif', 'image/webp', 'image/bmp'],
  options: { terrain: DEFAULTS },
  async parse(bytes, options = {}) {
    const [image] = await Promise.all([decodeImage(bytes), ready()]);
    const { tesselator, workerUrl, ...ours } = options.terrain ?? {}; // options of loaders.gl's own loader
    return makeTerrainMesh(image, ours);
  },
};
