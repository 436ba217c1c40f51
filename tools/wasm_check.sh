#!/bin/bash
# Compiles the core with Emscripten and compares its meshes under node with those of a native build.
#
# Environment: BUILD (build), JOBS (cores).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build}
jobs=${JOBS:-$(nproc 2>/dev/null || echo 2)}
tools/configure.sh "$build-core" -DCMAKE_BUILD_TYPE=Release -DSCARP_CORE_ONLY=ON -DSCARP_WITH_MESHOPTIMIZER=OFF
cmake --build "$build-core" -j "$jobs" --target scarp_core_check
tools/configure_wasm.sh "$build-wasm"
cmake --build "$build-wasm" -j "$jobs" --target scarp_core_check
native=$("$build-core/bin/scarp_core_check")
wasm=$(node --experimental-wasm-eh "$build-wasm/bin/scarp_core_check.js" 2>/dev/null || node "$build-wasm/bin/scarp_core_check.js")
printf 'effort, triangles, hash of the mesh (native = WebAssembly)\n%s\n' "$native"
[ "$native" = "$wasm" ] || { printf 'WebAssembly makes others:\n%s\n' "$wasm"; exit 1; }
