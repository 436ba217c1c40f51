#!/usr/bin/env bash
# --ridges with --memory: the same lines as in memory, inserted strip by strip. The bound holds, any number of threads
# gives the same bytes, and the memory of the search counts.
source "$(dirname "$0")/lib.sh"

succeeds "$scarp" generate fractal 1300 1000 hills.tif --seed 3 -q
small=80M # the samples alone are 5 MB, so they stay in their file, and strips are low
goal="-e 20 --ridges 25"
for more in "--effort fast" "--effort normal" "--effort normal --keep-ridges"; do
  # shellcheck disable=SC2086
  by_threads hills.tif hills.obj $goal $more --memory "$small"
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify hills.tif whole.obj $goal $more --report whole.json --overwrite
  holds "$(json r.json max_error) <= 20"
  holds "$(json r.json ridges ridges) > 0"
  agree r.json whole.json "ridges ridges" "ridges valleys" "ridges line_vertices"
  holds "$(json r.json triangles) <= 1.5 * $(json whole.json triangles)"
done
refuses 1 "--memory $small is too little: ridges and valleys take" \
  "$scarp" simplify hills.tif x.obj -e 20 --ridges 15 --memory "$small"
