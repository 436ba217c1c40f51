#!/bin/bash
# The demonstration: makes a mesh, a picture and a report of a bundled DEM in demo/, reads the mesh file back and judges
# it. A page shows it if the viewer could be built. The program's output is what a user sees.
#
# usage: tools/demo.sh PROGRAM
set -euo pipefail
scarp=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
cd "$(dirname "$0")/.."
dem=data/jacksboro_fault.tif

# Prints the command as a user would type it, then runs it.
run() {
  printf '\n$ scarp %s\n' "$*"
  "$scarp" "$@"
}

mkdir -p demo
run info "$dem"
run simplify "$dem" demo/jacksboro.glb -e 20 --preview demo/jacksboro.png --report demo/jacksboro.json --overwrite
run measure "$dem" demo/jacksboro.glb --fail-above 20
page=$(dirname "$scarp")/../share/scarp/viewer.html
if [ -e "$page" ]; then run view demo/jacksboro.glb "$dem" -o demo/jacksboro.html --overwrite; fi

printf '\nOpen\n'
if [ -e "$page" ]; then echo "  demo/jacksboro.html   in a browser: the mesh and the error of every sample"; fi
echo "  demo/jacksboro.png    the hills, shaded, with the mesh over them"
echo "  demo/jacksboro.glb    in Blender, a game engine or any viewer of glTF"
echo "  demo/jacksboro.json   the numbers, for scripts"
if [ ! -e "$page" ]; then echo "'make viewer' builds the page that shows a mesh in a browser; it needs node and npm."; fi
printf '\nA raster of your own (.obj, .stl, .ply and others by their names):\n'
echo "  ${scarp#"$PWD/"} simplify YOUR.tif out.glb -e 1%"
