#!/usr/bin/env python3
"""Compares the water masks of a folder of tiles with a lake's polygon, without Scarp's code.

  tile_masks.py FOLDER LAKE.geojson TILE...: redraws the masks of the tiles (z/x/y) from 4 x 4 places a texel. All tiles
  must have a mask. Prints how many are land, water, and both.
"""

import json
import math
import pathlib
import sys

from tiles import read_tile


def draw(edges, z, x, y):
    side = 180 / 2 ** z
    west, north = -180 + side * x, -90 + side * (y + 1)
    counts = [0] * 65536
    for j in range(1024):
        row = north - side * (j + 0.5) / 1024
        cuts = sorted(p[0] + (row - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) for p, q in edges if (p[1] <= row) != (q[1] <= row))
        for low, high in zip(cuts[::2], cuts[1::2]):
            begin, end = ((cut - west) / side * 1024 - 0.5 for cut in (low, high))
            for i in range(max(math.ceil(begin), 0), min(math.ceil(end), 1024)):
                counts[j // 4 * 256 + i // 4] += 1
    mask = bytes(int(255 * count / 16 + 0.5) for count in counts)
    return mask[:1] if len(set(mask)) == 1 else mask


def main():
    folder = pathlib.Path(sys.argv[1])
    assert "watermask" in json.load(open(folder / "layer.json"))["extensions"]
    rings = [ring for feature in json.load(open(sys.argv[2]))["features"] for ring in feature["geometry"]["coordinates"]]
    edges = [edge for ring in rings for edge in zip(ring, ring[1:])]
    seen = [0, 0, 0]
    for path in folder.glob("*/*/*.terrain"):
        mask = read_tile(path)["mask"]
        assert len(mask) in (1, 65536) and (len(mask) == 1) == (len(set(mask)) == 1), path
        seen[2 if len(mask) > 1 else mask[0] // 255] += 1
    for name in sys.argv[3:]:
        mine = draw(edges, *map(int, name.split("/")))
        theirs = read_tile(folder / f"{name}.terrain")["mask"]
        assert len(mine) == len(theirs), name
        # A place on an edge may count either way.
        apart = sum(a != b for a, b in zip(mine, theirs))
        assert apart <= 3 and len(set(mine)) > 5, (name, apart)
    print(*seen)


main()
