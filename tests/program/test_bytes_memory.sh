#!/usr/bin/env bash
# The rows of the byte table (test_bytes.sh) for streamed rasters.
source "$(dirname "$0")/lib.sh"
need python3

python3 "$SCARP_SOURCE/tests/bytes/table.py" "$scarp" "$dem" "$SCARP_SOURCE/tests/bytes/table.txt" streamed ||
  fail "files differ from tests/bytes/table.txt"
