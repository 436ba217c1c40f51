#!/usr/bin/env bash
# Values beyond float32: the cost of rounding is reported and counts against every bound.
source "$(dirname "$0")/lib.sh"
need gdal_translate python3
gdal_translate -q -srcwin 0 0 40 30 -ot Float64 -scale 236 1076 100000.1 100900.7 "$dem" fine.tif

succeeds "$scarp" simplify fine.tif exact.glb -p 5000 --report exact.json
rounding=$(json exact.json sample_rounding)
holds "$rounding > 1e-5 && $rounding < 0.01"
[ "$rounding" = "$(json exact.json input sample_rounding)" ] || fail "two figures for one rounding"
holds "$(json exact.json max_error) == 0"
grep -q 'values rounded to float32 by up to' "$logs/out" || fail "the summary hides the rounding"
if grep -q 'Reproduced every sample' "$logs/out"; then fail "rounded values are called reproduced"; fi

refuses_zero() {
  try "$scarp" measure fine.tif exact.glb "$@"
  [ "$code" = 3 ] || fail "exit code $code instead of 3: $*"
  grep -q 'values rounded to float32 by up to' "$logs/err" || fail "the verdict hides the rounding"
}
refuses_zero --fail-above 0
refuses_zero --fail-above "$(python3 -c "print(0.5 * $rounding)")"
succeeds "$scarp" measure fine.tif exact.glb --fail-above "$rounding"
grep -q 'values rounded to float32 by up to' "$logs/out" || fail "the table hides the rounding"
succeeds "$scarp" measure fine.tif exact.glb --fail-above "$rounding" --json
[ "$(json "$logs/out" sample_rounding)" = "$rounding" ] || fail "the judge's report has another rounding"
[ "$(json "$logs/out" passed)" = true ] || fail "not passed"
python3 - "$logs/out" <<'PYTHON' || fail "the mesh does not carry the rounding"
import json, sys
report = json.load(open(sys.argv[1]))
assert json.loads(report["mesh"]["metadata"]["error"])["sample_rounding"] == report["sample_rounding"]
PYTHON

# A goal preserves the reserve.
succeeds "$scarp" simplify fine.tif goal.glb -e 5 --report goal.json
holds "$(json goal.json max_error) + $(json goal.json sample_rounding) <= 5"
succeeds "$scarp" measure fine.tif goal.glb --fail-above 5 -q

# The error named in the refusal of 0 is kept, and hardly exceeds the rounding: decoded tenths, far coordinates and big
# numbers.
gdal_translate -q -srcwin 0 0 40 30 -a_scale 0.1 -a_offset 3 "$dem" tenths.tif
gdal_translate -q -srcwin 0 0 40 30 -ot Int32 -scale 236 1076 1000000001 1000900007 "$dem" whole.tif
for raster in fine.tif tenths.tif whole.tif; do
  refuses 3 "rounded" "$scarp" simplify "$raster" none.glb -e 0
  enough=$(sed -n 's/.*ask for \([^ ]*\) or more.*/\1/p' "$logs/err")
  for format in glb ply obj; do
    succeeds "$scarp" simplify "$raster" "asked.$format" -e "$enough" --report asked.json --overwrite
    holds "$enough <= 1.1 * $(json asked.json sample_rounding)"
    succeeds "$scarp" measure "$raster" "asked.$format" --fail-above "$enough" -q
  done
done
# Float64 and scaled values that fit float32 need no reserve.
gdal_translate -q -srcwin 0 0 40 30 -ot Float64 "$dem" fits.tif
gdal_translate -q -srcwin 0 0 40 30 -a_scale 0.125 -a_offset 3 "$dem" eighths.tif
for raster in fits.tif eighths.tif; do
  succeeds "$scarp" simplify "$raster" exact.glb -e 0 --report zero.json --overwrite
  holds "$(json zero.json max_error) == 0"
  succeeds "$scarp" measure "$raster" exact.glb --fail-above 0 -q
done

# Coordinates too large for double to separate samples are reported; around the centre there is room.
gdal_translate -q -of VRT -srcwin 0 0 40 30 "$dem" far.vrt
sed -i 's|<GeoTransform>.*</GeoTransform>|<GeoTransform>1e20, 1, 0, 1e20, 0, -1</GeoTransform>|; s|<SRS.*</SRS>||' far.vrt
refuses 3 "coordinates of 1e+20 cannot tell samples 1 apart" "$scarp" simplify far.vrt far.glb -e 5 --crs source
succeeds "$scarp" simplify far.vrt far.glb -e 5 --crs local -q

# If samples equal the values, nothing is reported.
succeeds "$scarp" simplify "$dem" plain.glb -e 0 --report plain.json
if grep -q 'rounded' "$logs/out" || grep -q '^  "sample_rounding"' plain.json; then fail "a rounding that is none"; fi

# A share of the relief smaller than the rounding is named as requested.
gdal_translate -q -srcwin 0 0 40 30 -ot Float64 -scale 236 1076 1000000000 1000000000.01 "$dem" level.tif
refuses 3 '-e 1% of a relief of 0, a max error of 0, cannot be kept: ' "$scarp" simplify level.tif o.glb -e 1%
echo "roundings are told and counted"
