#!/usr/bin/env bash
# scarp tile --grid: the same laws on another grid than the geographic one.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalwarp
reader=$SCARP_SOURCE/tests/program/tiles.py
sets=$SCARP_SOURCE/tests/program/tile_sets.py
client=$SCARP_SOURCE/tests/program/serve_raster.py
breaker=$SCARP_SOURCE/tests/program/break_tiles.py

succeeds "$scarp" tile "$dem" web --grid mercator --vertical egm96 --report r.json -j 1
[ "$(json web/layer.json projection)" = '"EPSG:3857"' ] || fail "layer.json does not name Web Mercator"
# The cells have the size of level 11's on the geographic grid.
[ "$(json web/layer.json maxzoom)" = 12 ] || fail "3 seconds of arc are level 12"
read -r tiles edges low high < <(python3 "$reader" web)
holds "$tiles > 50 && $edges > 70 && $low == 0 && $high > 1030 && $high < 1055"
for z in 12 11 10 9 8 7; do
  holds "$(json r.json levels $z node_error) <= $(json r.json levels $z asked)"
  holds "$(json r.json levels $z tiles_over) == 0"
done

# Every node, at places computed by the check itself: promised errors are exact to the digit.
succeeds "$scarp" tile check web --source "$dem" --vertical egm96 --json
cp "$logs/out" check.json
for z in 12 11 10 9 8 7; do
  holds "$(json check.json levels $z node_error) <= $(json r.json levels $z node_error) * 1.000000001"
  holds "$(json check.json levels $z node_error) >= $(json r.json levels $z node_error) * 0.999999"
done
holds "$(json check.json edges) > 50 && $(json check.json edges_apart) == 0"

# Containers, shares and threads give the same set.
make() { succeeds "$scarp" tile "$dem" "$1" --grid mercator --vertical egm96 --zoom 9 -q "${@:2}"; }
make few -j 1
files=$(find few -type f | wc -l)
for ending in pmtiles mbtiles 3tz; do
  make few.$ending -j 3
  [ "$(python3 "$sets" few few.$ending)" = "$files" ] || fail "few.$ending is not the folder"
  succeeds "$scarp" tile check few.$ending -q
done
if npm_judges pmtiles; then
  succeeds node "$js/compare_pmtiles.mjs" few.pmtiles few
  [ "$(cat "$logs/out")" = $((files - 1)) ] || fail "the reference reader finds other tiles"
fi
succeeds "$scarp" tile plan "$dem" few.json --grid mercator --vertical egm96 --zoom 9 -q
[ "$(json few.json pyramid grid kind)" = '"mercator"' ] || fail "the plan does not name its grid"
for shard in 2/2 1/2; do succeeds "$scarp" tile run few.json --shard $shard -q; done
succeeds "$scarp" tile finish few.json joined -q
diff -r few joined || fail "shares make another set"
succeeds "$scarp" tile check joined --source few.json -q

# Tiles made on demand.
"$scarp" serve few.json --port 0 > served &
server=$!
trap 'kill $server 2> /dev/null || true; rm -rf "$root"' EXIT
await $server names_port served
succeeds python3 "$client" "$port" few
kill -INT $server
wait $server

# A raster on the grid's own map; across the antimeridian; up to the end of the grid.
succeeds gdalwarp -q -t_srs EPSG:3857 -r bilinear -dstnodata -9999 -ot Float32 "$dem" map.tif
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr 179.9 10.2 180.24 9.9 "$dem" date.tif
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr 12 85.3 12.4 84.9 "$dem" north.tif
for raster in map date north; do
  succeeds "$scarp" tile $raster.tif $raster --grid mercator --vertical ellipsoid --zoom 10 -q
  python3 "$reader" $raster > /dev/null || fail "$raster"
  succeeds "$scarp" tile check $raster --source $raster.tif --vertical ellipsoid -q
done

# Planted faults.
# finds KIND SET [OPTIONS]
finds() {
  local kind=$1
  shift
  try "$scarp" tile check "$@"
  [ "$code" = 3 ] || fail "exit code $code instead of 3: check $*"
  grep -q "^  fault of $kind: " "$logs/out" || fail "no fault of $kind: check $* says $(cat "$logs/out")"
}
tile=$(cd web && ls -S 12/*/*.terrain | head -1)
cp -r web broken && python3 "$breaker" heights "broken/$tile"
finds border broken
finds bound broken --source "$dem" --vertical egm96
rm -r broken && cp -r web broken && sed -i 's/EPSG:3857/EPSG:4326/' broken/layer.json
finds header broken
# An option replaces missing data of layer.json.
sed -i '/"projection"/d' broken/layer.json
finds header broken
succeeds "$scarp" tile check broken --grid mercator -q

# A user's mistakes.
refuses 1 "--grid" "$scarp" tile "$dem" no --vertical egm96 --grid utm
refuses 1 "--of 3dtiles cannot be combined with --grid mercator" "$scarp" tile "$dem" no --of 3dtiles --vertical egm96 --grid mercator
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr 12 88.3 12.4 87.9 "$dem" pole.tif
refuses 1 "ends at 85.0511" "$scarp" tile pole.tif no --grid mercator
