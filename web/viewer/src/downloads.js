// The displayed mesh as the program writes it: GLB and OBJ y up, STL z up; x and y are offsets from `origin`, heights
// are absolute.

function originOf({ field, place }) {
  return field ? field.toPlace(field.cols >> 1, field.rows >> 1) : place.center.map(Math.round);
}

/** Interleaved x, y, z: offsets in float32. */
function offsets(terrain, [ox, oy]) {
  const from = [ox, oy, 0];
  return Float32Array.from(terrain.positions, (value, k) => value - from[k % 3]);
}

/** The metadata of the program's files. */
function extrasOf({ extras, goal, judged, told }) {
  const error =
    judged && !told
      ? {
          ...(goal?.maxError === undefined ? {} : { asked: goal.maxError }),
          max_error: judged.maxError,
          rmse: judged.rmse,
          samples: judged.covered,
        }
      : told;
  const { command, error: _, ...rest } = extras;
  return { ...rest, ...(command && told ? { command } : {}), ...(error ? { error } : {}), generator: 'Scarp viewer' };
}

function encodeGlb(terrain) {
  const [ox, oy] = originOf(terrain);
  const xyz = offsets(terrain, [ox, oy]);
  const positions = new Float32Array(xyz.length);
  for (let v = 0; v < xyz.length; v += 3) positions.set([xyz[v], xyz[v + 2], 0 - xyz[v + 1]], v);
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, k) => {
    low[k % 3] = Math.min(low[k % 3], value);
    high[k % 3] = Math.max(high[k % 3], value);
  });
  const json = {
    asset: { version: '2.0', generator: 'Scarp viewer', extras: extrasOf(terrain) },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ name: 'terrain', mesh: 0, translation: [ox, 0, 0 - oy] }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: xyz.length / 3, type: 'VEC3', min: low, max: high },
      { bufferView: 1, componentType: 5125, count: terrain.indices.length, type: 'SCALAR' },
    ],
    bufferViews: [
      { buffer: 0, byteLength: positions.byteLength, target: 34962 },
      { buffer: 0, byteOffset: positions.byteLength, byteLength: terrain.indices.byteLength, target: 34963 },
    ],
    buffers: [{ byteLength: positions.byteLength + terrain.indices.byteLength }],
  };
  const text = new TextEncoder().encode(JSON.stringify(json));
  const space = (4 - (text.length % 4)) % 4;
  const length = text.length + space;
  const binary = json.buffers[0].byteLength;
  return [
    Uint32Array.of(0x46546c67, 2, 28 + length + binary, length, 0x4e4f534a),
    text,
    ' '.repeat(space),
    Uint32Array.of(binary, 0x004e4942),
    positions,
    terrain.indices,
  ];
}

function encodeStl(terrain) {
  const origin = originOf(terrain).slice(0, 2);
  const xyz = offsets(terrain, origin);
  const bytes = new DataView(new ArrayBuffer(84 + 50 * terrain.triangles));
  new TextEncoder().encodeInto(`scarp origin ${origin.join(' ')} 0`, new Uint8Array(bytes.buffer, 0, 80));
  bytes.setUint32(80, terrain.triangles, true);
  terrain.indices.forEach((v, k) => {
    for (let c = 0; c < 3; ++c)
      bytes.setFloat32(84 + 50 * Math.floor(k / 3) + 12 + 12 * (k % 3) + 4 * c, xyz[3 * v + c], true);
  });
  return [bytes.buffer];
}

/** Escapes text for a comment as the program does: characters that could end the line become their numbers. */
const comment = value =>
  (typeof value === 'string' ? value : JSON.stringify(value)).replace(
    /[%\p{Cc}]/gu,
    letter => `%${letter.charCodeAt(0).toString(16).padStart(2, '0').toUpperCase()}`,
  );

function encodeObj(terrain) {
  const [ox, oy] = originOf(terrain);
  const { positions } = terrain;
  const sorted = Object.entries({ ...extrasOf(terrain), up: 'y' }).sort(([a], [b]) => (a < b ? -1 : 1));
  const lines = [
    '# Terrain by Scarp. Right-handed, x east, y up, z south; faces counter-clockwise from above.',
    `# scarp.counts: ${positions.length / 3} ${terrain.triangles}`,
  ];
  if (ox || oy) lines.push(`# scarp.origin: ${ox} 0 ${0 - oy}`);
  for (const [key, value] of sorted) lines.push(`# scarp ${key}: ${comment(value)}`);
  lines.push('o terrain');
  for (let v = 0; v < positions.length; v += 3)
    lines.push(`v ${positions[v]} ${positions[v + 2]} ${0 - positions[v + 1]}`);
  for (let t = 0; t < terrain.indices.length; t += 3)
    lines.push(`f ${terrain.indices[t] + 1} ${terrain.indices[t + 1] + 1} ${terrain.indices[t + 2] + 1}`);
  return [lines.join('\n') + '\n# scarp.end\n'];
}

const ENCODERS = { glb: encodeGlb, stl: encodeStl, obj: encodeObj };

export function save(parts, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob(parts));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

export function saveMesh(terrain, name, format) {
  save(ENCODERS[format](terrain), `${name.replace(/\.[^.]*$/, '')}.${format}`);
}
