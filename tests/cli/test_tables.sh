#!/bin/bash
# The tables of docs/performance.md and bench/speed/results.md are those of the numbers that are kept.
set -euo pipefail
source_tree=${SCARP_SOURCE:?}
python=$(command -pv python3 || command -v python3) || { echo "skipped: python3 is missing"; exit 77; }
PYTHONDONTWRITEBYTECODE=1 "$python" "$source_tree/bench/speed/report.py" --check
