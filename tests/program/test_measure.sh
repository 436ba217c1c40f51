#!/usr/bin/env bash
# The judge: its report, map and verdict, and its detection of planted faults.
source "$(dirname "$0")/lib.sh"
need python3 awk

succeeds "$scarp" simplify "$dem" good.obj -e 20 --up z
succeeds "$scarp" measure "$dem" good.obj --fail-above 20
grep -q '^Passed: max error' "$logs/out" || fail "no verdict in the table"
grep -q 'sound; [0-9,]* open edges in 1 border loop' "$logs/out" || fail "no topology in the table"
succeeds "$scarp" measure "$dem" good.obj --fail-above 20 -q
[ ! -s "$logs/out" ] && [ ! -s "$logs/err" ] || fail "-q is not quiet"

succeeds "$scarp" measure "$dem" good.obj --json --map map.png
cp "$logs/out" good.json
python3 - good.json <<'PYTHON'
import json, sys
r = json.load(open(sys.argv[1]))
assert list(r) == ["scarp", "command", "input", "frame", "mesh", "vertices", "triangles", "full_triangles", "max_error",
                   "max_error_at", "rmse", "mean_error", "mean_abs_error", "p50", "p95", "p99", "p999", "max_error_place", "cutline", "samples", "uncovered",
                   "stray", "void_cells_covered", "topology", "fail_above", "passed", "seconds", "warnings"], list(r)
assert r["fail_above"] is None and r["passed"] is None
assert list(r["seconds"]) == ["read", "measure", "total"]
PYTHON
[ "$(head -c 4 map.png | tail -c 3)" = PNG ] || fail "map.png is no PNG"

# fails WORDS MESH [BOUND]: exit code 3 and one line that contains WORDS; the table is still printed.
fails() {
  try "$scarp" measure "$dem" "$2" --fail-above "${3:-20}"
  [ "$code" = 3 ] || fail "exit code $code instead of 3 for $2"
  [ "$(grep -vc '^scarp: warning: ' "$logs/err")" = 1 ] || fail "not one sentence on stderr for $2"
  grep -q "^scarp: $2: " "$logs/err" || fail "the line does not name $2"
  grep -qE -- "$1" "$logs/err" || fail "the line does not hold '$1'"
  grep -q '^Failed: ' "$logs/out" || fail "no verdict in the table for $2"
  try "$scarp" measure "$dem" "$2" --fail-above "${3:-20}" --json
  [ "$code" = 3 ] && [ "$(json "$logs/out" passed)" = false ] || fail "--json passes $2"
  succeeds "$scarp" measure "$dem" "$2"
}

fails 'max error [0-9.]+ at column [0-9]+, row [0-9]+ exceeds 10' good.obj 10

# A truncated file is refused; an edited one is judged.
faces=$(grep -c '^f ' good.obj)
head -n $((faces / 2)) good.obj > cut.obj
refuses 2 "cut.obj" "$scarp" measure "$dem" cut.obj
succeeds "$scarp" measure "$dem" good.obj --fail-above 20

# One vertex in the middle of the file, raised by 100 m.
vertices=$(grep -c '^v ' good.obj)
awk -v n=$((vertices / 2)) '$1 == "v" && ++k == n { $4 += 100 } { print }' good.obj > moved.obj
fails 'max error (1[0-2]|9)[0-9.]+ at column [0-9]+, row [0-9]+ exceeds 20' moved.obj
# The same vertex moved sideways: heights no longer fit, or the mesh folds.
awk -v n=$((vertices / 2)) '$1 == "v" && ++k == n { $2 += 3000 } { print }' good.obj > shifted.obj
fails '' shifted.obj
# One triangle dropped, flipped, or duplicated.
awk -v n=$((faces / 2)) '!($1 == "f" && ++k == n) { print }' good.obj > dropped.obj
try "$scarp" measure "$dem" dropped.obj --json
holds "$(json "$logs/out" topology border_loops) == 2"
fails 'covered by no triangle|gap' dropped.obj
awk -v n=$((faces / 2)) '$1 == "f" && ++k == n { t = $3; $3 = $4; $4 = t } { print }' good.obj > flipped.obj
fails 'flipped triangle' flipped.obj
awk -v n=$((faces / 2)) '{ print } $1 == "f" && ++k == n { print }' good.obj > doubled.obj
fails 'overlap' doubled.obj
# A missing triangle with samples is detected: drops the largest of the mesh.
python3 - good.obj <<'PYTHON' > hole.obj
import sys
lines = open(sys.argv[1]).read().splitlines()
v = [tuple(map(float, l.split()[1:4])) for l in lines if l.startswith("v ")]
def area(line):
    a, b, c = (v[int(w.split("/")[0]) - 1] for w in line.split()[1:4])
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
largest = max((l for l in lines if l.startswith("f ")), key=area)
print("\n".join(l for l in lines if l is not largest))
PYTHON
fails 'covered by no triangle, the first at column [0-9]+, row [0-9]+' hole.obj
# A missing triangle without samples is detected, too: drops one of the smallest of a fine mesh.
succeeds "$scarp" simplify "$dem" fine.obj -e 2 --up z
python3 - fine.obj <<'PYTHON' > pinhole.obj
import sys
lines = [l for l in open(sys.argv[1]).read().splitlines() if not l.startswith("# scarp.")]
v = [tuple(map(float, l.split()[1:4])) for l in lines if l.startswith("v ")]
def area(line):
    a, b, c = (v[int(w.split("/")[0]) - 1] for w in line.split()[1:4])
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
smallest = min((l for l in lines if l.startswith("f ")), key=area)
print("\n".join(l for l in lines if l is not smallest))
PYTHON
fails 'not sound: [123] gaps?' pinhole.obj 2
holds "$(try "$scarp" measure "$dem" pinhole.obj --json; json "$logs/out" topology gaps) >= 1"
# The table of a mesh elsewhere reports it.
awk '$1 == "v" { $2 += 1e7 } { print }' good.obj > away.obj
# A mesh elsewhere is not judged: no number, exit code 3, and both positions.
for options in "" "--fail-above 20"; do
  try "$scarp" measure "$dem" away.obj $options --json
  [ "$code" = 3 ] || fail "a mesh elsewhere ends with $code"
  for key in max_error max_error_at rmse mean_error mean_abs_error p50 p95 p99 p999; do
    [ "$(json "$logs/out" $key)" = null ] || fail "a mesh elsewhere has the $key $(json "$logs/out" $key)"
  done
  [ "$(json "$logs/out" passed)" = false ] || fail "a mesh elsewhere passes"
  grep -q 'covers no sample of .*: its vertices lie at x 9[0-9.]* to 10[0-9.]* and y .*, the samples at x -15' "$logs/err" ||
    fail "no word where they lie"
done
try "$scarp" measure "$dem" away.obj
[ "$code" = 3 ] && grep -q 'max error *none: no sample is covered' "$logs/out" || fail "the table tells an error of nothing"

# A verdict in percent of the relief (840), like simplify's goal: the recipe for a build.
succeeds "$scarp" simplify "$dem" percent.glb -e 1% --overwrite
succeeds "$scarp" measure "$dem" percent.glb --fail-above 1%
succeeds "$scarp" measure "$dem" percent.glb --fail-above 1% --json
cp "$logs/out" percent.json
[ "$(json percent.json fail_above)" = 8.4 ] || fail "1% of 840 is $(json percent.json fail_above)"
try "$scarp" measure "$dem" percent.glb --fail-above 0.9%
[ "$code" = 3 ] || fail "--fail-above 0.9% of a mesh for 1% ends with $code"
refuses 1 "--fail-above 1mm is an error on a print" "$scarp" measure "$dem" percent.glb --fail-above 1mm
# The mesh before the raster.
refuses 1 "percent.glb is a mesh: the raster comes first, scarp measure" "$scarp" measure percent.glb "$dem"

# A mesh lies where its file places it, not around any raster's centre: for a raster elsewhere, a window of a larger
# one, and the window itself in another type.
need gdal_translate
gdal_translate -q -srcwin 20 30 201 180 "$dem" window.tif
gdal_translate -q -of AAIGrid window.tif window.asc
gdal_translate -q -a_ullr 20 45 20.2 44.82 window.tif moved.tif
for name in window.glb window.obj window.ply; do
  for options in "" "--crs local" "--crs grid"; do
    succeeds "$scarp" simplify window.tif $name -e 20 $options --overwrite
    succeeds "$scarp" measure window.tif $name --fail-above 20
    succeeds "$scarp" measure window.asc $name --fail-above 20
    try "$scarp" measure moved.tif $name --fail-above 20 --json
    [ "$code" = 3 ] || fail "$name $options of another place ends with $code"
    [ "$(json "$logs/out" max_error)" = null ] || fail "$name $options of another place has an error"
    grep -q "covers no sample of moved.tif" "$logs/err" || fail "no word that $name $options lies elsewhere"
    try "$scarp" measure "$dem" $name --fail-above 20 --json
    [ "$code" = 3 ] || fail "$name $options passes for a larger raster"
    holds "$(json "$logs/out" max_error) <= 20.0000001 && $(json "$logs/out" samples) == 201 * 180"
    holds "$(json "$logs/out" uncovered) == 403 * 344 - 201 * 180"
    grep -q "covered by no triangle" "$logs/err" || fail "no word that samples are uncovered"
  done
done
# --crs overrides the file's metadata; a raster without georeference has no place to compare.
succeeds "$scarp" simplify window.tif window.glb -e 20 --overwrite
try "$scarp" measure moved.tif window.glb --crs local --fail-above 60 --json
holds "$(json "$logs/out" samples) > 20000"
