#!/bin/bash
# Makes a folder with a globe of terrain tiles and its page: tools/globe.sh SCARP RASTER FOLDER [OPTIONS]. OPTIONS: of
# scarp tile. Needs npm once, for CesiumJS.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
scarp=$1 raster=$2 folder=$3
shift 3
mkdir -p "$folder"
"$scarp" tile "$raster" "$folder/tiles" --overwrite "$@"
if [ ! -e "$folder/cesium/Cesium.js" ]; then
  rm -rf "$folder/cesium" "$folder/package"
  if [ -n "${CESIUM_MODULES:-}" ]; then
    cp -r "$CESIUM_MODULES/cesium/Build/Cesium" "$folder/cesium"
  else
    command -v npm > /dev/null || { echo "The page needs CesiumJS, which npm fetches: install npm, then run this again" >&2; exit 1; }
    (cd "$folder" && npm pack --silent cesium@1.140.0 > /dev/null && tar -xzf cesium-1.140.0.tgz package/Build/Cesium && rm cesium-1.140.0.tgz)
    mv "$folder/package/Build/Cesium" "$folder/cesium"
    rm -r "$folder/package"
  fi
fi
cp "$here/globe/index.html" "$folder/index.html"
