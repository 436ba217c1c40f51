#!/usr/bin/env bash
# LAS and LAZ: classes, returns and flags, what is omitted, info, the judge that remembers, refusals in one sentence.
source "$(dirname "$0")/lib.sh"
need python3

# A LAS 1.4 file of format 6 in a UTM zone: a grid of ground, trees on it, noise, and points withheld or in an overlap.
python3 - <<'PY'
import struct

wkt = b'PROJCS["WGS 84 / UTM zone 33N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",15],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG","32633"]]'


def points():
    for row in range(40):
        for col in range(50):
            ground = 30000 + (col * 7 + row * 11) % 90
            yield col * 200, row * 200, ground, (2, 2), 2, 0
            if (row + col) % 5 == 0:
                yield col * 200 + 3, row * 200 + 5, ground + 1800, (1, 2), 5, 0
            if (row * col) % 97 == 1:
                yield col * 200 + 9, row * 200 + 1, ground + 90000, (1, 1), 18, 0
    yield 5, 9, -5000, (1, 1), 2, 4  # withheld
    yield 7, 9, 30100, (1, 1), 2, 8  # overlap


def write(name, points):
    points = list(points)
    head = bytearray(375)
    struct.pack_into("<4s", head, 0, b"LASF")
    struct.pack_into("<H", head, 6, 16)
    struct.pack_into("<BB", head, 24, 1, 4)
    struct.pack_into("<HIIBH", head, 94, 375, 375 + 54 + len(wkt), 1, 6, 30)
    struct.pack_into("<6d", head, 131, 0.01, 0.01, 0.01, 500000, 4649000, 0)
    struct.pack_into("<Q", head, 247, len(points))
    record = struct.pack("<H16sHH32s", 0, b"LASF_Projection", 2112, len(wkt), b"") + wkt
    with open(name, "wb") as file:
        file.write(bytes(head) + record)
        for x, y, z, (r, n), number, flags in points:
            file.write(struct.pack("<3iHBBBBhHd", x, y, z, 0, r | n << 4, flags, number, 0, 0, 0, 0))


write("survey.las", points())
write("empty.las", [])
PY

succeeds "$scarp" info survey.las
for words in 'LAS 1.4, point format 6' 'EPSG:32633' '2 ground: 2001' '5 high-vegetation: 400' '18 high-noise' \
  '(1 withheld left out)' 'points per square metre' 'next  *scarp simplify survey.las survey.glb -e 1% --class ground'; do
  grep -q -- "$words" "$logs/out" || fail "info does not print '$words'"
done
eval "$(sed -n 's/^  next  *scarp/succeeds "$scarp"/p' "$logs/out")"

# A folder of a flight is one set of points; its other files do not matter, but a raster does.
mkdir flight
cp survey.las flight/b.las
cp survey.las flight/A.LAS
echo 'flown in May' > flight/notes.txt
succeeds "$scarp" info flight
grep -q "next  *scarp simplify flight flight.glb" "$logs/out" || fail "the command for a folder: $(cat "$logs/out")"
succeeds "$scarp" simplify flight flight.ply -e 0.2 --class ground
grep -q 'duplicates  *2001,' "$logs/out" || fail "a folder of two equal files: $(cat "$logs/out")"
succeeds "$scarp" measure flight flight.ply --fail-above 0.2 -q
cp "$dem" flight/dem.tif
succeeds "$scarp" info flight --no-suggest
grep -q '403 columns' "$logs/out" || fail "a folder with a raster is no mosaic any more"
refuses 2 "empty.las: holds no points" "$scarp" info empty.las
refuses 2 "empty.las: holds no points" "$scarp" simplify empty.las x.glb -e 1

body() { LC_ALL=C sed '1,/^end_header/d' "$1"; } # without the command in the header

# A class by name is that by number; the mesh remembers it for its judge.
succeeds "$scarp" simplify survey.las ground.ply -e 0.2 --class ground,no-overlap --report r.json
grep -q '2000 (1 withheld, 4[0-9]* of other classes, 1 in overlaps left out)' "$logs/out" || fail "the summary does not count what is omitted"
holds "$(json r.json input las points) == 2000 + 1 + 1 + 400 + $(json r.json input las classes 18)"
# The lattice of the file, or that divided by a power of two.
holds "$(json r.json input lattice_step) == 2 / 2 ^ int(log(2 / $(json r.json input lattice_step)) / log(2) + 0.5)"
succeeds "$scarp" measure survey.las ground.ply --fail-above 0.2 -q
refuses 3 "exceeds 0.2" "$scarp" measure survey.las ground.ply --fail-above 0.2 --class all -q
succeeds "$scarp" simplify survey.las number.ply -e 0.2 --class 2,no-overlap --overwrite -q -j 3
cmp <(body ground.ply) <(body number.ply) || fail "a class by name is not that by number"
succeeds "$scarp" simplify survey.las rest.ply -e 0.2 --class no-vegetation,no-noise,no-overlap -q
cmp <(body ground.ply) <(body rest.ply) || fail "classes that are omitted leave others"
succeeds "$scarp" simplify survey.las last.ply -e 0.2 --class returns=last --report r.json --overwrite -q
[ "$(json r.json input las of_other_returns)" = 400 ] || fail "first returns are used"
succeeds "$scarp" measure survey.las last.ply --fail-above 0.2 --json
[ "$(json "$logs/out" input las of_other_returns)" = 400 ] || fail "the judge forgets the returns"
succeeds "$scarp" info survey.las --class all,withheld --json
[ "$(json "$logs/out" points count)" = "$(json "$logs/out" points las points)" ] || fail "withheld points cannot be had"
holds "$(json "$logs/out" points bounds low 2) == -50"

# In parts, within a memory limit: the promise at all points, and the same verdict in parts.
python3 - <<'PY'
import math
import random
import struct

random.seed(4)
count = 300000
head = bytearray(227)
head[:4] = b"LASF"
struct.pack_into("<BB", head, 24, 1, 2)
struct.pack_into("<HII", head, 94, 227, 227, 0)
struct.pack_into("<BHI", head, 104, 0, 20, count)
struct.pack_into("<3d", head, 131, 0.01, 0.01, 0.001)
with open("large.las", "wb") as file:
    file.write(head)
    for _ in range(count):
        x, y = random.randrange(100000), random.randrange(80000)
        z = 40000 * math.sin(x / 9000) * math.cos(y / 7000) + random.randrange(2000)
        file.write(struct.pack("<3iHBBbBH", x, y, round(z), 0, 9, 2, 0, 0, 0))
PY
for effort in fast normal; do
  succeeds "$scarp" simplify large.las parts.ply -e 2 --effort $effort --memory 90M --report parts.json --overwrite
  grep -q 'points  *300,000, heights' "$logs/out" || fail "the summary of points in parts: $(cat "$logs/out")"
  [ "$(json parts.json input points)" = 300000 ] || fail "the report of points in parts"
  succeeds "$scarp" measure large.las parts.ply --fail-above 2
  mv "$logs/out" whole.txt
  succeeds "$scarp" measure large.las parts.ply --fail-above 2 --memory 90M
  cmp "$logs/out" whole.txt || fail "the judge in parts: $(diff "$logs/out" whole.txt)"
  succeeds "$scarp" simplify large.las one.ply -e 2 --effort $effort --memory 90M -j 1 --overwrite -q
  cmp <(body parts.ply) <(body one.ply) || fail "threads change a mesh in parts"
done
succeeds "$scarp" simplify large.las few.glb -t 500 --memory 90M --normals -q
succeeds "$scarp" measure large.las few.glb --json
holds "$(json "$logs/out" triangles) <= 500"
refuses 1 "--memory cannot be combined with --despike" "$scarp" simplify large.las y.glb -e 2 --memory 90M --duplicates despike=5
refuses 1 "--memory cannot be combined with --boundary concave:50: it reads points in parts" "$scarp" simplify large.las y.glb -e 2 --memory 90M --boundary concave:50
refuses 1 "--memory cannot be combined with --effort high" "$scarp" simplify large.las y.glb -e 2 --memory 90M --effort high
refuses 1 "--memory cannot be combined with --vertices free" "$scarp" simplify large.las y.glb -e 2 --memory 90M --vertices free
refuses 1 "--memory cannot be combined with --lods" "$scarp" simplify large.las y.glb -e 2 --memory 90M --lods 2
succeeds "$scarp" simplify large.las ends.glb -e 2 --boundary concave:50 -q
refuses 1 "--memory cannot be combined with --boundary" "$scarp" measure large.las ends.glb --memory 90M
printf '1,2,3\n4,5,6\n9,7,8\n' >plain.csv
refuses 1 "only points of LAS and LAZ files are read in parts: leave --memory out" "$scarp" simplify plain.csv y.glb -e 1 --memory 90M

# By content, whatever the name; from a pipe.
cp survey.las survey.bin
succeeds "$scarp" simplify survey.bin x.glb -e 1 --points --overwrite -q
succeeds "$scarp" simplify - x.glb -e 1 --points --overwrite -q <survey.las

# Refusals.
refuses 1 "grass, which is no class" "$scarp" simplify survey.las y.glb -e 1 --class ground,grass
refuses 1 "leaves no class" "$scarp" simplify survey.las y.glb -e 1 --class 2,no-2
refuses 1 "--class is empty" "$scarp" simplify survey.las y.glb -e 1 --class ''
refuses 1 "choose all, first, last or only" "$scarp" simplify survey.las y.glb -e 1 --class returns=second
refuses 2 "of other classes; its classes are 2 (2001), 5 (400)" "$scarp" simplify survey.las y.glb -e 1 --class water --overwrite
refuses 1 "LAS and LAZ files" "$scarp" simplify plain.csv x.glb -e 1 --class ground --overwrite
refuses 1 "--class is for scattered points" "$scarp" simplify "$dem" x.glb -e 1 --class ground --overwrite
head -c 5000 survey.las >cut.las
refuses 2 "the file is cut off" "$scarp" simplify cut.las x.glb -e 1 --overwrite
head -c 100 survey.las >cut.las
refuses 2 "cut.las: ends within its header" "$scarp" info cut.las
refuses 4 "cannot keep points in a file in" bash -c 'ulimit -f 8; exec "$@"' - "$scarp" simplify large.las y.glb -e 2 --memory 90M
refuses 4 "cannot keep points in a file in /nowhere" env TMPDIR=/nowhere "$scarp" simplify large.las y.glb -e 2 --memory 90M
refuses 1 "--memory 73M has no space for" "$scarp" simplify large.las y.obj -e 0.1 --memory 73M
