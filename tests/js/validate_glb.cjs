// Judges GLB files with the Khronos glTF validator: node validate_glb.cjs FILE…
// One line a file; exit 1 if any has an error or a warning, 77 if the validator is not installed.
const fs = require('fs');
const path = require('path');

let validator;
try {
  validator = require('gltf-validator');
} catch (missing) {
  console.error('gltf-validator is not installed (npm ci in tests/js)');
  process.exit(77);
}

async function main() {
  let bad = 0;
  for (const file of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: path.basename(file) });
    const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
    const { totalVertexCount, totalTriangleCount } = report.info;
    console.log(
      `${path.basename(file)}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ` +
        `${numHints} hints, ${totalVertexCount} vertices, ${totalTriangleCount} triangles`,
    );
    for (const message of messages) console.log(`  ${message.code} ${message.pointer || ''}: ${message.message}`);
    if (numErrors + numWarnings > 0) bad = 1;
  }
  process.exit(bad);
}

main().catch(error => {
  console.error(String(error));
  process.exit(1);
});
