#!/usr/bin/env python3
"""Reads a folder of quantized-mesh tiles without Scarp's code.

  tiles.py FOLDER: fails if tiles differ from those that layer.json announces, two neighbours differ on their shared
  edge (places, heights in single precision, normals), or a triangle faces down. Prints tiles, shared edges, and the
  lowest and the highest height.
"""

import gzip
import json
import pathlib
import struct
import sys


def read_tile(path):
    data = gzip.open(path).read()
    low, high = struct.unpack_from("<2f", data, 24)
    count, = struct.unpack_from("<I", data, 88)
    at = 92

    def deltas():
        nonlocal at
        value, values = 0, []
        for code in struct.unpack_from(f"<{count}H", data, at):
            value += (code >> 1) ^ -(code & 1)
            values.append(value)
        at += 2 * count
        return values

    u, v, h = deltas(), deltas(), deltas()
    assert count <= 65536
    triangles, = struct.unpack_from("<I", data, at)
    at += 4
    highest, indices = 0, []
    for code in struct.unpack_from(f"<{3 * triangles}H", data, at):
        indices.append(highest - code)
        highest += code == 0
    at += 6 * triangles
    edges = []
    for _ in range(4):
        size, = struct.unpack_from("<I", data, at)
        edges.append(struct.unpack_from(f"<{size}H", data, at + 4))
        at += 4 + 2 * size
    extensions = {}
    while at < len(data):
        kind, size = struct.unpack_from("<BI", data, at)
        extensions[kind] = data[at + 5:at + 5 + size]
        at += 5 + size
    assert at == len(data) and set(extensions) <= {1, 2} and len(extensions[1]) == 2 * count
    normals = extensions[1]
    for a, b, c in zip(indices[::3], indices[1::3], indices[2::3]):
        assert (u[b] - u[a]) * (v[c] - v[a]) > (u[c] - u[a]) * (v[b] - v[a]), f"{path}: a triangle faces down"
    heights = [struct.unpack("<f", struct.pack("<f", low + (high - low) * (k / 32767)))[0] for k in h]
    heights = [0.0 if abs(height) < 1e-10 else height for height in heights]

    def edge(number, along):
        return [(along[k], heights[k], normals[2 * k:2 * k + 2]) for k in edges[number]]

    assert {k for k in range(count) if u[k] == 0} == set(edges[0])
    return {"west": edge(0, v), "south": edge(1, u), "east": edge(2, v), "north": edge(3, u), "heights": heights,
            "u": u, "v": v, "triangles": indices, "mask": extensions.get(2)}


def main():
    folder = pathlib.Path(sys.argv[1])
    layer = json.load(open(folder / "layer.json"))
    announced = {(z, x, y) for z, ranges in enumerate(layer["available"]) for r in ranges
                 for x in range(r["startX"], r["endX"] + 1) for y in range(r["startY"], r["endY"] + 1)}
    there = {(int(p.parts[-3]), int(p.parts[-2]), int(p.stem)): p for p in folder.glob("*/*/*.terrain")}
    assert announced == set(there), "layer.json and the folder differ"
    roots = {"EPSG:4326": 2, "EPSG:3857": 1}[layer["projection"]]
    assert {(0, root, 0) for root in range(roots)} == {key for key in announced if key[0] == 0}
    for z, x, y in announced:
        assert z == 0 or (z - 1, x // 2, y // 2) in announced, "a tile without a parent"
    tiles = {key: read_tile(path) for key, path in there.items()}
    edges = 0
    for (z, x, y), tile in tiles.items():
        for key, mine, theirs in (((z, (x + 1) % (roots << z), y), "east", "west"), ((z, x, y + 1), "north", "south")):
            if key in tiles:
                edges += 1
                assert tile[mine] == tiles[key][theirs], f"{(z, x, y)} and {key} differ"
    heights = [height for tile in tiles.values() for height in tile["heights"]]
    print(len(tiles), edges, min(heights), max(heights))


if __name__ == "__main__":
    main()
