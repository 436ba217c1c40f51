#!/bin/bash
# Builds the viewer's page, BUILD/share/scarp/viewer.html, a template for BUILD/bin/scarp. npm fetches three.js and
# esbuild once, into BUILD/viewer. With the npm package of `make npm` in ENGINE the page also refines live.
#
# usage: tools/build_viewer.sh BUILD [ENGINE]      ENGINE: BUILD-wasm/npm if it exists
set -euo pipefail
build=$(mkdir -p "$1" && cd "$1" && pwd)
cd "$(dirname "$0")/.."
engine=${2:-$build-wasm/npm}
for tool in node npm; do
  command -v $tool >/dev/null || { echo "The viewer's page needs $tool (Debian: nodejs, npm); it is not built." >&2; exit 1; }
done
work=$build/viewer
mkdir -p "$work"
exec 9>"$work/lock"
flock 9
rm -rf "$work/src"
cp -r web/viewer/src web/viewer/build.mjs web/viewer/package.json web/viewer/package-lock.json "$work/"
cp bindings/wasm/package/alive.js "$work/src/"
if ! cmp -s "$work/package-lock.json" "$work/node_modules/installed"; then
  (cd "$work" && npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1) || {
    echo "The viewer's page needs packages that npm cannot fetch now ($work/npm.log tells why); it is not built." >&2
    exit 1
  }
  cp "$work/package-lock.json" "$work/node_modules/installed"
fi
node "$work/build.mjs" "$build/share/scarp/viewer.html" "$engine"
