#!/bin/bash
# The tables of bench/performance.md, bench/quality.md and bench/tiles.md match the stored numbers, and the pictures of
# bench/quality.md exist.
set -euo pipefail
source_tree=${SCARP_SOURCE:?}
python=$(command -pv python3 || command -v python3) || { echo "skipped: python3 is missing"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
"$python" "$source_tree/bench/report.py" --check
grep -o 'images/[a-z_]*\.png' "$source_tree/bench/quality.md" | sort -u | while read -r picture; do
  [ -s "$source_tree/bench/$picture" ] || { echo "bench/$picture is missing"; exit 1; }
done
