#!/usr/bin/env bash
# Missing samples are never heights: holes by default, filled or given a height on request.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate awk

# A 60 x 40 hill with a rectangle of nodata (columns 20..29, rows 10..19) around a valid sample, and a nodata corner.
awk 'BEGIN {
  print "ncols 60\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999";
  for (r = 0; r < 40; ++r) {
    line = "";
    for (c = 0; c < 60; ++c) {
      hole = (c >= 20 && c < 30 && r >= 10 && r < 20 && !(c == 25 && r == 15)) || (c < 3 && r < 3);
      line = line (hole ? "-9999 " : sprintf("%.3f ", 50 + 40 * sin(c / 9) * cos(r / 7)));
    }
    print line;
  }
}' > hill.asc
voids=$((100 - 1 + 9))

succeeds "$scarp" simplify hill.asc hole.obj -e 1 --report r.json
[ "$(json r.json input void)" = $voids ] || fail "$(json r.json input void) nodata samples instead of $voids"
[ "$(json r.json stray)" = 1 ] || fail "the lone sample is not stray"
[ "$(json r.json samples)" = $((2400 - voids - 1)) ] || fail "judged $(json r.json samples)"
[ "$(json r.json void_cells_covered)" = 0 ] || fail "the mesh covers nodata"
[ "$(json r.json topology border_loops)" = 2 ] || fail "no hole"
grep -q '1 outside every cell' "$logs/out" || fail "the stray sample is not told"
succeeds "$scarp" measure hill.asc hole.obj --fail-above 1
holds "$(json r.json input min) > 0"

# A value that the file does not declare.
sed 's/^NODATA_value.*$/NODATA_value -1/' hill.asc > undeclared.asc
succeeds "$scarp" simplify undeclared.asc a.obj -e 1 --nodata -9999 --report a.json
[ "$(json a.json input void)" = $voids ] || fail "--nodata is not used"
[ ! -s "$logs/err" ] || fail "a warning about nodata that --nodata names"
[ "$(json a.json input undeclared_nodata)" = "[]" ] || fail "nodata that is named is suspected"
# Without --nodata they are heights, reported with the option, in memory and streamed.
warning="$voids samples are exactly -9999, far below all others (1[0-9.]* to [89][0-9.]*): if they mean nodata, give --nodata -9999\$"
for limit in "" "--memory 72.5M"; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify undeclared.asc suspect.obj -e 1 $limit --report suspect.json --overwrite
  grep -q "^scarp: warning: $warning" "$logs/err" || fail "undeclared nodata goes unseen $limit"
  [ "$(json suspect.json input undeclared_nodata 0 samples)" = $voids ] || fail "the report does not count undeclared nodata"
done
succeeds "$scarp" info undeclared.asc --json
grep -q "^scarp: warning: $warning" "$logs/err" || fail "info does not see undeclared nodata"
[ "$(json "$logs/out" input undeclared_nodata 0 value)" = -9999.0 ] || fail "the report of info does not tell undeclared nodata"
grep -v '^#' a.obj > a.txt
grep -v '^#' hole.obj > hole.txt
cmp a.txt hole.txt || fail "--nodata and a declared value differ"

succeeds "$scarp" simplify hill.asc fill.obj -e 1 --nodata-policy fill --report f.json
[ "$(json f.json input filled)" = $voids ] || fail "filled $(json f.json input filled)"
[ "$(json f.json samples)" = 2400 ] || fail "filled samples are not judged"
[ "$(json f.json topology border_loops)" = 1 ] || fail "a hole is left"
grep -q "filled  *$voids nodata samples" "$logs/out" || fail "the summary does not tell what was filled"
succeeds "$scarp" simplify hill.asc near.obj -e 1 --nodata-policy fill --fill-distance 1 --report n.json
holds "$(json n.json input filled) > 0 && $(json n.json input filled) < $voids"

succeeds "$scarp" simplify hill.asc back.obj -e 1 --up z --nodata-policy background --background -20 --report b.json
[ "$(json b.json input filled)" = $voids ] || fail "background filled $(json b.json input filled)"
[ "$(json b.json samples)" = 2400 ] || fail "background samples are not judged"
# Percentages refer to the relief of the terrain only.
holds "$(json b.json input min) > 0"
grep -Eq '^v [^ ]+ [^ ]+ -20(\.0*)?$' back.obj || fail "no vertex at the background's height"

# An outline that may move outwards becomes simpler and loses no sample. Here the nodata area is a disc.
awk 'BEGIN {
  print "ncols 80\nnrows 80\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999";
  for (r = 0; r < 80; ++r) {
    line = "";
    for (c = 0; c < 80; ++c) {
      line = line ((c - 40) * (c - 40) + (r - 40) * (r - 40) > 1400 ? "-9999 " : sprintf("%.3f ", 50 + c + r));
    }
    print line;
  }
}' > disc.asc
succeeds "$scarp" simplify disc.asc exact.obj -e 1 --report e.json
succeeds "$scarp" simplify disc.asc loose.obj -e 1 --outline-tolerance 2 --report l.json
holds "$(json l.json vertices) < 0.7 * $(json e.json vertices)"
[ "$(json l.json uncovered)" = 0 ] && [ "$(json e.json uncovered)" = 0 ] || fail "samples are lost"
holds "$(json l.json samples) >= $(json e.json samples)"

# Infinities are nodata, with a warning that counts them.
python3 -c "
import struct
z = [float(c + r) for r in range(10) for c in range(10)]
z[55] = float('inf')
open('inf.bil', 'wb').write(struct.pack('<100f', *z))"
printf 'nrows 10\nncols 10\nnbands 1\nnbits 32\npixeltype float\nbyteorder I\nlayout bil\n' > inf.hdr
succeeds "$scarp" simplify inf.bil inf.glb -e 1 --report i.json
grep -q '^scarp: warning: .*1.*infinit' "$logs/err" || grep -qi '^scarp: warning: .*inf' "$logs/err" || fail "no warning"
[ "$(json i.json input valid)" = 99 ] || fail "an infinity is a height"
holds "$(python3 -c "import json; print(len(json.load(open('i.json'))['warnings']))") == 1"
succeeds "$scarp" simplify inf.bil inf.glb -e 1 -q --overwrite

# If outlines alone need most of the mesh, the summary reports that number for -t; a simpler outline needs fewer.
awk 'BEGIN {
  print "ncols 80\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999";
  for (r = 0; r < 60; ++r) {
    line = "";
    for (c = 0; c < 80; ++c) line = line ((c % 8 == 3 && r % 6 > 2) || (c + r) % 16 == 9 && r % 6 == 1 ? "-9999 " : "5 ");
    print line;
  }
}' > ragged.asc
try "$scarp" simplify ragged.asc x.obj -t 10
needed=$(sed -n 's/.*alone needs \([0-9]*\);.*/\1/p' "$logs/err")
succeeds "$scarp" simplify ragged.asc ragged.obj -e 1 --report ragged.json
[ "$(json ragged.json outline_triangles)" = "$needed" ] || fail "$(json ragged.json outline_triangles) instead of $needed"
grep -q "outlines  *of nodata and border alone need $(json ragged.json outline_triangles) triangles: --nodata-policy outline=" "$logs/out" ||
  fail "the summary does not tell what outlines need"
succeeds "$scarp" simplify ragged.asc looser.obj -e 1 --nodata-policy outline=1 --report looser.json
at_one=$(json looser.json outline_triangles)
[ "$(json ragged.json outline_triangles_at_one)" = "$at_one" ] || fail "$(json ragged.json outline_triangles_at_one) at one instead of $at_one"
holds "$at_one < 0.5 * $needed"
succeeds "$scarp" simplify ragged.asc ragged.obj -e 1 --overwrite
grep -q "outlines .*: --nodata-policy outline=1 takes $at_one$" "$logs/out" || fail "the summary does not tell what a tolerance of 1 takes"
succeeds "$scarp" simplify hill.asc hole.obj -e 1 --overwrite
if grep -q '^  outlines' "$logs/out"; then fail "a small outline is told of"; fi
[ ! -s "$logs/err" ] || fail "-q warns"

# A frame of -9999 around land of one height is reported; two heights that are both plausible are not.
make_raster frame.tif "-9999 if min(row, col, 343 - row, 402 - col) < 5 else 7"
try "$scarp" info frame.tif --no-suggest
grep -q "samples are exactly -9999, far below all others (7 to 7)" "$logs/out" "$logs/err" || fail "no word of -9999 around a flat raster"
make_raster steps.tif "0 if col < 5 else 7"
try "$scarp" info steps.tif --no-suggest
if grep -q "far below\|far above" "$logs/out" "$logs/err"; then fail "a step is taken for nodata"; fi

# Finite values beyond float32 are not nodata.
make_raster ramp.tif "col"
gdal_translate -q -ot Float64 -scale 0 402 0 4.02e39 ramp.tif over.tif
refuses 2 "over.tif: the value 3.5e+38 at column 35, row 0 is beyond what a float32 holds (3.4e38)" \
  "$scarp" simplify over.tif over.glb -e 1e37
refuses 2 "the value 3.5e+38 at column 35, row 0" "$scarp" simplify over.tif over.glb -e 1e37 --memory 200M

# Two undeclared values: each remedy in a warning leaves none.
need gdalwarp
awk 'BEGIN {
  print "ncols 60\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 10";
  for (r = 0; r < 40; ++r) {
    line = "";
    for (c = 0; c < 60; ++c) line = line (c < 5 ? "-9999 " : c > 50 ? "0 " : sprintf("%.1f ", 500 + r + c));
    print line;
  }
}' > two.asc
for given in "" "--nodata -9999" "--nodata 0"; do
  succeeds "$scarp" info two.asc --no-suggest $given
  grep -o 'gdalwarp -srcnodata .* NEW.tif' "$logs/err" > way || fail "no way out of two nodata values $given"
  eval "$(sed 's/NEW.tif/one.tif -q -overwrite/' way)"
  succeeds "$scarp" simplify one.tif one.glb -e 1 --report one.json --overwrite
  [ ! -s "$logs/err" ] || fail "the way out leads to another warning $given"
  [ "$(json one.json input void)" = $((14 * 40)) ] || fail "the way out misses samples: $(json one.json input void)"
done
