#!/usr/bin/env bash
# The byte table: outputs of some 90 sets of options for four rasters have the same bytes as before; streamed rasters:
# test_bytes_memory.sh. A commit must explain changed rows; to update: tests/bytes/table.py PROGRAM DEM TABLE --update
source "$(dirname "$0")/lib.sh"
need python3

python3 "$SCARP_SOURCE/tests/bytes/table.py" "$scarp" "$dem" "$SCARP_SOURCE/tests/bytes/table.txt" memory ||
  fail "files differ from tests/bytes/table.txt"
