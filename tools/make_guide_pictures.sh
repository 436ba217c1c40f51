#!/bin/bash
# Makes the pictures of docs/guide and of the README. Views in three dimensions need f3d, and xvfb-run without a display
# (Debian: f3d, xvfb); the mesh layer needs QGIS (python3-qgis, qgis-providers); pngquant and GDAL compress them
# (pngquant, gdal-bin).
#
# usage: tools/make_guide_pictures.sh PROGRAM
set -euo pipefail
scarp=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
tree=$(cd "$(dirname "$0")/.." && pwd)
out=$tree/docs/guide/images
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp -L "$tree"/data/examples/* "$scratch"
mkdir -p "$out"
cd "$scratch"
# shrink PICTURE WIDTH: a small file, for a repository.
shrink() {
  gdal_translate -q -of PNG -r cubic -outsize "$2" 0 "$1" "$scratch/small.png" && rm -f "$scratch/small.png.aux.xml"
  pngquant --force --speed 1 --output "$1" 96 "$scratch/small.png"
}
simplify() { "$scarp" simplify "$@" --quiet --overwrite; }

# A sky that lights the views: a sun in the north-west, as a Radiance picture in longitude and latitude.
python3 - sky.hdr << 'PYTHON'
import math, sys
WIDTH, HEIGHT, SUN = 256, 128, (2.5, 0.55)
def pixel(*colour):
    fraction, exponent = math.frexp(max(colour))
    return bytes([*(min(255, int(part * fraction * 256 / max(colour))) for part in colour), exponent + 128])
rows = []
for y in range(HEIGHT):
    latitude = math.pi * (0.5 - (y + 0.5) / HEIGHT)
    for x in range(WIDTH):
        longitude = 2 * math.pi * (x + 0.5) / WIDTH
        nearness = math.sin(latitude) * math.sin(SUN[1]) + math.cos(latitude) * math.cos(SUN[1]) * math.cos(longitude - SUN[0])
        sun, sky = 13 if nearness > 0.97 else 0, 0.15 if latitude > 0 else 0.06
        rows.append(pixel(sky + sun, sky + 0.95 * sun, 1.1 * sky + 0.85 * sun))
with open(sys.argv[1], "wb") as file:
    file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (HEIGHT, WIDTH) + b"".join(rows))
PYTHON

# view MESH PICTURE UP POSITION FOCAL [OPTIONS]: draws with f3d.
view() {
  local mesh=$1 picture=$2 up=$3 position=$4 focal=$5
  shift 5
  local run=()
  if [ -z "${DISPLAY:-}" ]; then run=(xvfb-run -a); fi
  "${run[@]}" f3d "$mesh" --output "$out/$picture" --resolution 900,540 --up "$up" --camera-position "$position" \
    --camera-focal-point "$focal" --hdri "$scratch/sky.hdr" --roughness 1 --color 0.87,0.82,0.7 --axis=false --grid=false --filename=false "$@" > /dev/null
  shrink "$out/$picture" 900
}

/usr/bin/python3 "$tree/tools/draw_panes.py" "$scarp" "$tree/docs/images/panes.png"

simplify dem.tif lakes.glb -e 20 --water lakes.geojson --rivers streams.geojson --preview "$out/gis_water.png"
shrink "$out/gis_water.png" 900
simplify dem.tif parcel.glb -e 40 --cutline parcel.geojson --roi site.geojson=5,falloff=2000 --preview "$out/gis_parcel.png"
shrink "$out/gis_parcel.png" 900
simplify dem.tif tin.2dm -e 20 --crs EPSG:32616
"$scarp" measure dem.tif tin.2dm --map "$out/gis_errors.png" --quiet --overwrite
shrink "$out/gis_errors.png" 700
# Debian's interpreter, even if the path has another first.
QT_QPA_PLATFORM=offscreen /usr/bin/python3 - "$out/gis_qgis.png" << 'PYTHON'
import sys
from qgis.core import (QgsApplication, QgsCoordinateReferenceSystem, QgsMapRendererParallelJob, QgsMapSettings, QgsMeshLayer,
                       QgsRectangle)
from qgis.PyQt.QtCore import QSize
from qgis.PyQt.QtGui import QColor
program = QgsApplication([], False)
program.initQgis()
crs = QgsCoordinateReferenceSystem("EPSG:32616")
mesh = QgsMeshLayer("tin.2dm", "tin", "mdal")
assert mesh.isValid() and mesh.meshFaceCount() > 10000
mesh.setCrs(crs)
style = mesh.rendererSettings()
lines = style.nativeMeshSettings()
lines.setEnabled(True)
lines.setLineWidth(0.2)
lines.setColor(QColor(20, 40, 90))
style.setNativeMeshSettings(lines)
style.setActiveScalarDatasetGroup(0)
mesh.setRendererSettings(style)
middle, half = mesh.extent().center(), 0.3 * mesh.extent().width()
view = QgsMapSettings()
view.setLayers([mesh])
view.setDestinationCrs(crs)
view.setExtent(QgsRectangle(middle.x() - half, middle.y() - 0.6 * half, middle.x() + half, middle.y() + 0.6 * half))
view.setOutputSize(QSize(900, 540))
job = QgsMapRendererParallelJob(view)
job.start()
job.waitForFinished()
job.renderedImage().save(sys.argv[1])
program.exitQgis()
PYTHON
shrink "$out/gis_qgis.png" 900
mkdir plugins
python3 "$tree/bindings/qgis/make_plugin.py" "$scarp" plugins.zip
(cd plugins && python3 -m zipfile -e ../plugins.zip .)
QT_QPA_PLATFORM=offscreen /usr/bin/python3 "$tree/tools/draw_qgis.py" plugins "$scarp" "$PWD/dem.tif" "$out"
shrink "$out/qgis_dialog.png" 900
shrink "$out/qgis_layer.png" 700

simplify dem.tif flow.2dm -e 20 --crs local --breaklines dikes.geojson --min-angle 25 --max-edge 1500 --grade 0.3 \
  --preview "$out/simulation_lines.png"
shrink "$out/simulation_lines.png" 900

# Heights are exaggerated three times in the views to be visible.
python3 - << 'PYTHON'
import subprocess
subprocess.run(["gdal_translate", "-q", "-of", "VRT", "dem.tif", "tall.vrt"], check=True)
text = open("tall.vrt").read()
open("tall.vrt", "w").write(text.replace("<SourceBand>1</SourceBand>", "<SourceBand>1</SourceBand><ScaleOffset>0</ScaleOffset><ScaleRatio>3</ScaleRatio>")
                            .replace("<SimpleSource>", "<ComplexSource>").replace("</SimpleSource>", "</ComplexSource>"))
PYTHON
place=(+Z 0,-30000,16000 0,-2000,1500)
simplify tall.vrt terrain.ply -t 20k --crs local --normals
view terrain.ply games_normals.png "${place[@]}"
simplify tall.vrt flat.ply -t 20k --crs local
view flat.ply games_flat.png "${place[@]}"
for level in "0 15" "1 60" "2 240"; do
  read -r number error <<< "$level"
  simplify tall.vrt "lod$number.ply" -e "$error" --crs local
  view "lod$number.ply" "games_lod$number.png" "${place[@]}" --edges --line-width 0.6
done

# An image and a normal map in the GLB, which is y-up.
printf '240 92 130 84\n450 168 170 110\n700 190 150 105\n1076 245 240 235\n' > ramp.txt
gdaldem color-relief -q dem.tif ramp.txt relief.tif
simplify tall.vrt draped.glb -e 60 --drape relief.tif --normal-map 403
view draped.glb games_draped.png +Y 0,16000,30000 0,1500,2000 --color 1,1,1

simplify dem.tif hills.stl -e 0.1mm --solid size=120mm,exaggerate=3,thickness=3mm
view hills.stl printing_solid.png +Z -40,-90,110 57,60,0
simplify dem.tif big.stl -e 0.1mm --solid size=360mm,exaggerate=3 --split 2x2,joint=dovetail,gap=0.2mm
view big-r1-c1.stl printing_tile.png +Z 120,-60,220 100,260,0

# Tiles: as triangles, and in CesiumJS, from the picture of the test of make globe.
/usr/bin/python3 "$tree/tools/draw_tiles.py" "$scarp" "$tree/docs/images/tiles_levels.png"
SCARP_SHOTS=$scratch SCARP_BUILD=$(dirname "$(dirname "$scarp")") SCARP_SOURCE=$tree bash "$tree/tests/browsers/test_globe.sh"
shrink globe.png 900
mv globe.png "$out/globe_cesium.png"
