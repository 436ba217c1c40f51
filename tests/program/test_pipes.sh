#!/usr/bin/env bash
# "-" is standard input and standard output; pipes are read once, by the reader for their bytes.
source "$(dirname "$0")/lib.sh"
need python3
cp "$dem" "$logs/grid.tif"
"$scarp" simplify "$logs/grid.tif" grid.stl -e 20 -q
after_header() { tail -c +81 "$1"; }  # it holds the command

"$scarp" simplify - piped.stl -e 20 < "$logs/grid.tif" > "$logs/out"
cmp <(after_header grid.stl) <(after_header piped.stl)
cat "$logs/grid.tif" | "$scarp" simplify - - --of stl -e 20 > out.stl 2> "$logs/err"
cmp <(after_header grid.stl) <(after_header out.stl)
grep -q '^Reached the error goal' "$logs/err" || fail "the summary is not on stderr where the mesh is on stdout"
"$scarp" simplify <(cat "$logs/grid.tif") fifo.stl -e 20 -q
cmp <(after_header grid.stl) <(after_header fifo.stl)
[ "$(find . -name 'scarp-*')" = "" ] || fail "a copy of standard input is left"

# All readers: PGM, a streamed raster, points, and the mesh of measure.
succeeds "$scarp" generate fractal 60 50 hills.pgm
cat hills.pgm | "$scarp" simplify - pgm.glb -e 5 -q
"$scarp" measure hills.pgm pgm.glb --fail-above 5 -q
cat "$dem" | "$scarp" simplify - streamed.glb -e 20 --memory 100M -q
"$scarp" measure "$dem" - --fail-above 20 -q < streamed.glb
printf 'x,y,z\n0,0,1\n1,0,2\n0,1,3\n1,1,5\n' | "$scarp" simplify - points.ply --points -e 0 -q
cat "$dem" | "$scarp" info - --json > info.json
[ "$(json info.json input path)" = '"-"' ] || fail "info does not tell that it read standard input"

# Reports or pictures, but only one of them.
"$scarp" simplify "$dem" a.glb -e 50 --report - 2> "$logs/err" | python3 -c 'import json, sys; assert json.load(sys.stdin)["max_error"] <= 50'
grep -q '^Reached' "$logs/err" || fail "the summary is not on stderr where the report is on stdout"
refuses 1 "OUTPUT and --report both write to standard output" "$scarp" simplify "$dem" - --of glb -e 50 --report -
refuses 1 "OUTPUT - is standard output, whose name tells no format: give --of FORMAT" "$scarp" simplify "$dem" - -e 50
refuses 2 "standard input: the file is empty" "$scarp" info - < /dev/null
refuses 2 "standard input: not a raster" "$scarp" simplify - b.glb -e 1 < <(echo "no raster at all, but words")
printf 'x,y,z\n0,0,1\n1,0,2\n0,1,3\n1,1,5\n0.3,0.7,2\n' > points.csv
for piped in points.csv points.ply; do
  for command in "simplify - b.glb -e 1" "info -" "measure - points.ply"; do
    refuses 2 "it is read as a raster, with --points as points or lines, never as a mesh" "$scarp" $command < $piped
  done
done
echo '{"type":"Point","coordinates":[1,2,3]}' > point.json
refuses 2 "point.json: holds vector data (GeoJSON), not a raster; --points reads it as points or lines" "$scarp" info point.json
cp "$dem" own.tif
try "$scarp" simplify - own.tif -e 50 --overwrite < own.tif
[ "$code" = 1 ] || fail "exit code $code instead of 1 where OUTPUT is what standard input reads"
cmp "$dem" own.tif
