#!/usr/bin/env bash
# The byte table: outputs of some 80 sets of options for four rasters, in memory and streamed, have the same bytes as
# before. A commit must explain changed rows; to update: tests/bytes/table.py PROGRAM DEM TABLE --update
source "$(dirname "$0")/lib.sh"
need python3

python3 "$SCARP_SOURCE/tests/bytes/table.py" "$scarp" "$dem" "$SCARP_SOURCE/tests/bytes/table.txt" ||
  fail "files differ from tests/bytes/table.txt"
