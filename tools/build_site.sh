#!/bin/bash
# Builds the static site in a folder: documents, an example of the viewer, and the page for trying own files. Needs
# BUILD/bin/scarp and the npm package of `make npm`.
#
# usage: tools/build_site.sh BUILD SITE
set -euo pipefail
build=$(cd "$1" && pwd)
site=$(mkdir -p "$2" && cd "$2" && pwd)
cd "$(dirname "$0")/.."
[ -e "$build-wasm/npm/inline-data.js" ] || { echo "The site needs the engine of 'make npm' ($build-wasm/npm)." >&2; exit 1; }
tools/build_viewer.sh "$build"
cp "$build/share/scarp/viewer.html" "$site/try.html"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$build/bin/scarp" simplify data/jacksboro_fault.tif "$scratch/jacksboro.glb" -e 20 --quiet
"$build/bin/scarp" view "$scratch/jacksboro.glb" data/jacksboro_fault.tif -o "$site/example.html" --overwrite --quiet
cp -r web/dig "$build/viewer/"
node "$build/viewer/dig/build.mjs" "$site/dig.html" "$build-wasm/npm"
cp web/site/build.mjs "$build/viewer/site.mjs"
python3 tools/generate_docs.py "$build/bin/scarp" "$scratch"
python3 tools/python_reference.py "$scratch/doc/scarp/python.md"
node "$build/viewer/site.mjs" . "$site" "$scratch/doc/scarp"
