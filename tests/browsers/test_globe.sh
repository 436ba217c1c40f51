#!/usr/bin/env bash
# The page of make globe in a browser: heights in CesiumJS are within the bounds of three levels.
source "$(dirname "$0")/../program/lib.sh"
need python3 gdal_translate node "$browser"
npm_judges cesium playwright-core || skip "npm could not fetch CesiumJS"

# Samples on the nodes of level 11: nothing is interpolated, so the bounds at nodes hold for them.
python3 - > corners << 'E2'
step = 180 / 2 ** 18
west, north = round((11 + 180) / step) * step - 180, 90 - round((90 - 45) / step) * step
print(repr(west - step / 2), repr(north + step / 2), repr(west + 402.5 * step), repr(north - 343.5 * step))
E2
read -r west north east south < corners
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr "$west" "$north" "$east" "$south" "$dem" nodes.tif
CESIUM_MODULES=$js/node_modules succeeds "$SCARP_SOURCE/tools/globe.sh" "$scarp" nodes.tif globe --report r.json
succeeds gdal_translate -q -of XYZ nodes.tif nodes.xyz
python3 - > points.json << 'E2'
import json, random
rows = [list(map(float, line.split())) for line in open("nodes.xyz")]
assert len(rows) == 403 * 344
random.seed(1)
# Away from the raster's edge, where the background begins.
print(json.dumps([rows[random.randrange(2, 342) * 403 + random.randrange(2, 401)] for _ in range(400)]))
E2
"$python_program" "$SCARP_SOURCE/tools/globe/serve.py" globe 0 > address &
server=$!
trap 'kill $server; rm -rf "$root"' EXIT
await $server test -s address
succeeds node "$js/globe.mjs" "$(cat address)" points.json shot.png "$browser"
cp "$logs/out" judged.json
python3 - << 'E2'
import json
judged, report = json.load(open("judged.json")), json.load(open("r.json"))
assert not judged["errors"], judged["errors"]
assert not judged["elsewhere"], judged["elsewhere"]
assert "proven" in judged["says"], judged["says"]
levels = {int(z): error for z, error in judged["levels"].items()}
assert {9, 10, 11} <= set(levels), levels
for z, error in levels.items():
    # The browser's numbers are rounded, and points are found by longitude and latitude.
    assert error <= report["levels"][z]["node_error"] * 1.001 + 0.01, (z, error, report["levels"][z])
assert abs(judged["picked"] - judged["expected"]) <= report["levels"][9]["bound"], judged
print({z: (round(levels[z], 2), round(report["levels"][z]["node_error"], 2)) for z in (9, 10, 11)})
E2
[ -z "${SCARP_SHOTS:-}" ] || cp shot.png "$SCARP_SHOTS/globe.png"
