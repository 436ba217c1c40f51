#!/usr/bin/env bash
# scarp tile: the same set in a folder, PMTiles, MBTiles and .3tz, read by foreign readers.
source "$(dirname "$0")/lib.sh"
need python3
reader=$SCARP_SOURCE/tests/program/tile_sets.py

succeeds "$scarp" tile "$dem" globe --vertical egm96 -q -j 1
files=$(find globe -type f | wc -l)
for ending in pmtiles mbtiles 3tz; do
  succeeds "$scarp" tile "$dem" world.$ending --vertical egm96 --report $ending.json -j 1
  grep -q "world.$ending" "$logs/out" || fail "the summary does not name $ending"
  [ "$(python3 "$reader" globe world.$ending)" = "$files" ] || fail "world.$ending is not the folder"
  # Any number of threads gives the same bytes.
  succeeds "$scarp" tile "$dem" again.$ending --vertical egm96 -j 3 -q
  cmp world.$ending again.$ending || fail "3 threads make another $ending"

  # Existing files are kept, except that Scarp's own sets can be replaced.
  refuses 4 "--overwrite" "$scarp" tile "$dem" world.$ending --vertical egm96
  succeeds "$scarp" tile "$dem" again.$ending --vertical egm96 --zoom 8 --overwrite -q
  cmp -s world.$ending again.$ending && fail "$ending was not replaced"
  echo mine > mine.$ending
  refuses 4 "is not Scarp's" "$scarp" tile "$dem" mine.$ending --vertical egm96 --overwrite
  mkdir folder.$ending
  refuses 4 "folder" "$scarp" tile "$dem" folder.$ending --vertical egm96
  refuses 4 "folder does not exist" "$scarp" tile "$dem" missing/world.$ending --vertical egm96
done
[ -z "$(find . -name '.scarp*')" ] || fail "something temporary is left"

# Killed in the middle: nothing has the final name, and existing files are unchanged.
make_big_raster big.tif
cp again.pmtiles kept.pmtiles
for output in killed killed.pmtiles killed.mbtiles killed.3tz kept.pmtiles; do
  "$scarp" tile big.tif $output --vertical egm96 --overwrite --json-progress > /dev/null 2> progress &
  process=$!
  # Once tiles are being made.
  await $process grep -q '"tiles"' progress
  kill -9 $process
  wait $process 2> /dev/null || true
  if [ $output = kept.pmtiles ]; then
    cmp again.pmtiles kept.pmtiles || fail "what was there has changed"
  else
    [ ! -e $output ] || fail "$output is there, half made"
  fi
done

# The next run of the same name removes remains of a killed run, but not those of another name or a live run.
[ "$(ls -d .scarp-tiles-* | wc -l)" = 1 ] || fail "the killed run left no folder"
left=$(ls -d .scarp-tiles-*)
succeeds "$scarp" tile "$dem" another --vertical egm96 --zoom 8 -q
[ -e "$left" ] || fail "a set of another name removes the folder"
mkdir "$left.old"
(
  flock 9
  "$scarp" tile "$dem" killed --vertical egm96 --zoom 8 -q
) 9< "$left"
[ -e "$left" ] || fail "a folder that a process holds is removed"
[ -e "$left.old" ] || fail "a set that was to be replaced is lost while none has its name"
succeeds "$scarp" tile "$dem" killed --vertical egm96 --zoom 8 --overwrite -q
[ -z "$(find . -maxdepth 1 -name '.scarp-tiles-*')" ] || fail "the next run leaves what the killed one left"

# Container names in capitals; other file names are refused, except existing folders and names that end with a slash.
succeeds "$scarp" tile "$dem" CAPITALS.PMTILES --vertical egm96 --zoom 8 -q
cmp again.pmtiles CAPITALS.PMTILES || fail "capitals make another container"
succeeds "$scarp" tile check CAPITALS.PMTILES -q
for name in no.glb no.OBJ no.terrain no.json; do
  refuses 1 "a set of tiles is a folder, or one .pmtiles, .mbtiles or .3tz file" "$scarp" tile "$dem" $name --vertical egm96
done
succeeds "$scarp" tile "$dem" v1.glb/ --vertical egm96 --zoom 8 -q
succeeds "$scarp" tile "$dem" v1.glb --vertical egm96 --zoom 8 -q --overwrite

# The reference reader of PMTiles.
if npm_judges pmtiles; then
  succeeds node "$js/compare_pmtiles.mjs" world.pmtiles globe
  [ "$(cat "$logs/out")" = $((files - 1)) ] || fail "the reference reader finds other tiles"
fi
