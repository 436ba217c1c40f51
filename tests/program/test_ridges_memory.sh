#!/usr/bin/env bash
# --ridges with --memory: the same lines as in memory, inserted strip by strip; the bound holds, the bytes are
# those of any number of threads, and what is searched through counts.
source "$(dirname "$0")/lib.sh"

succeeds "$scarp" generate fractal 1300 1000 hills.tif --seed 3 -q
small=80M # the samples alone are 5 MB, so they stay in their file, and strips are low
goal="-e 20 --ridges 25"
for more in "--effort fast" "--effort normal" "--effort normal --keep-ridges"; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify hills.tif hills.obj $goal $more --memory "$small" -j 1 --report hills.json --overwrite
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify hills.tif whole.obj $goal $more --report whole.json --overwrite
  holds "$(json hills.json max_error) <= 20"
  [ "$(json hills.json topology sound)" = true ] || fail "ridges and $more make an unsound mesh"
  holds "$(json hills.json ridges ridges) > 0"
  for count in ridges valleys line_vertices; do
    [ "$(json hills.json ridges $count)" = "$(json whole.json ridges $count)" ] || fail "other $count than in memory"
  done
  holds "$(json hills.json triangles) <= 1.5 * $(json whole.json triangles)"
done
# shellcheck disable=SC2086
succeeds "$scarp" simplify hills.tif two.obj $goal --effort normal --keep-ridges --memory "$small" -j 2
cmp <(grep -v '^#' hills.obj) <(grep -v '^#' two.obj) || fail "-j 2 makes another mesh"
refuses 1 "--memory $small is too little: ridges and valleys take" \
  "$scarp" simplify hills.tif x.obj -e 20 --ridges 15 --memory "$small"
