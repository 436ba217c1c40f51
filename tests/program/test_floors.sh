#!/bin/bash
# This tree satisfies the floors of docs/design.md, each source includes what it uses, and the scripts that check both
# find planted violations.
set -euo pipefail
source_tree=${SCARP_SOURCE:?}
python=$(command -pv python3 || command -v python3) || { echo "skipped: python3 is missing"; exit 77; }
check="$source_tree/tools/check_floors.py"

"$python" "$check" "$source_tree"

while read -r row; do
  grep -qxF -- "$row" "$source_tree/docs/design.md" || { echo "docs/design.md lacks this row of --table: $row"; exit 1; }
done < <("$python" "$check" --table)

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

mkdir "$scratch/tree"
cp -r "$source_tree/include" "$source_tree/src" "$source_tree/apps" "$scratch/tree"
planted=()
# expect_fault FILE LINE WORDS: the check of a copy of the tree with LINE added to FILE, and with all other such lines,
# names FILE with WORDS.
expect_fault() {
  printf '%b\n' "$2" >>"$scratch/tree/$1"
  planted+=("$1" "$2" "$3")
}

expect_fault src/tin/triangulation.h '#include "refine/refinement.h"' 'a step upwards from tin (floor 2) to refine (floor 3)'
expect_fault src/geom/plane.h '#include "grid/raster.h"' 'strangers on floor 1'
expect_fault src/geom/plane.cpp 'namespace scarp::tin {' 'the names of this room are in scarp::geom'
expect_fault src/tin/triangulation.cpp '#include "scarp/height_field.h"\nauto f() { return grid_frame(2); }' 'grid implements: tin must not know grid'
expect_fault src/pieces/plan.cpp '#include "scarp/simplify.h"\nstruct Holder { Refiner* of; };' 'a step upwards from pieces (floor 5) to simplify (floor 6)'
expect_fault src/io/tiles/md5.cpp '#include "scarp/tile.h"\nauto f(PyramidPlan p) { return find_blocks(p); }' 'a step upwards from io (floor 3) to tiles/pyramid (floor 8)'
expect_fault include/scarp/mesh.h 'int lost(int);' 'no source of src that includes it defines lost'
expect_fault src/tin/triangulation.h '#include "grid/raster.h"' 'must not know the room grid'
expect_fault src/measure/measure.cpp '#include "geom/scan.h"' 'measure must not know the room geom'
expect_fault src/base/array.h '#include "geom/plane.h"' 'a step upwards from base'
expect_fault include/scarp/mesh.h '#include "base/array.h"' 'public headers only'
expect_fault include/scarp/new.h '#pragma GCC visibility push(default)' 'scarp.h does not include it'
expect_fault apps/scarp/main.cpp '#include "grid/raster.h"' 'apps may include'
expect_fault src/session/options/values.h '#include "session/reports/report.h"' 'a step upwards from session/options (floor 10)'
expect_fault src/session/inputs/lines.h '#include "session/plan/outputs.h"' 'session/inputs and session/plan are strangers'
expect_fault src/session/tasks/runner.h '#include "grid/raster.h"' 'session/tasks must not know the room grid'
expect_fault src/session/tasks/runner.h '#include "io/file_reason.h"' 'session/tasks must not know the room io'
expect_fault src/session/text/text.h '#include "io/file_reason.h"' 'session/text must not know the room io'
expect_fault src/session/plan/outputs.h '#include <CLI/CLI.hpp>' 'command lines'
expect_fault src/tiles/mesh/tile_rows.h '#include "tiles/pyramid/larger.h"' 'a step upwards from tiles/mesh (floor 7) to tiles/pyramid (floor 8)'
expect_fault src/io/raster/stm.cpp '#include <gdal.h>' 'GDAL'
expect_fault src/pieces/freeze.cpp '#include <thread>' 'threads'
expect_fault src/geom/scan.h '#include <immintrin.h>' 'instruction set'
expect_fault src/io/mesh/stl.cpp '#include "io/no_such.h"' 'there is no src/io/no_such.h'
expect_fault src/simplify/run.cpp 'bool fits = options.quality.effort != Effort::kFast;' 'decided in the recipe of a run'
expect_fault src/geom/plane.h "$(printf '// line\\n%.0s' $(seq 600))" 'more than 600'
if "$python" "$check" "$scratch/tree" >"$scratch/out"; then
  echo "no planted line is noticed"
  exit 1
fi
for ((k = 0; k < ${#planted[@]}; k += 3)); do
  grep -F -- "${planted[k]}" "$scratch/out" | grep -qF -- "${planted[k + 2]}" ||
    { echo "not noticed: ${planted[k + 1]} in ${planted[k]}"; cat "$scratch/out"; exit 1; }
done
mkdir -p "$scratch/empty"
if "$python" "$check" "$scratch/empty" 2>/dev/null; then echo "an empty tree passed"; exit 1; fi
# expect_missing FILE INCLUDE WORDS: a copy of the tree without the line INCLUDE in FILE is refused with WORDS.
"$python" "$source_tree/tools/check_includes.py"
expect_missing() {
  rm -rf "$scratch/tree"
  mkdir "$scratch/tree"
  cp -r "$source_tree/include" "$source_tree/src" "$source_tree/apps" "$source_tree/bindings" "$source_tree/tools" "$scratch/tree"
  grep -vxF -- "$2" "$source_tree/$1" >"$scratch/tree/$1"
  if "$python" "$scratch/tree/tools/check_includes.py" >"$scratch/out"; then
    echo "not noticed: $1 without $2"
    exit 1
  fi
  grep -qF -- "$3" "$scratch/out" || { echo "wrong sentence for $1 without $2:"; cat "$scratch/out"; exit 1; }
}

expect_missing src/mesh/half_edges.cpp '#include <algorithm>' 'std::'
expect_missing src/pieces/freeze.cpp '#include "pieces/offset_map.h"' 'pieces/offset_map.h'
echo "floors hold, includes are whole, planted violations are noticed"
