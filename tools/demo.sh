#!/bin/bash
# The demonstration: a bundled DEM becomes a mesh in two formats, a picture and a report in demo/; the mesh file is read
# back and judged; a table tells what came out, and a page shows it where the viewer could be built.
#
# usage: tools/demo.sh PROGRAM
set -euo pipefail
scarp=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
cd "$(dirname "$0")/.."
dem=data/jacksboro_fault.tif
goal=20
python=$(command -pv python3 || command -v python3)

# The command as a user would type it, then its run.
run() {
  echo "scarp $*"
  "$scarp" "$@" --quiet
}

mkdir -p demo
run simplify "$dem" demo/jacksboro.glb -e $goal --normals --preview demo/jacksboro.png --report demo/jacksboro.json --overwrite
run simplify "$dem" demo/jacksboro.obj -e $goal --overwrite
echo "scarp measure $dem demo/jacksboro.glb --fail-above $goal"
"$scarp" measure "$dem" demo/jacksboro.glb --fail-above $goal --json --quiet >demo/measured.json
"$scarp" measure "$dem" demo/jacksboro.obj --fail-above $goal --quiet >/dev/null
page=$(dirname "$scarp")/../share/scarp/viewer.html
if [ -e "$page" ]; then
  run view demo/jacksboro.glb "$dem" -o demo/jacksboro.html --overwrite
fi
"$python" tools/demo_table.py demo/jacksboro.json demo/measured.json demo/jacksboro.glb demo/jacksboro.obj \
  demo/jacksboro.png demo/jacksboro.json
if [ -e "$page" ]; then
  echo "Look at it, with its errors: open $PWD/demo/jacksboro.html in a browser."
else
  echo "'make viewer' builds the page that shows it in a browser; it needs node and npm."
fi
echo "A raster of your own: ${scarp#"$PWD/"} simplify YOUR.tif out.glb -e 1%"
