#!/usr/bin/env bash
# scarp tile check: good sets pass, and each fault that is planted in a copy is found, with the name of its tile.
source "$(dirname "$0")/lib.sh"
need python3
breaker=$SCARP_SOURCE/tests/cli/break_tiles.py

# finds KIND WORDS SET [OPTIONS]: exit code 3, a fault of the kind in the table, the words in its sentence.
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
# With all nodes: what is promised of each level is what is found, below the blocks to the digit.
succeeds "$scarp" tile check globe --source "$dem" --vertical egm96 --json -j 1
cp "$logs/out" one.json
for z in 11 10 9 8 7 6; do
  holds "$(json one.json levels $z node_error) <= $(json r.json levels $z node_error) * 1.000000001"
  holds "$(json one.json levels $z node_error) >= $(json r.json levels $z node_error) * 0.999999"
  holds "$(json one.json levels $z distance) <= $(json r.json levels $z bound)"
done
holds "$(json one.json edges) > 50 && $(json one.json corners) > 20 && $(json one.json edges_apart) == 0"
# Threads change nothing.
succeeds "$scarp" tile check globe --source "$dem" --vertical egm96 --json -j 3
diff <(grep -v '"seconds"\|"command"' one.json) <(grep -v '"seconds"\|"command"' "$logs/out") || fail "3 threads find otherwise"
# Of a plan, which says what the nodes are; and of 3D Tiles, in a container.
succeeds "$scarp" tile plan "$dem" world.json --vertical egm96 -q
succeeds "$scarp" tile check globe --source world.json -q
succeeds "$scarp" tile "$dem" globe.3tz --of 3dtiles --vertical egm96 -q
succeeds "$scarp" tile check globe.3tz --source "$dem" --vertical egm96

# Faults of a tile in the middle.
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
# Another source than the set's.
finds bound ".terrain is" globe --source "$dem" --vertical ellipsoid

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
refuses 1 "--vertical egm96" "$scarp" tile check globe --source "$dem"
refuses 2 "no such file" "$scarp" tile check globe --source missing.tif
