// The mesh that is shown, as a file: GLB (y up), STL and OBJ (z up, y up), float32 around its centre.

function offsets(terrain) {
  const { center } = terrain.place;
  return Float32Array.from(terrain.positions, (value, k) => value - center[k % 3]);
}

function encode_glb(terrain) {
  const xyz = offsets(terrain), positions = new Float32Array(xyz.length), [cx, cy, cz] = terrain.place.center;
  for (let v = 0; v < xyz.length; v += 3) positions.set([xyz[v], xyz[v + 2], -xyz[v + 1]], v);
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, k) => {
    low[k % 3] = Math.min(low[k % 3], value);
    high[k % 3] = Math.max(high[k % 3], value);
  });
  const json = { asset: { version: '2.0', generator: 'Scarp viewer', extras: { origin: [cx, cy, cz] } }, scene: 0, scenes: [{ nodes: [0] }],
    nodes: [{ name: 'terrain', mesh: 0, translation: [cx, cz, -cy] }], meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: xyz.length / 3, type: 'VEC3', min: low, max: high },
      { bufferView: 1, componentType: 5125, count: terrain.indices.length, type: 'SCALAR' }],
    bufferViews: [{ buffer: 0, byteLength: positions.byteLength, target: 34962 },
      { buffer: 0, byteOffset: positions.byteLength, byteLength: terrain.indices.byteLength, target: 34963 }],
    buffers: [{ byteLength: positions.byteLength + terrain.indices.byteLength }] };
  let text = JSON.stringify(json);
  text += ' '.repeat((4 - text.length % 4) % 4);
  const binary = json.buffers[0].byteLength;
  return [Uint32Array.of(0x46546c67, 2, 28 + text.length + binary, text.length, 0x4e4f534a), text, Uint32Array.of(binary, 0x004e4942), positions, terrain.indices];
}

function encode_stl(terrain) {
  const xyz = offsets(terrain), bytes = new DataView(new ArrayBuffer(84 + 50 * terrain.triangles));
  bytes.setUint32(80, terrain.triangles, true);
  terrain.indices.forEach((v, k) => {
    for (let c = 0; c < 3; ++c) bytes.setFloat32(84 + 50 * Math.floor(k / 3) + 12 + 12 * (k % 3) + 4 * c, xyz[3 * v + c], true);
  });
  return [bytes.buffer];
}

function encode_obj(terrain) {
  const xyz = offsets(terrain), lines = [];
  for (let v = 0; v < xyz.length; v += 3) lines.push(`v ${xyz[v]} ${xyz[v + 2]} ${-xyz[v + 1]}`);
  for (let t = 0; t < terrain.indices.length; t += 3) lines.push(`f ${terrain.indices[t] + 1} ${terrain.indices[t + 1] + 1} ${terrain.indices[t + 2] + 1}`);
  return [lines.join('\n') + '\n'];
}

const ENCODERS = { glb: encode_glb, stl: encode_stl, obj: encode_obj };

export function save(parts, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob(parts));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

export function save_mesh(terrain, name, format) {
  save(ENCODERS[format](terrain), `${name.replace(/\.[^.]*$/, '')}.${format}`);
}
