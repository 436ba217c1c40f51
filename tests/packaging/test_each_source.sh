#!/bin/bash
# Each source of the library and the program includes what it needs; batches hide missing includes behind neighbours'
# headers. Runs as long as a build, so it is for `make soak`; tools/check_includes.py finds most missing includes in a
# second. The compiler only checks (-fsyntax-only), in half the time; a second run checks changed files.
set -euo pipefail
folder=$SCARP_BUILD/each_source
touch_target="<CMAKE_COMMAND> -E touch <TARGET>"
cmake -S "$SCARP_SOURCE" -B "$folder" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_UNITY_BUILD=OFF \
  -DCMAKE_CXX_COMPILE_OBJECT="<CMAKE_CXX_COMPILER> <DEFINES> <INCLUDES> <FLAGS> -fsyntax-only <SOURCE> && touch <OBJECT>" \
  -DCMAKE_CXX_ARCHIVE_CREATE="$touch_target" -DCMAKE_CXX_ARCHIVE_FINISH= -DCMAKE_CXX_LINK_EXECUTABLE="$touch_target" >/dev/null
cmake --build "$folder" -j "${JOBS:-2}" --target scarp scarp_program >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
echo "each source compiles alone"
