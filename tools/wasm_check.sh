#!/bin/bash
# Compiles the core with Emscripten, and compares the meshes that it makes under node with those of a native build.
#
# Environment: BUILD (build), JOBS (cores).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build}
jobs=${JOBS:-$(nproc 2>/dev/null || echo 2)}
toolchain=/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake
options=(-DCMAKE_BUILD_TYPE=Release -DSCARP_CORE_ONLY=ON -DSCARP_WITH_MESHOPTIMIZER=OFF)
tools/configure.sh "$build-core" "${options[@]}"
cmake --build "$build-core" -j "$jobs" --target scarp_core_check
tools/configure.sh "$build-wasm" -DCMAKE_TOOLCHAIN_FILE=$toolchain "${options[@]}"
cmake --build "$build-wasm" -j "$jobs" --target scarp_core_check
native=$("$build-core/bin/scarp_core_check")
wasm=$(node --experimental-wasm-eh "$build-wasm/bin/scarp_core_check.js" 2>/dev/null || node "$build-wasm/bin/scarp_core_check.js")
printf 'effort, triangles, hash of the mesh (native = WebAssembly)\n%s\n' "$native"
[ "$native" = "$wasm" ] || { printf 'WebAssembly makes others:\n%s\n' "$wasm"; exit 1; }
