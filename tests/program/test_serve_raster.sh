#!/usr/bin/env bash
# scarp serve of a raster and of a plan: tiles made on demand equal those of the finished set.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdaladdo
client=$SCARP_SOURCE/tests/program/serve_raster.py

# start ARGUMENT...: a server in the background with PID $server at $port.
start() {
  # Discards the port of the previous server.
  : > served
  set -m
  "$scarp" serve "$@" --port 0 > served 2> complaints &
  server=$!
  set +m
  await $server names_port served
}
stop() {
  kill -INT $server
  code=0
  wait $server || code=$?
  [ $code = 0 ] || fail "exit code $code"
}
trap 'kill $server 2> /dev/null || true; rm -rf "$root"' EXIT

# With nodata, in memory.
make_raster holes.tif '300 + (col * 7 + row * 3) % 59 + 40 * math.sin(col / 30) if (col // 60 + row // 50) % 3 else nan'
succeeds "$scarp" tile holes.tif globe --vertical egm96 --effort fast --background 250 -q
start holes.tif --vertical egm96 --background 250 -j 2
grep -q "made when asked for" served || fail "the server does not tell that it makes tiles"
grep -q "heights   above EGM96" served || fail "the server does not tell what heights are above"
succeeds python3 "$client" "$port" globe "$server"
[ "$(cat "$logs/out")" = "$(find globe -name '*.terrain' | wc -l)" ] || fail "not all tiles were asked for"
stop
[ ! -s complaints ] || fail "the server complains: $(cat complaints)"
# The server ends whatever it is preparing.
start holes.tif --vertical egm96 --effort high -j 2
stop

# A plan, and a raster in another CRS that stays in its file.
succeeds gdalwarp -q -t_srs EPSG:32616 -r bilinear -co TILED=YES -co COMPRESS=DEFLATE "$dem" utm.tif
succeeds "$scarp" tile plan utm.tif plan.json --vertical egm96 --effort fast --zoom 10 -q
succeeds "$scarp" tile utm.tif mapped --vertical egm96 --effort fast --zoom 10 -q
start plan.json --memory 1M -j 2
succeeds python3 "$client" "$port" mapped
await $server grep -q "no room for all coarse tiles" complaints
stop

refuses 1 "--effort" "$scarp" serve plan.json --effort high
refuses 1 "--zoom" "$scarp" serve globe --zoom 3
refuses 1 "one set or plan" "$scarp" serve globe "$dem"
refuses 1 "nobody says what the heights" "$scarp" serve "$dem"
refuses 1 "--memory" "$scarp" serve "$dem" --vertical egm96 --memory x
touch utm.tif
refuses 2 "plan again" "$scarp" serve plan.json
echo '{}' > none.json
refuses 2 "no plan of tiles" "$scarp" serve none.json
