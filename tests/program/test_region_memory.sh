#!/usr/bin/env bash
# --tolerance, --roi and --falloff with --memory: bounds are read in windows while heights stay in their file, and equal
# those in memory. Any number of threads gives the same bytes, the memory suffices, and the memory of bounds counts.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

succeeds "$scarp" generate smooth 500 600 smooth.tif --seed 3 --range 300 -q
# Nodata in bands along contours, in heights and tolerances.
gdal_translate -q -ot Int16 -a_nodata 255 smooth.tif whole.tif
gdal_translate -q -ot Float32 whole.tif hills.tif
succeeds "$scarp" generate smooth 500 600 other.tif --seed 8 --range 300 -q
gdal_translate -q -ot Byte -scale 0 300 4 60 -a_nodata 40 other.tif accuracy.tif
gdal_translate -q -ot Float32 -scale 0 300 -1 60 other.tif broken.tif
gdal_translate -q -srcwin 0 0 400 600 accuracy.tif narrow.tif
python3 - <<'PYTHON'
import json
def layer(name, kind, geometries):
    json.dump({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": kind, "coordinates": g}} for g in geometries]}, open(name, "w"))
site = [[[110.3, 120.2], [290.7, 110.4], [270.2, 510.1], [140.6, 495.5], [110.3, 120.2]],
        [[170.4, 280.3], [210.2, 290.6], [190.8, 350.9], [170.4, 280.3]]]
layer("site.geojson", "Polygon", [site, [[[350, 210], [600, 250], [420, 420], [350, 210]]]])
layer("road.geojson", "LineString", [[[-20.3, 560.2], [320.6, 350.4], [490.8, 20.3]]])
layer("long.geojson", "LineString", [[[i % 500, i // 500] for i in range(90000)]])
PYTHON

small=74 # the samples, 1.2 MB, may use 1 of it, so they stay in their file, and strips are low
sites=(--roi site.geojson=2 --roi road.geojson=5 --falloff 90)
check() { # check EFFORT BOUND OPTION...: a mesh in little memory, judged in little and in much memory
  local effort=$1 bound=() judge=()
  [ "$2" = none ] || bound=(-e "$2") judge=(--fail-above "$2")
  shift 2
  within=$small by_threads hills.tif one.obj "${bound[@]}" "$@" --effort "$effort" --memory "${small}M"
  mv r.json one.json
  within "$small" "$scarp" measure hills.tif one.obj "${judge[@]}" "$@" --memory "${small}M" --json
  cp "$logs/out" little.json
  succeeds "$scarp" measure hills.tif one.obj "${judge[@]}" "$@" --json
  cp "$logs/out" much.json
  [ "$(json little.json over_tolerance)" = 0 ] || fail "samples are above their tolerance"
  agree little.json much.json weighted_max_error weighted_rmse ignored over_tolerance max_error rmse topology passed
  agree one.json much.json weighted_max_error ignored max_error samples uncovered
  [ "$(json much.json topology sound)" = true ] || fail "the mesh is not sound"
  [ "$effort" != high ] || return 0
  succeeds "$scarp" simplify hills.tif whole.obj "${bound[@]}" "$@" --effort "$effort" --report whole.json --overwrite
  agree one.json whole.json ignored
  holds "$(json one.json triangles) < 1.1 * $(json whole.json triangles)"
}
check fast 40 "${sites[@]}"
check high 40 "${sites[@]}" --tolerance accuracy.tif
check normal none --tolerance accuracy.tif
agree little.json much.json bounded_max_error bounded_max_error_at
agree one.json much.json bounded_max_error
check fast none --roi site.geojson=2 --roi road.geojson=5
agree little.json much.json bounded_max_error bounded_max_error_at

# With shape goals.
within "$small" "$scarp" simplify hills.tif shaped.obj -e 40 "${sites[@]}" --min-angle 20 --effort normal --memory "${small}M" \
  --report shaped.json
[ "$(json shaped.json shape below)" = 0 ] || fail "triangles with smaller angles are left"
succeeds "$scarp" measure hills.tif shaped.obj "${sites[@]}" --fail-above 40

# Within a budget, one factor of all tolerances is searched for.
within=$small by_threads hills.tif few.obj -t 1500 -e 40 "${sites[@]}" --effort normal --memory "${small}M"
mv r.json few.json
holds "$(json few.json triangles) <= 1500 && 1 < $(json few.json tolerance_factor)"
holds "$(json few.json weighted_max_error) <= $(json few.json tolerance_factor)"
succeeds "$scarp" simplify hills.tif whole.obj -t 1500 -e 40 "${sites[@]}" --effort normal --report whole.json --overwrite
holds "$(json few.json tolerance_factor) < 1.3 * $(json whole.json tolerance_factor)"

# A mesh that violates regions is detected, with the same number of samples.
succeeds "$scarp" simplify hills.tif coarse.obj -e 40 -q
for memory in "--memory ${small}M" ""; do
  try "$scarp" measure hills.tif coarse.obj "${sites[@]}" --fail-above 40 --json $memory
  [ "$code" = 3 ] || fail "a mesh without regions keeps their bounds"
  cp "$logs/out" "coarse${#memory}.json"
done
agree coarse0.json coarse12.json over_tolerance weighted_max_error weighted_rmse
holds "$(json coarse0.json over_tolerance) > 1000"

# Impossible requests are refused before the work.
refuses 2 "--tolerance broken.tif: the value -" "$scarp" simplify hills.tif x.obj --tolerance broken.tif --memory "${small}M"
refuses 2 "gdal_translate" "$scarp" simplify hills.tif x.obj --tolerance narrow.tif --memory "${small}M"
for command in "simplify hills.tif x.obj -e 40" "measure hills.tif coarse.obj --fail-above 40"; do
  refuses 1 "--memory is too little: --roi takes 9M; allow 90M" "$scarp" $command --roi long.geojson=2 --memory "${small}M"
done

# Bounds in memory count: a raster that fits without them is read in windows.
within 84 "$scarp" simplify hills.tif fits.obj -e 40 "${sites[@]}" --memory 84M --effort fast --overwrite
