#!/usr/bin/env bash
# info: facts about the raster, and suggested errors that keep their promise.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

succeeds "$scarp" info "$dem"
for words in '403 columns x 344 rows' '236 to 1076' 'relief 840' 'GTiff, Int16' 'EPSG:4326' '0.000833333 degrees' \
  '74.85 x 92.47 m' 'missing  *0 %' 'Suggested errors:'; do
  grep -q "$words" "$logs/out" || fail "info does not tell '$words'"
done
[ "$(grep -c -- '-e [0-9.]*$' "$logs/out")" = 3 ] || fail "not three suggestions"

# Each suggested error gives a mesh within its share and uses most of it.
succeeds "$scarp" info "$dem" --json
cp "$logs/out" info.json
for k in 0 1 2; do
  error=$(json info.json suggestions $k max_error)
  budget=$(json info.json suggestions $k triangles)
  succeeds "$scarp" simplify "$dem" out.glb -e "$error" --report r.json --overwrite
  holds "$(json r.json triangles) <= $budget && $(json r.json triangles) >= 0.9 * $budget"
done
[ "$(json info.json suggestions_are_estimates)" = false ] || fail "a small raster is estimated"

# Beyond 2 million samples: an estimate, marked as such.
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

# Nodata is reported.
gdal_translate -q -a_nodata 300 "$dem" holes.tif
succeeds "$scarp" info holes.tif
grep -q 'missing .*%, nodata 300' "$logs/out" || fail "nodata is not told"

# The facts are printed before the engine runs, and alone on request.
succeeds "$scarp" info "$dem" --no-suggest
grep -q 'relief 840' "$logs/out" || fail "--no-suggest leaves out the facts"
if grep -q 'Suggested' "$logs/out"; then fail "--no-suggest suggests"; fi
succeeds "$scarp" info "$dem" --no-suggest --json
cp "$logs/out" info.json
[ "$(json info.json suggestions)" = '[]' ] || fail "--no-suggest --json: $(json info.json suggestions)"
python3 - "$scarp" large.tif <<'PYTHON' || fail "the facts wait for the suggestions"
import os, signal, subprocess, sys
run = subprocess.Popen([sys.argv[1], "info", sys.argv[2]], stdout=subprocess.PIPE)
seen = b""
while b"mesh frame" not in seen:
    piece = os.read(run.stdout.fileno(), 65536)  # at the end it would be empty
    assert piece, seen
    seen += piece
assert b"Suggested" not in seen, "both came at once"
run.send_signal(signal.SIGINT)
run.communicate()
PYTHON

# Points and meshes.
printf 'x,y,z\n0,0,1\n9,0,2\n0,9,3.5\n9,9,4\n' > survey.csv
succeeds "$scarp" info survey.csv
for words in 'points  *4$' 'heights  *1 to 4, relief 3' 'x  *0 to 9, 9 in all'; do
  grep -q "$words" "$logs/out" || fail "info of points does not tell '$words'"
done
succeeds "$scarp" info survey.csv --json
cp "$logs/out" info.json
[ "$(json info.json points count)" = 4 ] || fail "count of points"
[ "$(json info.json points bounds high)" = '[9.0, 9.0, 4.0]' ] || fail "bounds: $(json info.json points bounds high)"
refuses 1 "--band is for rasters" "$scarp" info survey.csv --band 1
refuses 1 "--layer is for points" "$scarp" info "$dem" --layer a
for mesh in m.glb m.obj m.ply m.stl m.2dm m.xml; do
  succeeds "$scarp" simplify "$dem" $mesh -e 50 --report r.json --overwrite
  succeeds "$scarp" info $mesh --json
  cp "$logs/out" info.json
  [ "$(json info.json mesh triangles)" = "$(json r.json triangles)" ] || fail "info $mesh: triangles"
  [ "$(json info.json mesh bytes)" = "$(stat -c %s $mesh)" ] || fail "info $mesh: bytes"
done
succeeds "$scarp" simplify "$dem" dressed.glb -e 40 --normals --uvs
# The same mesh in another format, read by awk.
succeeds "$scarp" simplify "$dem" plain.obj -e 40 --up z
heights=$(awk '$1 == "v" { if (n++ == 0) { low = high = $4 } if ($4 < low) low = $4; if ($4 > high) high = $4 }
  END { print low " to " high ", " high - low " in all" }' plain.obj)
succeeds "$scarp" info dressed.glb
for words in 'attributes  *normals, uvs' 'command  *scarp simplify jacksboro_fault.tif' 'triangles, .* vertices' \
  "z  *$heights"; do
  grep -q "$words" "$logs/out" || fail "info of a mesh does not tell '$words': $(cat "$logs/out")"
done
# The up axis and the origin of the file's numbers.
for given in "y.obj|--up y|y is up" "z.obj|--up z|z is up" "y.ply|--up y|y is up" "z.ply||z is up" "y.stl|--up y|y is up" \
  "z.stl||z is up" "a.glb||y is up"; do
  IFS='|' read -r name option words <<< "$given"
  succeeds "$scarp" simplify "$dem" "axes_$name" -e 50 $option
  succeeds "$scarp" info "axes_$name"
  grep -q "^  in the file *$words" "$logs/out" || fail "info axes_$name does not say that $words: $(cat "$logs/out")"
  if grep -q '^  up ' "$logs/out"; then fail "info axes_$name tells of another axis"; fi
  if grep -q 'offsets' "$logs/out"; then fail "info axes_$name tells offsets from 0"; fi
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' > foreign.obj
succeeds "$scarp" info foreign.obj
grep -q '^  in the file *nothing says which axis is up: z is taken' "$logs/out" || fail "an axis that no file tells"
for name in far.stl far.glb far.obj; do
  succeeds "$scarp" simplify "$dem" $name -e 50 --crs EPSG:32616
  succeeds "$scarp" info $name --json
  cp "$logs/out" info.json
done
[ "$(json info.json mesh axes)" = '{"up": "y", "offsets_from": null}' ] || fail "axes of an OBJ: $(json info.json mesh axes)"
succeeds "$scarp" info far.stl
grep -q '^  in the file *z is up; positions are offsets from x 74[0-9.]*, y 402[0-9.]*, z 0' "$logs/out" ||
  fail "info does not tell the origin of an STL file: $(cat "$logs/out")"
refuses 1 "--crs is for rasters, and dressed.glb holds a mesh" "$scarp" info dressed.glb --crs local
refuses 2 "missing.glb" "$scarp" info missing.glb
