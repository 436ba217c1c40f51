#!/usr/bin/env bash
# scarp tile --of 3dtiles: a set that satisfies the rules of 3D Tiles, read by foreign programs.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate
reader=$SCARP_SOURCE/tests/program/tiles3d.py

succeeds "$scarp" tile "$dem" globe --vertical egm96 --of 3dtiles --report r.json -j 1
read -r tiles subtrees low high < <(python3 "$reader" globe)
holds "$tiles > 50 && $subtrees >= 4"
# The land's heights above the ellipsoid lie between the limits of the root's region.
holds "$low < 0 && $high > 1030 && $high < 1200"
[ "$(find globe -name '*.glb' | wc -l)" = "$tiles" ] || fail "files and tiles differ"
# The error given for each level is proven and used by clients. An empty picture of a planet is a large error at any
# distance.
holds "$(json globe/tileset.json geometricError) > 6e6 && $(json globe/tileset.json root geometricError) > 6e6"
root_error=$(json globe/tileset.json root children 0 geometricError)
for z in 11 10 9 8 7 6 5; do
  holds "$(json r.json levels $z node_error) <= $(json r.json levels $z asked)"
  holds "$(json r.json levels $z bound) == $(json globe/tileset.json asset extras scarp levels $z bound)"
  holds "$root_error / 2^$z >= $(json r.json levels $z bound)"
done

# Any number of threads gives the same bytes; existing files are kept.
succeeds "$scarp" tile "$dem" again --vertical egm96 --of 3dtiles -j 3 -q
diff -r globe again || fail "3 threads make other tiles"
refuses 4 "--overwrite" "$scarp" tile "$dem" globe --vertical egm96 --of 3dtiles
succeeds "$scarp" tile "$dem" again --vertical ellipsoid --zoom 8 --of 3dtiles --overwrite -q
[ ! -e again/0/9 ] && [ -e again/0/8 ] || fail "old tiles are left"
refuses 1 "--of" "$scarp" tile "$dem" no --vertical egm96 --of glb

# Around the antimeridian and a pole.
for place in "179.9 10.2 180.24 9.9" "12 90 12.34 89.71"; do
  succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr $place "$dem" placed.tif
  succeeds "$scarp" tile placed.tif placed --of 3dtiles --overwrite -q
  python3 "$reader" placed > /dev/null || fail "at $place"
done

# The Khronos glTF validator on every tile.
if npm_judges gltf-validator; then
  find globe placed -name '*.glb' -exec node "$js/validate_glb.cjs" {} + > judged.txt || { grep -v ": 0 errors" judged.txt | head -20; fail "the glTF validator has objections"; }
  [ "$(grep -c ': 0 errors, 0 warnings' judged.txt)" = "$(find globe placed -name '*.glb' | wc -l)" ] || fail "not every tile was judged"
fi
