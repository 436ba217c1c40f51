#!/usr/bin/env bash
# --cliff with --memory: walls are found in a file by rows, cross strips, and need few triangles, too. The bound holds,
# any number of threads gives the same bytes, and the memory of walls counts.
source "$(dirname "$0")/lib.sh"
need python3

# A village of 33 rotated houses, each 60 x 36 samples, some next to nodata.
python3 - <<'PYTHON'
from array import array
def height(x, y):
    u, v = 0.932 * (x - 50) + 0.362 * (y - 48), 0.932 * (y - 48) - 0.362 * (x - 50)
    return 0.02 * x + (10 if abs(u) < 30 and abs(v) < 18 else 0)
house = [array("f", (height(x, y) for x in range(100))) for y in range(100)]
ruin = [array("f", (-9999 if 10 < x < 30 and 20 < y < 35 else z for x, z in enumerate(row))) for y, row in enumerate(house)]
grass = [array("f", (0.02 * x for x in range(100)))] * 100
with open("town.bil", "wb") as file:
    for block in range(10):
        for y in range(100):
            for column in range(13):
                (grass if (column + block) % 4 else ruin if column == block else house)[y].tofile(file)
with open("town.hdr", "w") as file:
    file.write("nrows 1000\nncols 1300\nnbands 1\nnbits 32\npixeltype float\nbyteorder I\nlayout bil\nnodata -9999\n"
               "ulxmap 0\nulymap 999\nxdim 1\nydim 1\n")
PYTHON

small=80M # the samples alone are 5 MB, so they stay in their file, and strips are low
for effort in fast normal high; do
  by_threads town.bil town.obj -e 1 --effort "$effort" --cliff 4 --memory "$small"
  succeeds "$scarp" simplify town.bil whole.obj -e 1 --effort "$effort" --cliff 4 --report whole.json --overwrite
  holds "$(json r.json max_error) <= 1"
  agree r.json whole.json "cliffs walls" "cliffs line_vertices"
  holds "$(json r.json triangles) <= 1.5 * $(json whole.json triangles)"
done
succeeds "$scarp" measure town.bil town.obj --fail-above 1
