#!/bin/bash
# For `make soak`, since it runs as long as a build. Each source of the library and the program includes what it needs:
# elsewhere sources are compiled in batches, where one lives on the headers of its neighbours until the batches change.
# tools/check_includes.py finds most missing includes in a second. The compiler only checks (-fsyntax-only), half the
# time of compiling; a second run checks files that have changed since.
set -euo pipefail
folder=$SCARP_BUILD/each_source
touch_target="<CMAKE_COMMAND> -E touch <TARGET>"
cmake -S "$SCARP_SOURCE" -B "$folder" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_UNITY_BUILD=OFF \
  -DCMAKE_CXX_COMPILE_OBJECT="<CMAKE_CXX_COMPILER> <DEFINES> <INCLUDES> <FLAGS> -fsyntax-only <SOURCE> && touch <OBJECT>" \
  -DCMAKE_CXX_ARCHIVE_CREATE="$touch_target" -DCMAKE_CXX_ARCHIVE_FINISH= -DCMAKE_CXX_LINK_EXECUTABLE="$touch_target" >/dev/null
cmake --build "$folder" -j "${JOBS:-2}" --target scarp scarp_program >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
echo "each source compiles alone"
