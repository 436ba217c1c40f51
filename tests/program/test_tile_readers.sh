#!/usr/bin/env bash
# Foreign decoders read the same numbers from our quantized-mesh tiles as ours, and validators accept our 3D Tiles.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate
npm_judges @here/quantized-mesh-decoder @loaders.gl/terrain || skip "npm could not fetch the readers"

# Steep land, and a raster around the antimeridian.
succeeds "$scarp" tile "$dem" land --vertical egm96 -q
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr 179.9 10.2 180.24 9.9 "$dem" placed.tif
succeeds "$scarp" tile placed.tif seam -q
# With water masks of one byte and of 65536.
printf '{"type":"Polygon","coordinates":[[[180.0,10.13],[180.17,10.15],[180.19,10.02],[180.02,9.99],[180.0,10.13]]]}' > lake.geojson
succeeds "$scarp" tile placed.tif wet --water lake.geojson --watermask -q
for set in land seam wet; do
  succeeds node "$js/read_quantized_mesh.mjs" "$set" theirs
  [ "$(cat "$logs/out")" = "$(find "$set" -name '*.terrain' | wc -l)" ] || fail "not all tiles were read"
  "$SCARP_BUILD/bin/scarp_decode_tiles" "$set" > ours
  cmp ours theirs || fail "$set: @here/quantized-mesh-decoder reads other numbers than the library"
done

# The GLBs of 3D Tiles, unpacked by meshoptimizer's own decoder: neighbours have the same positions and normals.
npm_judges meshoptimizer
succeeds "$scarp" tile "$dem" land3 --vertical egm96 --of 3dtiles -q
succeeds "$scarp" tile placed.tif seam3 --of 3dtiles -q
for set in land3 seam3; do
  succeeds node "$js/read_tile_glbs.mjs" "$set"
  read -r tiles edges < "$logs/out"
  [ "$tiles" = "$(find "$set" -name '*.glb' | wc -l)" ] && holds "$edges > $tiles" || fail "not all tiles were read"
done

# The 3D Tiles validator, if installed: not every registry has it.
if command -v 3d-tiles-validator > /dev/null; then
  try 3d-tiles-validator --tilesetFile land3/tileset.json --reportFile verdict.json
  [ "$(json verdict.json numErrors) $(json verdict.json numWarnings)" = "0 0" ] || fail "the 3D Tiles validator has objections"
else
  echo "left out: 3d-tiles-validator"
fi
