#!/usr/bin/env python3
"""Reads a folder of 3D Tiles terrain without Scarp's code.

  tiles3d.py FOLDER: follows tileset.json and its subtrees by the specification; fails if tiles differ from the
  announced ones, a height, sphere or horizon point in a property table is impossible, or a file's parts are
  inconsistent. Prints tiles, subtrees, and the region's lowest and highest height.
"""

import json
import math
import pathlib
import struct
import sys


def read_glb(path):
    data = path.read_bytes()
    magic, version, size, json_size, kind = struct.unpack_from("<4s4I", data)
    assert (magic, version, size, kind) == (b"glTF", 2, len(data), 0x4E4F534A), path
    gltf = json.loads(data[20:20 + json_size])
    assert struct.unpack_from("<II", data, 20 + json_size) == (len(data) - 28 - json_size, 0x004E4942), path
    assert len(gltf["nodes"]) == len(gltf["meshes"]) == 1
    primitive, skirt = gltf["meshes"][0]["primitives"]
    assert skirt["extras"] == {"scarp": {"skirt": True}} and "extras" not in primitive
    assert set(primitive["extensions"]["CESIUM_tile_edges"]) == {"left", "bottom", "right", "top"}
    return gltf


class Subtree:
    def __init__(self, path):
        data = path.read_bytes()
        magic, version, json_size, size = struct.unpack_from("<4sIQQ", data)
        assert (magic, version) == (b"subt", 1) and 24 + json_size + size == len(data), path
        self.json = json.loads(data[24:24 + json_size])
        self.binary = data[24 + json_size:]
        assert self.json["buffers"] == [{"byteLength": size}]

    def view(self, number):
        view = self.json["bufferViews"][number]
        assert view["byteOffset"] % 8 == 0 and view["byteOffset"] + view["byteLength"] <= len(self.binary)
        return self.binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]

    def bits(self, availability, size):
        if "constant" in availability:
            return [availability["constant"] == 1] * size
        data = self.view(availability["bitstream"])
        assert len(data) == (size + 7) // 8
        bits = [bool(data[k // 8] >> k % 8 & 1) for k in range(size)]
        assert sum(bits) == availability["availableCount"]
        return bits

    def numbers(self, name, width):
        data = self.view(self.json["propertyTables"][0]["properties"][name]["values"])
        numbers = struct.unpack(f"<{len(data) // 8}d", data)
        return [numbers[k:k + width] for k in range(0, len(numbers), width)]


def deinterleave(code, bits):
    return (sum((code >> 2 * k & 1) << k for k in range(bits)), sum((code >> 2 * k + 1 & 1) << k for k in range(bits)))


def main():
    folder = pathlib.Path(sys.argv[1])
    tileset = json.loads((folder / "tileset.json").read_text())
    assert tileset["asset"]["version"] == "1.1"
    root = tileset["root"]
    low, high = root["boundingVolume"]["region"][4:]
    assert len(root["children"]) == 2 and root["geometricError"] >= root["children"][0]["geometricError"]
    announced, subtrees, origins = {}, 0, {}
    for number, child in enumerate(root["children"]):
        west, south, east, north, *_ = child["boundingVolume"]["region"]
        assert math.isclose(west, (number - 1) * math.pi, abs_tol=1e-12) and math.isclose(east - west, math.pi)
        tiling = child["implicitTiling"]
        levels = tiling["subtreeLevels"]
        size = (4 ** levels - 1) // 3
        pending = [(0, 0, 0)]
        while pending:
            z, x, y = pending.pop()
            uri = tiling["subtrees"]["uri"].format(level=z, x=x, y=y)
            subtree = Subtree(folder / uri)
            subtrees += 1
            tiles = subtree.bits(subtree.json["tileAvailability"], size)
            assert tiles == subtree.bits(subtree.json["contentAvailability"][0], size) and tiles[0]
            rows = zip(subtree.numbers("min_height", 1), subtree.numbers("max_height", 1),
                       subtree.numbers("sphere", 4), subtree.numbers("horizon_point", 3))
            for depth in range(levels):
                for code in range(4 ** depth):
                    if not tiles[(4 ** depth - 1) // 3 + code]:
                        continue
                    dx, dy = deinterleave(code, depth)
                    at = (z + depth, (x << depth) + dx, (y << depth) + dy)
                    assert at[0] < tiling["availableLevels"]
                    (least,), (most,), sphere, horizon = next(rows)
                    assert low <= least < most <= high and sphere[3] > 0 and all(map(math.isfinite, horizon))
                    assert math.hypot(*horizon) > 0.99
                    announced[number, *at] = child["content"]["uri"].format(level=at[0], x=at[1], y=at[2])
                    origins[number, *at] = sphere
            assert next(rows, None) is None
            below = subtree.bits(subtree.json["childSubtreeAvailability"], 4 ** levels)
            for code in (code for code in range(4 ** levels) if below[code]):
                dx, dy = deinterleave(code, levels)
                pending.append((z + levels, (x << levels) + dx, (y << levels) + dy))
    for number, z, x, y in announced:
        assert z == 0 or (number, z - 1, x // 2, y // 2) in announced, "a tile without a parent"
    assert sorted(announced.values()) == sorted(str(p.relative_to(folder)) for p in folder.glob("*/*/*/*.glb"))
    assert subtrees == len(list(folder.glob("subtrees/*/*/*/*.subtree")))
    for key, uri in announced.items():
        gltf = read_glb(folder / uri)
        # The node's corner, turned back to z up, is as far from the sphere's centre as a box's corner can be.
        x, y, z = gltf["nodes"][0]["matrix"][12:15]
        sphere = origins[key]
        assert math.dist((x, -z, y), sphere[:3]) <= 3 ** 0.5 * 3 * sphere[3], f"{uri} is elsewhere"
        # The tile's middle is at its address, with y from the south.
        root_number, level, column, row = key
        if level < 3:
            continue
        side = 180 / 2 ** level
        lon, lat = math.radians(-180 + 180 * root_number + (column + 0.5) * side), math.radians(-90 + (row + 0.5) * side)
        middle = [6.37e6 * c for c in (math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat))]
        assert math.dist(middle, sphere[:3]) < 60000 + sphere[3], f"{uri} is elsewhere"
    print(len(announced), subtrees, low, high)


main()
