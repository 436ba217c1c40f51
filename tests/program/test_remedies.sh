#!/usr/bin/env bash
# Every command and option that a message recommends works as printed and leads to a result.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalwarp ogr2ogr xmllint gdal_fillnodata.py
mkdir rows
cd rows
try python3 "$SCARP_SOURCE/tests/program/remedies.py" "$scarp" "$SCARP_SOURCE" "$data/examples"
cat "$logs/out"
[ "$code" = 0 ] || fail "a remedy does not work"
