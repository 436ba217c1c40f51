#!/usr/bin/env bash
# borders.sh SCARP DEM ERROR: triangles of DEM cut into 1 x 1, 2 x 2 and 4 x 4 parts that share rows and columns,
# without and with --lock-border. Prints parts a side, effort, free, locked, excess in per cent. Needs gdal_translate.
set -euo pipefail
scarp=$(realpath "$1") dem=$(realpath "$2") error=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
read -r cols rows < <("$scarp" info "$dem" --json | python3 -c 'import json, sys; i = json.load(sys.stdin)["input"]; print(i["cols"], i["rows"])')

triangles() { # OPTIONS...: for all parts
  local sum=0 part
  for part in part-*.tif; do
    "$scarp" simplify "$part" x.ply -e "$error" "$@" --overwrite -q --report x.json
    sum=$((sum + $(python3 -c 'import json; print(json.load(open("x.json"))["triangles"])')))
  done
  echo $sum
}

for n in 1 2 4; do
  rm -f part-*.tif
  for i in $(seq 0 $((n - 1))); do
    for j in $(seq 0 $((n - 1))); do
      col=$(((cols - 1) * i / n)) end_col=$(((cols - 1) * (i + 1) / n))
      row=$(((rows - 1) * j / n)) end_row=$(((rows - 1) * (j + 1) / n))
      gdal_translate -q -srcwin $col $row $((end_col - col + 1)) $((end_row - row + 1)) "$dem" part-$i-$j.tif
    done
  done
  for effort in fast normal high; do
    free=$(triangles --effort $effort) locked=$(triangles --effort $effort --lock-border)
    echo "$n $effort $free $locked $(python3 -c "print(f'{100 * ($locked / $free - 1):.1f}')")"
  done
done
