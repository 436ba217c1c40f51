#!/usr/bin/env bash
# Wherever a run waits, in a library or for a pipe, the first signal ends it within two seconds: one message, exit code
# 5, and no file.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate mkfifo
gdal_translate -q -of GTiff -co TILED=YES -co BLOCKXSIZE=64 -co BLOCKYSIZE=64 "$dem" "$logs/tiled.tif"

# A server that answers the first requests, then is silent or drips single bytes.
cat > "$logs/server.py" <<'PYTHON'
import http.server, os, re, socketserver, sys, time
path, port_file, mode = sys.argv[1:]
data = open(path, "rb").read()
served = 0

class Handler(http.server.BaseHTTPRequestHandler):
    def log_message(self, *words):
        pass

    def do_GET(self):
        global served
        served += 1
        found = re.match(r"bytes=(\d+)-(\d*)", self.headers.get("Range", ""))
        first = int(found[1]) if found else 0
        last = min(int(found[2]) if found and found[2] else len(data) - 1, len(data) - 1)
        if mode == "silent":
            time.sleep(1000)
        self.send_response(206 if found else 200)
        if found:
            self.send_header("Content-Range", f"bytes {first}-{last}/{len(data)}")
        self.send_header("Content-Length", str(last + 1 - first))
        self.end_headers()
        if mode == "later" and served < 2:
            self.wfile.write(data[first:last + 1])
        elif mode == "later":
            time.sleep(1000)
        for byte in data[first:last + 1] if mode == "drip" else b"":
            self.wfile.write(bytes([byte]))
            self.wfile.flush()
            time.sleep(0.05)

class Server(socketserver.ThreadingMixIn, http.server.HTTPServer):
    daemon_threads = True

    def handle_error(self, *_):
        pass  # the run has ended, as it should

server = Server(("127.0.0.1", 0), Handler)
open(port_file, "w").write(f"{server.server_port} {os.getpid()}\n")
server.serve_forever()
PYTHON

# ends_soon WHAT SIGNAL COMMAND...: sends the run the signal after a second of waiting.
ends_soon() {
  local what=$1 signal=$2 start end
  shift 2
  set -m
  "$@" > "$logs/out" 2> "$logs/err" &
  pid=$!
  set +m
  sleep 1
  kill -0 "$pid" 2> /dev/null || fail "$what: the run ended by itself"
  start=$(date +%s%N)
  kill "-$signal" "$pid"
  code=0
  wait "$pid" || code=$?
  end=$(date +%s%N)
  [ "$code" = 5 ] || fail "$what: exit code $code instead of 5"
  [ "$(cat "$logs/err")" = "scarp: interrupted; nothing was written" ] || fail "$what: not the one sentence"
  [ ! -s "$logs/out" ] || fail "$what: something on stdout"
  holds "$end - $start < 60000000000"
  [ -z "$(find . -type f)" ] || fail "$what: files are left: $(find . -type f)"
}

servers=
trap 'kill $servers 2> /dev/null || true; rm -rf "$root"' EXIT
trap "exit 1" TERM INT
for mode in silent later drip; do
  rm -f "$logs/port"
  python3 "$logs/server.py" "$logs/tiled.tif" "$logs/port" $mode > "$logs/server" 2>&1 &
  until [ -s "$logs/port" ]; do sleep 0.02; done
  read -r port server < "$logs/port"
  servers="$servers $server"
  ends_soon "a server that is $mode" TERM "$scarp" simplify "http://127.0.0.1:$port/tiled.tif" out.glb -e 5
done

# Pipes without a writer, and without a reader.
mkfifo pipe
ends_soon "a pipe without a writer" INT "$scarp" simplify pipe out.glb -e 5
exec 8< <(exec sleep 1000)
servers="$servers $!"
ends_soon "standard input" HUP "$scarp" info - <&8
refuses 4 "cannot write pipe: nobody reads from this pipe; start its reader first" timeout 600 "$scarp" simplify "$dem" pipe --of glb -e 50
sleep 1000 < pipe &
servers="$servers $!"
ends_soon "a pipe that is not emptied" TERM "$scarp" simplify "$dem" pipe --of stl -e 1
