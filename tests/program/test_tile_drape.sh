#!/usr/bin/env bash
# An image on 3D Tiles: each pixel of each texture in its place, equal in neighbours, with the same bytes for any
# threads and shares.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalbuildvrt gdalwarp gdalinfo

make_image image.tif '(col * 255) // 402' '(row * 255) // 343' '77'
gdalwarp -q -t_srs EPSG:32616 -r bilinear -dstalpha image.tif utm.tif
tiles() { "$scarp" tile "$dem" "$@" --vertical egm96 --of 3dtiles --zoom 10 -q; }
succeeds tiles own --drape image.tif --drape-format png -j 1
succeeds tiles utm --drape utm.tif --drape-format png -j 1
succeeds tiles plain
succeeds "$scarp" tile check own --source "$dem" --vertical egm96

cat > judge.py <<'E2'
import json, pathlib, random, struct, subprocess, sys, zlib
import glb


def pixels(data):
    """Rows of a PNG of 8 bits, red green blue."""
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack_from(">IIBB", data, at + 8)
            assert (depth, colours) == (8, 2)
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    raw, before, rows = zlib.decompress(packed), bytearray(3 * width), []
    for y in range(height):
        line = bytearray(raw[y * (3 * width + 1) + 1:(y + 1) * (3 * width + 1)])
        rule = raw[y * (3 * width + 1)]
        for x in range(3 * width):
            left, corner = (line[x - 3], before[x - 3]) if x >= 3 else (0, 0)
            if rule == 4:
                guess = left + before[x] - corner
                near = min((abs(guess - left), 0, left), (abs(guess - before[x]), 1, before[x]), (abs(guess - corner), 2, corner))
                add = near[2]
            else:
                add = (0, left, before[x], (left + before[x]) // 2)[rule]
            line[x] = (line[x] + add) & 255
        rows.append(bytes(line))
        before = line
    return rows


info = json.loads(subprocess.check_output(["gdalinfo", "-json", "image.tif"]))
west, cell, _, north, _, down = info["geoTransform"]
ground = (0.47, 0.42, 0.33)
ground = tuple(round(255 * (1.055 * c ** (1 / 2.4) - 0.055)) for c in ground)
random.seed(1)
inside = outside = edges = 0
textures = {}
for path in pathlib.Path(sys.argv[1]).glob("*/*/*/*.glb"):
    root, z, x, y = map(int, path.with_suffix("").parts[1:])
    document, binary = glb.load(path)
    primitive = document["meshes"][0]["primitives"][0]
    factor = document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"]
    assert ("TEXCOORD_0" in primitive["attributes"]) == ("images" in document) == (factor == [1, 1, 1, 1])
    if z < 7:
        continue
    side = 180 / 2 ** z
    left, bottom = -180 + 180 * root + x * side, -90 + y * side
    touches = left < west + 403 * cell and left + side > west and bottom < north and bottom + side > north + 344 * down
    assert touches <= ("images" in document), path
    if "images" not in document:
        continue
    rows = pixels(glb.view_bytes(document, binary, document["images"][0]["bufferView"]))
    count = len(rows)
    assert len(rows[0]) == 3 * count and count == (256 if z == 10 else 512), (path, count)
    textures[root, z, x, y] = rows
    pixel = side / (count - 2)
    for _ in range(100):
        i, j = random.randrange(count), random.randrange(count)
        col = (left + (i - 0.5) * pixel - west) / cell - 0.5
        row = (bottom + side - (j - 0.5) * pixel - north) / down - 0.5
        found = rows[j][3 * i:3 * i + 3]
        reach = 2 + pixel / cell
        if reach < col < 402 - reach and reach < row < 343 - reach:
            inside += 1
            wanted = (col * 255 / 402, row * 255 / 343, 77)
        elif not (-reach < col < 402 + reach and -reach < row < 343 + reach):
            outside += 1
            wanted = ground
        else:
            continue
        assert all(abs(a - b) <= 3 for a, b in zip(found, wanted)), (path, i, j, found, wanted)
for (root, z, x, y), rows in textures.items():
    right = textures.get((root, z, x + 1, y))
    if right is None or len(right) != len(rows):
        continue
    edges += 1
    count = len(rows)
    for mine, theirs in zip(rows, right):
        assert all(abs(a - b) <= 1 for a, b in zip(mine[3 * (count - 2):], theirs[:6])), (z, x, y)
print(len(textures), inside, outside, edges)
assert inside > 300 and outside > 100 and edges > 3
E2
for set in own utm; do
  PYTHONPATH=$SCARP_SOURCE/tests/program python3 judge.py $set || fail "textures of $set"
done

# Only textures differ from the set without an image; threads and shares give the same bytes.
succeeds tiles threads --drape image.tif --drape-format png -j 3
diff -r own threads || fail "3 threads make other textures"
succeeds "$scarp" tile plan "$dem" plan.json --vertical egm96 --of 3dtiles --zoom 10 --drape image.tif --drape-format png -q
for shard in 2/2 1/2; do succeeds "$scarp" tile run plan.json --shard $shard -j 2 -q; done
succeeds "$scarp" tile finish plan.json shares -q
diff -r own shares || fail "shares make other textures"
diff <(cd own && find . | sort) <(cd plain && find . | sort) || fail "an image changes which tiles there are"

# The image is part of the plan, like the raster.
cp image.tif kept.tif
touch image.tif
refuses 2 "image.tif has changed" "$scarp" tile run plan.json
refuses 1 "all tiles show it" "$scarp" tile plan "$dem" next.json --changed-since plan.json
cp -p kept.tif other.tif
succeeds "$scarp" tile plan "$dem" other.json --vertical egm96 --of 3dtiles --zoom 10 --drape other.tif --drape-format png -q
refuses 2 "another plan" "$scarp" tile run other.json --parts plan.parts

# JPEG and WebP.
formats=$(gdalinfo --formats) judged=(own)
for format in jpeg webp; do
  grep -qi "^ *$format " <<< "$formats" || continue
  succeeds tiles $format --drape utm.tif --drape-format $format
  tile=$(find $format -path '*/10/*' -name '*.glb' -printf '%s %p\n' | sort -rn | cut -d' ' -f2 | head -1)
  python3 "$SCARP_SOURCE/tests/program/glb.py" "$tile" json > g.json
  [ "$(json g.json images 0 mimeType)" = "\"image/$format\"" ] || fail "mime type of $format"
  [ $format = webp ] || judged+=("$format")
done
if npm_judges gltf-validator; then
  find "${judged[@]}" -name '*.glb' -exec node "$js/validate_glb.cjs" {} + > judged.txt || { grep -v ": 0 errors" judged.txt | head -20; fail "the glTF validator has objections"; }
  [ "$(grep -c ': 0 errors, 0 warnings' judged.txt)" = "$(find "${judged[@]}" -name '*.glb' | wc -l)" ] || fail "not every tile was judged"
fi

# A user's mistakes.
refuses 1 "clients of quantized-mesh lay images over the terrain themselves" "$scarp" tile "$dem" no --vertical egm96 --drape utm.tif
refuses 1 "--drape-format needs --drape" "$scarp" tile "$dem" no --vertical egm96 --of 3dtiles --drape-format png
refuses 2 "no such file" tiles no --drape missing.tif
refuses 2 "an image to drape has 8 bits" tiles no --drape "$dem"
gdal_translate -q -of PNG image.tif bare.png && rm -f bare.png.aux.xml
refuses 2 "bare.png does not say where on the globe it lies" tiles no --drape bare.png
gdal_translate -q -a_srs "+proj=longlat +R=1737400 +no_defs" utm.tif moon.tif
refuses 2 "on a planet of 1737400 m" tiles no --drape moon.tif
