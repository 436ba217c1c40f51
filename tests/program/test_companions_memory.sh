#!/usr/bin/env bash
# --mask, --script, --normals, --error-raster, --map and --preview with --memory: weights, ignored samples and
# neighbours are read in windows while heights stay in their file; errors and pictures are written by rows. Results for
# a mesh equal those in memory to the last bit. Any number of threads gives the same bytes, and the memory suffices.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalinfo

succeeds "$scarp" generate smooth 500 600 smooth.tif --seed 3 --range 300 -q
# Nodata in bands along contours, in heights and weights.
gdal_translate -q -ot Int16 -a_nodata 255 smooth.tif whole.tif
gdal_translate -q -ot Float32 whole.tif hills.tif
succeeds "$scarp" generate smooth 500 600 other.tif --seed 8 --range 300 -q
gdal_translate -q -ot Byte -scale 0 300 0 200 -a_nodata 150 other.tif weights.tif
gdal_translate -q -ot Float32 -scale 0 300 -1 60 other.tif broken.tif
gdal_translate -q -srcwin 0 0 400 600 weights.tif narrow.tif
python3 - <<'PYTHON'
with open("ignored.txt", "w") as script:
    for y in range(200, 320):
        for x in range(60, 200): print("i" if x % 2 else "u", x, y, file=script)
with open("long.txt", "w") as script:
    for k in range(200000): print("i", k % 500, k // 500, file=script)
PYTHON

small=74 # the samples, 1.2 MB, may use 1 of it, so they stay in their file, and strips are low
check() { # check EFFORT OPTION...: a mesh in little memory, judged in little and in much memory
  local effort=$1
  shift
  within=$small by_threads hills.tif one.obj -e 20 "$@" --effort "$effort" --normals --memory "${small}M"
  mv r.json one.json
  [ "$(grep -c '^vn ' one.obj)" = "$(grep -c '^v ' one.obj)" ] || fail "not one normal a vertex"
  within "$small" "$scarp" measure hills.tif one.obj --fail-above 20 "$@" --memory "${small}M" --json
  cp "$logs/out" little.json
  succeeds "$scarp" measure hills.tif one.obj --fail-above 20 "$@" --json
  cp "$logs/out" much.json
  agree little.json much.json ignored max_error rmse bounded_max_error bounded_max_error_at topology passed
  [[ "$*" != *--mask* ]] || agree little.json much.json weighted_max_error weighted_rmse
  agree one.json much.json ignored max_error samples uncovered bounded_max_error
  [ "$(json much.json topology sound)" = true ] || fail "the mesh is not sound"
  [ "$effort" != high ] || return 0
  succeeds "$scarp" simplify hills.tif held.obj -e 20 "$@" --effort "$effort" --report held.json --overwrite
  agree one.json held.json ignored
  holds "$(json one.json triangles) < 1.15 * $(json held.json triangles)"
}
check fast --mask weights.tif
holds "$(json one.json ignored) > 900 && $(json one.json weighted_max_error) <= 20 && $(json one.json max_error) > 20"
check high --mask weights.tif
check fast --script ignored.txt
check normal --script ignored.txt --mask weights.tif
check normal --script ignored.txt --tolerance weights.tif

# Errors and pictures of one mesh have the same bytes in little and in much memory.
within "$small" "$scarp" simplify hills.tif made.obj -e 20 --normals --memory "${small}M" --error-raster made.tif \
  --preview made.png --report made.json
within "$small" "$scarp" measure hills.tif made.obj --error-raster little.tif --map little.png --memory "${small}M" -j 2
succeeds "$scarp" measure hills.tif made.obj --error-raster much.tif
cmp made.tif much.tif || fail "simplify writes other errors in little memory than measure in much"
cmp little.tif much.tif || fail "measure writes other errors in little memory than in much"
holds "$(json made.json outputs 2 bytes) == $(wc -c < made.tif)"
for picture in made.png little.png; do gdalinfo "$picture" | grep -q "^Size is" || fail "$picture is no picture"; done
succeeds "$scarp" measure hills.tif made.obj --error-raster /dev/stdout --memory "${small}M"
cmp "$logs/out" much.tif || fail "other errors go to standard output"
refuses 4 "made.tif exists" "$scarp" measure hills.tif made.obj --error-raster made.tif --memory "${small}M"
gdal_translate -q -of VRT -outsize 300000 60 hills.tif wide.vrt
refuses 1 "--memory is too little: --error-raster takes 310M" "$scarp" measure wide.vrt made.obj --error-raster w.tif --memory "${small}M"
bash -c 'ulimit -f 8; exec "$@"' - "$scarp" measure hills.tif made.obj --error-raster full.tif --memory "${small}M" \
  > "$logs/out" 2> "$logs/err" && fail "a file is larger than it may be"
grep -q "cannot write full.tif" "$logs/err" || fail "the sentence does not name the file"
[ "$(wc -l < "$logs/err")" = 1 ] || fail "not one line on stderr"
[ -z "$(find . -name '.scarp-*' -o -name 'full*' -o -name w.tif)" ] || fail "files are left"

# Block sizes that differ from the heights': of weights that are read, and of output.
gdal_translate -q -ot Int16 -a_nodata none -co TILED=YES -outsize 1500 6000 smooth.tif tall.tif
gdal_translate -q -ot Byte -a_nodata none -co TILED=YES -scale 0 300 0 200 -outsize 1500 6000 smooth.tif heavy.tif
within 86 "$scarp" simplify tall.tif tall.obj -e 20 --error-raster tall_errors.tif --memory 86M -j 2
within 86 "$scarp" simplify tall.tif tall_near.tif -e 20 --memory 86M -j 2
within 86 "$scarp" measure tall.tif tall.obj --mask heavy.tif --error-raster tall_again.tif --map tall.png --memory 86M -j 2
succeeds "$scarp" measure tall.tif tall.obj --error-raster tall_whole.tif
cmp tall_errors.tif tall_again.tif || fail "measure writes other errors than simplify"
cmp tall_errors.tif tall_whole.tif || fail "errors by rows are not those of the whole raster"

# The approximation as a raster: heights and their errors.
within "$small" "$scarp" simplify hills.tif near.tif -e 20 --error-raster errors.tif --memory "${small}M" -j 1
succeeds "$scarp" simplify hills.tif again.tif -e 20 --memory "${small}M" -j 2
cmp near.tif again.tif || fail "-j 2 writes another raster"
for raster in hills near errors; do gdal_translate -q -of XYZ "$raster.tif" "$raster.xyz"; done
python3 - <<'PYTHON' || fail "the raster is not the heights and their errors"
rows = [[float(line.split()[2]) for line in open(name + ".xyz")] for name in ("hills", "near", "errors")]
valid = [(z, near, error) for z, near, error in zip(*rows) if error == error]
assert len(valid) > 290000 and len({near for _, near, _ in valid}) > 1000
assert all(abs(near - z - error) < 1e-3 and abs(error) <= 20 for z, near, error in valid)
PYTHON

# A mesh that violates weights is detected, with the same number of samples.
succeeds "$scarp" simplify hills.tif coarse.obj -e 60 -q
for memory in "--memory ${small}M" ""; do
  # shellcheck disable=SC2086
  try "$scarp" measure hills.tif coarse.obj --mask weights.tif --fail-above 20 --json $memory
  [ "$code" = 3 ] || fail "a coarse mesh keeps the weights' bounds"
  cp "$logs/out" "coarse${#memory}.json"
done
agree coarse0.json coarse12.json weighted_max_error weighted_rmse bounded_max_error max_error

# Impossible requests are refused before the work.
refuses 2 "--mask broken.tif: the value -" "$scarp" simplify hills.tif x.obj -e 20 --mask broken.tif --memory "${small}M"
refuses 2 "gdal_translate" "$scarp" simplify hills.tif x.obj -e 20 --mask narrow.tif --memory "${small}M"
refuses 1 "--memory is too little: --script takes 20M" "$scarp" simplify hills.tif x.obj -e 20 --script long.txt --memory "${small}M"
