#!/usr/bin/env bash
# The main job: a raster becomes a mesh, a preview and a report that agree with each other and with the judge.
source "$(dirname "$0")/lib.sh"
need python3

succeeds "$scarp" simplify "$dem" hills.glb -e 20 --preview hills.png --report hills.json
[ ! -s "$logs/err" ] || fail "something on stderr"
# The last line names the goal that ended the run, and does not repeat lines above.
tail -n 1 "$logs/out" | grep -Eq '^Reached the error goal, after [0-9.]+ s$' || fail "the last line is: $(tail -n 1 "$logs/out")"
for words in 'triangles  *[0-9,]* *, [0-9.]* % of the full grid.s 275,772' 'effort  *normal$' 'order  *dominant$' 'frame  *local metres' \
  'max error  *[0-9.]* at column [0-9]*, row [0-9]* (asked 20)$' '^  *at longitude -84\.[0-9]*, latitude 36\.[0-9]* in EPSG:4326$'; do
  grep -q "$words" "$logs/out" || fail "the summary does not tell '$words'"
done
[ "$(head -c 4 hills.glb)" = glTF ] || fail "hills.glb is no GLB"
[ "$(head -c 4 hills.png | tail -c 3)" = PNG ] || fail "hills.png is no PNG"

python3 - hills.json "$(wc -c < hills.glb)" <<'PYTHON'
import json, sys
r = json.load(open(sys.argv[1]))
assert list(r) == ["scarp", "command", "input", "frame", "goal", "strategy", "breaklines", "water", "rivers", "cliffs", "ridges", "shape", "cutline", "node_strings", "materials", "stopped_by", "vertices", "triangles",
                   "full_triangles", "outline_triangles", "outline_triangles_at_one", "max_error", "max_error_at", "rmse", "mean_error", "mean_abs_error", "p50", "p95", "p99", "p999", "ignored",
                   "max_error_place",
                   "samples", "uncovered", "stray", "void_cells_covered", "topology", "levels", "work", "passes", "seconds", "outputs",
                   "warnings"], list(r)
assert r["command"].startswith("scarp simplify ") and r["command"].endswith(" hills.glb -e 20 --preview hills.png --report hills.json")
i = r["input"]
assert (i["cols"], i["rows"], i["valid"], i["void"], i["filled"]) == (403, 344, 403 * 344, 0, 0)
assert (i["min"], i["max"], i["crs"], i["geographic"], i["sample_type"]) == (236, 1076, "EPSG:4326", True, "Int16")
assert r["frame"]["kind"] == "local"
assert r["goal"] == {"max_error": 20, "percent_of_relief": None, "max_triangles": None, "max_points": None}
assert r["stopped_by"] == "max_error"
assert r["full_triangles"] == 2 * 402 * 343
assert 10 < r["max_error"] <= 20 and 0 < r["rmse"] < r["max_error"] and abs(r["mean_error"]) <= r["mean_abs_error"] <= r["rmse"]
assert r["p50"] <= r["p95"] <= r["p99"] <= r["p999"] <= r["max_error"] * 1.001
c, w = r["max_error_at"]
assert 0 <= c < 403 and 0 <= w < 344
assert r["samples"] == 403 * 344 and r["uncovered"] == 0 and r["stray"] == 0 and r["void_cells_covered"] == 0
t = r["topology"]
assert t["sound"] and not t["closed"] and t["border_loops"] == 1 and t["overlaps"] == 0 and t["down_facing"] == 0
# Euler: a disc whose border has equally many vertices and edges.
assert r["triangles"] == 2 * r["vertices"] - 2 - t["open_edges"], (r["vertices"], r["triangles"], t["open_edges"])
assert list(r["seconds"]) == ["read", "refine", "measure", "write", "total"] and all(s >= 0 for s in r["seconds"].values())
assert r["outputs"] == [{"path": "hills.glb", "format": "glb", "bytes": int(sys.argv[2])},
                        {"path": "hills.png", "format": "png", "bytes": r["outputs"][1]["bytes"]}]
assert r["warnings"] == []
PYTHON

# The independent judge finds the same numbers for the file.
"$scarp" measure "$dem" hills.glb --json --fail-above 20 > judged.json
for key in vertices triangles samples uncovered; do
  [ "$(json hills.json $key)" = "$(json judged.json $key)" ] || fail "$key differs between the report and the judge"
done
holds "$(json judged.json max_error) - $(json hills.json max_error) < 1e-6 && $(json hills.json max_error) - $(json judged.json max_error) < 1e-6"

# The mesh's metadata describe it, without the path where it was made.
json judged.json mesh metadata > metadata.json
[ "$(json metadata.json generator)" = "\"Scarp $("$scarp" --version | cut -d' ' -f2)\"" ] || fail "generator"
[ "$(json metadata.json command)" = '"scarp simplify jacksboro_fault.tif OUTPUT --max-error 20"' ] || fail "command: $(cat metadata.json)"
json metadata.json frame | grep -q 'local metres' || fail "frame"
json metadata.json error | grep -q 'asked.*20.*max_error.*rmse.*samples.*138632' || fail "error: $(cat metadata.json)"
if grep -q "$root" hills.glb; then fail "the mesh names a folder"; fi

# -e 0 reproduces every sample.
succeeds "$scarp" simplify "$dem" exact.ply -e 0 --report exact.json
holds "$(json exact.json max_error) == 0"
succeeds "$scarp" measure "$dem" exact.ply --fail-above 0
holds "$(json exact.json triangles) <= 275772"

# A solid: closed, sound, and within the bound.
succeeds "$scarp" simplify "$dem" solid.stl -e 20 --base 100 --report solid.json
"$scarp" measure "$dem" solid.stl --json --fail-above 20 > judged.json
[ "$(json judged.json topology closed)" = true ] || fail "the solid is open"
[ "$(json judged.json triangles)" = "$(json solid.json solid triangles)" ] || fail "the report's solid is another"
[ "$(json solid.json triangles)" = "$(json hills.json triangles)" ] || fail "the base changes the terrain's count"
holds "$(json solid.json solid triangles) > $(json solid.json triangles)"

# -q and the remaining output.
succeeds "$scarp" simplify "$dem" quiet.obj -e 100 -q
[ ! -s "$logs/out" ] && [ ! -s "$logs/err" ] || fail "-q is not quiet"
for words in "" simplify measure info; do
  # shellcheck disable=SC2086
  succeeds "$scarp" $words --help
  grep -q 'Usage: scarp' "$logs/out" || fail "no help for '$words'"
done
succeeds "$scarp" simplify --version
grep -Eq '^scarp [0-9]+\.[0-9]+\.[0-9]+$' "$logs/out" || fail "--version"
