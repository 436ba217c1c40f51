#!/usr/bin/env bash
# Budgets with --memory: a raster that stays in its file becomes a mesh that uses the budget, also with lines, within
# the limit and with the same bytes on any number of threads.
source "$(dirname "$0")/lib.sh"
need python3

succeeds "$scarp" generate smooth 1200 900 hills.tif --seed 3 -q
echo '{"type":"LineString","coordinates":[[5.3,7.1],[600,400.5],[1190.7,833.2]]}' > line.geojson
for effort in fast normal; do
  succeeds "$scarp" simplify hills.tif whole.ply -t 4000 --effort "$effort" --report whole.json --overwrite
  within=78 by_threads hills.tif mesh.ply -t 4000 --effort "$effort" --memory 78M
  holds "$(json r.json triangles) <= 4000"
  holds "$(json r.json triangles) >= 0.97 * 4000"
  holds "$(json r.json max_error) <= 1.25 * $(json whole.json max_error)"
  succeeds "$scarp" measure hills.tif mesh.ply --fail-above "$(json r.json max_error)"
done
within 78 "$scarp" simplify hills.tif mesh.ply -p 2000 --breaklines line.geojson --effort normal --memory 78M --report r.json --overwrite
holds "$(json r.json vertices) <= 2000"
holds "$(json r.json vertices) >= 0.97 * 2000"
[ "$(json r.json topology sound)" = true ] || fail "a budget with a line makes an unsound mesh"
within 78 "$scarp" simplify hills.tif mesh.ply -e 20 -t 100000 --memory 78M --report r.json --overwrite
holds "$(json r.json max_error) <= 20"

echo '{"type":"LineString","coordinates":[[5.3,800.1],[600,400.5]]}' > river.geojson
succeeds "$scarp" simplify hills.tif mesh.ply -t 2000 --rivers river.geojson --effort normal --objective rms --overwrite

refuses 1 "alone need" "$scarp" simplify hills.tif x.ply -t 1 --memory 78M
refuses 1 "--memory 74M is too little: the mesh has" "$scarp" simplify hills.tif x.ply -t 400000 --memory 74M
grep -q 'allow that much, or a smaller budget of triangles$' "$logs/err" || fail "the advice does not name the budget"
refuses 1 "or a smaller budget of vertices" "$scarp" simplify hills.tif x.ply -p 200000 --memory 74M
