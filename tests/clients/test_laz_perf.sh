#!/usr/bin/env bash
# laz-perf, a reader that is not ours, comes to the same points in all LAZ files of the shared folder.
source "$(dirname "${BASH_SOURCE[0]}")/../program/lib.sh"
files=${SCARP_SHARED:-$SCARP_SOURCE/../shared}/data/las
[ -d "$files" ] || skip "the shared files are not here"
[ -x "$SCARP_BUILD/bin/scarp_speed_las" ] || skip "needs scarp_speed_las"
npm_judges laz-perf || skip "needs laz-perf"
cp "$SCARP_SOURCE/bench/speed/speed_laz_perf.mjs" "$js/"

counted() { sed -E 's/[{}" ]//g; s/,(bytes|cpu_seconds).*//'; } # points, hash and points of class 2
for file in "$files"/*.laz; do
  ours=$("$SCARP_BUILD/bin/scarp_speed_las" "$file" --rounds 1 | counted)
  if ! peers=$(node "$js/speed_laz_perf.mjs" "$file" 1 2>"$logs/err" | counted); then
    echo "left out: $(basename "$file"), which laz-perf does not read"
    continue
  fi
  [ "$ours" = "$peers" ] || fail "$file: $ours, and laz-perf reads $peers"
  echo "$(basename "$file"): $ours"
done
