#!/usr/bin/env bash
# scarp tile: a folder of quantized-mesh tiles with matching neighbours.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalwarp
reader=$SCARP_SOURCE/tests/program/tiles.py

# Heights above an unknown zero are not heights on a globe.
refuses 1 "--vertical egm96" "$scarp" tile "$dem" globe

succeeds "$scarp" tile "$dem" globe --vertical egm96 --report r.json -j 1
grep -q "EGM96 height" "$logs/out" || fail "the summary does not tell the datum"
[ "$(json globe/layer.json maxzoom)" = 11 ] || fail "3 seconds of arc are level 11"
read -r tiles edges low high < <(python3 "$reader" globe)
holds "$tiles > 50 && $edges > 70"
# In ellipsoidal heights the land lies 31 to 33 m lower; around it is the ellipsoid's surface.
holds "$low == 0 && $high > 1030 && $high < 1055"
[ "$(find globe -name '*.terrain' | wc -l)" = "$tiles" ] || fail "files and tiles differ"
# Each level's promise equals the one in layer.json.
for z in 11 10 9 8 7 6; do
  holds "$(json r.json levels $z node_error) <= $(json r.json levels $z asked)"
  holds "$(json r.json levels $z bound) == $(json globe/layer.json scarp levels $z bound)"
  # Separately, the distance of the raster's own samples from the mesh.
  holds "$(json r.json levels $z node_error) / 2 < $(json r.json levels $z source_error)"
  holds "$(json r.json levels $z source_error) == $(json globe/layer.json scarp levels $z source_error)"
done
[ -z "$(find . -name '.scarp*')" ] || fail "something temporary is left"

# Any number of threads gives the same bytes.
succeeds "$scarp" tile "$dem" again --vertical egm96 -j 3 -q
diff -r globe again || fail "3 threads make other tiles"

# Also bound at the raster's samples: brute force in other code finds at most the requested error.
succeeds "$scarp" tile "$dem" bound --vertical egm96 --bound samples --report b.json -j 1
python3 "$reader" bound > /dev/null
[ "$(json bound/layer.json maxzoom)" = 11 ] || fail "denser nodes move the finest level"
succeeds "$scarp" tile check bound --source "$dem" --vertical egm96
broken=0
for z in 11 10 9 8 7 6; do
  holds "$(json b.json levels $z node_error) <= $(json b.json levels $z asked)"
  holds "$(json b.json levels $z source_error) <= $(json b.json levels $z asked)"
  holds "$(json b.json levels $z tiles_over) == 0"
  ! awk "BEGIN { exit !($(json r.json levels $z source_error) > $(json r.json levels $z asked)) }" || broken=$((broken + 1))
done
[ $broken -gt 0 ] || fail "samples are bound without asking for it: the test shows nothing"

# If bounds are violated, the warning distinguishes nodes and samples, with a remedy for each.
succeeds "$scarp" tile "$dem" rough --vertical egm96 --bound samples --zoom 7 -e 20 --effort fast --report rough.json
grep -q "tiles\? of the levels .*: level 7 has .* m at nodes and .* m at samples where 20 m were asked. Nodes .* give a larger --zoom" "$logs/err" ||
  fail "no word of samples"
holds "$(json rough.json levels 7 node_error) <= 20 && $(json rough.json levels 7 source_error) > 20"
holds "$(json rough.json levels 7 tiles_over) > 0"

# A byte limit makes interiors coarser. Edges do not change, bounds are true, and tiles that exceed the limit are
# counted.
limit=2500
succeeds "$scarp" tile "$dem" small --vertical egm96 --max-tile-bytes $limit --report small.json -j 1
grep -q -- "--max-tile-bytes $limit" "$logs/err" || fail "no warning counts the tiles"
python3 "$reader" small > /dev/null
holds "$(find small -name '*.terrain' -size +${limit}c | wc -l) == $(python3 -c '
import json
print(sum(level["tiles_oversized"] for level in json.load(open("small.json"))["levels"]))')"
holds "$(json small.json levels 11 tiles_coarser) > 10 && $(json r.json levels 11 tiles_coarser) == 0"
holds "$(json small.json levels 11 tiles_coarser) == $(json small/layer.json scarp levels 11 tiles_coarser)"
holds "$(json small.json levels 11 node_error) > $(json small.json levels 11 asked)"
[ "$(json small.json levels 11 tiles_over)" = 0 ] || fail "coarser tiles count as cliffs"
succeeds "$scarp" tile check small --source "$dem" --vertical egm96
succeeds "$scarp" tile plan "$dem" plan.json --vertical egm96 --max-tile-bytes $limit -q
for shard in 2/3 3/3 1/3; do succeeds "$scarp" tile run plan.json --shard $shard -j 2 -q; done
succeeds "$scarp" tile finish plan.json small_parts
grep -q -- "--max-tile-bytes $limit" "$logs/err" || fail "no warning counts the tiles of parts"
diff -r small small_parts || fail "shares make other tiles"
succeeds "$scarp" tile "$dem" least --vertical egm96 --zoom 9 --max-tile-bytes 1 --report least.json
grep -q "what neighbours share alone takes more" "$logs/err" || fail "no warning of tiles that are too large"
[ "$(json least.json levels 9 tiles_oversized)" = "$(json least.json levels 9 tiles)" ] || fail "not all tiles are counted"
refuses 1 "holds no tile" "$scarp" tile "$dem" no --vertical egm96 --max-tile-bytes 0
refuses 1 "--max-tile-bytes" "$scarp" tile "$dem" no --vertical egm96 --max-tile-bytes x

# Existing files are kept.
refuses 4 "--overwrite" "$scarp" tile "$dem" globe --vertical egm96
mkdir other && touch other/mine
refuses 4 "no set of tiles" "$scarp" tile "$dem" other --vertical egm96 --overwrite
succeeds "$scarp" tile "$dem" globe/ --vertical ellipsoid --zoom 9 --overwrite -q
[ "$(json globe/layer.json maxzoom)" = 9 ] || fail "not replaced"
[ ! -e globe/10 ] || fail "old tiles are left"
read -r tiles edges low high < <(python3 "$reader" globe)
holds "$high > 1060"

# A raster in UTM with an outline slanted in degrees; efforts.
succeeds gdalwarp -q -t_srs EPSG:32616 -r bilinear -dstnodata -9999 -ot Float32 "$dem" utm.tif
for effort in fast high; do
  succeeds "$scarp" tile utm.tif "utm_$effort" --vertical ellipsoid --effort $effort --zoom 10 --report $effort.json -q
  python3 "$reader" "utm_$effort" > /dev/null || fail "utm, $effort"
  holds "$(json $effort.json levels 10 node_error) <= $(json $effort.json levels 10 asked)"
done
holds "$(json high.json levels 10 triangles) < 0.6 * $(json fast.json levels 10 triangles)"

# Around the antimeridian and a pole.
for place in "179.9 10.2 180.24 9.9" "-180.1 -70.1 -179.77 -70.4" "359.8 50.2 360.14 49.9" "12 90 12.34 89.71"; do
  succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr $place "$dem" placed.tif
  succeeds "$scarp" tile placed.tif placed --overwrite -q
  python3 "$reader" placed > /dev/null || fail "at $place"
done

# An impossible place.
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr 1000 45.2 1000.3 44.9 "$dem" placed.tif
refuses 2 "placed.tif: its CRS, EPSG:4326, has the unit degree, but its middle lies at 1000.15" "$scarp" tile placed.tif no
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr 10 95.2 10.3 94.9 "$dem" placed.tif
refuses 2 "placed.tif: no part of the raster lies on the globe" "$scarp" tile placed.tif no

# A user's mistakes.
refuses 1 "--zoom" "$scarp" tile "$dem" no --vertical egm96 --zoom x
refuses 1 "--zoom 24 is above 23" "$scarp" tile "$dem" no --vertical egm96 --zoom 24
refuses 1 "above 0" "$scarp" tile "$dem" no --vertical egm96 -e 0
refuses 1 "cells" "$scarp" tile "$dem" no --vertical egm96 --cells 100
refuses 1 "quality" "$scarp" tile "$dem" no --vertical egm96 --quality 0.1
refuses 1 "quantized-mesh holds" "$scarp" tile "$dem" no --vertical egm96 -e 0.01
refuses 2 "no such file" "$scarp" tile missing.tif no
refuses 4 "no folder can be made" "$scarp" tile "$dem" missing/no --vertical egm96
printf "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 5 6\n7 8 9\n" > bare.asc
refuses 2 "where on the globe" "$scarp" tile bare.asc no --grid geographic

# Foreign files are not deleted.
touch globe/mine
refuses 4 "globe/mine is not Scarp's" "$scarp" tile "$dem" globe --vertical egm96 --overwrite
mkdir theirs && echo '{"format":"quantized-mesh-1.0"}' > theirs/layer.json
refuses 4 "is not Scarp's" "$scarp" tile "$dem" theirs --vertical egm96 --overwrite

# Beyond 180 degrees a projection cannot be inverted; a raster there has no place.
succeeds gdal_translate -q -a_srs EPSG:3857 -a_ullr 20000000 2000000 20400000 1600000 "$dem" beyond.tif
refuses 2 "beyond 180 degrees" "$scarp" tile beyond.tif no --vertical ellipsoid
succeeds gdal_translate -q -a_srs EPSG:4326 -a_ullr 10.01 50.02 10.06 49.97 -outsize 60 60 "$dem" small.tif
refuses 1 "larger --zoom" "$scarp" tile small.tif no --vertical ellipsoid --zoom 3

# Fine rasters of high land have the least error of the format, above an ellipsoid far below.
succeeds gdal_translate -q -ot Float32 -a_srs EPSG:32616 -a_ullr 500000 4000060 500060 4000000 -outsize 60 60 -scale 236 1076 2400 2430 "$dem" lidar.tif
succeeds "$scarp" tile lidar.tif lidar --vertical ellipsoid -q
python3 "$reader" lidar > /dev/null || fail "lidar"
