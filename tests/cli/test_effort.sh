#!/usr/bin/env bash
# --effort normal, high: half and two fifths of the triangles, the same promise, the same bytes on any number of threads.
source "$(dirname "$0")/lib.sh"
need python3

# The mesh is smaller by what QUALITY's measurements let expect (0.54 to 0.60), and every sample keeps the bound.
for error in 84 16.8 4.2; do
  succeeds "$scarp" simplify "$dem" fast.glb -e "$error" --report fast.json --overwrite
  succeeds "$scarp" simplify "$dem" normal.glb -e "$error" --effort normal --report normal.json --overwrite
  holds "$(json normal.json triangles) < 0.63 * $(json fast.json triangles)"
  succeeds "$scarp" measure "$dem" normal.glb --fail-above "$error"
  succeeds "$scarp" simplify "$dem" high.glb -e "$error" --effort high --report high.json --overwrite
  holds "$(json high.json triangles) < 0.95 * $(json normal.json triangles)"
  succeeds "$scarp" measure "$dem" high.glb --fail-above "$error"
done
[ "$(json fast.json strategy effort) $(json normal.json strategy effort) $(json high.json strategy effort)" = '"fast" "normal" "high"' ] ||
  fail "the report does not tell the effort"
python3 - normal.json <<'PYTHON'
import json, sys
passes = {p["name"]: p for p in json.load(open(sys.argv[1]))["passes"]}
assert passes["fit"]["removals"] > 1000 and passes["tiles"]["removals"] == 0, passes
PYTHON
grep -aq -- '--effort normal"' normal.glb || fail "the metadata does not tell the effort"

for effort in normal high; do
  # Solids, projections and formats go on from there.
  succeeds "$scarp" simplify "$dem" solid.stl -e 20 --effort "$effort" --base -100 --overwrite
  succeeds "$scarp" measure "$dem" solid.stl --fail-above 20
  succeeds "$scarp" simplify "$dem" utm.glb -e 20 --effort "$effort" --crs EPSG:32616 --overwrite
  succeeds "$scarp" measure "$dem" utm.glb --crs EPSG:32616 --fail-above 20
  succeeds "$scarp" simplify "$dem" greedy.obj -e 20 --effort "$effort" --order greedy --overwrite
  succeeds "$scarp" measure "$dem" greedy.obj --fail-above 20
  succeeds "$scarp" simplify "$dem" exact.ply -e 0 --effort "$effort" --overwrite
  succeeds "$scarp" measure "$dem" exact.ply --fail-above 0

  # Threads change nothing.
  for threads in 1 2 7; do
    succeeds "$scarp" simplify "$dem" "threads$threads.glb" -e 2 --effort "$effort" -j "$threads" --overwrite
    cmp threads1.glb "threads$threads.glb" || fail "-j $threads makes another mesh with $effort effort"
  done
done

# What removal has no place for is named.
for other in "-t 100" "-p 100" "--mask $dem" "--tolerance $dem" "--texture $dem" "--outline-tolerance 1" "--edges data"; do
  # shellcheck disable=SC2086
  refuses 1 "--effort normal and --" "$scarp" simplify "$dem" never.glb -e 20 --effort normal $other
done
refuses 1 "--effort high and --max-triangles" "$scarp" simplify "$dem" never.glb -e 20 --effort high -t 100
refuses 1 "--effort" "$scarp" simplify "$dem" never.glb -e 20 --effort much
refuses 1 "no goal" "$scarp" simplify "$dem" never.glb --effort normal
