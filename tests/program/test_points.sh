#!/bin/bash
# Scattered points: recognised by name, proven, judged, refused with one message; the same from every format.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need awk python3

# A bumpy square kilometre in UTM coordinates with two decimals; some places occur twice.
awk 'BEGIN { srand(7); print "x,y,z"
  for (i = 0; i < 3000; i++) { x = rand() * 1000; y = rand() * 800
    printf "%.2f,%.2f,%.3f\n", 500000 + x, 4649000 + y, 300 + 40 * sin(x / 90) * cos(y / 70) + rand() }
  print "500500.00,4649400.00,310"; print "500500.00,4649400.00,330" }' >survey.csv

succeeds "$scarp" simplify survey.csv hills.glb -e 0.5 --report hills.json
! grep -q -- --boundary "$logs/err" || fail "points scattered evenly are warned of"
grep -q '3,002\|3002' "$logs/out" || fail "the summary does not count the points"
grep -q 'duplicates    1, the first' "$logs/out" || fail "the summary does not count duplicates"
python3 - <<'PY' || fail "the report"
import json, math
r = json.load(open("hills.json"))
assert r["input"]["points"] == 3002 and r["input"]["duplicates"] == 1, r["input"]
assert math.frexp(r["input"]["lattice_step"])[0] == 0.5, r["input"]  # room for free vertices in float32
assert r["max_error"] <= 0.5 and r["uncovered"] == 0 and r["samples"] == 3001
assert r["topology"]["sound"] and r["stopped_by"] == "max_error"
assert 500000 <= r["max_error_at"][0] <= 501000
PY
succeeds "$scarp" simplify survey.csv decimals.glb -e 0.5 --effort fast --report decimals.json -q
python3 -c 'import json; assert abs(json.load(open("decimals.json"))["input"]["lattice_step"] - 0.01) < 1e-12' ||
  fail "the lattice of fast effort is not that of the decimals"
succeeds "$scarp" measure survey.csv hills.glb --fail-above 0.5 --json
python3 -c 'import json,sys; r=json.load(sys.stdin); assert r["passed"] and r["samples"] == 3001' <"$logs/out" || fail "measure --json"
refuses 3 "exceeds 0.001" "$scarp" measure survey.csv hills.glb --fail-above 0.001 -q

# The mesh lies around the middle of the points and reports it; the judge moves it back.
for name in near.obj near.ply near.glb near.stl; do
  succeeds "$scarp" simplify survey.csv "$name" -e 1 --report near.json --overwrite -q
  succeeds "$scarp" measure survey.csv "$name" --fail-above 1 -q
done
python3 - <<'PY' || fail "the local frame of points"
import json
x, y = json.load(open("near.json"))["frame"]["origin"]
assert 500400 < x < 500600 and 4649300 < y < 4649500, (x, y)
corners = [list(map(float, row.split()[1:4])) for row in open("near.obj") if row.startswith("v ")]
assert max(max(abs(c[0]), abs(c[2])) for c in corners) < 600
PY
succeeds "$scarp" simplify survey.csv there.obj -e 1 --crs source -q
grep -Eq '^v 50[01][0-9.]* ' there.obj || fail "--crs source moves the points"
succeeds "$scarp" measure survey.csv there.obj --fail-above 1 -q
succeeds "$scarp" simplify survey.csv there.2dm -e 1 -q
grep -Eq '^ND 1 50[01]' there.2dm || fail "a 2DM does not lie where the points do"

# All vertex budgets, percentage goals, solids, exact reproduction.
succeeds "$scarp" simplify survey.csv few.ply -p 200 -q
succeeds "$scarp" simplify survey.csv part.obj -e 2% -q
succeeds "$scarp" simplify survey.csv exact.ply -e 0 -q
succeeds "$scarp" measure survey.csv exact.ply --fail-above 0 -q
succeeds "$scarp" simplify survey.csv solid.stl -e 1 --base 0 -q
succeeds "$scarp" measure survey.csv solid.stl --fail-above 1 -q

# The judge uses the policy stored in the mesh.
succeeds "$scarp" simplify survey.csv high.ply -e 0 --duplicates highest -q
succeeds "$scarp" measure survey.csv high.ply --fail-above 0 -q
refuses 3 "exceeds 0" "$scarp" measure survey.csv high.ply --fail-above 0 --duplicates lowest -q

# The same points in other formats give the same bytes, as does any number of threads.
tail -n +2 survey.csv | tr ',' ' ' >survey.xyz
tr ',' ';' <survey.csv | sed 's/$/\r/' >semicolons.csv
cp survey.xyz survey.points
succeeds "$scarp" simplify survey.csv a.obj -e 1 -j 1 -q
for other in survey.xyz semicolons.csv survey.points; do
  succeeds "$scarp" simplify "$other" b.obj -e 1 -j 4 -q --points --overwrite
  cmp <(grep -v '^#' a.obj) <(grep -v '^#' b.obj) || fail "$other gives another mesh"
done
succeeds "$scarp" simplify /dev/stdin c.obj -e 1 -q --points <survey.xyz
cmp <(grep -v '^#' a.obj) <(grep -v '^#' c.obj) || fail "a pipe gives another mesh"

if command -v ogr2ogr >/dev/null; then
  for format in GPKG:gpkg GeoJSON:geojson 'ESRI Shapefile:shp' FlatGeobuf:fgb; do
    file=vector.${format#*:}
    extra=()
    [ "${format#*:}" = geojson ] && extra=(-lco RFC7946=NO -lco COORDINATE_PRECISION=3)
    ogr2ogr -q -f "${format%:*}" "$file" survey.csv -a_srs EPSG:32611 -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y \
      -oo Z_POSSIBLE_NAMES=z -oo AUTODETECT_TYPE=YES -nlt PointZ "${extra[@]}" 2>/dev/null || continue
    succeeds "$scarp" simplify "$file" "$file.obj" -e 1 -q
    succeeds "$scarp" measure "$file" "$file.obj" --fail-above 1 -q
    cmp <(grep '^[vf]' a.obj) <(grep '^[vf]' "$file.obj") || fail "$file gives another mesh"
    grep -q 'EPSG:32611' "$file.obj" || fail "$file: the mesh does not know its CRS"
  done
  refuses 2 "no layer 'none'" "$scarp" simplify vector.gpkg x.glb -e 1 --layer none
  succeeds "$scarp" simplify vector.gpkg deg.glb -e 1 --crs EPSG:4326 -q
  succeeds "$scarp" simplify vector.gpkg local.glb -e 1 --crs local -q
  succeeds "$scarp" measure vector.gpkg local.glb --fail-above 1 -q
fi

# A mesh of a raster has a frame that points lack: the message names its source.
succeeds "$scarp" simplify "$dem" grid.ply -e 50 --crs grid -q
refuses 1 "grid.ply says of itself that its coordinates are the columns and rows" "$scarp" measure survey.csv grid.ply
refuses 1 "cannot be given in 'grid'" "$scarp" measure survey.csv grid.ply --crs grid
try "$scarp" measure survey.csv grid.ply --crs source --json
[ "$code" = 3 ] && grep -q 'covers no sample of survey.csv' "$logs/err" || fail "a mesh elsewhere ends with $code"
[ "$(json "$logs/out" max_error) $(json "$logs/out" passed)" = "null false" ] || fail "a mesh elsewhere has an error"
succeeds "$scarp" simplify "$dem" utm.ply -e 50 --crs EPSG:32612 -q
refuses 1 "utm.ply names that CRS as its own, --crs overrides it" "$scarp" measure survey.csv utm.ply

# A C that opens to the east: with a concave hull the mesh ends at the bay and contains every point.
awk 'BEGIN { srand(3); print "x,y,z"
  while (n < 3000) { x = rand() * 1000; y = rand() * 1000
    if (x > 400 && y > 300 && y < 700) continue
    printf "%.2f,%.2f,%.3f\n", 500000 + x, 4649000 + y, 300 + 20 * sin(x / 90) * cos(y / 70) + rand(); n++ } }' >bay.csv
for name in bay.ply bay.obj bay.glb; do
  succeeds "$scarp" simplify bay.csv "$name" -e 0.5 --boundary concave:80 --report bay.json --overwrite
  succeeds "$scarp" measure bay.csv "$name" --fail-above 0.5 -q
done
refuses 3 "gaps" "$scarp" measure bay.csv bay.ply --boundary hull --fail-above 0.5 -q
succeeds "$scarp" simplify bay.csv bay.stl -e 0.5 --boundary concave:80 -q
succeeds "$scarp" measure bay.csv bay.stl --boundary concave:80 --fail-above 0.5 -q
succeeds "$scarp" simplify bay.csv block.stl -e 0.5 --boundary concave:80 --base 0 -q
succeeds "$scarp" measure bay.csv block.stl --fail-above 0.5 -q
python3 - <<'PY' || fail "the mesh around the bay"
import json
r = json.load(open("bay.json"))
assert r["max_error"] <= 0.5 and r["uncovered"] == 0 and r["samples"] == r["input"]["points"] == 3000, r
assert r["topology"]["sound"] and r["topology"]["border_loops"] == 1 and r["input"]["boundary"] == "concave:80", r
rows = [row.split() for row in open("bay.obj")]
at = [(float(row[1]) + r["frame"]["origin"][0] - 500000, -float(row[3]) + r["frame"]["origin"][1] - 4649000)
      for row in rows if row[:1] == ["v"]]
area = 0
for row in rows:
    if row[:1] != ["f"]:
        continue
    a, b, c = (at[int(corner.split("/")[0]) - 1] for corner in row[1:])
    area += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
    x, y = ((a[k] + b[k] + c[k]) / 3 for k in (0, 1))
    assert not (x > 480 and 380 < y < 620), ("a triangle across the bay", a, b, c)
assert 0.95 * 760000 < area < 1.02 * 760000, area
PY
succeeds "$scarp" simplify bay.csv wide.ply -e 0.5 --boundary concave:1e9 -q
succeeds "$scarp" simplify bay.csv convex.ply -e 0.5 --report convex.json
boundary=$(json convex.json input suggested_boundary | tr -d '"')
grep -q "^scarp: warning: .* of the mesh lies across bays .* --boundary $boundary ends" "$logs/err" || fail "no warning of the bay"
succeeds "$scarp" simplify bay.csv no-bay.ply -e 0.5 --boundary "$boundary" --report no-bay.json
[ ! -s "$logs/err" ] || fail "the boundary that the warning names draws another"
python3 - <<'PY' || fail "the boundary that the warning names"
import json
bay, rest = (json.load(open(name)) for name in ("convex.json", "no-bay.json"))
assert rest["input"]["suggested_boundary"] is None and rest["input"]["on_hull"] > 2 * bay["input"]["on_hull"]
PY
succeeds "$scarp" simplify bay.csv hull.ply -e 0.5 --boundary hull
[ ! -s "$logs/err" ] || fail "--boundary hull is warned of"
python3 - <<'PY' || fail "a LENGTH beyond all edges is the convex hull"
wide, convex = (open(name, "rb").read().split(b"end_header\n", 1)[1] for name in ("wide.ply", "convex.ply"))
assert wide == convex
PY

# Impossible requests: one message, and nothing written.
: >empty.csv
printf 'x,y,z\n' >header.csv
printf '1,2,3\n4,5,nan\n7,8,10\n' >nan.csv
printf '1,2,3\n4,5,inf\n7,8,10\n' >inf.csv
printf '1,2,3\n4,5\n7,8,10\n' >short.csv
printf 'x,y,depth\n1,2,3\n' >names.csv
printf '1,1,3\n2,2,3\n5,5,9\n9,9,1\n' >line.csv
printf '1,1,3\n2,2,3\n1,1,9\n' >two.csv
head -c 3000 "$dem" >binary.csv
printf '1,2,3\n1,5 2,5 3\n2,3,4\n' >comma.csv
printf 'x,y,z\n0,0,0\n1e9,0,1\n0,1e9,2\n0.001,0.001,900\n0.002,0.001,-900\n' >wide.csv
{ cat survey.csv; echo '-9999999999,4649000,0'; } >far.csv
refuses 2 "empty.csv: the file is empty" "$scarp" simplify empty.csv x.glb -e 1
refuses 2 "header.csv: the file holds a header line and no points" "$scarp" simplify header.csv x.glb -e 1
refuses 2 "nan.csv: line 2: z is 'nan'" "$scarp" simplify nan.csv x.glb -e 1
refuses 2 "inf.csv: line 2: z is 'inf'" "$scarp" simplify inf.csv x.glb -e 1
refuses 2 "short.csv: line 2 has 2 columns, so that z is missing" "$scarp" simplify short.csv x.glb -e 1
refuses 2 "names.csv: line 1 names no column z" "$scarp" simplify names.csv x.glb -e 1
refuses 2 "line.csv: all points lie on one line" "$scarp" simplify line.csv x.glb -e 1
refuses 2 "two.csv: all points lie at two places" "$scarp" simplify two.csv x.glb -e 1
refuses 2 "binary.csv: line 1" "$scarp" simplify binary.csv x.glb -e 1
refuses 2 "wide.csv: the points at (0, 0) and (0.001, 0.001) cannot be told apart" \
  "$scarp" simplify wide.csv x.ply -e 0.5
try "$scarp" measure wide.csv hills.glb --fail-above 0.5
[ "$code" = 3 ] || fail "near points are not judged: $code"
refuses 2 "; the point at (-9999999999, 4649000) lies far from all others" \
  "$scarp" simplify far.csv x.ply -e 0.5
refuses 2 "comma.csv: line 2: '1,5' has a decimal comma" "$scarp" simplify comma.csv x.ply -e 0.5
refuses 2 "none.csv: no such file" "$scarp" simplify none.csv x.glb -e 1
refuses 2 "nan.csv: line 2" "$scarp" measure nan.csv hills.glb
refuses 1 "no goal" "$scarp" simplify survey.csv x.glb
refuses 1 "--band is for rasters" "$scarp" simplify survey.csv x.glb -e 1 --band 1
refuses 1 "--uvs is for rasters" "$scarp" simplify survey.csv x.glb -e 1 --uvs
refuses 1 "--map is for rasters" "$scarp" measure survey.csv hills.glb --map p.png
refuses 1 "--duplicates is for scattered points" "$scarp" simplify "$dem" x.glb -e 1 --duplicates mean
for boundary in 0 concave concave: concave:0 concave:-5 concave:nan concave:inf concave:5m alpha:5; do
  refuses 1 "--boundary $boundary is neither hull nor concave:LENGTH" \
    "$scarp" simplify survey.csv x.glb -e 1 --boundary "$boundary"
done
refuses 1 "--boundary is for scattered points" "$scarp" simplify "$dem" x.glb -e 1 --boundary concave:5
refuses 1 "--z-field is for scattered points" "$scarp" measure "$dem" hills.glb --z-field h
refuses 1 "--duplicates best is unknown" "$scarp" simplify survey.csv x.glb -e 1 --duplicates best
refuses 1 "10 vertices are too few" "$scarp" simplify survey.csv x.glb -p 10
refuses 1 "--base 400 is not below" "$scarp" simplify survey.csv x.glb -e 1 --base 400
refuses 1 "CRS" "$scarp" simplify survey.csv x.glb -e 1 --crs local
refuses 3 "float32" "$scarp" simplify survey.csv x.glb -e 0
refuses 4 "exists already" "$scarp" simplify survey.csv hills.glb -e 1
echo "points are simplified, judged and refused"
