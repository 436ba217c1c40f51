#!/usr/bin/env bash
# A raster over HTTP: read by ranges from a local server, with the same mesh as from the file.
set -euo pipefail
nginx=$(command -v nginx || command -v /usr/sbin/nginx || true)
gdal_translate=$(command -v gdal_translate || true)
if [ -z "$nginx" ] || [ -z "$gdal_translate" ]; then
  echo "skipped: needs nginx (nginx-light) and gdal_translate (gdal-bin)"
  exit 77
fi
scarp=$SCARP_BUILD/bin/scarp
work=$(mktemp -d)
trap 'if [ -f "$work/nginx.pid" ]; then kill "$(cat "$work/nginx.pid")" 2>/dev/null || true; fi; rm -rf "$work"' EXIT
chmod 755 "$work"
mkdir -p "$work/www" "$work/tmp"

# A 700 x 700 hill as cloud-optimised GeoTIFF: several tiles, so that a range is smaller than the file.
awk 'BEGIN {
  print "ncols 700\nnrows 700\nxllcorner 500000\nyllcorner 4000000\ncellsize 10";
  for (r = 0; r < 700; ++r) {
    line = "";
    for (c = 0; c < 700; ++c) line = line sprintf("%.2f ", 300 * sin(c / 90) * cos(r / 70) + 0.01 * ((c * 7919 + r * 104729) % 500));
    print line;
  }
}' > "$work/hill.asc"
gdal_translate -q -of COG -co COMPRESS=DEFLATE -co BLOCKSIZE=256 -a_srs EPSG:32611 "$work/hill.asc" "$work/www/hill.tif"
head -c 200000 "$work/www/hill.tif" > "$work/www/cut.tif"

start_server() {
  cat > "$work/nginx.conf" <<CONF
pid $work/nginx.pid;
error_log $work/error.log;
events {}
http {
  log_format ranges '\$request_method \$status \$uri \$body_bytes_sent';
  access_log $work/access.log ranges;
  client_body_temp_path $work/tmp; proxy_temp_path $work/tmp; fastcgi_temp_path $work/tmp;
  uwsgi_temp_path $work/tmp; scgi_temp_path $work/tmp;
  server { listen 127.0.0.1:$1; root $work/www; }
}
CONF
  "$nginx" -p "$work" -c "$work/nginx.conf" 2> "$work/start.log"
}
port=
for attempt in 1 2 3 4 5 6 7 8; do
  candidate=$((20000 + (RANDOM + attempt) % 20000))
  if start_server "$candidate"; then port=$candidate; break; fi
done
if [ -z "$port" ]; then
  echo "nginx does not start:"; cat "$work/start.log"
  exit 1
fi

"$scarp" simplify "http://127.0.0.1:$port/hill.tif" "$work/remote.stl" -e 5
"$scarp" simplify "$work/www/hill.tif" "$work/local.stl" -e 5
# STL has no command line: equal rasters give equal bytes after the 80-byte header.
cmp <(tail -c +81 "$work/remote.stl") <(tail -c +81 "$work/local.stl")
"$scarp" simplify "http://127.0.0.1:$port/hill.tif" "$work/out.glb" -e 5
test -s "$work/out.glb"

grep -q '^GET 206 /hill.tif' "$work/access.log" || { echo "no range request was made:"; cat "$work/access.log"; exit 1; }
if grep -v '/hill.tif' "$work/access.log"; then echo "requests for side files were made"; exit 1; fi

status=0
"$scarp" simplify "http://127.0.0.1:$port/missing.tif" "$work/missing.glb" -e 5 2> "$work/missing.err" || status=$?
[ "$status" -eq 2 ] && [ ! -e "$work/missing.glb" ] && grep -q 'missing.tif' "$work/missing.err"
status=0
"$scarp" simplify "http://127.0.0.1:$port/cut.tif" "$work/cut.glb" -e 5 2> "$work/cut.err" || status=$?
[ "$status" -eq 2 ] && [ ! -e "$work/cut.glb" ] && grep -q 'cut.tif' "$work/cut.err"
echo "read by $(grep -c 206 "$work/access.log") range requests"
