#!/usr/bin/env bash
# Foreign programs read every format that we write and count the same as our report: the Khronos glTF validator, assimp,
# meshio, and admesh for closed solids. A missing program is named and skipped.
source "$(dirname "$0")/../program/lib.sh"
work=$scratch
judges=0

complain() { echo "FAILED: $*"; exit 1; }
# number FILE KEY…: a number of a JSON report
number() { node -e 'let j = JSON.parse(require("fs").readFileSync(process.argv[1])); for (const k of process.argv.slice(2)) j = j[k]; console.log(j)' "$@" 2>/dev/null ||
  python3 -c 'import json, sys
j = json.load(open(sys.argv[1]))
for k in sys.argv[2:]: j = j[k]
print(j)' "$@"; }
# same WHAT GOT WANTED
same() { [ "$2" = "$3" ] || complain "$1: $2, and our report says $3"; echo "  $1: $2"; }

for format in glb obj ply stl; do
  "$scarp" simplify "$dem" "$work/open.$format" -e 5 --normals --report "$work/open.json" --overwrite -q
  "$scarp" simplify "$dem" "$work/solid.$format" -e 5 --base 100 --report "$work/solid.json" --overwrite -q
done
"$scarp" simplify "$dem" "$work/plain.glb" -e 20 -q
open_vertices=$(number "$work/open.json" vertices)
open_triangles=$(number "$work/open.json" triangles)
solid_vertices=$(number "$work/solid.json" solid vertices)
solid_triangles=$(number "$work/solid.json" solid triangles)
echo "open: $open_vertices vertices, $open_triangles triangles; solid: $solid_vertices vertices, $solid_triangles triangles"

# Colours, uvs and channels: three meshes with different attributes.
read -r attribute_vertices attribute_triangles < <("$SCARP_BUILD/bin/scarp_attribute_meshes" "$work")

# --- Khronos glTF validator -------------------------------------------------------------------------------------------
if npm_judges gltf-validator; then
  judges=$((judges + 1))
  node "$js/validate_glb.cjs" "$work/open.glb" "$work/solid.glb" "$work/plain.glb" >"$work/validator.txt" ||
    { cat "$work/validator.txt"; complain "the glTF validator has objections"; }
  sed 's/^/  /' "$work/validator.txt"
  grep -q "^open.glb: 0 errors, 0 warnings, 0 infos, 0 hints, $open_vertices vertices, $open_triangles triangles" "$work/validator.txt" ||
    complain "the glTF validator counts differently"
  node "$js/validate_glb.cjs" "$work/colored.glb" "$work/photo.glb" "$work/bare.glb" >"$work/validator.txt" ||
    { cat "$work/validator.txt"; complain "the glTF validator has objections to attributes"; }
  sed 's/^/  /' "$work/validator.txt"
  [ "$(grep -c ': 0 errors, 0 warnings, 0 infos, 0 hints' "$work/validator.txt")" = 3 ] || complain "the glTF validator has remarks on attributes"
  # A judge that never objects is useless: it must notice a missing accessor.
  LC_ALL=C sed 's/"POSITION":0/"POSITION":9/' "$work/open.glb" >"$work/bad.glb"
  if node "$js/validate_glb.cjs" "$work/bad.glb" >/dev/null; then complain "the glTF validator accepts a broken file"; fi
fi

# --- assimp -----------------------------------------------------------------------------------------------------------
if command -v assimp >/dev/null; then
  judges=$((judges + 1))
  for format in glb obj ply stl; do
    for kind in open solid; do
      assimp info "$work/$kind.$format" >"$work/assimp.txt" 2>&1 || { cat "$work/assimp.txt"; complain "assimp cannot read $kind.$format"; }
      triangles=${kind}_triangles vertices=${kind}_vertices
      same "assimp, faces of $kind.$format" "$(awk '/^Faces:/ {print $2}' "$work/assimp.txt")" "${!triangles}"
      if [ "$format" != stl ]; then  # it names places, not vertices
        same "assimp, vertices of $kind.$format" "$(awk '/^Vertices:/ {print $2}' "$work/assimp.txt")" "${!vertices}"
      fi
    done
  done
  # assimp finds colours and uvs where we put them: it writes what it read as text.
  for format in glb obj ply; do
    assimp export "$work/colored.$format" "$work/again.ply" >/dev/null
    for property in red green blue; do
      grep -aq "^property uchar $property" "$work/again.ply" || complain "assimp finds no $property in colored.$format"
    done
    assimp export "$work/colored.$format" "$work/again.obj" >/dev/null
    grep -q '^vt ' "$work/again.obj" || complain "assimp finds no texture coordinates in colored.$format"
    # The second vertex of the mesh lies at u = 1/651, v = 1 − 7/64 from the top.
    LC_ALL=C awk '/^vt / && $2 > 0.0015360 && $2 < 0.0015362 && $3 > 0.109374 && $3 < 0.109376 {found = 1} END {exit !found}' "$work/again.obj" ||
      complain "assimp finds other texture coordinates in colored.$format"
    echo "  assimp, colours and texture coordinates of colored.$format: found"
  done
  assimp export "$work/colored.ply" "$work/again.ply" >/dev/null
  # Vertex 1 has the colour 37, 138, 239.
  grep -aq ' 37 138 239 255 *$' "$work/again.ply" || complain "assimp finds other colours in colored.ply"
else
  echo "left out: assimp (assimp-utils)"
fi

# --- meshio -----------------------------------------------------------------------------------------------------------
if command -v meshio >/dev/null && meshio info "$work/open.ply" >/dev/null 2>&1; then
  judges=$((judges + 1))
  for format in obj ply stl; do
    for kind in open solid; do
      meshio info "$work/$kind.$format" >"$work/meshio.txt" 2>&1 || { cat "$work/meshio.txt"; complain "meshio cannot read $kind.$format"; }
      triangles=${kind}_triangles vertices=${kind}_vertices
      same "meshio, triangles of $kind.$format" "$(awk '/triangle:/ {print $2}' "$work/meshio.txt")" "${!triangles}"
      same "meshio, points of $kind.$format" "$(awk '/Number of points:/ {print $4}' "$work/meshio.txt")" "${!vertices}"
    done
  done
  meshio info "$work/colored.ply" >"$work/meshio.txt"
  for name in red green blue s t channel_1 channel_4; do
    grep -qE "Point data:.* $name(,|\$)" "$work/meshio.txt" || { cat "$work/meshio.txt"; complain "meshio finds no $name in colored.ply"; }
  done
  meshio info "$work/colored.obj" >"$work/meshio.txt"
  grep -q 'Point data:.*obj:vt' "$work/meshio.txt" || complain "meshio finds no texture coordinates in colored.obj"
  same "meshio, points of colored.obj" "$(awk '/Number of points:/ {print $4}' "$work/meshio.txt")" "$attribute_vertices"
  same "meshio, triangles of colored.obj" "$(awk '/triangle:/ {print $2}' "$work/meshio.txt")" "$attribute_triangles"
else
  echo "left out: meshio (meshio-tools)"
fi

# --- admesh: solids are closed and outward ----------------------------------------------------------------------------
if command -v admesh >/dev/null; then
  judges=$((judges + 1))
  # before_repair TEXT: the figure of the unrepaired file
  before_repair() { awk -F: -v text="$1" 'index($0, text) {split($2, n, " "); print n[1]; exit}' "$work/admesh.txt"; }
  admesh "$work/solid.stl" >"$work/admesh.txt"
  same "admesh, facets" "$(before_repair 'Number of facets')" "$solid_triangles"
  for fault in 'Total disconnected facets' 'Degenerate facets' 'Edges fixed' 'Facets removed' 'Facets added' 'Facets reversed' 'Backwards edges' 'Normals fixed'; do
    [ "$(before_repair "$fault")" = 0 ] || { cat "$work/admesh.txt"; complain "admesh: $fault is not 0"; }
  done
  awk -F: '/Volume/ {exit !($3 > 0)}' "$work/admesh.txt" || complain "admesh: the volume is not positive"
  echo "  admesh: closed, outward, no repairs; volume $(awk -F: '/Volume/ {print $3 + 0}' "$work/admesh.txt")"
  admesh "$work/open.stl" >"$work/admesh.txt"
  [ "$(before_repair 'Total disconnected facets')" -gt 0 ] || complain "admesh finds no border in an open terrain"
else
  echo "left out: admesh"
fi

if [ "$judges" = 0 ]; then
  echo "skipped: no judge is installed (npm, assimp-utils, meshio-tools, admesh)"
  exit 77
fi
echo "$judges judges agree"
