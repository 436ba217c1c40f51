#!/usr/bin/env bash
# bench/paper/run.py on small fields: every section, every picture of the page, no invalid number.
source "$(dirname "$0")/lib.sh"

run=$SCARP_SOURCE/bench/paper/run.py
"$python_program" -c 'import matplotlib' 2> /dev/null || skip "needs matplotlib"

try "$python_program" "$run" "$scarp" . out
{ [ "$code" = 1 ] && grep -q 'has no field crater, ashby' "$logs/err" && [ ! -e out ]; } || fail "a folder without fields is accepted"

"$python_program" - << 'PYTHON'
import numpy
from PIL import Image
row, col = numpy.mgrid[:60, :80]
pixels = numpy.stack([3 * col, 4 * row, 120 + 60 * numpy.sin(col * row / 300)], 2).astype(numpy.uint8)
for name in ("astronaut.png", "santa_barbara_aerial.tif"):
    Image.fromarray(pixels).save(name)
Image.fromarray((row * numpy.sin(col / 9)).astype(numpy.float32)).save("santa_barbara_elev.tif")
PYTHON
succeeds "$python_program" "$run" "$scarp" --fast out
grep -q '^paper: ' "$logs/err" || fail "nothing reports the experiments"
for heading in 'A field and its TIN (figures 1 and 2)' 'What is worth inserting (section 3' 'Algorithms I, II and III (section 4, page' \
  'The cost of Algorithm III (section 4, page' 'Insertion in batches (section 4' \
  'Data-dependent triangulation, Algorithm IV (section 4.4, page' 'The threshold of shape' 'Supersampling' 'Meshes and surfaces' \
  'Fields curved in one direction' 'Results (section 5, page' 'Other programs' 'Error against vertices' \
  'Delaunay and data-dependent edges against vertices' 'Seconds' 'Textured terrain' 'Colour images'; do
  grep "^##" out/paper.md | grep -qF "$heading" || fail "the page has no section $heading"
done
if grep -qE '\b(nan|inf|None)\b' out/paper.md; then fail "a number is none"; fi
pictures=$(grep -oE 'images/paper/[a-z_]+\.png' out/paper.md)
[ "$(wc -w <<< "$pictures")" = 13 ] || fail "other pictures: $pictures"
for picture in $pictures; do
  head -c 8 "out/$picture" | tail -c 7 | grep -q '^PNG' || fail "$picture is no picture"
  [ "$(wc -c < "out/$picture")" -gt 2000 ] || fail "$picture shows nothing"
done

# The number of vertices is exactly the row's, the algorithms agree, and numbers far from Scape's are explained.
grep -qE '^\| crater \| 154 \| [0-9]+ \(288, ' out/paper.md || fail "no row of crater with 154 vertices"
[ "$(grep -cE '^\| (crater|ashby|ozark) .*\| yes \|' out/paper.md)" = 3 ] || fail "Algorithms I, II and III disagree"
tr '\n' ' ' < out/paper.md | grep -qE '\*\*Max error of sharp-step, sum, q 0 \(−[0-9]+ %\)' || fail "sharp-step is not explained"

# The figure's mesh has all 512 vertices, though the best mesh near that budget has fewer.
grep -q '^Max error 32.14, RMS 10.84, of a relief of 1000.$' out/paper.md || fail "another mesh of the figure"
