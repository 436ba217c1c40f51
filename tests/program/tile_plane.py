#!/usr/bin/env python3
"""Judges a folder of tiles on a local grid by its files alone, without Scarp's code.

  tile_plane.py FOLDER SAMPLES COLS ROWS BACKGROUND CELL: SAMPLES are float32, row by row from the north-west. Decodes
  every GLB (meshopt, version 0). Fails unless each sample has a triangle within the bound of each level, no vertex lies
  a coarse node beyond the raster, neighbours have the same vertices on their edge, and all heights lie in the box of
  tileset.json. Prints for each level: tiles, triangles, the worst error, the bound.
"""
import array
import json
import math
import pathlib
import struct
import sys


def decode_vertices(data, count, stride):
    assert data[0] == 0xA0, "vertex stream of another version"
    tail = max(stride, 32)
    last = bytearray(data[len(data) - stride:])
    at, out = 1, bytearray(count * stride)
    block = min((8192 // stride) & ~15, 256)
    for first in range(0, count, block):
        size = min(block, count - first)
        groups = (size + 15) // 16
        for k in range(stride):
            header = data[at:at + (groups + 3) // 4]
            at += (groups + 3) // 4
            value = last[k]
            for group in range(groups):
                mode = header[group // 4] >> (group % 4 * 2) & 3
                if mode == 0:
                    deltas = bytes(16)
                elif mode == 3:
                    deltas = data[at:at + 16]
                    at += 16
                else:
                    bits = 2 * mode
                    packed, at = data[at:at + 2 * bits], at + 2 * bits
                    deltas = bytearray()
                    for i in range(16):
                        shift = 8 - bits - i % (8 // bits) * bits
                        delta = packed[i // (8 // bits)] >> shift & (1 << bits) - 1
                        if delta == (1 << bits) - 1:
                            delta, at = data[at], at + 1
                        deltas.append(delta)
                for i in range(min(16, size - 16 * group)):
                    delta = deltas[i]
                    value = value + (-(delta & 1) ^ delta >> 1) & 255
                    out[(first + 16 * group + i) * stride + k] = value
            last[k] = value
    assert at <= len(data) - tail
    return out


def decode_triangles(data, count):
    assert data[0] & 0xF0 == 0xE0, "no stream of triangles"
    longest = 13 if data[0] & 15 >= 1 else 15
    edges, vertices = [(0, 0)] * 16, [0] * 16
    next_vertex = last = 0
    table, at, out = data[len(data) - 16:], 1 + count // 3, []

    def read_index():
        nonlocal at
        value = shift = 0
        while True:
            byte, at = data[at], at + 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return last + (value >> 1 ^ -(value & 1)) & 0xFFFFFFFF

    def keep(vertex):
        vertices.insert(0, vertex)
        vertices.pop()

    def keep_edges(*some):
        for edge in some:
            edges.insert(0, edge)
            edges.pop()

    for code in data[1:1 + count // 3]:
        if code < 0xF0:
            a, b = edges[code >> 4]
            third = code & 15
            if third == 0:
                c, next_vertex = next_vertex, next_vertex + 1
                keep(c)
            elif third < longest:
                c = vertices[third]
            else:
                c = last = read_index() if third == 15 else last + (1 if third == 14 else -1)
                keep(c)
            out += [a, b, c]
            keep_edges((c, b), (a, c))
            continue
        if code < 0xFE:
            aux, explicit = table[code & 15], False
        else:
            aux, at, explicit = data[at], at + 1, True
            if aux == 0:
                next_vertex = 0
        kinds = [15 if code == 0xFF else 0, aux >> 4, aux & 15]
        corners = []
        for kind in kinds:
            if kind == 0:
                corners.append(next_vertex)
                next_vertex += 1
            else:
                corners.append(vertices[kind - 1] if not (explicit and kind == 15) else None)
        if explicit:
            for k in range(3):
                if corners[k] is None:
                    corners[k] = last = read_index()
        for kind, corner in zip(kinds, corners):
            if kind == 0 or explicit and kind == 15:
                keep(corner)
        a, b, c = corners
        out += corners
        keep_edges((b, a), (c, b), (a, c))
    return out


class Tile:
    def __init__(self, path):
        data = path.read_bytes()
        size = struct.unpack_from("<I", data, 12)[0]
        self.json, self.binary = json.loads(data[20:20 + size]), data[28 + size:]
        primitive = self.json["meshes"][0]["primitives"][0]
        matrix = self.json["nodes"][0]["matrix"]
        assert [value for k, value in enumerate(matrix[:12]) if k % 5] == [0] * 9
        position = self.json["accessors"][primitive["attributes"]["POSITION"]]
        items, is_short = self.items(position), position["componentType"] == 5123
        self.places = []
        for v in range(position["count"]):
            # A normalized value is a number of steps: matrix / 65535 is one.
            numbers = struct.unpack_from("<3H", items, 8 * v) if is_short else struct.unpack_from("<3f", items, 12 * v)
            scales = [matrix[5 * k] / (65535 if is_short else 1) for k in range(3)]
            x, y, z = (matrix[12 + k] + scales[k] * numbers[k] for k in range(3))
            self.places.append((x, -z, y))
        self.triangles = self.indices(primitive["indices"])
        edges = primitive["extensions"]["CESIUM_tile_edges"]
        self.edges = {name: [self.places[v] for v in self.indices(edges[name])] for name in edges}

    def items(self, accessor):
        view = self.json["bufferViews"][accessor["bufferView"]]
        packed = view.get("extensions", {}).get("EXT_meshopt_compression")
        start = accessor.get("byteOffset", 0)
        if packed is None:
            return self.binary[view.get("byteOffset", 0):][start:view["byteLength"]]
        data = self.binary[packed.get("byteOffset", 0):][:packed["byteLength"]]
        if packed["mode"] == "ATTRIBUTES":
            return decode_vertices(data, packed["count"], packed["byteStride"])
        return struct.pack(f"<{packed['count']}H", *decode_triangles(data, packed["count"]))

    def indices(self, number):
        accessor = self.json["accessors"][number]
        kind = {5123: "H", 5125: "I"}[accessor["componentType"]]
        return struct.unpack_from(f"<{accessor['count']}{kind}", self.items(accessor))


def main():
    folder, samples, cols, rows = pathlib.Path(sys.argv[1]), array.array("f"), int(sys.argv[3]), int(sys.argv[4])
    background, cell = float(sys.argv[5]), float(sys.argv[6])
    samples.frombytes(pathlib.Path(sys.argv[2]).read_bytes())
    heights = [[background if math.isnan(z) else z for z in samples[row * cols:(row + 1) * cols]] for row in range(rows)]
    heights.reverse()
    tileset = json.loads((folder / "tileset.json").read_text())
    scarp, box = tileset["asset"]["extras"]["scarp"], tileset["root"]["boundingVolume"]["box"]
    # For 29 bits.
    assert all(math.isclose(size, cell, rel_tol=2e-9) for size in scarp["grid"]["cell"]), scarp["grid"]
    cell = scarp["grid"]["cell"][0]
    low, high = box[2] - box[11], box[2] + box[11]
    west, south = (cols - 1) // 2, (rows - 1) // 2
    assert math.isclose(box[0] - box[3], -west * cell, abs_tol=1e-6 * cell) and math.isclose(
        box[1] - box[7], -south * cell, abs_tol=1e-6 * cell)
    tiles, error = {}, tileset["root"]["geometricError"]
    for path in folder.glob("0/*/*/*.glb"):
        z, x, y = int(path.parts[-3]), int(path.parts[-2]), int(path.stem)
        tiles[z, x, y] = Tile(path)
    for z, level in enumerate(scarp["levels"]):
        of_level = {key: tile for key, tile in tiles.items() if key[0] == z}
        assert len(of_level) == level["tiles"] > 0 and level["bound"] <= error / 2 ** z
        met, worst, triangles = set(), 0, 0
        beyond = max(0, (scarp["grid"]["side"] >> z) / 256 - 1) + 1e-9
        for (_, x, y), tile in of_level.items():
            for name, (to_x, to_y), other in (("right", (1, 0), "left"), ("top", (0, 1), "bottom")):
                beside = of_level.get((z, x + to_x, y + to_y))
                assert beside is None or tile.edges[name] == beside.edges[other][::-1], (z, x, y, name)
            places = [(px / cell + west, py / cell + south, pz) for px, py, pz in tile.places]
            triangles += len(tile.triangles) // 3
            for px, py, pz in places:
                assert -1e-9 <= px <= cols - 1 + beyond and -1e-9 <= py <= rows - 1 + beyond, (z, x, y, px, py)
                assert low <= pz <= high
            for k in range(0, len(tile.triangles), 3):
                (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (places[v] for v in tile.triangles[k:k + 3])
                area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
                assert area > 0, (z, x, y)
                for row in range(math.ceil(min(ay, by, cy) - 1e-9), min(math.floor(max(ay, by, cy) + 1e-9), rows - 1) + 1):
                    for col in range(math.ceil(min(ax, bx, cx) - 1e-9), min(math.floor(max(ax, bx, cx) + 1e-9), cols - 1) + 1):
                        to_b = ((col - ax) * (cy - ay) - (cx - ax) * (row - ay)) / area
                        to_c = ((bx - ax) * (row - ay) - (col - ax) * (by - ay)) / area
                        if min(to_b, to_c, 1 - to_b - to_c) < -1e-9:
                            continue
                        met.add(row * cols + col)
                        worst = max(worst, abs(az + to_b * (bz - az) + to_c * (cz - az) - heights[row][col]))
        assert len(met) == cols * rows, f"level {z}: {cols * rows - len(met)} samples lie on no triangle"
        # The reported error is at least that of the file's numbers.
        assert worst <= level["node_error"] * (1 + 1e-9) + 1e-6, (z, worst, level["node_error"])
        print(len(of_level), triangles, worst, level["bound"])


if __name__ == "__main__":
    main()
