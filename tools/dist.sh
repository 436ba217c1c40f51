#!/bin/bash
# Makes everything to distribute in FOLDER, with SHA256SUMS: the sources, the npm package, the wheel and the sdist for
# Python, the plugin for QGIS, Debian packages. Wheel and packages include the viewer's page. Files that cannot be made
# on this machine are skipped, with a message: the npm package without Emscripten, the page where npm cannot fetch,
# Debian's packages without dpkg-buildpackage.
#
# usage: tools/dist.sh BUILD FOLDER      BUILD has the program and scarp_c_alone; Emscripten builds in BUILD-wasm
set -euo pipefail
here=$(dirname "$0")
build=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
find "$folder" -maxdepth 1 -type f -delete
sources=$("$here/source_tarball.sh" "$folder")

# quietly LOG COMMAND...: prints the end of the log only on failure.
quietly() {
  local log=$1
  shift
  "$@" >"$log" 2>&1 || { tail -n 50 "$log" >&2; exit 1; }
}

if command -v em++ >/dev/null && command -v npm >/dev/null; then
  quietly "$build/npm.log" "$here/build_npm.sh" "$build-wasm" "$folder"
else
  echo "the npm package: left out, it needs em++ and npm"
fi
"$here/build_viewer.sh" "$build" >/dev/null || echo "the viewer's page: left out of wheel and packages"
"$here/build_python.sh" "$build" "$folder" >/dev/null
python3 "$here/../bindings/qgis/make_plugin.py" "$build/bin/scarp" "$folder/scarp_processing.zip"
if command -v dpkg-buildpackage >/dev/null; then
  # Without debug symbols, which are larger than the packages and need longer to compile.
  export DEB_BUILD_OPTIONS="nocheck noautodbgsym" DEB_CXXFLAGS_STRIP=-g SCARP_VIEWER_PAGE=$build/share/scarp/viewer.html
  quietly "$build/debian.log" "$here/debian_packages.sh" "$sources" "$build/debian"
  cp "$build/debian"/*.deb "$folder/"
  rm -rf "$build/debian"
else
  echo "Debian's packages: left out, this is not a Debian machine"
fi
cd "$folder"
find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%P\n' | LC_ALL=C sort | xargs sha256sum -- >SHA256SUMS
cat SHA256SUMS
