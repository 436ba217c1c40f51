#!/usr/bin/env bash
# --ridges: lines along crests and beds, preferred or kept. The bound holds, and the report lists the lines.
source "$(dirname "$0")/lib.sh"
need python3

# Two rotated crests and the descending valley between them; nodata.
python3 - <<'PYTHON'
def height(x, y):
    u = 0.93 * x + 0.37 * y
    return -9999 if 60 < x < 66 and 20 < y < 27 else 2 * abs(u % 50 - 25) + 0.3 * y + 0.4 * ((7 * x + 13 * y) % 5)
with open("hills.asc", "w") as file:
    file.write("ncols 80\nnrows 60\nxllcorner 1000\nyllcorner 2000\ncellsize 10\nNODATA_value -9999\n")
    for y in range(60):
        file.write(" ".join("%.2f" % height(x, y) for x in range(80)) + "\n")
PYTHON
cat > road.geojson << 'JSON'
{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
  {"type": "LineString", "coordinates": [[1012, 2110], [1740, 2560]]}}]}
JSON
cat > pond.geojson << 'JSON'
{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
  {"type": "Polygon", "coordinates": [[[1500, 2200], [1610, 2212], [1580, 2300], [1500, 2200]]]}}]}
JSON
cat > site.geojson << 'JSON'
{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
  {"type": "Polygon", "coordinates": [[[1100, 2100], [1760, 2130], [1700, 2500], [1150, 2480], [1100, 2100]]]}}]}
JSON
run() { succeeds "$scarp" simplify hills.asc "$@" -e 2 --ridges 10 --report r.json --overwrite; }
check() {
  holds "$(json r.json max_error) <= 2"
  [ "$(json r.json topology sound)" = true ] || fail "ridges make an unsound mesh: $*"
  holds "$(json r.json ridges ridges) >= 1"
  holds "$(json r.json ridges valleys) >= 2"
  holds "$(json r.json ridges height) == 10"
}
for effort in fast normal high; do
  run m.glb --effort "$effort"
  check "$effort"
  succeeds "$scarp" measure hills.asc m.glb --fail-above 2
  run m.glb --effort "$effort" --keep-ridges
  check "$effort --keep-ridges"
  run m.glb --effort "$effort" --breaklines road.geojson --water pond.geojson
  check "$effort --breaklines --water"
  [ "$(json r.json breaklines laid)" = 2 ] || fail "ridges are counted as breaklines"
  [ "$(json r.json breaklines lines)" = 2 ] || fail "ridges are counted as breaklines"
done
run m.glb --cutline site.geojson --breaklines road.geojson
check --cutline
[ "$(json r.json breaklines laid)" = 1 ] || fail "ridges are counted as breaklines beside a cutline"
succeeds "$scarp" measure hills.asc m.glb --cutline site.geojson --fail-above 2
run m.2dm --min-angle 20 --keep-ridges
check --min-angle
run m.glb --cliff 30
check --cliff
run m.stl --solid size=100mm --split 1x2
holds "$(json r.json max_error) <= 2"

for effort in fast normal; do
  succeeds "$scarp" simplify hills.asc m.glb -t 300 --ridges 10 --effort "$effort" --report r.json --overwrite
  holds "$(json r.json triangles) <= 300"
  holds "$(json r.json triangles) >= 200"
  holds "$(json r.json ridges valleys) >= 2"
done
refuses 1 "alone need" "$scarp" simplify hills.asc x.glb -t 6 --ridges 10 --keep-ridges

succeeds "$scarp" simplify hills.asc one.glb -e 2 --ridges 10 -j 1
grep -q "ridge.*valley.*vertices in all" "$logs/out" || fail "the summary does not tell of ridges"
succeeds "$scarp" simplify hills.asc two.glb -e 2 --ridges 10 -j 3
cmp one.glb two.glb || fail "-j 3 makes another mesh"

# Nothing is that prominent: the same mesh as without --ridges.
succeeds "$scarp" simplify hills.asc high.obj -e 2 --ridges 200 --report r.json --overwrite
succeeds "$scarp" simplify hills.asc none.obj -e 2 --report plain.json
[ "$(json r.json ridges ridges)" = 0 ] || fail "a ridge where there is none"
[ "$(json plain.json ridges)" = null ] || fail "a report tells of ridges that nobody asked for"
[ "$(grep -v '^#' high.obj)" = "$(grep -v '^#' none.obj)" ] || fail "--ridges changes a mesh without ridges"

for height in 0 -2 tall; do refuses 1 "--ridges" "$scarp" simplify hills.asc x.glb -e 2 --ridges "$height"; done
refuses 1 "--keep-ridges needs --ridges" "$scarp" simplify hills.asc x.glb -e 2 --keep-ridges
refuses 1 "--max-error" "$scarp" simplify hills.asc x.glb --tolerance hills.asc --ridges 10

# None is that high: a warning reports it.
succeeds "$scarp" simplify hills.asc none.obj -e 2 --ridges 1000 --overwrite
grep -q '^scarp: warning: --ridges 1000: no ridge or valley was found' "$logs/err" || fail "no word on ridges that are not there"
run none.obj
if grep -q 'was found' "$logs/err"; then fail "a warning about ridges that are there"; fi
refuses 1 "dominant" "$scarp" simplify hills.asc x.glb -e 2 --order dominant --ridges 10
