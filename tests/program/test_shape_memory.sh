#!/usr/bin/env bash
# --min-angle, --max-edge and --grade with --memory: samples stay in their file, and goals hold for every effort and
# across all bands of rows. Any number of threads gives the same bytes, and the memory suffices.
source "$(dirname "$0")/lib.sh"
need python3
shape_of=$SCARP_SOURCE/tests/program/shape_of.py

succeeds "$scarp" generate smooth 1000 800 hills.tif --seed 3 -q
limit=77 # the samples, 3.2 MB, may use 2.5 of it

for effort in fast normal high; do
  within=$limit by_threads hills.tif one.2dm -e 12 --min-angle 25 --effort "$effort" --memory "${limit}M"
  read -r count smallest shortest longest < <(python3 "$shape_of" one.2dm)
  holds "$smallest >= 25"
  [ "$(json r.json shape below)" = 0 ] || fail "triangles with smaller angles are left"
  succeeds "$scarp" measure hills.tif one.2dm --fail-above 12
  succeeds "$scarp" simplify hills.tif whole.2dm -e 12 --min-angle 25 --effort "$effort" --overwrite
  read -r whole smallest shortest longest < <(python3 "$shape_of" whole.2dm)
  holds "$count < 1.1 * $whole"
done

# Lines are split along their course, across any strips.
echo '{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
 {"type": "LineString", "coordinates": [[5.3, 7.1], [990.7, 733.2]]}}, {"type": "Feature", "properties": {}, "geometry":
 {"type": "LineString", "coordinates": [[-50, 512], [1100, 512]]}}]}' >lines.geojson
for effort in fast high; do
  within "$limit" "$scarp" simplify hills.tif lines.obj --up z -e 12 --min-angle 20 --max-edge 60 --breaklines lines.geojson \
    --effort "$effort" --memory "${limit}M" --report r.json --overwrite
  read -r count smallest shortest longest < <(python3 "$shape_of" lines.obj)
  holds "$longest <= 60"
  [ "$(json r.json shape below)" = "$(json r.json shape forced)" ] || fail "angles are small where no lines meet"
  [ "$(json r.json topology sound)" = true ] || fail "$effort effort makes an unsound mesh"
  python3 "$SCARP_SOURCE/tests/program/walk_lines.py" lines.obj lines.geojson 1000 800 40 || fail "lines are lost with $effort effort"
  succeeds "$scarp" measure hills.tif lines.obj --up z --fail-above 12
done

within "$limit" "$scarp" simplify hills.tif graded.obj --up z -e 12 --grade 0.3 --max-edge 80 --effort normal --memory "${limit}M"
read -r count smallest shortest longest < <(python3 "$shape_of" graded.obj)
holds "$longest <= 80"
succeeds "$scarp" measure hills.tif graded.obj --up z --fail-above 12

# A request refused during the run stays within the limit; an impossible one is refused immediately.
refuses_within() {
  try run_within "$limit" "$scarp" simplify hills.tif x.obj --memory "${limit}M" "$@"
  [ "$code" = 1 ] || fail "exit code $code instead of 1: $*"
  grep -q "^scarp: --memory ${limit}M is too little: " "$logs/err" || fail "another sentence: $(cat "$logs/err")"
}
refuses_within -e 12 --max-edge 3
grep -q 'edges so short need at least 204818 triangles, which take more than' "$logs/err" || fail "triangles are not counted"
for grade in 0.01 0.001 1e-9; do refuses_within -e 12 --grade $grade; done
refuses_within -e 0 --min-angle 5
succeeds "$scarp" generate fractal 1000 800 rough.tif -q
for effort in fast normal; do
  try run_within "$limit" "$scarp" simplify rough.tif x.obj -e 0 --effort $effort --memory "${limit}M" -j 8
  grep -q "^scarp: --memory ${limit}M is too little: the mesh has" "$logs/err" || fail "another sentence: $(cat "$logs/err")"
done
