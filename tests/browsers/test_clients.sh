#!/usr/bin/env bash
# CesiumJS in a browser: heights of both formats within the bound, the sag of a flat ocean, poles, the antimeridian, a
# plain tileset, and one with an image; no sky below the horizon. SCARP_SHOTS=FOLDER keeps the pictures.
source "$(dirname "$0")/../program/lib.sh"
need python3 gdal_translate node "$browser"
npm_judges cesium playwright-core || skip "npm could not fetch CesiumJS"
shots=${SCARP_SHOTS:-$scratch/shots}
mkdir -p site "$shots"
ln -s "$js/node_modules/cesium/Build/Cesium" site/cesium
cp "$js/clients.html" site/

# A whole planet that is smooth everywhere: a cliff or spike at a pole or at 180 degrees is a fault.
cat > planet.py << 'E2'
import math
def height(longitude, latitude):
    a, b = math.radians(longitude), math.radians(latitude)
    x, y, z = math.cos(b) * math.cos(a), math.cos(b) * math.sin(a), math.sin(b)
    return 8000 * (x * x * y + 0.7 * z * x - 0.4 * y * z * z + 0.5 * math.sin(3 * x + 1) * math.cos(4 * y - z))
E2
python3 - > planet.asc << 'E2'
from planet import height
print("ncols 720\nnrows 360\nxllcorner -180\nyllcorner -90\ncellsize 0.5")
for row in range(360):
    print(*(f"{height(-179.75 + 0.5 * column, 89.75 - 0.5 * row):.2f}" for column in range(720)))
E2
succeeds gdal_translate -q -ot Float32 -a_srs EPSG:4979 planet.asc planet.tif
# Samples on the nodes of level 11: nothing is interpolated, so the bounds at nodes hold for them.
python3 - > corners << 'E2'
step = 180 / 2 ** 18
west, north = round((11 + 180) / step) * step - 180, 90 - round((90 - 45) / step) * step
print(repr(west - step / 2), repr(north + step / 2), repr(west + 402.5 * step), repr(north - 343.5 * step))
E2
read -r west north east south < corners
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr "$west" "$north" "$east" "$south" "$dem" land.tif
succeeds gdal_translate -q -of XYZ land.tif land.xyz
# The same land across the antimeridian.
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr 179.9 10.2 180.24 9.9 "$dem" date.tif
for format in qm 3dtiles; do
  succeeds "$scarp" tile planet.tif "site/planet.$format" --of "$format" -e 20 --report "planet.$format.json" -q
  succeeds "$scarp" tile land.tif "site/land.$format" --of "$format" --report "land.$format.json" -q
done
succeeds "$scarp" tile date.tif site/date.qm -q
# The grid of web maps, whose tiles end at other latitudes: clients must decode the judged heights.
succeeds "$scarp" tile planet.tif site/planet.web --grid mercator -e 20 --report planet.web.json -q
python3 - > nodes << 'E2'
import math
from planet import height
# Nodes of level 3, none on an edge of a tile. Between half degrees cubic interpolation is exact to a millimetre.
for row in range(3, 1023, 4):
    latitude = math.degrees(math.atan(math.sinh(math.pi * (1 - row / 512))))
    longitude = -180 + 360 * ((row * 37 % 1024 | 1) / 1024)
    print(longitude, latitude, height(longitude, latitude))
E2
# An image, red in the west and blue in the east, with darker squares.
make_image halves.tif '(200 if col < 201 else 30) * (1 if (col // 20 + row // 20) % 2 else 0.7)' '30' '(30 if col < 201 else 200) * (1 if (col // 20 + row // 20) % 2 else 0.7)'
succeeds gdal_translate -q -a_srs EPSG:4326 -a_ullr "$west" "$north" "$east" "$south" halves.tif image.tif
succeeds "$scarp" tile land.tif site/draped.3dtiles --of 3dtiles --drape image.tif -q
printf '{"type":"Polygon","coordinates":[[[180.0,10.13],[180.17,10.15],[180.19,10.02],[180.02,9.99],[180.0,10.13]]]}' > lake.geojson
succeeds "$scarp" tile date.tif site/wet.qm --water lake.geojson --watermask -q

cat > judge.py << 'E2'
import json, random, sys
from planet import height

random.seed(1)
rows = [list(map(float, line.split())) for line in open("land.xyz")]
places = [rows[random.randrange(2, 342) * 403 + random.randrange(2, 401)] for _ in range(400)]
jobs, checks = [], []


def job(check, **words):
    jobs.append(words)
    checks.append(check)


def levels(name):
    return json.load(open(f"{name}.json"))["levels"]


def near(found, wanted, bound):
    """Heights that are there and within the bound."""
    assert None not in found, "a hole"
    worst = max(abs(a - b) for a, b in zip(found, wanted))
    assert worst <= bound, (worst, bound)
    return f"{worst:.2f} m of {bound:.2f}"


def drawn(answer, whole=True):
    """A picture without a failed tile, and without a hole where the planet fills it."""
    assert answer["failed"] == 0 and (answer["holes"] == 0 or not whole), answer
    return answer


for form in ("qm", "3dtiles"):
    # Samples that are nodes. GLBs are bounded in space, quantized-mesh at nodes; the browser's numbers are rounded.
    for z in (9, 10, 11):
        bound = levels(f"land.{form}")[z]["node_error" if form == "qm" else "bound"] * 1.001 + 0.01
        job(lambda answer, bound=bound: near(answer["heights"], [place[2] for place in places], bound), kind="sample", of=form,
            url=f"land.{form}", level=z, places=places)

    # The flat ocean, which sampling sees as flat but rays do not. Seen from where the level is the finest drawn.
    for z, distance in ((0, 6e7), (1, 1.2e7), (3, 3e6)):
        def sag(answer, z=z, form=form):
            seen = [int(level) for level in drawn(answer, whole=False)["drawn"]]
            assert max(seen) == z, answer["drawn"]
            # The sag exists, or nothing would be tested.
            assert min(answer["picked"]) < -levels(f"land.{form}")[z]["asked"] / 20, min(answer["picked"])
            return near(answer["picked"], [0] * len(answer["picked"]), max(levels(f"land.{form}")[k]["bound"] for k in seen))
        job(sag, kind="globe", of=form, url=f"land.{form}", pixels=2, **{"from": [8, 36, distance], "to": [8, 36, 0]},
            picks=[[8 + 1.3 * x, 36 + 1.3 * y] for x in range(-3, 4) for y in range(-3, 4)])

    # Both poles and the antimeridian. With the client's single precision, places exactly on a border lie in no tile.
    around = [[longitude + 3, 90 - away] for longitude in range(-180, 180, 30) for away in (0.01, 0.1, 1, 5)]
    across = [[side * (180 - away), latitude] for latitude in range(-4, 15, 3) for away in (0.01, 0.1, 1) for side in (-1, 1)]
    for name, middle, picks in (("north", [0, 90], around), ("south", [0, -90], [[x, -y] for x, y in around]),
                                ("across", [180, 5], across)):
        def smooth(answer, picks=picks, form=form):
            assert set(drawn(answer)["drawn"]) <= {"1", "2"}, answer["drawn"]
            bound = max(level["bound"] for level in levels(f"planet.{form}")[1:])
            return near(answer["picked"], [height(*place) for place in picks], bound)
        # At 3 pixels CesiumJS draws nothing derived from a level above.
        job(smooth, kind="globe", of=form, url=f"planet.{form}", pixels=3, ramp=[-6000, 6000], picks=picks,
            shot=f"{name}_{form}", **{"from": [*middle, 3.5e6], "to": [*middle, 0]})

# Web Mercator: at nodes level by level, also near the ends of the grid; then around the antimeridian and the north.
nodes = [list(map(float, line.split())) for line in open("nodes")]
for z in (1, 2, 3):
    job(lambda answer, bound=levels("planet.web")[z]["node_error"] * 1.001 + 0.1: near(answer["heights"], [place[2] for place in nodes], bound),
        kind="sample", of="qm", url="planet.web", level=z, places=nodes)


def drawn_web(answer):
    bound = max(level["bound"] for level in levels("planet.web")[2:])
    return near(drawn(answer)["picked"], [height(*place) for place in across], bound)


job(drawn_web, kind="globe", of="qm", url="planet.web", pixels=3, ramp=[-6000, 6000], picks=across, shot="across_web",
    **{"from": [180, 5, 3.5e6], "to": [180, 5, 0]})
job(drawn, kind="globe", of="qm", url="date.qm", pixels=2, ramp=[200, 1000], shot="date_qm",
    **{"from": [180.07, 9.6, 30000], "to": [180.07, 10.05, 500]})


def wet(answer):
    """Tiles with masks, which the client takes for water."""
    assert drawn(answer)["masks"] > 0, answer
    return answer


job(wet, kind="globe", of="qm", url="wet.qm", pixels=2, ramp=[200, 1000], shot="wet_qm",
    **{"from": [180.07, 9.6, 30000], "to": [180.07, 10.05, 500]})


def tileset(answer, most):
    assert answer["failed"] == 0 and answer["loaded"] > 0 and answer["selected"] > 0 and answer["holes"] <= most, answer
    return answer


# From a distance where the whole planet is a ball before the background, and from near.
job(lambda answer: tileset(answer, 480 * 320 * 9 // 10), kind="tileset", url="planet.3dtiles", pixels=2, shot="tileset_planet",
    **{"from": [180, 20, 3e7], "to": [180, 20, 0]})
middle = places[0][:2]
job(lambda answer: tileset(answer, 0), kind="tileset", url="land.3dtiles", pixels=2, shot="tileset_land",
    **{"from": [middle[0], middle[1] - 0.4, 25000], "to": [*middle, 0]})


def closed(answer):
    """Where tiles of several levels meet, nobody sees through."""
    assert answer["failed"] == 0 and answer["slits"] <= 5, answer
    return f"{answer['slits']} pixels of sky below the horizon"


# Seen along the ground, as terrain of both formats and as a plain tileset.
centre = [(a + b) / 2 for a, b in zip(rows[0][:2], rows[-1][:2])]
for number, (away, high) in enumerate(((0.4, 12000), (0.3, 15000))):
    for form, words in (("qm", {"kind": "globe", "of": "qm"}), ("3dtiles", {"kind": "globe", "of": "3dtiles"}), ("3dtiles", {"kind": "tileset"})):
        job(closed, url=f"land.{form}", pixels=2, shot=f"closed_{number}_{words.get('of', 'tileset')}",
            **{**words, "from": [centre[0], centre[1] - away, high], "to": [*centre, 500]})


def draped(answer):
    tileset(answer, 0)
    left, right = answer["halves"]
    assert left[0] > 2 * left[2] and right[2] > 2 * right[0] and min(left[0], right[2]) > 30, answer["halves"]
    return answer["halves"]


job(draped, kind="tileset", url="draped.3dtiles", pixels=2, shot="tileset_draped",
    **{"from": [*centre, 14000], "to": [*centre, 0]})
job(lambda answer: near(answer["heights"], [place[2] for place in places], levels("land.3dtiles")[11]["bound"] * 1.001 + 0.01),
    kind="sample", of="3dtiles", url="draped.3dtiles", level=11, places=places)

if sys.argv[1:] == ["jobs"]:
    print(json.dumps(jobs))
else:
    told = json.load(open("answers.json"))
    assert not told["errors"] and not told["elsewhere"], told
    for words, check, answer in zip(jobs, checks, told["answers"], strict=True):
        print(words["kind"], words["url"], words.get("level", words.get("shot", "")), check(answer))
E2
python3 judge.py jobs > jobs.json
"$python_program" "$SCARP_SOURCE/tools/globe/serve.py" site 0 > address &
server=$!
trap 'kill $server; rm -rf "$root"' EXIT
await $server test -s address
succeeds node "$js/clients.mjs" "$(cat address)" jobs.json "$shots" "$browser"
cp "$logs/out" answers.json
python3 judge.py
