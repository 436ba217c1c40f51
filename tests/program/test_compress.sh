#!/usr/bin/env bash
# A compressed GLB has a fraction of the bytes and keeps the promise when decoded: measure reads it and agrees.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalbuildvrt gdalinfo

make_image ortho.tif '(col * 255) // 402' '128 + 100 * math.sin(col * row / 40000)' '200 if (col // 50 + row // 50) % 2 else 40'
make_raster holes.tif 'nan if (col // 40 + row // 30) % 5 == 0 else 300 + 40 * math.sin(col / 9) * math.cos(row / 13)'

# packed RASTER ERROR SHARE OPTION...: the bytes are below SHARE percent of the plain file's, and the judge's error is
# the report's.
packed() {
  local raster=$1 error=$2 share=$3
  shift 3
  succeeds "$scarp" simplify "$raster" plain.glb -e "$error" "$@" --overwrite -q
  succeeds "$scarp" simplify "$raster" packed.glb -e "$error" "$@" --compress --report s.json --overwrite -q
  succeeds "$scarp" measure "$raster" packed.glb --fail-above "$error" --json
  cp "$logs/out" m.json
  holds "$(json s.json max_error) - $(json m.json max_error) < 1e-9 && $(json m.json max_error) - $(json s.json max_error) < 1e-9"
  holds "$(json m.json uncovered) == 0"
  holds "100 * $(stat -c %s packed.glb) < $share * $(stat -c %s plain.glb)"
  python3 "$SCARP_SOURCE/tests/program/glb.py" packed.glb json > g.json
  [ "$(json g.json extensionsRequired)" = '["KHR_mesh_quantization", "EXT_meshopt_compression"]' ] || fail "extensions of $*"
}
is_16_bit() { holds "$(json g.json accessors 0 componentType) == 5123"; }

packed "$dem" 5 36
is_16_bit
packed "$dem" 5 36 --effort high
is_16_bit
packed "$dem" 5 36 --effort high --crs local
packed "$dem" 10 36 --order greedy --effort fast
packed holes.tif 1 40 --effort high
packed "$dem" 20 60 --crs EPSG:32617
packed "$dem" 20 60 --base 0
packed "$dem" 60 60 --texture ortho.tif
packed "$dem" 10 40 --normals --uvs
packed "$dem" 10 50 --min-angle 20
# More vertices than 16 bits number; every sample exact.
packed "$dem" 0 36
holds "$(json g.json meshes 0 primitives 1 indices) > 0"

succeeds "$scarp" simplify "$dem" one.glb -e 2 --effort high --compress -j 1 -q
succeeds "$scarp" simplify "$dem" two.glb -e 2 --effort high --compress -j 2 -q
cmp one.glb two.glb || fail "threads change a compressed file"
succeeds "$scarp" simplify "$dem" budget.glb -t 3000 --compress -q
succeeds "$scarp" measure "$dem" budget.glb -q

printf 'x,y,z\n0,0,1\n10,0,2\n0,10,3\n10,10,4.5\n5,5,9.25\n' > points.csv
succeeds "$scarp" simplify points.csv points.glb -e 0.5 --compress -q
succeeds "$scarp" measure points.csv points.glb --fail-above 0.5 -q

refuses 1 '--compress writes GLB, and OUTPUT is OBJ: choose .glb' "$scarp" simplify "$dem" a.obj -e 5 --compress
head -c 5000 one.glb > cut.glb
refuses 2 'cut.glb is not a usable mesh: it ends after 5000 of' "$scarp" measure "$dem" cut.glb
