#!/usr/bin/env bash
# info: what is in the raster, and errors that keep what they suggest.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

succeeds "$scarp" info "$dem"
for words in '403 columns x 344 rows' '236 to 1076' 'relief 840' 'GTiff, Int16' 'EPSG:4326' '0.000833333 degrees' \
  '74.85 x 92.47 m' 'missing  *0 %' 'Suggested errors:'; do
  grep -q "$words" "$logs/out" || fail "info does not tell '$words'"
done
[ "$(grep -c -- '-e [0-9.]*$' "$logs/out")" = 3 ] || fail "not three suggestions"

# Each suggested error gives a mesh within its share, and uses most of it.
succeeds "$scarp" info "$dem" --json
cp "$logs/out" info.json
for k in 0 1 2; do
  error=$(json info.json suggestions $k max_error)
  budget=$(json info.json suggestions $k triangles)
  succeeds "$scarp" simplify "$dem" out.glb -e "$error" --report r.json --overwrite
  holds "$(json r.json triangles) <= $budget && $(json r.json triangles) >= 0.9 * $budget"
done
[ "$(json info.json suggestions_are_estimates)" = false ] || fail "a small raster is estimated"

# Beyond 2 million samples: an estimate, and it says so.
gdal_translate -q -r cubic -ot Float32 -outsize 1612 1376 -a_nodata 300 "$dem" large.tif
succeeds "$scarp" info large.tif
grep -q 'an estimate from windows' "$logs/out" || fail "the estimate is not called one"
succeeds "$scarp" info large.tif --json
cp "$logs/out" info.json
[ "$(json info.json suggestions_are_estimates)" = true ] || fail "a large raster is not estimated"
holds "$(json info.json suggestions 0 max_error) > $(json info.json suggestions 1 max_error)"
error=$(json info.json suggestions 1 max_error)
budget=$(json info.json suggestions 1 triangles)
succeeds "$scarp" simplify large.tif out.glb -e "$error" --report r.json --overwrite
holds "$(json r.json triangles) <= 2 * $budget && $(json r.json triangles) >= 0.5 * $budget"

# Nodata is told.
gdal_translate -q -a_nodata 300 "$dem" holes.tif
succeeds "$scarp" info holes.tif
grep -q 'missing .*%, nodata 300' "$logs/out" || fail "nodata is not told"
