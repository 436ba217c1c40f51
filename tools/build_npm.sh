#!/bin/bash
# Builds and packs the npm package: tools/build_npm.sh BUILD DIST. BUILD: the build folder of Emscripten. Prints the
# file's path.
#
# Environment: JOBS (cores).
set -euo pipefail
build=$1 dist=$2
# Avoids the Python wrapper of a version manager: em++ starts once a source.
export EMSDK_PYTHON=${EMSDK_PYTHON:-$(command -pv python3 || command -v python3)}
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/tools/configure_wasm.sh" "$build" >&2
cmake --build "$build" -j "${JOBS:-$(nproc 2>/dev/null || echo 2)}" --target scarp_npm >&2
node "$root/bindings/wasm/pack.mjs" "$build" "$dist"
