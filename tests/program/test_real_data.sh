#!/usr/bin/env bash
# simplify and measure agree on all kinds of real terrain: nodata, lidar, cliffs, sea floor, other planets, cities.
. "$(dirname "$0")/lib.sh"

shared=${SCARP_SHARED:-$SCARP_SOURCE/../shared}/data
if [ ! -d "$shared" ]; then
  echo "skipped: the folder of real terrains is absent ($shared)"
  exit 77
fi

# file, max error in metres, mesh format
while read -r file error format; do
  mesh=$scratch/${file%%.*}.$format
  "$scarp" simplify "$shared/$file" "$mesh" -e "$error" -q || fail "simplify $file failed"
  "$scarp" measure "$shared/$file" "$mesh" --fail-above "$error" --json >"$scratch/m.json" || fail "measure does not agree on $file at $error"
  python3 - "$scratch/m.json" "$file" <<'PY' || fail "$file: covered nodata or lost samples"
import json, sys
m = json.load(open(sys.argv[1]))
print(f"{sys.argv[2]}: {m['triangles']} triangles, max {m['max_error']:.6g}, rmse {m['rmse']:.4g}")
sys.exit(m["uncovered"] != 0 or m["void_cells_covered"] != 0 or not 0 < m["samples"])
PY
done <<'LIST'
everest_srtm_voids.tif 40 glb
rainier_srtm_voids.tif 25 ply
cape_town_srtm_sea_nodata.tif 12 obj
exploradores_aster.tif 60 stl
wahoo_swath_nan.tif 20 glb
tidal_marsh_zSW3.asc 0.4 ply
antarctica_bedmap.tif 150 glb
gabilan_lidar_1m.tif 1 glb
cuyuna_pits_lidar_1m.tif 0.3 stl
nrw_dom1_essen.tif 5 ply
athens_dsm_1m.tif 2 glb
azores_bathymetry_1min.tif 60 obj
mid_atlantic_ridge_2min.tif 150 glb
moon_gld100_caucasus_4096.tif 150 ply
mars_gale_hirise_1m.tif 0.3 glb
san_francisco_pier_3857.tif 2 glb
bijou_gully_5m.asc 0.25 ply
puget_sound_1k.png 400 glb
crater.pgm 6 obj
scape_ozark.stm 3 glb
N44W072.hgt 20 ply
N42E001.hgt.zip 30 glb
SainteHelens.dem 15 obj
volcano.tif 0 glb
jacksboro_fault.tif 1 stl
LIST
