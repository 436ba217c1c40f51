#!/usr/bin/env bash
# scarp tile check: good sets pass, and each fault planted in a copy is found with the name of its tile.
source "$(dirname "$0")/lib.sh"
need python3 gdalwarp gdal_translate
breaker=$SCARP_SOURCE/tests/program/break_tiles.py

# finds KIND WORDS SET [OPTIONS]: exit code 3, a fault of the kind in the table, and the words in its message.
finds() {
  local kind=$1 words=$2
  shift 2
  try "$scarp" tile check "$@"
  [ "$code" = 3 ] || fail "exit code $code instead of 3: check $*"
  grep "^  fault of $kind: " "$logs/out" | grep -qF -- "$words" || fail "no fault of $kind with '$words': check $* says $(cat "$logs/out")"
  [ "$(wc -l < "$logs/err")" = 1 ] || fail "not one line on stderr: check $*"
}

succeeds "$scarp" tile "$dem" globe --vertical egm96 --report r.json -q
succeeds "$scarp" tile check globe
grep -q "faults     none" "$logs/out" || fail "a good set has faults"
# With all nodes: promised errors equal those found, below the blocks to the digit.
succeeds "$scarp" tile check globe --source "$dem" --vertical egm96 --json -j 1
cp "$logs/out" one.json
for z in 11 10 9 8 7 6; do
  holds "$(json one.json levels $z node_error) <= $(json r.json levels $z node_error) * 1.000000001"
  holds "$(json one.json levels $z node_error) >= $(json r.json levels $z node_error) * 0.999999"
  holds "$(json one.json levels $z distance) <= $(json r.json levels $z bound)"
done
holds "$(json one.json edges) > 50 && $(json one.json corners) > 20 && $(json one.json edges_apart) == 0"
# Any number of threads gives the same bytes.
succeeds "$scarp" tile check globe --source "$dem" --vertical egm96 --json -j 3
diff <(grep -v '"seconds"\|"command"' one.json) <(grep -v '"seconds"\|"command"' "$logs/out") || fail "3 threads find otherwise"
# Checks with a plan, which defines the nodes; and checks of 3D Tiles in a container.
succeeds "$scarp" tile plan "$dem" world.json --vertical egm96 -q
succeeds "$scarp" tile check globe --source world.json -q
succeeds "$scarp" tile "$dem" globe.3tz --of 3dtiles --vertical egm96 -q
succeeds "$scarp" tile check globe.3tz --source "$dem" --vertical egm96

# Faults of an inner tile.
tile=$(cd globe && ls -S 11/*/*.terrain | head -1)
broken() { rm -rf broken && cp -r globe broken && python3 "$breaker" "$1" "broken/$tile"; }
broken heights && finds border "$tile" broken
finds bound "$tile" broken --source "$dem" --vertical egm96
broken normals && finds border "$tile" broken
broken sphere && finds header "$tile" broken
broken horizon && finds horizon "$tile" broken
broken cut && finds file "$tile" broken
broken unzip && finds container "$tile" broken
rm "broken/$tile" && finds availability "$tile is announced, but missing" broken
rm -r broken && cp -r globe broken && mkdir -p broken/8/3 && cp "globe/$tile" broken/8/3/5.terrain
finds availability "8/3/5.terrain is there" broken
rm -r broken && cp -r globe broken && rm broken/layer.json && finds availability "layer.json is missing" broken
# Clients find no tile by a layer.json without their addresses or with another scheme.
layer() { rm -r broken && cp -r globe broken && sed -i "$1" broken/layer.json; }
layer 's/"tiles"/"tales"/' && finds availability "layer.json does not name its files" broken
layer 's/{x}.{y}/{y}\/{x}/' && finds availability "layer.json does not name its files" broken
layer 's/"schema"/"scheme"/; s/"tms"/"xyz"/' && finds availability "layer.json names another scheme" broken
# Another source than the set's.
finds bound ".terrain is" globe --source "$dem" --vertical ellipsoid

# Faults of tileset.json, of a globe and of a plane on it.
succeeds "$scarp" tile "$dem" ball --of 3dtiles --vertical egm96 --zoom 9 --effort fast -q
succeeds gdalwarp -q -t_srs EPSG:32616 -r bilinear "$dem" utm.tif
succeeds "$scarp" tile utm.tif city --grid local --vertical egm96 --effort fast -q
succeeds "$scarp" tile check ball --source "$dem" --vertical egm96 -q
succeeds "$scarp" tile check city --source utm.tif --vertical egm96 -q
# `told SET CHANGE WORDS [OPTION...]`: `root` is the first tile, `first` the first of implicit tiles, `own` Scarp's
# additions.
told() {
  local set=$1 change=$2 words=$3
  shift 3
  rm -rf broken && cp -r "$set" broken
  python3 - "$change" << 'E'
import json
import sys
tileset = json.load(open("broken/tileset.json"))
root, own = tileset["root"], tileset["asset"]["extras"]["scarp"]
first = root["children"][0] if "children" in root else root
volume = first["boundingVolume"]
exec(sys.argv[1])
json.dump(tileset, open("broken/tileset.json", "w"))
E
  finds tileset "$words" broken "$@"
}
told ball 'volume["region"][2] += 0.1' "the boundingVolume of root 0 goes from"
told ball 'volume["region"][5] = 10' "to 10 m high, and tiles are"
told ball 'del first["boundingVolume"]' "no boundingVolume"
told ball 'root["refine"] = "ADD"' 'refined by "ADD"'
told ball 'first["transform"] = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]' "a root has a transform"
told ball 'root["children"][1]["geometricError"] /= 100' "of root 1 clients take"
told ball 'root["geometricError"] = 1' "more than the 1 m of what is above it"
told ball 'del tileset["geometricError"]' "no geometricError"
told ball 'first["implicitTiling"]["availableLevels"] -= 1' "root 0 has 9 availableLevels, and the set has 10 levels"
told ball 'del root["children"][1]' "it has 1 roots of implicit tiles, and its grid has 2"
told city 'volume["box"][0] += 30' "the boundingVolume of root 0 goes from"
told city 'volume["box"][4] = 1' "the box of the root is turned"
told city 'root["transform"][10] *= 2' "its transform is no turn and move"
told city 'root["transform"][12] += 1' "its transform puts the raster's centre 0." --source utm.tif --vertical egm96
told city 'own["off_globe"]["height"] /= 2' "are told (off_globe)" --source utm.tif --vertical egm96
told city 'del root["transform"]' "has no transform, and its source has a place" --source utm.tif --vertical egm96
rm -rf broken && cp -r ball broken
sed -i 's/"subtreeLevels": 5/"subtreeLevels": 4/' broken/tileset.json
finds availability "is not of 4 levels (subtreeLevels)" broken
# The same samples elsewhere, and heights above another datum.
succeeds gdal_translate -q -a_srs EPSG:32617 utm.tif elsewhere.tif
finds tileset "from where the source has it" city --source elsewhere.tif --vertical egm96
finds tileset "m in height from where the source has it" city --source utm.tif --vertical ellipsoid

# Faults of containers.
for ending in pmtiles mbtiles; do
  succeeds "$scarp" tile "$dem" good.$ending --vertical egm96 -q
  succeeds "$scarp" tile check good.$ending -q
done
changed() { cp "$2" "broken.$3" && python3 "$breaker" "$1" "broken.$3"; }
changed count_of_pmtiles good.pmtiles pmtiles && finds container "broken.pmtiles: its header says" broken.pmtiles
changed swap_in_pmtiles good.pmtiles pmtiles && finds header "11/" broken.pmtiles
changed zoom_of_mbtiles good.mbtiles mbtiles && finds container "maxzoom" broken.mbtiles
changed row_of_mbtiles good.mbtiles mbtiles && finds availability "is announced, but missing" broken.mbtiles
changed index_of_3tz globe.3tz 3tz && finds container "its index, by which clients find tiles" broken.3tz
changed directory_of_pmtiles good.pmtiles pmtiles && refuses 2 "broken.pmtiles is damaged" "$scarp" tile check broken.pmtiles

# A user's mistakes.
refuses 2 "no such file or folder" "$scarp" tile check missing
refuses 2 "no set of tiles" "$scarp" tile check "$dem"
refuses 1 "--vertical is for the raster of --source" "$scarp" tile check globe --vertical egm96
refuses 1 "world.json has decided it" "$scarp" tile check globe --source world.json --vertical egm96
# The set stores the zero of its heights in each container; an option that names another overrides it and finds faults
# (above).
succeeds "$scarp" tile check globe --source "$dem" -q
succeeds "$scarp" tile check ball --source "$dem" -q
succeeds "$scarp" tile check globe.3tz --source "$dem" -q
refuses 2 "no such file" "$scarp" tile check globe --source missing.tif
