#!/usr/bin/env bash
# scarp serve: a set of tiles over HTTP, as clients ask for it and as they should not.
source "$(dirname "$0")/lib.sh"
need python3
client=$SCARP_SOURCE/tests/cli/serve.py

succeeds "$scarp" tile "$dem" globe --vertical egm96 -q
succeeds "$scarp" tile "$dem" world.pmtiles --vertical egm96 -q
succeeds "$scarp" tile "$dem" world.mbtiles --vertical egm96 -q
tiles=$(find globe -name '*.terrain' | wc -l)
echo mine > secret
cp -r globe linked
ln -s ../secret linked/link
echo mine > linked/.hidden

# start ARGUMENT...: a server in the background, with the number $server, at $port.
start() {
  # A background job of a script ignores SIGINT unless job control is on.
  # The one before may have left its port there.
  : > served
  set -m
  "$scarp" serve "$@" --port 0 > served 2> complaints &
  server=$!
  set +m
  port=
  for _ in $(seq 200); do
    port=$(sed -n 's#^  at  *http://127\.0\.0\.1:\([0-9]*\)/$#\1#p' served)
    [ -z "$port" ] || return 0
    kill -0 $server 2> /dev/null || fail "the server ended"
    sleep 0.05
  done
  fail "the server names no port"
}

# stop SIGNAL: ends at once, with exit code 0 and no word.
stop() {
  kill "-$1" $server
  code=0
  wait $server || code=$?
  [ $code = 0 ] || fail "exit code $code after SIG$1"
  [ ! -s complaints ] || fail "the server complains: $(cat complaints)"
}

start linked
trap 'kill $server 2> /dev/null || true; rm -rf "$root"' EXIT
succeeds python3 "$client" "$port" globe
[ "$(cat "$logs/out")" = "$tiles" ] || fail "not all tiles were asked for"
refuses 1 "port $port is in use" "$scarp" serve globe --port "$port"
stop INT

for archive in world.pmtiles world.mbtiles; do
  start $archive
  succeeds python3 "$client" "$port" globe $archive
  stop TERM
done

# A user's mistakes.
refuses 2 "no such file" "$scarp" serve missing.pmtiles
refuses 1 "nobody says what the heights" "$scarp" serve "$dem"
cp secret bad.pmtiles
refuses 2 "is no PMTiles" "$scarp" serve bad.pmtiles
head -c 3000 world.pmtiles > cut.pmtiles
refuses 2 "was cut off" "$scarp" serve cut.pmtiles
refuses 1 "--port" "$scarp" serve globe --port 70000
refuses 1 "--port" "$scarp" serve globe --port x
refuses 1 "--host" "$scarp" serve globe --host 192.0.2.1
