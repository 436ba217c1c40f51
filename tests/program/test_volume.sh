#!/bin/bash
# scarp measure --volume: its table, its report, frames that are brought together, and what it refuses.
source "$(dirname "$0")/lib.sh"
need python3

succeeds "$scarp" simplify "$dem" coarse.glb -e 20 -q
succeeds "$scarp" simplify "$dem" fine.glb -e 5 -q

# 1. The table: both files by name, the uncertainty in the same line; quiet; the same for any number of threads.
succeeds "$scarp" measure coarse.glb fine.glb --volume
cp "$logs/out" table.txt
grep -q '^volumes from coarse.glb to fine.glb$' table.txt || fail "the table does not name the files"
grep -Eq '^  cut  *[0-9,]+ m³ ± 2[0-9],[0-9,]+ m³, where fine.glb lies below coarse.glb$' table.txt || fail "no cut: $(< table.txt)"
grep -Eq '^  fill  *[0-9,]+ m³ ± 2[0-9],[0-9,]+ m³, where it lies above$' table.txt || fail "no fill: $(< table.txt)"
grep -Eq '^  net  *[0-9,]+ m³ ± 2[0-9],[0-9,]+ m³, more (cut than fill|fill than cut)$' table.txt || fail "no net: $(< table.txt)"
grep -Eq '^  common area  *95[0-9],[0-9]{3},[0-9]{3} m²$' table.txt || fail "no area: $(< table.txt)"
grep -Eq '^  outside it  *0 m² of coarse.glb, 0 m² of fine.glb$' table.txt || fail "no area outside: $(< table.txt)"
grep -Eq '^  uncertainty  *max errors times the common area: coarse.glb 20 m and fine.glb [0-5][.0-9]* m$' table.txt ||
  fail "no errors: $(< table.txt)"
for threads in 1 4; do
  succeeds "$scarp" measure coarse.glb fine.glb --volume -j $threads
  cmp "$logs/out" table.txt || fail "-j $threads prints other volumes"
done
succeeds "$scarp" measure coarse.glb fine.glb --volume -q
[ ! -s "$logs/out" ] && [ ! -s "$logs/err" ] || fail "-q is not quiet"

# 2. The report; both ways; and what the bounds imply.
succeeds "$scarp" measure coarse.glb fine.glb --volume --json -j 1
cp "$logs/out" forth.json
succeeds "$scarp" measure fine.glb coarse.glb --volume --json -j 4
cp "$logs/out" back.json
succeeds "$scarp" measure fine.glb fine.glb --volume --json
cp "$logs/out" self.json
succeeds "$scarp" measure coarse.glb level=0 --volume --json
cp "$logs/out" above_coarse.json
succeeds "$scarp" measure --volume level=0 fine.glb --json
cp "$logs/out" above_fine.json
python3 - <<'PYTHON' || fail "the report is wrong"
import json
forth, back, same, coarse, fine = (json.load(open(f"{name}.json")) for name in ("forth", "back", "self", "above_coarse", "above_fine"))
assert list(forth) == ["scarp", "command", "from", "to", "cut", "fill", "net", "uncertainty", "common_area", "volume_unit",
                       "area_unit", "seconds"], list(forth)
assert list(forth["from"]) == ["path", "level", "triangles", "max_error", "outside", "metadata"], list(forth["from"])
assert forth["from"]["path"] == "coarse.glb" and forth["to"]["level"] is None and forth["from"]["max_error"] == 20
assert forth["volume_unit"] == "m³" and forth["area_unit"] == "m²"
assert forth["net"] == forth["cut"] - forth["fill"] == -back["net"]
assert forth["cut"] == back["fill"] and forth["fill"] == back["cut"] and forth["common_area"] == back["common_area"]
bound = (forth["from"]["max_error"] + forth["to"]["max_error"]) * forth["common_area"]
assert forth["uncertainty"] == bound and 0 < forth["cut"] + forth["fill"] < bound
assert same["cut"] == same["fill"] == 0 and same["to"]["outside"] == 0
assert coarse["to"] == {"path": None, "level": 0, "triangles": 0, "max_error": 0, "outside": 0, "metadata": {}}, coarse["to"]
assert coarse["fill"] == 0 and fine["cut"] == 0 and fine["from"]["level"] == 0
assert abs(coarse["cut"] - fine["fill"] - forth["net"]) < 1e-9 * coarse["cut"]
PYTHON

# 3. A level in the middle; a text that is no number.
succeeds "$scarp" measure fine.glb --volume level=512.5
grep -q '^volumes from fine.glb to level 512.5$' "$logs/out" || fail "no level in the table"
grep -Eq '^  cut .*, where level 512.5 lies below fine.glb$' "$logs/out" || fail "no cut above the level"
grep -q 'outside' "$logs/out" && fail "a level has an area"
refuses 1 "level high is not a finite number" "$scarp" measure fine.glb level=high --volume
refuses 1 "both are levels" "$scarp" measure level=3 level=4 --volume
refuses 1 "MESH is required" "$scarp" measure fine.glb --volume
refuses 1 "compares two surfaces, and 3 are given" "$scarp" measure fine.glb coarse.glb fine.glb --volume
refuses 2 "no such file" "$scarp" measure fine.glb 512.5 --volume

# 4. Files of any format; those that hold no bound.
succeeds "$scarp" simplify "$dem" fine.stl -e 5 -q
succeeds "$scarp" measure fine.glb fine.stl --volume
grep -Eq '^  cut  *[0-9.e-]+ m³, where' "$logs/out" || fail "an uncertainty of a mesh that holds no bound"
grep -q 'uncertainty  *not known: fine.stl holds no max error$' "$logs/out" || fail "no word on the bound"
succeeds "$scarp" measure fine.glb fine.stl --volume --json
holds "$(json "$logs/out" cut) + $(json "$logs/out" fill) < 1" # both round to the same float32
[ "$(json "$logs/out" uncertainty)" = null ] || fail "an uncertainty of a mesh that holds no bound"

# 5. Frames: two rasters of one place, each around its own centre; windows overlap in part.
need gdal_translate gdalwarp
gdalwarp -q -t_srs EPSG:32616 -tr 60 60 -r bilinear -te 735000 4008000 759000 4032000 "$dem" utm.tif
gdal_translate -q -srcwin 0 0 300 400 utm.tif west.tif
gdal_translate -q -srcwin 100 0 300 400 utm.tif east.tif
for name in west east; do
  succeeds "$scarp" simplify $name.tif $name.glb -e 2 -q
  succeeds "$scarp" simplify $name.tif $name.obj -e 2 -q --crs source
done
for pair in "west.glb east.glb" "west.glb east.obj" "west.obj east.glb" "west.obj east.obj"; do
  succeeds "$scarp" measure $pair --volume --json
  cp "$logs/out" pair.json
  # 199 of 299 columns, 399 rows; cells of the local frame are rounded by less than 0.03 %.
  holds "$(json pair.json common_area) > 0.999 * 199 * 399 * 3600 && $(json pair.json common_area) < 1.001 * 199 * 399 * 3600"
  holds "$(json pair.json from outside) > 0.999 * 100 * 399 * 3600 && $(json pair.json to outside) > 0.999 * 100 * 399 * 3600"
  holds "$(json pair.json cut) + $(json pair.json fill) < $(json pair.json uncertainty)"
  [ "$(json pair.json volume_unit)" = '"m\u00b3"' ] || fail "no cubic metres: $pair"
done
gdal_translate -q -a_srs EPSG:2274 -a_ullr 0 24000 24000 0 utm.tif feet.tif
succeeds "$scarp" simplify feet.tif feet.obj -e 9 -q --crs source
succeeds "$scarp" measure feet.obj level=500 --volume
grep -Eq '^  cut .* us-ft³' "$logs/out" || fail "no cubic feet"
succeeds "$scarp" generate fractal 40 36 cells.tif -q
succeeds "$scarp" simplify cells.tif cells.glb -e 9 -q
succeeds "$scarp" measure cells.glb level=500 --volume
grep -Eq '^  cut .* cubic units' "$logs/out" || fail "cells have a unit"

# 6. What is no surface, or in no frame that fits: one sentence, and the way out.
refuses 2 "make one of it, scarp simplify $dem $dem.glb -e 1" "$scarp" measure "$dem" fine.glb --volume
succeeds "$scarp" simplify "$dem" degrees.glb -e 20 -q --crs source
refuses 2 "degrees.glb has x and y in degrees, in which there is no area: make it with --crs local" \
  "$scarp" measure degrees.glb level=3 --volume
succeeds "$scarp" simplify "$dem" enu.glb -e 20 -q --crs enu
refuses 2 "enu.glb lies in space, where z is no height: make it with --crs local" "$scarp" measure fine.glb enu.glb --volume
refuses 2 "fine.glb lies in EPSG:4326, and west.glb in EPSG:32616: make both with one --crs" "$scarp" measure fine.glb west.glb --volume
succeeds "$scarp" simplify "$dem" fine.obj -e 5 -q --crs EPSG:32616
succeeds "$scarp" measure fine.obj west.obj --volume
refuses 2 "have no area in common: the one lies at x" "$scarp" measure west.obj fine.stl --volume
succeeds "$scarp" simplify "$dem" solid.glb -e 20 -q --base 0
refuses 2 "solid.glb is a closed solid" "$scarp" measure fine.glb solid.glb --volume
refuses 2 "solid.glb is a closed solid" "$scarp" measure level=4 solid.glb --volume
succeeds "$scarp" simplify "$dem" plain.obj -e 20 -q --up z
awk '$1 == "f" && ++k == 7 { t = $3; $3 = $4; $4 = t } { print }' plain.obj > flipped.obj
refuses 2 "flipped.obj has a triangle, number 6, that faces down" "$scarp" measure flipped.obj fine.glb --volume
awk '{ print } $1 == "f" && ++k == 7' plain.obj > doubled.obj
refuses 2 "doubled.obj has 1 pair of triangles that overlap" "$scarp" measure doubled.obj level=3 --volume
refuses 1 "--volume cannot be combined with --fail-above: volumes lie between surfaces, without samples" \
  "$scarp" measure coarse.glb fine.glb --volume --fail-above 3
refuses 1 "--volume cannot be combined with --map" "$scarp" measure coarse.glb fine.glb --volume --map m.png
