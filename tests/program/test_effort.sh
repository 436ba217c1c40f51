#!/usr/bin/env bash
# --effort normal, high: half and a third of the triangles, the same promise, and the same bytes on any number of
# threads.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

# The mesh shrinks as listed in bench/quality.md, and every sample satisfies the bound.
for error in 84 16.8 8.4; do
  succeeds "$scarp" simplify "$dem" fast.glb -e "$error" --effort fast --report fast.json --overwrite
  succeeds "$scarp" simplify "$dem" normal.glb -e "$error" --effort normal --report normal.json --overwrite
  holds "$(json normal.json triangles) < 0.55 * $(json fast.json triangles)"
  succeeds "$scarp" measure "$dem" normal.glb --fail-above "$error"
  succeeds "$scarp" simplify "$dem" high.glb -e "$error" --effort high --report high.json --overwrite
  holds "$(json high.json triangles) < 0.85 * $(json normal.json triangles)"
  holds "$(json high.json triangles) < 0.295 * $(json fast.json triangles)"
  succeeds "$scarp" measure "$dem" high.glb --fail-above "$error"
  succeeds "$scarp" simplify "$dem" samples.glb -e "$error" --effort high --vertices samples --report samples.json --overwrite
  holds "$(json samples.json triangles) < 0.95 * $(json normal.json triangles)"
  holds "$(json high.json triangles) < 0.92 * $(json samples.json triangles)"
  succeeds "$scarp" measure "$dem" samples.glb --fail-above "$error"
done
[ "$(json normal.json strategy vertices) $(json samples.json strategy vertices) $(json high.json strategy vertices)" = '"samples" "samples" "free"' ] ||
  fail "the report does not tell where vertices are"
[ "$(json fast.json strategy effort) $(json normal.json strategy effort) $(json high.json strategy effort)" = '"fast" "normal" "high"' ] ||
  fail "the report does not tell the effort"
python3 - normal.json <<'PYTHON'
import json, sys
passes = {p["name"]: p for p in json.load(open(sys.argv[1]))["passes"]}
assert passes["fit"]["removals"] > 1000 and passes["tiles"]["removals"] == 0, passes
PYTHON
grep -aq -- '--effort normal"' normal.glb || fail "the metadata does not tell the effort"

# max goes deeper. Its result within a time limit depends on the machine but is never worse than refinement. After a
# limit before removal begins, the result is refinement's mesh, or removal's so far.
succeeds "$scarp" simplify "$dem" max.glb -e 168 --effort max --report max.json --overwrite
succeeds "$scarp" simplify "$dem" high.glb -e 168 --effort high --report high.json --overwrite
holds "$(json max.json triangles) < $(json high.json triangles)"
succeeds "$scarp" simplify "$dem" longer.glb -e 168 --effort max --time-limit 3 --report longer.json --overwrite
succeeds "$scarp" simplify "$dem" fast.glb -e 168 --effort fast --report fast.json --overwrite
holds "$(json longer.json triangles) <= $(json fast.json triangles)"
succeeds "$scarp" simplify "$dem" short.glb -e 8.4 --effort max --time-limit 0 --report short.json --overwrite
[ "$(json max.json strategy cut_short) $(json short.json strategy cut_short)" = "false true" ] ||
  fail "the report does not tell that the time was up"
succeeds "$scarp" simplify "$dem" fast.glb -e 8.4 --effort fast --report fast.json --overwrite
holds "$(json short.json triangles) <= 1.01 * $(json fast.json triangles)"
for mesh in max longer; do succeeds "$scarp" measure "$dem" "$mesh.glb" --fail-above 168; done
succeeds "$scarp" measure "$dem" short.glb --fail-above 8.4

# A limit that is not reached has no effect, except on max.
succeeds "$scarp" simplify "$dem" limited.glb -e 168 --effort high --time-limit 1000000 --report limited.json
holds "$(json limited.json triangles) == $(json high.json triangles)"

# Shape floors remove the smallest angles.
thinnest() { python3 - "$1" <<'PYTHON'
import struct, sys
data = open(sys.argv[1], "rb").read()
count = struct.unpack_from("<I", data, 80)[0]
least = 9.0
for t in range(count):
    p = struct.unpack_from("<9f", data, 84 + 50 * t + 12)
    xy = [(p[3 * k], p[3 * k + 1]) for k in range(3)]
    area2 = abs((xy[1][0] - xy[0][0]) * (xy[2][1] - xy[0][1]) - (xy[1][1] - xy[0][1]) * (xy[2][0] - xy[0][0]))
    longest2 = max((xy[k][0] - xy[k - 1][0]) ** 2 + (xy[k][1] - xy[k - 1][1]) ** 2 for k in range(3))
    least = min(least, area2 / longest2)
print(least)
PYTHON
}
for shape in 0 0.2; do
  succeeds "$scarp" simplify "$dem" "shape$shape.stl" -e 20 --effort high --min-shape "$shape" --overwrite
  succeeds "$scarp" measure "$dem" "shape$shape.stl" --fail-above 20
done
succeeds "$scarp" simplify "$dem" fast.stl -e 20 --effort fast --overwrite
holds "$(thinnest shape0.2.stl) >= 0.1999 || $(thinnest shape0.2.stl) >= 0.999 * $(thinnest fast.stl)"
holds "$(thinnest shape0.stl) < $(thinnest shape0.2.stl)"

for effort in normal high; do
  # Solids, projections and formats work on the result.
  succeeds "$scarp" simplify "$dem" solid.stl -e 20 --effort "$effort" --base -100 --overwrite
  succeeds "$scarp" measure "$dem" solid.stl --fail-above 20
  succeeds "$scarp" simplify "$dem" utm.glb -e 20 --effort "$effort" --crs EPSG:32616 --overwrite
  succeeds "$scarp" measure "$dem" utm.glb --crs EPSG:32616 --fail-above 20
  succeeds "$scarp" simplify "$dem" greedy.obj -e 20 --effort "$effort" --order greedy --overwrite
  succeeds "$scarp" measure "$dem" greedy.obj --fail-above 20
  succeeds "$scarp" simplify "$dem" exact.ply -e 0 --effort "$effort" --overwrite
  succeeds "$scarp" measure "$dem" exact.ply --fail-above 0

  # Any number of threads gives the same bytes.
  for threads in 1 2 7; do
    succeeds "$scarp" simplify "$dem" "threads$threads.glb" -e 8 --effort "$effort" -j "$threads" --overwrite
    cmp threads1.glb "threads$threads.glb" || fail "-j $threads makes another mesh with $effort effort"
  done
done

# Bounds of samples are satisfied, and used where they are large.
make_raster falling.tif '5 + 45 * col / 402'
make_raster steep.tif '0 if row < 5 else nan if row < 40 else 0.5 if col < 200 else 500'
make_raster weights.tif '0 if row < 40 else 1 - col / 1000'
succeeds "$scarp" simplify "$dem" fast.glb --tolerance falling.tif --effort fast --report fast.json --overwrite
succeeds "$scarp" simplify "$dem" normal.glb --tolerance falling.tif --effort normal --report normal.json --overwrite
succeeds "$scarp" simplify "$dem" high.glb --tolerance falling.tif --effort high --report high.json --overwrite
holds "$(json normal.json triangles) < 0.63 * $(json fast.json triangles)"
holds "$(json high.json triangles) < 0.7 * $(json normal.json triangles)"
[ "$(json high.json strategy vertices)" = '"free"' ] || fail "bounds of samples keep vertices on samples"
for mesh in normal high; do succeeds "$scarp" measure "$dem" "$mesh.glb" --tolerance falling.tif; done
printf 'i 100 100\nu 101 100\n' >ignored.txt
for effort in normal high; do
  succeeds "$scarp" simplify "$dem" steep.ply --tolerance steep.tif --effort "$effort" --overwrite
  succeeds "$scarp" measure "$dem" steep.ply --tolerance steep.tif
  succeeds "$scarp" simplify "$dem" masked.glb -e 20 --mask weights.tif --effort "$effort" --overwrite
  succeeds "$scarp" measure "$dem" masked.glb --mask weights.tif --fail-above 20
  succeeds "$scarp" simplify "$dem" ignored.glb -e 20 --script ignored.txt --effort "$effort" --overwrite
  succeeds "$scarp" measure "$dem" ignored.glb --script ignored.txt --fail-above 20
done
echo 's 50 50' >inserted.txt
succeeds "$scarp" simplify "$dem" inserted.glb -e 20 --effort normal --script inserted.txt
succeeds "$scarp" measure "$dem" inserted.glb --fail-above 20
succeeds "$scarp" simplify "$dem" masked.glb -t 2000 --mask weights.tif --effort normal --report masked.json --overwrite
holds "$(json masked.json triangles) <= 2000"
succeeds "$scarp" simplify "$dem" masked.glb -t 2000 --script ignored.txt --effort high --report masked.json --overwrite
holds "$(json masked.json triangles) <= 2000"

# A budget too small for the tolerances: one factor, smaller with higher effort, that every sample satisfies.
last=1e9
for effort in fast normal high; do
  succeeds "$scarp" simplify "$dem" few.glb -t 2000 --tolerance falling.tif --effort "$effort" --report few.json --overwrite
  holds "$(json few.json triangles) <= 2000"
  factor=$(json few.json tolerance_factor)
  holds "1 < $factor && $factor < 0.95 * $last"
  holds "$(json few.json weighted_max_error) <= $factor"
  last=$factor
done
succeeds "$scarp" simplify "$dem" few.glb -t 2000 --tolerance falling.tif --report few.json --overwrite
[ "$(json few.json strategy effort)" = '"normal"' ] || fail "tolerances beside a budget take $(json few.json strategy effort)"
grep -q 'kept: tolerances times ' "$logs/out" || fail "the summary does not tell the factor"

# At this error two flips cancel each other during repair: with the triangles of a ring that begins at another vertex,
# the mesh would break the bound.
succeeds "$scarp" simplify "$dem" rare.glb -e 2.546544983879489 --effort high --crs grid

# Free vertices of normal effort.
succeeds "$scarp" simplify "$dem" free.glb -e 20 --vertices free --report free.json
[ "$(json free.json strategy effort) $(json free.json strategy vertices)" = '"normal" "free"' ] || fail "vertices are not free"
succeeds "$scarp" measure "$dem" free.glb --fail-above 20

# Settings without support for removal are named.
for strategy in "--importance local" "--importance local --one-pass" "--algorithm heap" "--batch const" "--edges data"; do
  # shellcheck disable=SC2086
  refuses 1 "${strategy%% *}" "$scarp" simplify "$dem" never.glb -e 20 --effort normal $strategy
  grep -q "a strategy of the 1995 paper only inserts vertices" "$logs/err" || fail "no reason beside $strategy"
done
refuses 1 "--effort fast cannot be combined with --vertices free" "$scarp" simplify "$dem" never.glb -e 20 --effort fast --vertices free
refuses 1 "--vertices" "$scarp" simplify "$dem" never.glb -e 20 --effort high --vertices some
refuses 1 "regular" "$scarp" simplify "$dem" never.glb -e 20 --effort high --vertices free --crs EPSG:32616
refuses 1 "--effort min-shape 0.6 is above 0.5" "$scarp" simplify "$dem" never.glb -e 20 --min-shape 0.6
refuses 1 "--effort fast cannot be combined with --effort min-shape" "$scarp" simplify "$dem" never.glb -e 20 --effort fast --min-shape 0.1
refuses 1 "--effort fast cannot be combined with --effort time-limit" "$scarp" simplify "$dem" never.glb -e 20 --effort fast --time-limit 3
refuses 1 "--effort time-limit cannot be combined with --max-triangles beside --effort max" \
  "$scarp" simplify "$dem" never.glb -t 2000 --effort max --time-limit 3
refuses 1 "--effort time-limit soon is not a finite number" "$scarp" simplify "$dem" never.glb -e 20 --effort high --time-limit soon
# If fast is the default effort, settings that require more still get it.
for reason in "--mask weights.tif" "--script /dev/null" "--order greedy" "--memory 1G"; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify "$dem" shaped.glb -e 60 --min-shape 0.1 $reason --report shaped.json --overwrite
  [ "$(json shaped.json strategy effort)" = '"normal"' ] || fail "--min-shape beside $reason leaves effort fast"
done
succeeds "$scarp" simplify "$dem" timed.glb -t 2000 --time-limit 100 --overwrite --report timed.json
holds "$(json timed.json triangles) <= 2000"
refuses 1 "--edges data cannot be combined with --effort min-shape" "$scarp" simplify "$dem" never.glb -e 20 --min-shape 0.1 --edges data
refuses 1 "--order dominant cannot be combined with --ridges" "$scarp" simplify "$dem" never.glb -e 20 --order dominant --ridges 20
refuses 1 "--effort" "$scarp" simplify "$dem" never.glb -e 20 --effort much
refuses 1 "no goal" "$scarp" simplify "$dem" never.glb --effort normal
