#!/usr/bin/env bash
# --effort with --memory: strips are fitted while their samples are in memory. The same promise, fewer triangles, and
# the same bytes on any number of threads.
source "$(dirname "$0")/lib.sh"
need python3
small=80M # too small for the samples: they stay in their file, and strips are low

succeeds "$scarp" generate smooth 1500 1400 smooth.tif -q
for raster in smooth.tif "$dem"; do
  limit=$small
  [ "$raster" = smooth.tif ] || limit=72.8M
  for effort in fast normal high; do
    by_threads "$raster" "$effort.glb" -e 2% --effort "$effort" --memory "$limit"
    mv r.json "$effort.json"
    succeeds "$scarp" measure "$raster" "$effort.glb" --fail-above "$(json "$effort.json" goal max_error)"
    [ "$(json "$effort.json" strategy effort)" = "\"$effort\"" ] || fail "the report does not tell the effort"
  done
  [ "$(json normal.json strategy vertices) $(json high.json strategy vertices)" = '"samples" "free"' ] ||
    fail "the report does not tell where vertices are"
  holds "$(json normal.json triangles) < 0.75 * $(json fast.json triangles)"
  holds "$(json high.json triangles) < 0.85 * $(json normal.json triangles)"
done
python3 - normal.json <<'PYTHON'
import json, sys
passes = {p["name"]: p for p in json.load(open(sys.argv[1]))["passes"]}
assert passes["fit"]["removals"] > 1000 and passes["tiles"]["removals"] == 0, passes
PYTHON

# On samples, with a shape floor, an expired time limit, in a frame with an irregular grid.
for more in "--vertices samples" "--min-shape 0.2" "--time-limit 0" "--crs EPSG:32616"; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify "$dem" more.ply -e 10 --effort high --memory 72.8M $more --overwrite
  case $more in --crs*) frame="$more" ;; *) frame= ;; esac
  # shellcheck disable=SC2086
  succeeds "$scarp" measure "$dem" more.ply --fail-above 10 $frame
done

# Without an effort it is normal.
succeeds "$scarp" simplify "$dem" auto.glb -e 2% --memory 72.8M --report auto.json
[ "$(json auto.json strategy effort)" = '"normal"' ] || fail "the default is not normal"
