#!/usr/bin/env bash
# 3D Tiles in 3d-tiles-renderer (three.js), a client besides CesiumJS: all tiles load, and rays meet the land within its
# bound.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate node
npm_judges 3d-tiles-renderer three || skip "npm could not fetch 3d-tiles-renderer"

# Samples on the nodes of level 11, so that bounds at nodes hold for them.
python3 - > corners << 'E2'
step = 180 / 2 ** 18
west, north = round((11 + 180) / step) * step - 180, 90 - round((90 - 45) / step) * step
print(repr(west - step / 2), repr(north + step / 2), repr(west + 402.5 * step), repr(north - 343.5 * step))
E2
read -r west north east south < corners
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr "$west" "$north" "$east" "$south" "$dem" land.tif
succeeds gdal_translate -q -of XYZ land.tif land.xyz
succeeds "$scarp" tile land.tif land --of 3dtiles --report land.json -q
python3 - << 'E2'
import json
import random
random.seed(1)
rows = [list(map(float, line.split())) for line in open("land.xyz")]
places = [rows[172 * 403 + 201]] + [rows[random.randrange(120, 224) * 403 + random.randrange(150, 252)] for _ in range(299)]
json.dump([place[:2] for place in places], open("places.json", "w"))
json.dump([place[2] for place in places], open("wanted.json", "w"))
E2
succeeds node "$js/three_tiles.mjs" land places.json
cp "$logs/out" answer.json
python3 - << 'E2'
import json
answer, wanted, report = (json.load(open(f"{name}.json")) for name in ("answer", "wanted", "land"))
assert not answer["failed"], answer["failed"][:3]
finest = [uri for uri in answer["drawn"] if uri.split("/")[1] == "11"]
assert len(finest) >= 16, answer["drawn"]
assert None not in answer["heights"], "a hole"
worst = max(abs(a - b) for a, b in zip(answer["heights"], wanted, strict=True))
bound = report["levels"][11]["bound"]
print(f"{len(answer['drawn'])} tiles drawn; {len(wanted)} rays: {worst:.2f} m of {bound:.2f}")
assert bound / 10 < worst <= bound + 0.01, (worst, bound)
E2
