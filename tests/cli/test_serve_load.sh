#!/usr/bin/env bash
# scarp serve among thousands of clients, slow, broken and malicious ones among them: the others are answered, in bounded memory.
source "$(dirname "$0")/lib.sh"
need python3
succeeds "$scarp" tile "$dem" globe --vertical egm96 --effort fast -q
succeeds "$scarp" tile "$dem" world.pmtiles --vertical egm96 --effort fast -q
echo mine > secret

# Above the archive's own megabytes nothing is to be gained from it: it is asked for by those who do not read.
"$scarp" serve world.pmtiles --port 0 -j 2 > served 2> complaints &
server=$!
trap 'kill $server 2> /dev/null || true; rm -rf "$root"' EXIT
port=
for _ in $(seq 200); do
  port=$(sed -n 's#^  at  *http://127\.0\.0\.1:\([0-9]*\)/$#\1#p' served)
  [ -z "$port" ] || break
  sleep 0.05
done
[ -n "$port" ] || fail "the server names no port"
succeeds python3 "$SCARP_SOURCE/tests/cli/serve_load.py" "$port" globe world.pmtiles "$server"
cat "$logs/out"
kill -TERM $server
code=0
wait $server || code=$?
[ $code = 0 ] || fail "exit code $code"
[ ! -s complaints ] || fail "the server complains: $(cat complaints)"
