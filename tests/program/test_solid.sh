#!/bin/bash
# Solids for printing, whole and in print tiles: of the requested size, closed by admesh and the 3MF consortium's
# library, and within the bound by measure. Impossible ones are refused with one message.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# admesh_likes FILE: closed, outward, nothing to repair.
admesh_likes() {
  command -v admesh >/dev/null || return 0
  admesh "$1" >admesh.txt
  for fault in 'Total disconnected facets' 'Degenerate facets' 'Edges fixed' 'Facets removed' 'Facets reversed' 'Backwards edges'; do
    awk -F: -v text="$fault" 'index($0, text) {split($2, n, " "); exit n[1] != 0}' admesh.txt || fail "admesh: $fault in $1"
  done
  rm admesh.txt
}
# lib3mf_likes FILE OBJECTS TRIANGLES
lib3mf_likes() {
  [ -x "$SCARP_BUILD/bin/scarp_read_3mf" ] || return 0
  "$SCARP_BUILD/bin/scarp_read_3mf" "$1" >objects.txt || fail "lib3mf has objections to $1"
  awk -v objects="$2" -v triangles="$3" '{sum += $2; bad += $3 != 1} END {exit !(NR == objects && sum == triangles && bad == 0)}' objects.txt ||
    fail "lib3mf finds other objects in $1: $(cat objects.txt)"
  rm objects.txt
}
command -v admesh >/dev/null || echo "left out: admesh"
[ -x "$SCARP_BUILD/bin/scarp_read_3mf" ] || echo "left out: lib3mf (lib3mf-dev)"

# A whole print. The outline is a rectangle with 4 corners: the walls have one triangle per border edge plus 4, the base
# has 2.
succeeds "$scarp" simplify "$dem" whole.stl -e 20 --solid size=120mm,exaggerate=2,walls --report whole.json
admesh_likes whole.stl
[ "$(json whole.json solid pieces 0 closed)" = true ] || fail "the solid is not closed"
holds "$(json whole.json solid pieces 0 size 1) <= 120 && $(json whole.json solid pieces 0 size 1) > 119.998"
holds "$(json whole.json solid max_error) <= 20"
holds "$(json whole.json solid pieces 0 volume) > 0"
added=$(($(json whole.json solid triangles) - $(json whole.json triangles)))
holds "$(json whole.json solid vertices) == $(json whole.json vertices) + 4"
holds "$added < 500"
"$scarp" measure "$dem" whole.stl --fail-above 20 --json >judged.json || fail "the print breaks the bound"
[ "$(json judged.json topology closed)" = true ] || fail "measure finds the print open"
holds "$(json judged.json uncovered) == 0 && $(json judged.json max_error) == $(json whole.json solid max_error)"
for format in 3mf obj ply; do
  succeeds "$scarp" simplify "$dem" whole.$format -e 20 --solid size=120mm,exaggerate=2 -q
  "$scarp" measure "$dem" whole.$format --fail-above 20 --json >again.json || fail "$format breaks the bound"
  holds "$(json again.json triangles) == $(json judged.json triangles)"
  holds "$(json again.json max_error) == $(json judged.json max_error)"
done
lib3mf_likes whole.3mf 1 "$(json whole.json solid triangles)"
succeeds "$scarp" simplify "$dem" again.3mf -e 20 --solid size=120mm,exaggerate=2 -q -j 3
cmp again.3mf whole.3mf || fail "a 3MF file depends on threads or the time"

# Base and thickness: in the raster's units and on the print.
succeeds "$scarp" simplify "$dem" base.stl -e 50 --solid base=100 --report base.json
[ "$(json base.json solid base)" = 100.0 ] || fail "the base is not at 100"
[ "$(json base.json solid unit)" = null ] || fail "a solid without a size has a unit"
succeeds "$scarp" measure "$dem" base.stl --fail-above 50
succeeds "$scarp" simplify "$dem" thick.stl -e 50 --solid size=10cm,thickness=3mm --report thick.json
lowest=$(json thick.json input min)
holds "($lowest - $(json thick.json solid base)) * $(json thick.json solid scale 2) > 2.8"

# Nodata areas are holes through the solid, and parts that touch in a point are separate.
make_raster voids.tif 'nan if (col // 40 + row // 40) % 3 == 0 and col % 40 < 30 else 100 + col + row if (col, row) != (5, 5) else nan'
make_raster board.tif 'nan if (col % 2 == 0) != (row % 3 == 0) and col < 20 else 10 * math.sin(col / 9) + row / 5'
for raster in voids board; do
  succeeds "$scarp" simplify $raster.tif $raster.stl -e 2 --solid size=200mm --report $raster.json
  admesh_likes $raster.stl
  succeeds "$scarp" simplify $raster.tif $raster.3mf -e 2 --solid size=200mm
  lib3mf_likes $raster.3mf 1 "$(json $raster.json solid triangles)"
  succeeds "$scarp" measure $raster.tif $raster.3mf --fail-above 2
done

# Print tiles: files or objects that together form the whole.
succeeds "$scarp" simplify "$dem" cut.stl -e 20 --solid size=400mm,base=0 --split 2x3,joint=dovetail --report cut.json
[ "$(ls cut-r?-c?.stl | wc -l)" = 6 ] || fail "not six print tiles: $(ls)"
[ ! -e cut.stl ] || fail "the whole is there too"
for sheet in cut-r?-c?.stl; do admesh_likes "$sheet"; done
succeeds "$scarp" simplify "$dem" one.stl -e 20 --solid size=400mm,base=0 --report one.json
python3 - cut.json one.json <<'PYTHON' || fail "the print tiles are not the whole"
import json, sys
cut, one = (json.load(open(f))["solid"] for f in sys.argv[1:])
assert [(p["row"], p["column"]) for p in cut["pieces"]] == [(r, c) for r in (1, 2, 3) for c in (1, 2)]
assert all(p["closed"] and p["path"] == "cut-r%d-c%d.stl" % (p["row"], p["column"]) for p in cut["pieces"])
volumes = sum(p["volume"] for p in cut["pieces"]), one["pieces"][0]["volume"]
assert abs(volumes[0] / volumes[1] - 1) < 0.01, volumes   # two meshes of one terrain
assert cut["uncovered"] == 0 and cut["max_error"] <= 20
PYTHON
succeeds "$scarp" simplify "$dem" cut.3mf -e 20 --solid size=400mm,base=0 --split 2x3,joint=dovetail
lib3mf_likes cut.3mf 6 "$(json cut.json solid triangles)"
"$scarp" measure "$dem" cut.3mf --json >judged.json
holds "$(json judged.json uncovered) == 0 && $(json judged.json max_error) <= 20"

# With a gap print tiles are separate, and samples in it have no surface.
succeeds "$scarp" simplify "$dem" gap.3mf -e 20 --solid size=400mm --split 3x2,joint=dovetail,gap=1mm --report gap.json
lib3mf_likes gap.3mf 6 "$(json gap.json solid triangles)"
holds "$(json gap.json solid uncovered) > 0"
"$scarp" measure "$dem" gap.3mf --json >judged.json
holds "$(json judged.json uncovered) == $(json gap.json solid uncovered) && $(json judged.json max_error) <= 20"
holds "$(json judged.json topology overlaps) + $(json judged.json topology non_manifold_edges) == 0"

# The same for samples in their file, whole and in print tiles.
succeeds "$scarp" generate fractal 1300 1000 wide.tif --seed 2 -q
for split in "" "--split 2x2,joint=dovetail,gap=0.3mm"; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify wide.tif small.3mf -e 40 --solid size=120mm $split --memory 80M -j 1 --report small.json --overwrite
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify wide.tif two.3mf -e 40 --solid size=120mm $split --memory 80M -j 2 --overwrite
  cmp small.3mf two.3mf || fail "-j 2 makes another print"
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify wide.tif held.3mf -e 40 --solid size=120mm $split --report held.json --overwrite
  holds "$(json small.json solid max_error) <= 40"
  [ "$(json small.json solid uncovered)" = "$(json held.json solid uncovered)" ] || fail "other samples lie in gaps than in memory"
  [ "$(json small.json solid scale)" = "$(json held.json solid scale)" ] || fail "another size than in memory"
  sheets=1
  [ -z "$split" ] || sheets=4
  lib3mf_likes small.3mf $sheets "$(json small.json solid triangles)"
done

# Errors in millimetres of the print, and a hint if it is nearly flat. By hand: 120 mm are 31,719 m on the longer side.
succeeds "$scarp" simplify "$dem" mm.stl -e 0.05mm --solid size=120mm,exaggerate=3 --report mm.json
holds "$(json mm.json solid max_error) * $(json mm.json solid scale 2) <= 0.05"
holds "$(json mm.json solid max_error) * $(json mm.json solid scale 2) >= 0.03"
holds "$(json mm.json solid scale 2) * $(json mm.json goal max_error) - 0.05 < 1e-9"
if grep -q 'hint' "$logs/out"; then fail "9.4 mm of relief are called flat"; fi
succeeds "$scarp" simplify "$dem" flat.stl -e 0.05mm --solid size=120mm
grep -q 'the relief is 3.2 mm on the print; --solid exaggerate=3 makes it 9.5 mm' "$logs/out" ||
  fail "no hint for a flat print: $(cat "$logs/out")"
# Within a cutline the print's scale is larger than for the whole raster.
echo '{"type":"Polygon","coordinates":[[[-84.3,36.25],[-84.2,36.25],[-84.2,36.35],[-84.3,36.35],[-84.3,36.25]]]}' >part.geojson
succeeds "$scarp" simplify "$dem" part.stl -e 0.2mm --solid size=120mm --cutline part.geojson --report part.json
holds "$(json part.json solid max_error) * $(json part.json solid scale 2) <= 0.2"
holds "$(json part.json goal max_error) * $(json part.json solid scale 2) <= 0.2000001"

# Points: the file is judged where it was made.
python3 - >points.csv <<'EOF'
import math, random
random.seed(5)
print("x,y,z")
for _ in range(3000):
    x, y = random.uniform(0, 900), random.uniform(0, 700)
    print(f"{500000 + x:.2f},{4649000 + y:.2f},{60 * math.sin(x / 150) * math.cos(y / 110) + random.uniform(0, 3):.2f}")
EOF
for format in stl 3mf; do
  succeeds "$scarp" simplify points.csv points.$format -e 0.3mm --solid size=100mm,thickness=2mm --report points.json --overwrite
  holds "$(json points.json solid max_error) * $(json points.json solid scale 2) <= 0.3"
  holds "$(json points.json solid pieces 0 size 0) <= 100 && $(json points.json solid pieces 0 size 0) > 99.99"
  "$scarp" measure points.csv points.$format --json >judged.json || fail "a print of points breaks the bound"
  [ "$(json judged.json topology closed)" = true ] || fail "measure finds the print of points open"
  holds "$(json judged.json uncovered) == 0 && $(json judged.json max_error) == $(json points.json solid max_error)"
done
admesh_likes points.stl
lib3mf_likes points.3mf 1 "$(json points.json solid triangles)"
refuses 1 "--split is for rasters" "$scarp" simplify points.csv x.stl -e 2 --solid size=100 --split 2x2
refuses 3 "positions in the print are rounded to float32" "$scarp" simplify points.csv x.stl -e 0 --solid size=100

# Refusals.
refuses 1 "no key bse: choose base, thickness, size, exaggerate or walls" "$scarp" simplify "$dem" x.stl -e 20 --solid bse=1
refuses 1 "base=300 is not below the lowest vertex, which is at 2" "$scarp" simplify "$dem" x.stl -e 20 --solid base=300
refuses 1 "GLB has no place for millimetres" "$scarp" simplify "$dem" x.glb -e 20 --solid size=100
refuses 1 "3MF holds closed solids only" "$scarp" simplify "$dem" x.3mf -e 20
refuses 1 "120kg is no length above 0" "$scarp" simplify "$dem" x.stl -e 20 --solid size=120kg
refuses 1 "needs the size of the print" "$scarp" simplify "$dem" x.stl -e 20 --solid thickness=3mm
refuses 1 "base cannot be combined with thickness" "$scarp" simplify "$dem" x.stl -e 20 --solid base=0,thickness=3
refuses 1 "--split needs --solid" "$scarp" simplify "$dem" x.stl -e 20 --split 2x2
refuses 1 "no COLUMNSxROWS" "$scarp" simplify "$dem" x.stl -e 20 --solid size=100 --split 3
# Comparing ten thousand names is fast.
succeeds "$scarp" generate smooth 40 30 small.tif -q
refuses 1 "cannot be cut into 100 columns" "$scarp" simplify small.tif x.stl -e 20 --solid size=100 --split 100x100
refuses 1 "no key jiont" "$scarp" simplify "$dem" x.stl -e 20 --solid size=100 --split 2x2,jiont=dovetail
refuses 1 "each needs 12 cells" "$scarp" simplify "$dem" x.stl -e 20 --solid size=100 --split 9x40,joint=dovetail
refuses 1 "too wide" "$scarp" simplify "$dem" x.stl -e 20 --solid size=100 --split 2x2,gap=30mm
for goal in "-t 1500" "-e 60 --cliff 150" "-t 1500 --cliff 150"; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify "$dem" budget.3mf $goal --solid size=100 --split 2x2 --report budget.json --overwrite
  holds "$(json budget.json solid uncovered) == 0"
  holds "$(json budget.json solid max_error) <= 1.001 * $(json budget.json max_error)"
done
holds "$(json budget.json triangles) <= 1500"
refuses 1 "which --crs bends" "$scarp" simplify "$dem" x.stl -e 20 --crs EPSG:32617 --solid size=100 --split 2x2
refuses 1 "--solid cannot be combined with --base" "$scarp" simplify "$dem" x.stl -e 20 --base 0 --solid size=100
refuses 3 "rounded to float32" "$scarp" simplify "$dem" x.stl -e 0 --solid size=100
touch old-r2-c1.stl
refuses 4 "old-r2-c1.stl exists" "$scarp" simplify "$dem" old.stl -e 20 --solid size=100 --split 2x2
echo "solids and print tiles are closed, and keep the bound"
