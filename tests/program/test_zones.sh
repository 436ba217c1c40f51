#!/bin/bash
# Materials by polygon and node strings along lines in a 2DM, by the records of the file.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need python3

python3 - <<'PY'
import json
def box(x0, y0, x1, y1): return [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]]
def zone(material, *rings):
    return {"type": "Feature", "properties": {"mat": material}, "geometry": {"type": "Polygon", "coordinates": rings}}
def write(name, features): json.dump({"type": "FeatureCollection", "features": features}, open(name, "w"))
zones = [zone(5, box(-84.35, 36.25, -84.25, 36.35)),
         zone(7, box(-84.25, 36.25, -84.2, 36.35), box(-84.24, 36.28, -84.22, 36.3))]
write("zones.geojson", zones)
line = {"type": "Feature", "properties": {}, "geometry":
        {"type": "LineString", "coordinates": [[-84.38, 36.2], [-84.3, 36.22], [-84.2, 36.2]]}}
write("strings.geojson", [line])
write("half.geojson", [zone(2.5, box(-84.35, 36.25, -84.25, 36.35))])
PY

for effort in fast normal high; do
  succeeds "$scarp" simplify "$dem" flow.2dm -e 20 --crs source --effort "$effort" --materials zones.geojson \
    --material-field mat --node-strings strings.geojson --min-angle 15 --report r.json --overwrite
  cp "$logs/out" summary
  succeeds "$scarp" measure "$dem" flow.2dm --fail-above 20 -q
  python3 - <<'PY' || fail "materials or node strings with $effort effort"
import json
nodes, triangles, strings, open_string = {}, [], [], []
for row in open("flow.2dm"):
    word = row.split()
    if word[0] == "ND": nodes[int(word[1])] = tuple(map(float, word[2:5]))
    if word[0] == "E3T": triangles.append([int(w) for w in word[2:6]])
    if word[0] == "NS":
        for k, w in enumerate(word[1:], 1):
            open_string.append(abs(int(w)))
            if w.startswith("-"):
                strings.append(open_string)
                assert int(word[k + 1]) == len(strings), row
                open_string = []
                break
        assert len(word) <= 12, row
assert not open_string
# Borders are followed exactly: areas equal the polygons', up to the lattice of 256ths of a sample.
area = {}
edges = set()
for a, b, c, material in triangles:
    p, q, r = nodes[a], nodes[b], nodes[c]
    size = ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2
    area[material] = area.get(material, 0) + size
    edges |= {frozenset((a, b)), frozenset((b, c)), frozenset((c, a))}
assert set(area) == {1, 5, 7}, area
assert abs(area[5] - 0.1 * 0.1) < 1e-5 and abs(area[7] - (0.05 * 0.1 - 0.02 * 0.02)) < 1e-5, area
[string] = strings
assert all(frozenset(pair) in edges for pair in zip(string, string[1:]))
first, last = nodes[string[0]], nodes[string[-1]]
assert abs(first[0] + 84.38) < 1e-5 and abs(first[1] - 36.2) < 1e-5, first
assert abs(last[0] + 84.2) < 1e-5 and abs(last[1] - 36.2) < 1e-5, last
report = json.load(open("r.json"))
assert {m["material"] for m in report["materials"]} == {1, 5, 7}
assert sum(m["triangles"] for m in report["materials"]) == report["triangles"] == len(triangles)
assert report["node_strings"] == [{"number": 1, "name": "strings.geojson feature 0", "nodes": len(string)}]
PY
done
grep -q '^  materials     3 numbers; ' summary || fail "the summary does not tell the materials"
grep -q '^  node strings  1 of ' summary || fail "the summary does not tell the node strings"

# Without an attribute, features are numbered; without both options the file is unchanged.
succeeds "$scarp" simplify "$dem" counted.2dm -e 50 --materials zones.geojson -q
[ "$(awk '$1 == "E3T" { print $6 }' counted.2dm | sort -u | tr '\n' ' ')" = "1 2 3 " ] || fail "features are not counted"
succeeds "$scarp" simplify "$dem" plain.2dm -e 50 --report r.json --overwrite -q
[ "$(awk '$1 == "E3T" { print $6 }' plain.2dm | sort -u)" = 1 ] || fail "a plain 2DM has materials"
[ "$(json r.json materials)" = null ] || fail "a report tells materials that nobody asked for"

refuses 1 "--materials is for flow models, and GLB has no place for it: choose .2dm" "$scarp" simplify "$dem" x.glb -e 50 --materials zones.geojson
refuses 1 "--node-strings is for flow models" "$scarp" simplify "$dem" x.obj -e 50 --node-strings strings.geojson
refuses 1 "--material-field needs --materials" "$scarp" simplify "$dem" x.2dm -e 50 --material-field mat
refuses 1 "--materials cannot be combined with --base" "$scarp" simplify "$dem" x.2dm -e 50 --base 0 --materials zones.geojson
refuses 1 "--edges data cannot be combined with --materials" \
  "$scarp" simplify "$dem" x.2dm -e 50 --edges data --materials zones.geojson
refuses 2 "is a line, and --materials strings.geojson needs polygons" \
  "$scarp" simplify "$dem" x.2dm -e 50 --materials strings.geojson
refuses 2 "has 2.5 as its material: mat must be a whole number" \
  "$scarp" simplify "$dem" x.2dm -e 50 --materials half.geojson --material-field mat
refuses 2 "no attribute 'soil'" "$scarp" simplify "$dem" x.2dm -e 50 --materials zones.geojson --material-field soil
[ ! -e x.2dm ] || fail "a refused run left a file"
echo "materials follow polygons, node strings follow lines"
