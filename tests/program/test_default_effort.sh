#!/usr/bin/env bash
# The default effort is normal where possible; where it is fast, summary and report explain why.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

gdal_translate -q -srcwin 0 0 200 150 "$dem" part.tif
python3 - <<'PYTHON'
import json
square = [[[-84.40, 36.55], [-84.35, 36.55], [-84.35, 36.52], [-84.40, 36.52], [-84.40, 36.55]]]
json.dump({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": square}}]}, open("site.geojson", "w"))
for name, low, high in ("weights", 1, 3), ("tolerances", 4, 10):
    with open(name + ".pgm", "wb") as file:
        file.write(b"P5\n200 150\n255\n" + bytes(high if (x // 40 + y // 40) % 2 else low for y in range(150) for x in range(200)))
PYTHON
printf 's 100 100\ni 20 20\nu 30 30\n' > steps.txt

# run EFFORT OPTION...: "" for the default
run() {
  local effort=$1
  shift
  succeeds "$scarp" simplify part.tif out.obj "$@" ${effort:+--effort "$effort"} --report r.json --overwrite
}
check() { # check OPTION...: the default is normal's mesh, keeps everything that fast keeps, and is smaller
  run fast "$@"
  local fast
  fast=$(json r.json triangles)
  [ "$(json r.json strategy why_fast)" = null ] || fail "a reason for what was asked for: $*"
  run normal "$@"
  grep -v '^#' out.obj > normal.txt
  run "" "$@"
  grep -v '^#' out.obj > default.txt
  cmp normal.txt default.txt || fail "the default is not normal with $*"
  [ "$(json r.json strategy effort) $(json r.json strategy why_fast)" = '"normal" null' ] || fail "the report with $*"
  grep -q '^  effort  *normal$' "$logs/out" || fail "the summary does not tell the effort with $*"
  holds "$(json r.json triangles) < 0.8 * $fast"
}
check -e 10
check -e 10 --memory 200M
check -e 10 --memory 73M
check -e 10 --roi site.geojson=2
succeeds "$scarp" measure part.tif out.obj --fail-above 10 --roi site.geojson=2
check -e 10 --mask weights.pgm
succeeds "$scarp" measure part.tif out.obj --fail-above 10 --mask weights.pgm
check -e 10 --mask weights.pgm --memory 73M
for limit in "" "--memory 73M"; do
  # shellcheck disable=SC2086
  check --tolerance tolerances.pgm $limit
  succeeds "$scarp" measure part.tif out.obj --tolerance tolerances.pgm
done
check -e 10 --script steps.txt
succeeds "$scarp" measure part.tif out.obj --fail-above 10 --script steps.txt

# fast_because REASON WORDS OPTION...
fast_because() {
  local reason=$1 words=$2
  shift 2
  run "" "$@"
  [ "$(json r.json strategy effort) $(json r.json strategy why_fast)" = "\"fast\" \"$reason\"" ] || fail "the report with $*"
  grep -qF "fast ($words" "$logs/out" || fail "the summary does not tell '$words' with $*"
}
fast_because order 'because of --order greedy; --effort normal takes fewer triangles)' -e 10 --order greedy
fast_because strategy 'because of --edges' -e 10 --edges data
fast_because strategy 'because of --batch' -e 10 --batch const
python3 -c 'print("\n".join(f"{x},{y},{x * x % 17}" for x in range(20) for y in range(20)))' > points.csv
succeeds "$scarp" simplify points.csv points.glb --points -e 2 --report points.json
grep -qF 'effort        normal' "$logs/out" || fail "the summary of points does not tell the effort"
[ "$(json points.json strategy effort)" = '"normal"' ] || fail "the report of points"

# With memory for refinement but not for removal: the same mesh on any number of threads.
succeeds "$scarp" generate fractal 1000 700 rough.tif -q
for threads in 1 3; do
  succeeds "$scarp" simplify rough.tif "rough$threads.glb" -e 0.3% --memory 90M -j "$threads" --report r.json --overwrite
  [ "$(json r.json strategy why_fast)" = '"memory"' ] || fail "not fast for want of memory with -j $threads"
  grep -qF 'fast (because of --memory: removing vertices needs more)' "$logs/out" || fail "the summary hides the memory"
done
cmp rough1.glb rough3.glb || fail "the mesh depends on the number of threads"
refuses 1 "--memory 90M is too little" "$scarp" simplify rough.tif x.glb -e 0.3% --memory 90M --effort normal
echo "the default effort is told"
