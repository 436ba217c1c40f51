#!/usr/bin/env bash
# --cliff: walls need tens of triangles, the bound holds, and the report lists the walls.
source "$(dirname "$0")/lib.sh"
need python3

# A rotated house of 60 x 36 samples on a slope.
python3 - <<'PYTHON'
def height(x, y):
    u, v = 0.932 * (x - 50) + 0.362 * (y - 48), 0.932 * (y - 48) - 0.362 * (x - 50)
    return 0.1 * x + (10 if abs(u) < 30 and abs(v) < 18 else 0)
with open("house.asc", "w") as file:
    file.write("ncols 100\nnrows 100\nxllcorner 1000\nyllcorner 2000\ncellsize 2\nNODATA_value -9999\n")
    for y in range(100):
        file.write(" ".join("%.2f" % height(x, y) for x in range(100)) + "\n")
PYTHON
for effort in fast normal high; do
  succeeds "$scarp" simplify house.asc house.glb -e 0.5 --effort "$effort" --cliff 3 --report house.json --overwrite
  succeeds "$scarp" simplify house.asc plain.glb -e 0.5 --effort "$effort" --report plain.json --overwrite
  holds "$(json house.json max_error) <= 0.5"
  holds "$(json house.json triangles) <= 40"
  holds "$(json plain.json triangles) >= 2 * $(json house.json triangles)"
  [ "$(json house.json topology sound)" = true ] || fail "walls and $effort effort make an unsound mesh"
  [ "$(json house.json cliffs walls)" = 1 ] || fail "the report does not tell of one wall"
  succeeds "$scarp" measure house.asc house.glb --fail-above 0.5
done
[ "$(json plain.json cliffs)" = null ] || fail "a report tells of cliffs that nobody asked for"
holds "$(json house.json cliffs line_vertices) <= 16"
succeeds "$scarp" simplify house.asc one.glb -e 0.5 --cliff 3 -j 1
grep -Eq 'cliffs +1 wall \([0-9]+ vertices\)' "$logs/out" || fail "the summary does not tell of the wall"
succeeds "$scarp" simplify house.asc two.glb -e 0.5 --cliff 3 -j 2
cmp one.glb two.glb || fail "-j 2 makes another mesh"

# No step is that high: the same mesh as without --cliff.
succeeds "$scarp" simplify house.asc high.obj -e 0.5 --cliff 30 --report high.json
grep -q '^scarp: warning: --cliff 30: no wall was found' "$logs/err" || fail "no word on walls that are not there"
succeeds "$scarp" simplify house.asc none.obj -e 0.5
[ "$(json high.json cliffs walls)" = 0 ] || fail "a wall where there is none"
[ "$(grep -vc '^#' high.obj)" = "$(grep -vc '^#' none.obj)" ] || fail "--cliff changes a mesh without cliffs"

# With other lines, walls keep away from them.
cat > road.geojson << 'JSON'
{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
  {"type": "LineString", "coordinates": [[1002, 2010], [1190, 2160]]}}]}
JSON
cat > pond.geojson << 'JSON'
{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
  {"type": "Polygon", "coordinates": [[[1010, 2010], [1030, 2012], [1024, 2030], [1010, 2010]]]}}]}
JSON
for effort in fast normal high; do
  succeeds "$scarp" simplify house.asc both.glb -e 0.5 --effort "$effort" --cliff 3 --breaklines road.geojson \
    --water pond.geojson --report both.json --overwrite
  holds "$(json both.json max_error) <= 0.5"
  [ "$(json both.json topology sound)" = true ] || fail "walls and other lines make an unsound mesh"
  [ "$(json both.json breaklines laid)" = 2 ] || fail "lines of walls are counted as breaklines"
  holds "$(json both.json cliffs walls) >= 1"
done

refuses 1 "--cliff" "$scarp" simplify house.asc x.glb -e 0.5 --cliff 0
refuses 1 "--cliff" "$scarp" simplify house.asc x.glb -e 0.5 --cliff -2
refuses 1 "--cliff" "$scarp" simplify house.asc x.glb -e 0.5 --cliff tall
refuses 1 "--min-angle" "$scarp" simplify house.asc x.2dm -e 0.5 --min-angle 20 --cliff 3
refuses 1 "dominant" "$scarp" simplify house.asc x.glb -e 0.5 --order dominant --cliff 3
