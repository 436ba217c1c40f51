#!/bin/bash
# Configures a build folder for Emscripten: the core, its check, and the modules of the npm package.
#
# usage: tools/configure_wasm.sh FOLDER
set -euo pipefail
# Modules of batches of 10 are 0.3 % smaller than those of 20.
exec "$(dirname "$0")/configure.sh" "$1" -DCMAKE_BUILD_TYPE=Release -DSCARP_BATCH=10 -DSCARP_CORE_ONLY=ON -DSCARP_WITH_MESHOPTIMIZER=OFF -DSCARP_WITH_LINES=OFF \
  -DCMAKE_TOOLCHAIN_FILE=/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake
