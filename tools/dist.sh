#!/bin/bash
# Everything that is handed out, into FOLDER, with SHA256SUMS: the sources, the wheel and the sdist of Scarp for Python, the
# plugin for QGIS, Debian's packages (left out, aloud, where dpkg-buildpackage is not).
#
# usage: tools/dist.sh BUILD FOLDER      BUILD has the program and scarp_c_alone
set -euo pipefail
here=$(dirname "$0")
build=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
find "$folder" -maxdepth 1 -type f -delete
sources=$("$here/source_tarball.sh" "$folder")
"$here/build_python.sh" "$build" "$folder"
python3 "$here/../bindings/qgis/make_plugin.py" "$build/bin/scarp" "$folder/scarp_processing.zip"
if command -v dpkg-buildpackage >/dev/null; then
  "$here/debian_packages.sh" "$sources" "$build/debian" >"$build/debian.log" 2>&1 || { tail -n 50 "$build/debian.log"; exit 1; }
  cp "$build/debian"/*.deb "$folder/"
  rm -rf "$build/debian"
else
  echo "Debian's packages: left out, this is not a Debian machine"
fi
cd "$folder"
find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%P\n' | LC_ALL=C sort | xargs sha256sum -- >SHA256SUMS
cat SHA256SUMS
