#!/usr/bin/env python3
"""Reads single-file tilesets without Scarp's code.

  tile_sets.py FOLDER ARCHIVE: fails unless the archive (.pmtiles, .mbtiles, .3tz) contains exactly the files of the
  folder, byte for byte, and satisfies its format's rules. Prints the number of files.
"""

import base64
import gzip
import hashlib
import json
import pathlib
import sqlite3
import struct
import sys
import zipfile

LEVEL_OF_TILES = -3  # index from the end of a path z/x/y.terrain


def hilbert(zoom, x, y):
    """The index of a tile on the curves of all zooms, by recursion over quadrants."""
    if zoom == 0:
        return 0
    half = 1 << (zoom - 1)
    right, lower = x >= half, y >= half
    x, y = x % half, y % half
    if not lower:
        x, y = (half - 1 - y, half - 1 - x) if right else (y, x)
    quadrant = [[0, 3], [1, 2]][lower][right]
    return quadrant * half * half + hilbert(zoom - 1, x, y)


def tile_number(zoom, x, y):
    return (4 ** zoom - 1) // 3 + hilbert(zoom, x, y)


def varints(data):
    value = shift = 0
    for byte in data:
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            yield value
            value = shift = 0
    assert shift == 0


def directory(data):
    numbers = list(varints(gzip.decompress(data)))
    count = numbers[0]
    assert len(numbers) == 1 + 4 * count and count > 0
    entries, number, end = [], 0, 0
    for k in range(count):
        delta, run, length, offset = numbers[1 + k::count][:4]
        number += delta
        offset = end if offset == 0 and k > 0 else offset - 1
        end = offset + length
        entries.append((number, run, length, offset))
    return entries


def read_pmtiles(path, names):
    data = path.read_bytes()
    assert data[:8] == b"PMTiles\x03"
    root, root_size, about, about_size, leaves, leaves_size, tiles, tiles_size, addressed, entries, contents = \
        struct.unpack_from("<11Q", data, 8)
    clustered, inner, packed, kind, least, most = struct.unpack_from("<6B", data, 96)
    assert clustered == 1 and inner == 2 and kind == 0
    assert root == 127 and root + root_size <= 16384 and tiles + tiles_size == len(data)
    found = []
    for number, run, length, offset in directory(data[root:root + root_size]):
        if run > 0:
            found.append((number, run, length, offset))
            continue
        leaf = directory(data[leaves + offset:leaves + offset + length])
        assert leaf[0][0] == number
        found += leaf
    assert len(found) == addressed == entries == contents
    assert [n for n, *_ in found] == sorted({n for n, *_ in found}), "not in order"
    assert [o for *_, o in found] == sorted(o for *_, o in found), "not clustered"
    assert sum(length for _, _, length, _ in found) == tiles_size, "gaps"
    metadata = json.loads(gzip.decompress(data[about:about + about_size]))
    more = {"geographic": 1, "mercator": 0}[metadata["grid"]]
    assert metadata["zoom_offset"] == more
    files = {name: text.encode() if isinstance(text, str) else base64.b64decode(text["base64"])
             for name, text in metadata["files"].items()}
    places = {number: data[tiles + offset:tiles + offset + length] for number, _, length, offset in found}
    zooms = set()
    for name in names:
        parts = name.split("/")
        if name in files:
            continue
        z, x, y = int(parts[LEVEL_OF_TILES]), int(parts[-2]), int(parts[-1].split(".")[0])
        if len(parts) == 4:
            x += int(parts[0]) << z
        zooms.add(z + more)
        files[name] = places.pop(tile_number(z + more, x, (1 << z) - 1 - y))
        assert packed == (2 if files[name][:2] == b"\x1f\x8b" else 1)
    assert not places, "tiles that the folder does not have"
    assert (least, most) == (min(zooms), max(zooms))
    return files


def read_mbtiles(path, names):
    database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    assert database.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    assert database.execute("PRAGMA application_id").fetchone() == (0x4d504258,)
    about = dict(database.execute("SELECT name, value FROM metadata"))
    assert about["scheme"] == "tms" and about["grid"] in ("geographic", "mercator")
    ending = {"application/vnd.quantized-mesh": "terrain", "model/gltf-binary": "glb"}[about["format"]]
    files = dict(database.execute("SELECT name, data FROM files"))
    for z, x, y, data in database.execute("SELECT * FROM tiles"):
        root = f"{x >> z}/" if ending == "glb" else ""
        files[f"{root}{z}/{x & (1 << z) - 1 if root else x}/{y}.{ending}"] = data
    levels = [z for z, in database.execute("SELECT DISTINCT zoom_level FROM tiles ORDER BY zoom_level")]
    assert [int(about["minzoom"]), int(about["maxzoom"])] == [levels[0], levels[-1]]
    return files


def read_3tz(path, names):
    data = path.read_bytes()
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        entries = archive.infolist()
        assert all(entry.compress_type == zipfile.ZIP_STORED for entry in entries)
        files = {entry.filename: archive.read(entry) for entry in entries}
    assert entries[-1].filename == "@3dtilesIndex1@"
    index = files.pop("@3dtilesIndex1@")
    keys = [struct.unpack_from("<2Q", index, at) for at in range(0, len(index), 24)]
    assert keys == sorted(keys)
    places = {index[at:at + 16]: struct.unpack_from("<Q", index, at + 16)[0] for at in range(0, len(index), 24)}
    assert places == {hashlib.md5(entry.filename.encode()).digest(): entry.header_offset for entry in entries[:-1]}
    assert all(data[at:at + 4] == b"PK\x03\x04" for at in places.values())
    return files


def main():
    folder, archive = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    want = {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    read = {".pmtiles": read_pmtiles, ".mbtiles": read_mbtiles, ".3tz": read_3tz}[archive.suffix]
    have = read(archive, want)
    assert have.keys() == want.keys(), have.keys() ^ want.keys()
    for name, data in want.items():
        assert have[name] == data, f"{name} differs"
    print(len(want))


main()
