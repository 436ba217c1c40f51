#!/usr/bin/env bash
# The byte table: what some 80 sets of options make of four rasters, in memory and streamed, has the bytes that it had.
# A row that differs is a change to argue in its commit; then: tests/bytes/table.py PROGRAM DEM TABLE --update
source "$(dirname "$0")/lib.sh"
need python3

library=$SCARP_BUILD/tests/libscarp_start_once.so
[ ! -e "$library" ] || export SCARP_START_ONCE=$library
python3 "$SCARP_SOURCE/tests/bytes/table.py" "$scarp" "$dem" "$SCARP_SOURCE/tests/bytes/table.txt" ||
  fail "files differ from tests/bytes/table.txt"
