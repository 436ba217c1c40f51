#!/bin/bash
# Makes a folder with a globe of terrain tiles and a page that shows it: tools/globe.sh SCARP RASTER FOLDER [OPTIONS]
# OPTIONS are those of scarp tile. Needs npm once, for CesiumJS.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
scarp=$1 raster=$2 folder=$3
shift 3
mkdir -p "$folder"
"$scarp" tile "$raster" "$folder/tiles" --overwrite "$@"
if [ ! -e "$folder/cesium/Cesium.js" ]; then
  modules=${CESIUM_MODULES:-}
  if [ -z "$modules" ]; then
    command -v npm > /dev/null || { echo "The page needs CesiumJS, which npm fetches: install npm, then run this again" >&2; exit 1; }
    modules=$folder/npm
    mkdir -p "$modules"
    cp "$here/globe/package.json" "$here/globe/package-lock.json" "$modules/"
    (cd "$modules" && npm ci --no-audit --no-fund --silent)
    modules=$modules/node_modules
  fi
  rm -rf "$folder/cesium"
  cp -r "$modules/cesium/Build/Cesium" "$folder/cesium"
  rm -rf "$folder/npm"
fi
cp "$here/globe/index.html" "$folder/index.html"
