#!/usr/bin/env python3
"""Plants a fault in a tileset without Scarp's code.

  break_tiles.py FAULT PATH: changes the file (a tile of quantized-mesh, or a set in one file) by FAULT.
"""

import gzip
import pathlib
import sqlite3
import struct
import sys

HIGH, RADIUS, HORIZON, COUNT = 28, 56, 64, 88  # byte offsets in a header


def of_tile(change):
    def run(path):
        data = bytearray(gzip.decompress(path.read_bytes()))
        change(data)
        path.write_bytes(gzip.compress(bytes(data)))
    return run


def add(data, at, kind, change):
    struct.pack_into(kind, data, at, change(struct.unpack_from(kind, data, at)[0]))


def heights(data):
    """Raises all heights by a metre."""
    for at in (HIGH - 4, HIGH):
        add(data, at, "<f", lambda h: h + 1)


def normals(data):
    """Changes a bit in the last bytes: normals of all vertices."""
    count, = struct.unpack_from("<I", data, COUNT)
    for at in range(len(data) - 2 * count, len(data), 2):
        data[at] ^= 16


def sphere(data):
    add(data, RADIUS, "<d", lambda r: 0.9 * r)


def horizon(data):
    for axis in range(3):
        add(data, HORIZON + 8 * axis, "<d", lambda x: 0.999 * x)


def unzip(path):
    path.write_bytes(gzip.decompress(path.read_bytes()))


def cut(path):
    path.write_bytes(path.read_bytes()[:200])


def count_of_pmtiles(path):
    data = bytearray(path.read_bytes())
    add(data, 72, "<Q", lambda count: count + 1)
    path.write_bytes(data)


def directory_of_pmtiles(path):
    data = bytearray(path.read_bytes())
    data[140:150] = bytes(10)
    path.write_bytes(data)


def swap_in_pmtiles(path):
    """Swaps two tiles of a level: the last two entries of the directory exchange their lengths and bytes."""
    data = bytearray(path.read_bytes())
    root, root_size = struct.unpack_from("<2Q", data, 8)
    tiles, = struct.unpack_from("<Q", data, 56)
    numbers, value, shift = [], 0, 0
    for byte in gzip.decompress(bytes(data[root:root + root_size])):
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            numbers.append(value)
            value = shift = 0
    count = numbers[0]
    lengths = numbers[1 + 2 * count:1 + 3 * count]
    end = tiles + sum(lengths)
    start = end - lengths[-1] - lengths[-2]
    first, second = data[start:start + lengths[-2]], data[start + lengths[-2]:end]
    data[start:end] = second + first
    lengths[-2:] = [len(second), len(first)]
    numbers[1 + 2 * count:1 + 3 * count] = lengths
    packed = bytearray()
    for number in numbers:
        while number > 127:
            packed.append(number & 127 | 128)
            number >>= 7
        packed.append(number)
    packed = gzip.compress(bytes(packed), 9)
    assert len(packed) <= root_size + 64
    # At the end of the file, where there is room.
    struct.pack_into("<2Q", data, 8, len(data), len(packed))
    path.write_bytes(bytes(data) + packed)


def index_of_3tz(path):
    data = path.read_bytes()
    at = data.index(b"@3dtilesIndex1@") + 15
    path.write_bytes(data[:at] + data[at + 24:at + 48] + data[at:at + 24] + data[at + 48:])


def row_of_mbtiles(path):
    with sqlite3.connect(path) as database:
        database.execute("DELETE FROM tiles WHERE zoom_level = 8 AND tile_row = (SELECT min(tile_row) FROM tiles "
                         "WHERE zoom_level = 8)")


def zoom_of_mbtiles(path):
    with sqlite3.connect(path) as database:
        database.execute("UPDATE metadata SET value = '12' WHERE name = 'maxzoom'")


FAULTS = {name: of_tile(change) for name, change in
          {"heights": heights, "normals": normals, "sphere": sphere, "horizon": horizon}.items()}
FAULTS.update({"unzip": unzip, "cut": cut, "count_of_pmtiles": count_of_pmtiles,
               "directory_of_pmtiles": directory_of_pmtiles, "swap_in_pmtiles": swap_in_pmtiles,
               "index_of_3tz": index_of_3tz, "row_of_mbtiles": row_of_mbtiles, "zoom_of_mbtiles": zoom_of_mbtiles})
FAULTS[sys.argv[1]](pathlib.Path(sys.argv[2]))
