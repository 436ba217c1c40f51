#!/bin/bash
# Makes the wheel and the sdist of Scarp for Python in a folder, with the library of a build folder, without GDAL.
#
# usage: tools/build_python.sh BUILD FOLDER
set -euo pipefail
source_tree=$(cd "$(dirname "$0")/.." && pwd)
library=$(realpath "$1/bindings/python/libscarp_c.so")
mkdir -p "$2"
folder=$(realpath "$2")
page=$(realpath -m "$1/share/scarp/viewer.html")  # where `make viewer` has built it
if [ -e "$page" ]; then export SCARP_VIEWER_PAGE=$page; fi
cd "$source_tree/bindings/python"
SCARP_C_LIBRARY=$library python3 -B -c '
import sys
import backend
for build in (backend.build_wheel, backend.build_sdist):
    print(sys.argv[1] + "/" + build(sys.argv[1]))
' "$folder"
