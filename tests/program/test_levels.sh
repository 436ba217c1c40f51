#!/usr/bin/env bash
# --lock-border: separately simplified rasters meet. --lods: levels of detail with a common outline, in files or in one
# GLB.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

# meet.py DIGITS NORTH_WEST NORTH_EAST SOUTH_WEST SOUTH_EAST: for OBJs of rasters that share a row and a column, counts
# vertices on shared lines, and those of only one neighbour. Heights are compared to the last bit, as are places if
# DIGITS is 17: gdal_translate rounds origins of parts in degrees. A vertex of one mesh does not count where its surface
# ends: there it has a border edge that leaves the line.
cat > meet.py <<'PYTHON'
import sys
digits = int(sys.argv[1])
def read(path):
    vertices, uses = [], {}
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]: vertices.append((round(float(words[1]), digits), round(float(words[2]), digits), float(words[3])))
        if words[:1] == ["f"]:
            f = [int(w.split("/")[0]) - 1 for w in words[1:]]
            for k in range(3):
                edge = frozenset((f[k], f[(k + 1) % 3]))
                uses[edge] = uses.get(edge, 0) + 1
    return vertices, [tuple(edge) for edge, n in uses.items() if n == 1]
def on_side(mesh, axis, pick):
    vertices, border = mesh
    at = pick(v[axis] for v in vertices)
    inside = {v for edge in border if all(vertices[n][axis] == at for n in edge) for v in edge}
    ends = {v for edge in border if not all(vertices[n][axis] == at for n in edge) for v in edge}
    return {vertices[v]: v in ends for v in inside}
north_west, north_east, south_west, south_east = map(read, sys.argv[2:])
differ = shared = 0
for a, b, axis in ((north_west, north_east, 0), (south_west, south_east, 0), (south_west, north_west, 1), (south_east, north_east, 1)):
    first, second = on_side(a, axis, max), on_side(b, axis, min)
    shared += len(first.keys() & second.keys())
    for one, other in ((first, second), (second, first)):
        differ += sum(1 for vertex, ends in one.items() if vertex not in other and not ends)
print(differ, shared)
PYTHON

# cut RASTER COLS ROWS: into 2 x 2 parts that share the middle column and row.
cut() {
  local col=$(($2 / 2)) row=$(($3 / 2))
  succeeds gdal_translate -q -srcwin 0 0 $((col + 1)) $((row + 1)) "$1" nw.tif
  succeeds gdal_translate -q -srcwin $col 0 $(($2 - col)) $((row + 1)) "$1" ne.tif
  succeeds gdal_translate -q -srcwin 0 $row $((col + 1)) $(($3 - row)) "$1" sw.tif
  succeeds gdal_translate -q -srcwin $col $row $(($2 - col)) $(($3 - row)) "$1" se.tif
}

# Terrain with cliffs, and voids across the shared lines.
python3 - <<'PYTHON'
import math
rows = []
for y in range(161):
    row = []
    for x in range(181):
        z = 30 * math.sin(0.11 * x + 0.05 * y) + 12 * math.cos(0.23 * x - 0.3 * y) + (60 if 2 * x + y > 290 else 0)
        hole = (x - 90) ** 2 + (y - 40) ** 2 < 90 or (x - 40) ** 2 + (y - 80) ** 2 < 60 or (abs(x - 130) < 8 and abs(y - 81) < 6)
        row.append("-9999" if hole else f"{z:.2f}")
    rows.append(" ".join(row))
open("made.asc", "w").write("ncols 181\nnrows 161\nxllcorner 500000\nyllcorner 4000000\ncellsize 10\nNODATA_value -9999\n" + "\n".join(rows) + "\n")
PYTHON
succeeds gdal_translate -q -ot Float32 -a_srs EPSG:32616 made.asc made.tif

check_meeting() { # RASTER ERROR DIGITS
  local effort part
  for effort in fast normal high; do
    for part in nw ne sw se; do
      succeeds "$scarp" simplify $part.tif $part.obj -e "$2" --effort $effort --lock-border --crs source --overwrite --report $part.json
      holds "$(json $part.json max_error) <= $2"
      [ "$(json $part.json topology sound)" = true ] || fail "$part of $1 is not sound with $effort effort"
    done
    read -r differ shared < <(python3 meet.py "$3" nw.obj ne.obj sw.obj se.obj)
    [ "$differ" = 0 ] || fail "$1, $effort: $differ border vertices are one raster's alone"
    holds "$shared > 30"
  done
}
cut made.tif 181 161
check_meeting made 1.5 17
cut "$dem" 403 344
check_meeting dem 10 10

# Normals on a shared side are equal: separate rasters derive them from the side alone; parts of one mosaic have those
# of the whole.
cat > shades.py <<'PYTHON'
import math, sys
def read(path):
    vertices = [line.split()[1:] for line in open(path) if line.startswith("v ")]
    normals = [line.split()[1:] for line in open(path) if line.startswith("vn ")]
    assert len(vertices) == len(normals) > 0
    return {tuple(round(float(c), 6) for c in v): tuple(map(float, n)) for v, n in zip(vertices, normals)}
west, east, whole = map(read, sys.argv[1:])
shared = west.keys() & east.keys()
unequal = sum(west[v] != east[v] for v in shared)
# Y is up. At the ends of the side the whole raster has samples that both parts lack.
last = sorted(shared, key=lambda v: v[2])
off = [math.degrees(math.dist(west[v], whole[v])) for v in last[1:-1] if v in whole]  # acos() is coarse near 1
print(len(shared), unequal, len(off), max(off))
PYTHON
succeeds "$scarp" simplify made.tif whole.obj -e 0 --normals --crs source --vertices samples
cut made.tif 181 161
for part in nw ne; do succeeds "$scarp" simplify $part.tif $part.obj -e 1.5 --lock-border --normals --crs source --overwrite; done
read -r shared unequal compared off < <(python3 shades.py nw.obj ne.obj whole.obj)
[ "$unequal" = 0 ] && holds "$shared > 10 && $off > 5" || fail "apart: $unequal of $shared normals differ, up to $off degrees from the whole's"
west=(500000 4000800 500910 4001610) east=(500900 4000800 501810 4001610)
for source in made.tif "nw.tif ne.tif"; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify $source nw.obj -e 1.5 --te "${west[@]}" --lock-border --normals --crs source --overwrite
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify $source ne.obj -e 1.5 --te "${east[@]}" --lock-border --normals --crs source --overwrite
  read -r shared unequal compared off < <(python3 shades.py nw.obj ne.obj whole.obj)
  [ "$unequal" = 0 ] && holds "$shared > 10 && $compared > 5 && $off < 0.001" ||
    fail "of $source: $unequal of $shared normals differ, up to $off degrees from the whole's"
done

# Any -j; strips are refused.
succeeds "$scarp" simplify "$dem" one.glb -e 10 --effort high --lock-border -j 1
succeeds "$scarp" simplify "$dem" two.glb -e 10 --effort high --lock-border -j 2
cmp one.glb two.glb || fail "threads change a mesh with a locked border"
refuses 1 "--lock-border needs --max-error" "$scarp" simplify "$dem" x.glb -t 5000 --lock-border
refuses 1 "the locked border and the outline of the valid data alone need" \
  "$scarp" simplify "$dem" x.glb -e 10 -t 50 --lock-border

# One tile in the dominant order, unless the other is requested.
succeeds "$scarp" simplify "$dem" tile.glb -e 10 --lock-border --report tile.json
[ "$(json tile.json strategy order)" = '"dominant"' ] || fail "a locked border takes $(json tile.json strategy order)"
succeeds "$scarp" simplify "$dem" worst.glb -e 10 --lock-border --order greedy --effort normal --report worst.json
[ "$(json worst.json strategy order)" = '"greedy"' ] || fail "--order greedy gives way to $(json worst.json strategy order)"
succeeds "$scarp" measure "$dem" tile.glb --fail-above 10 -q
holds "$(json tile.json triangles) < 1.03 * $(json worst.json triangles)"
holds "$(json worst.json triangles) < 1.03 * $(json tile.json triangles)"

# Levels: each keeps its bound by measure, and all have the finest level's outline.
succeeds "$scarp" simplify "$dem" hills.ply -e 5 --lods 3 --report levels.json
for k in 0 1 2; do
  error=$((5 << k))
  holds "$(json levels.json levels $k asked) == $error"
  succeeds "$scarp" measure "$dem" hills_lod$k.ply --fail-above $error --json
  [ "$(json levels.json levels $k path)" = "\"hills_lod$k.ply\"" ] || fail "level $k has another name"
done
holds "$(json levels.json levels 0 triangles) > 1.5 * $(json levels.json levels 1 triangles)"
succeeds "$scarp" simplify "$dem" hills.ply -e 5 --lods 3 --overwrite
grep -q "level 2 .*asked 20" "$logs/out" || fail "the summary does not list the levels"
[ ! -e hills.ply ] || fail "OUTPUT itself was written"
succeeds "$scarp" simplify "$dem" ratio.obj -e 2 --lods 2:5 --report ratio.json -q
holds "$(json ratio.json levels 1 asked) == 10"

succeeds "$scarp" simplify "$dem" all.glb -e 5 --lods 3 --lods-in-one --report all.json
[ "$(json all.json levels 2 triangles)" = "$(json levels.json levels 2 triangles)" ] || fail "one file has other levels"
succeeds "$scarp" measure "$dem" all.glb --fail-above 5
python3 - <<'PYTHON'
import json, struct
data = open("all.glb", "rb").read()
gltf = json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])
assert [node["name"] for node in gltf["nodes"]] == ["terrain_LOD0", "terrain_LOD1", "terrain_LOD2"], gltf["nodes"]
assert gltf["nodes"][0]["extensions"]["MSFT_lod"]["ids"] == [1, 2]
assert gltf["nodes"][0]["extras"]["MSFT_screencoverage"] == [0.25, 0.0625, 0]
assert gltf["scenes"][0]["nodes"] == [0] and len(gltf["meshes"]) == 3 and "MSFT_lod" in gltf["extensionsUsed"]
PYTHON

# Every level of a mesh on a map has its .prj file, and y is up in every level on request.
succeeds "$scarp" simplify made.tif map.2dm -e 3 --lods 2
for k in 0 1; do grep -q WGS map_lod$k.prj || fail "level $k has no .prj file"; done
[ ! -e map.prj ] || fail "a .prj file has no mesh"
succeeds "$scarp" simplify made.tif up.obj -e 3 --lods 2 --up y
for k in 0 1; do succeeds "$scarp" measure made.tif up_lod$k.obj --fail-above $((3 << k)); done

# All or none.
touch taken_lod1.glb
refuses 4 "taken_lod1.glb exists already" "$scarp" simplify "$dem" taken.glb -e 5 --lods 3
refuses 1 "--lods cannot be combined with --max-triangles" "$scarp" simplify "$dem" x.glb -e 5 -t 900 --lods 3
refuses 1 "--lods needs --max-error" "$scarp" simplify "$dem" x.glb -t 900 --lods 3
refuses 1 "--lods 3:nan: the ratio nan is not a finite number" "$scarp" simplify "$dem" x.glb -e 5 --lods 3:nan
refuses 1 "--lods 1 is not a whole number of at least 2" "$scarp" simplify "$dem" x.glb -e 5 --lods 1
refuses 1 "has a ratio that is not above 1" "$scarp" simplify "$dem" x.glb -e 5 --lods 3:1
refuses 1 "--lods-in-one needs --lods" "$scarp" simplify "$dem" x.glb -e 5 --lods-in-one
refuses 1 "--lods in-one writes one GLB" "$scarp" simplify "$dem" x.obj -e 5 --lods 3,in-one
refuses 1 "--lods cannot be combined with --base" "$scarp" simplify "$dem" x.glb -e 5 --lods 3 --base 0
refuses 1 "--lods writes meshes" "$scarp" simplify "$dem" x.tif -e 5 --lods 3
refuses 1 "--lods cannot be combined with --tolerance" "$scarp" simplify "$dem" x.glb -e 5 --tolerance "$dem" --lods 3
