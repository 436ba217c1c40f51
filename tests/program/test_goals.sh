#!/usr/bin/env bash
# Goals: which one ends the run; budgets are upper bounds.
source "$(dirname "$0")/lib.sh"
need python3 gdal_create

# run ARGUMENTS...: the report in r.json, the last line in $last.
run() {
  succeeds "$scarp" simplify "$dem" out.glb --report r.json --overwrite "$@"
  last=$(tail -n 1 "$logs/out")
}

run -e 20
by_error=$(json r.json triangles)
[ "$(json r.json stopped_by)" = '"max_error"' ] || fail "-e 20 is stopped by $(json r.json stopped_by)"

# A percentage is of the relief, 840.
run -e 2.5%
[ "$(json r.json goal max_error)" = 21.0 ] || fail "2.5% of 840 is $(json r.json goal max_error)"
[ "$(json r.json goal percent_of_relief)" = 2.5 ] || fail "percent_of_relief"
holds "$(json r.json max_error) <= 21"
grep -q '  max error .*(asked 21)' "$logs/out" || fail "the summary does not tell what was asked"

run -t 3000
[ "$(json r.json stopped_by)" = '"max_triangles"' ] || fail "-t is stopped by $(json r.json stopped_by)"
holds "$(json r.json triangles) <= 3000 && $(json r.json triangles) >= 2800"
grep -qE '^Reached the triangle budget of 3000, after [0-9.]+ s$' <<< "$last" || fail "the last line is: $last"

run -p 1000
[ "$(json r.json stopped_by)" = '"max_points"' ] || fail "-p is stopped by $(json r.json stopped_by)"
holds "$(json r.json vertices) <= 1000 && $(json r.json vertices) >= 930"
grep -qE '^Reached the point budget of 1000, after [0-9.]+ s$' <<< "$last" || fail "the last line is: $last"

# The first goal reached ends the run.
run -e 20 -t 500
[ "$(json r.json stopped_by)" = '"max_triangles"' ] || fail "-e 20 -t 500 is stopped by $(json r.json stopped_by)"
holds "$(json r.json triangles) <= 500 && $(json r.json max_error) > 20"
grep -q '  max error .*(asked 20, not reached)' "$logs/out" || fail "the summary does not tell that 20 was not reached"
run -e 20 -t 1000000 -p 1000000
[ "$(json r.json stopped_by)" = '"max_error"' ] || fail "a large budget stops the run"
[ "$(json r.json triangles)" = "$by_error" ] || fail "a large budget changes the mesh"

# More triangles than the samples allow: every sample is reproduced.
gdal_create -q -of GTiff -outsize 30 20 -bands 1 -burn 7 plain.tif
succeeds "$scarp" simplify plain.tif plain.obj -t 100000 --report r.json --overwrite
[ "$(json r.json stopped_by)" = '"exact"' ] || fail "a plain is stopped by $(json r.json stopped_by)"
[ "$(json r.json triangles)" = 2 ] || fail "a plain has $(json r.json triangles) triangles"
tail -n 1 "$logs/out" | grep -qE '^Reproduced every sample, after [0-9.]+ s$' || fail "the last line is: $(tail -n 1 "$logs/out")"
succeeds "$scarp" simplify plain.tif plain.obj -e 1% --overwrite

# A budget below the outline's minimum.
refuses 1 "" "$scarp" simplify "$dem" small.glb -t 1
refuses 1 "" "$scarp" simplify "$dem" small.glb -p 3

# Numbers as people type them.
run -t 3k
budget=$(json r.json goal max_triangles)
[ "$budget" = 3000 ] || fail "-t 3k asks for $budget triangles"
run -e 20 -t 1e5 -p 2M
[ "$(json r.json goal max_triangles)" = 100000 ] || fail "-t 1e5"
[ "$(json r.json goal max_points)" = 2000000 ] || fail "-p 2M"
gdal_translate -q "$dem" metres.tif
gdal_edit.py -units metre metres.tif 2> /dev/null || python3 - <<'PYTHON'
import subprocess
subprocess.run(["gdal_translate", "-q", "-of", "VRT", "metres.tif", "metres.vrt"], check=True)
text = open("metres.vrt").read()
open("metres.vrt", "w").write(text.replace("<ColorInterp>", "<UnitType>metre</UnitType><ColorInterp>", 1))
subprocess.run(["gdal_translate", "-q", "metres.vrt", "metres.tif"], check=True)
PYTHON
for goal in 20 20m 2000cm; do
  succeeds "$scarp" simplify metres.tif "by_$goal.obj" -e "$goal" --report r.json --overwrite
  [ "$(json r.json goal max_error)" = 20.0 ] || fail "-e $goal is $(json r.json goal max_error)"
  grep -v '^#' "by_$goal.obj" > mesh && [ "$(cksum < mesh)" = "${first:=$(cksum < mesh)}" ] || fail "-e $goal: another mesh"
  [ ! -s "$logs/err" ] || fail "-e $goal of metres warns: $(cat "$logs/err")"
done
succeeds "$scarp" simplify metres.tif out2.glb -e 60ft --report r.json --overwrite
holds "$(json r.json goal max_error) == 18.288 && $(json r.json max_error) <= 18.288"
succeeds "$scarp" simplify "$dem" out.glb -e 20m --overwrite
unit=$("$scarp" info "$dem" --json --no-suggest | python3 -c 'import json, sys; print(json.load(sys.stdin)["input"].get("unit") or "")')
if [ -z "$unit" ]; then
  grep -q 'does not tell the unit of its heights' "$logs/err" || fail "a goal in metres of heights without a unit passes in silence"
fi
