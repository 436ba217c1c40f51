#!/usr/bin/env python3
"""Judges tiles with a lake by brute force, without Scarp's code.

  tile_water.py FOLDER RASTER.xyz LAKE.geojson LEVEL LAYERS: the raster's samples are the nodes of the finest level.
  Flattens the raster's lake independently. Then compares every node of the last LAYERS levels with every triangle above
  it, against the bound in layer.json. Vertices in the lake must have one height on each level.
"""

import json
import math
import pathlib
import sys

from tiles import read_tile


def main():
    folder, level, layers = pathlib.Path(sys.argv[1]), float(sys.argv[4]), int(sys.argv[5])
    layer = json.load(open(folder / "layer.json"))
    finest = layer["maxzoom"]
    per_degree = 128 * 2 ** finest / 180
    nodes = {}
    for line in open(sys.argv[2]):
        x, y, z = map(float, line.split())
        nodes[round((x + 180) * per_degree), round((90 - y) * per_degree)] = z
    rings = [[((x + 180) * per_degree, (90 - y) * per_degree) for x, y in ring]
             for feature in json.load(open(sys.argv[3]))["features"] for ring in feature["geometry"]["coordinates"]]
    edges = [edge for ring in rings for edge in zip(ring, ring[1:])]

    def crossings(row):
        cuts = []
        for p, q in edges:
            if (p[1] <= row) != (q[1] <= row):
                cuts.append(p[0] + (row - p[1]) / (q[1] - p[1]) * (q[0] - p[0]))
                # Nodes within a 128th of the shore are water, too.
                away = abs(cuts[-1] - round(cuts[-1])) * abs(q[1] - p[1]) / math.dist(p, q)
                assert away > 1 / 100, f"the lake's edge is on a node: {row}, {away}"
        return sorted(cuts)

    water = set()
    for row in {row for _, row in nodes}:
        cuts = crossings(row)
        for west, east in zip(cuts[::2], cuts[1::2]):
            water.update((col, row) for col in range(math.ceil(west), math.floor(east) + 1))
    water &= set(nodes)
    assert len(water) > 5000
    wet = dict(nodes)
    for col, row in water:
        wet[col, row] = level
    for col, row in water:
        for x in (col - 1, col, col + 1):
            for y in (row - 1, row, row + 1):
                if (x, y) in nodes and (x, y) not in water:
                    wet[x, y] = max(wet[x, y], level + 0.01)
    compared = 0
    for z in range(finest, finest - layers, -1):
        step = 128 << (finest - z)
        told = layer["scarp"]["levels"][z]
        worst, seen, flat = 0, 0, set()
        for path in (folder / str(z)).glob("*/*.terrain"):
            tile = read_tile(path)
            left, top = int(path.parent.name) * step, (2 ** z - 1 - int(path.stem)) * step
            points = [(left + u * step / 32767, top + step - v * step / 32767, h)
                      for u, v, h in zip(tile["u"], tile["v"], tile["heights"])]
            flat |= {h for x, y, h in points if (round(x), round(y)) in water}
            for a, b, c in zip(*(iter(points[k] for k in tile["triangles"]),) * 3):
                area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
                for row in range(math.ceil(min(a[1], b[1], c[1]) - 1e-9), math.floor(max(a[1], b[1], c[1]) + 1e-9) + 1):
                    for col in range(math.ceil(min(a[0], b[0], c[0]) - 1e-9), math.floor(max(a[0], b[0], c[0]) + 1e-9) + 1):
                        if (col, row) not in wet:
                            continue
                        s = ((col - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (row - a[1])) / area
                        t = ((b[0] - a[0]) * (row - a[1]) - (col - a[0]) * (b[1] - a[1])) / area
                        if s < -1e-9 or t < -1e-9 or s + t > 1 + 1e-9:
                            continue
                        seen += 1
                        worst = max(worst, abs(a[2] + s * (b[2] - a[2]) + t * (c[2] - a[2]) - wet[col, row]))
        assert seen >= len(nodes), (z, seen)
        assert worst <= told["node_error"] * (1 + 1e-6) + 1e-4, (z, worst, told)
        # At least as many as a flat lake's shore requires, all at one height.
        assert len(flat) == 1, (z, flat)
        assert abs(flat.pop() - level) <= told["quantum"] / 2 + 1e-4, (z, told)
        compared += seen
    print(len(water), compared)


main()
