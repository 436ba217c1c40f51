#!/usr/bin/env bash
# scarp serve with thousands of clients, many slow, broken or malicious: the others are answered, in bounded memory.
source "$(dirname "$0")/lib.sh"
need python3
succeeds "$scarp" tile "$dem" globe --vertical egm96 --effort fast -q
succeeds "$scarp" tile "$dem" world.pmtiles --vertical egm96 --effort fast -q
echo mine > secret

# start ARGUMENT...: a server in the background with PID $server at $port.
start() {
  # Discards the port of the previous server.
  : > served
  (
    [ -z "${files:-}" ] || ulimit -n "$files"
    exec "$scarp" serve "$@" --port 0 -j 2 > served 2> complaints
  ) &
  server=$!
  await $server names_port served
}
stop() {
  kill -TERM $server
  code=0
  wait $server || code=$?
  [ $code = 0 ] || fail "exit code $code"
  [ ! -s complaints ] || fail "the server complains: $(cat complaints)"
}
trap 'kill $server 2> /dev/null || true; rm -rf "$root"' EXIT

# Only the archive exceeds some megabytes: clients that do not read request it.
start world.pmtiles
succeeds python3 "$SCARP_SOURCE/tests/program/serve_load.py" "$port" globe world.pmtiles "$server"
cat "$logs/out"
stop

# 1,000 places, and more deaf clients than that.
python3 -c 'import random; open("globe/large.bin", "wb").write(random.Random(1).randbytes(8_000_000))'
[ "$(ulimit -Hn)" = unlimited ] || [ "$(ulimit -Hn)" -ge 5000 ] || skip "the rest needs 5,000 open files"
files=2000
start globe
succeeds python3 "$SCARP_SOURCE/tests/program/serve_fair.py" "$port" globe large.bin "$server"
cat "$logs/out"
stop
