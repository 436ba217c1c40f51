#!/usr/bin/env bash
# scarp serve: a tileset over HTTP, with correct and incorrect requests.
source "$(dirname "$0")/lib.sh"
need python3
client=$SCARP_SOURCE/tests/program/serve.py

succeeds "$scarp" tile "$dem" globe --vertical egm96 -q
succeeds "$scarp" tile "$dem" world.pmtiles --vertical egm96 -q
succeeds "$scarp" tile "$dem" world.mbtiles --vertical egm96 -q
tiles=$(find globe -name '*.terrain' | wc -l)
echo mine > secret
cp -r globe linked
ln -s ../secret linked/link
echo mine > linked/.hidden

# start ARGUMENT...: a server in the background with PID $server at $port.
start() {
  # A background job of a script ignores SIGINT unless job control is on. Discards the port of the previous server.
  : > served
  set -m
  "$scarp" serve "$@" --port 0 > served 2> complaints &
  server=$!
  set +m
  await $server names_port served
}

# stop SIGNAL: the server ends immediately with exit code 0 and no message.
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

# After a set is replaced, in a folder and in one file, its new tiles are served.
old=(--vertical ellipsoid --zoom 4 --effort fast -q)
new=(--vertical ellipsoid --zoom 3 --background 7 --effort fast -q)
replaced=$SCARP_SOURCE/tests/program/serve_replaced.py
succeeds "$scarp" tile "$dem" old "${old[@]}"
succeeds "$scarp" tile "$dem" new "${new[@]}"
for set in set set.pmtiles set.mbtiles set.3tz; do
  succeeds "$scarp" tile "$dem" $set "${old[@]}"
  start $set
  succeeds python3 "$replaced" "$port" old new "$scarp" tile "$dem" $set "${new[@]}" --overwrite
  stop INT
done

# Without the viewer's page next to the program, a map of the tiles is shown.
mkdir -p alone/bin
cp "$scarp" alone/bin/scarp
if alone/bin/scarp --version > /dev/null 2>&1; then
  scarp=alone/bin/scarp start old
  succeeds python3 -c "import sys, urllib.request; print(urllib.request.urlopen('http://127.0.0.1:$port/').read().decode())"
  [ "$(grep -o '<rect ' "$logs/out" | wc -l)" = "$(ls old/4/*/*.terrain | wc -l)" ] || fail "the map has other tiles: $(cat "$logs/out")"
  stop INT
fi

# Files added to the folder later have the types of their endings; a page in the folder has priority.
start linked
mkdir -p linked/Assets/Images
succeeds python3 - "$port" << 'END'
import pathlib, sys, urllib.request


def fetch(path):
    with urllib.request.urlopen(f"http://127.0.0.1:{sys.argv[1]}{path}") as answer:
        return answer.headers["Content-Type"], answer.read()


assert b"<!" in fetch("/")[1]
for name, kind in {"icon.svg": "image/svg+xml", "logo.png": "image/png", "draco.wasm": "application/wasm",
                   "a.mjs": "text/javascript; charset=utf-8", "photo.webp": "image/webp", "a.geojson": "application/geo+json",
                   "unknown.xyz": "application/octet-stream", "large.bin": "application/octet-stream"}.items():
    bytes = name.encode() * (1000000 if name == "large.bin" else 1)
    pathlib.Path("linked/Assets/Images", name).write_bytes(bytes)
    assert fetch("/Assets/Images/" + name) == (kind, bytes), name
pathlib.Path("linked/index.html").write_text("<p>mine")
assert fetch("/") == ("text/html; charset=utf-8", b"<p>mine")
part = urllib.request.Request(f"http://127.0.0.1:{sys.argv[1]}/index.html", headers={"Range": "bytes=3-"})
assert urllib.request.urlopen(part).read() == b"mine"
assert b"\n/layer.json\n" in fetch("/index.txt")[1]
END
stop INT

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
