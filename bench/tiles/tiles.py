#!/usr/bin/env python3
"""Compares terrain tiles of Scarp with those of martini: triangles, bytes, true errors, and edges where neighbours
differ.

  tiles.py SCARP DATA     SCARP: the program; DATA: the open set of rasters. Writes tiles.csv and tiles_seconds.csv.

The raster is a part of srtm3_sierra_nevada_basin_range.tif, resampled to the nodes of level 12, 64 cells a tile: the
same input for all. Each tile is encoded as quantized-mesh, decoded, and judged at every node below it. Needs numpy,
gdal-bin, node and npm."""

import gzip
import pathlib
import struct
import subprocess
import sys
import tempfile

import numpy

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from harness import install, seconds_of_children, write_table  # noqa: E402
FINEST, CELLS = 12, 64
LEVEL, COLUMN, ROW, ACROSS = 8, 86, 180, 2  # the area: tiles of this level, y from the south
SIDE = (ACROSS << FINEST - LEVEL) * CELLS + 1
LEVELS = (12, 10, 8)


def geometric_error(z):
    """The error that clients assume for a level, in metres."""
    return 6378137 * 2 * numpy.pi * 0.25 / (65 * 2) / 2 ** z


def read_deltas(codes):
    return numpy.cumsum((codes >> 1) ^ -(codes & 1))


class Tile:
    """u, v (0 … 32767), heights, triangles, and the bytes without normals."""

    def __init__(self, data):
        low, high = struct.unpack_from("<2f", data, 24)
        count, = struct.unpack_from("<I", data, 88)
        codes = numpy.frombuffer(data, "<u2", 3 * count, 92).reshape(3, count).astype(int)
        self.u, self.v, h = (read_deltas(part) for part in codes)
        self.heights = (low + (high - low) * (h / 32767)).astype(numpy.float32)
        assert count <= 65536
        at = 92 + 6 * count
        size, = struct.unpack_from("<I", data, at)
        codes = numpy.frombuffer(data, "<u2", 3 * size, at + 4).astype(int)
        highest = numpy.concatenate([[0], numpy.cumsum(codes == 0)[:-1]])
        self.triangles = (highest - codes).reshape(-1, 3)
        at += 4 + 6 * size
        for _ in range(4):
            size, = struct.unpack_from("<I", data, at)
            at += 4 + 2 * size
        self.bytes = len(gzip.compress(data[:at], 9))

    def edge(self, across, value):
        """The vertices of an edge: places along it, and heights."""
        along = self.v if across is self.u else self.u
        return sorted(zip(along[across == value].tolist(), self.heights[across == value].tolist()))

    def error(self, window):
        """The largest |height of the triangle − height of the node| over all nodes."""
        cells = len(window) - 1
        x, y, worst = self.u / 32767 * cells, (32767 - self.v) / 32767 * cells, 0.0
        covered = numpy.zeros(window.shape, bool)
        for corner in self.triangles:
            (xa, xb, xc), (ya, yb, yc), (za, zb, zc) = x[corner], y[corner], self.heights[corner].astype(float)
            west, east = int(numpy.ceil(min(xa, xb, xc) - 1e-3)), int(numpy.floor(max(xa, xb, xc) + 1e-3))
            north, south = int(numpy.ceil(min(ya, yb, yc) - 1e-3)), int(numpy.floor(max(ya, yb, yc) + 1e-3))
            area = (yb - yc) * (xa - xc) + (xc - xb) * (ya - yc)
            if abs(area) < 1e-9 or east < west or south < north:
                continue
            gx, gy = numpy.meshgrid(numpy.arange(west, east + 1), numpy.arange(north, south + 1))
            a = ((yb - yc) * (gx - xc) + (xc - xb) * (gy - yc)) / area
            b = ((yc - ya) * (gx - xc) + (xa - xc) * (gy - yc)) / area
            inside = (a > -1e-6) & (b > -1e-6) & (a + b < 1 + 1e-6)
            part = window[north:south + 1, west:east + 1]
            errors = numpy.abs(a * za + b * zb + (1 - a - b) * zc - part)[inside]
            covered[north:south + 1, west:east + 1] |= inside
            worst = max(worst, errors.max(initial=0))
        # Rounded positions put some nodes on tilted edges slightly outside; all others are judged.
        assert covered.mean() > 0.995, covered.mean()
        return worst


def encode(columns, rows, heights, triangles):
    """quantized-mesh without a place: a header of zeros has the same size."""
    order = list(dict.fromkeys(triangles.ravel().tolist()))
    rank = {vertex: k for k, vertex in enumerate(order)}
    low, high = float(heights.min()), float(heights.max())
    h = numpy.rint((heights - low) / max(high - low, 1e-9) * 32767).astype(int)
    u, v = numpy.rint(columns / CELLS * 32767).astype(int), 32767 - numpy.rint(rows / CELLS * 32767).astype(int)
    data = bytearray(24) + struct.pack("<2f", low, high) + bytes(56) + struct.pack("<I", len(order))
    for values in (u[order], v[order], h[order]):
        deltas = numpy.diff(values, prepend=0)
        data += ((deltas << 1) ^ (deltas >> 31)).astype("<u2").tobytes()
    data += struct.pack("<I", len(triangles))
    highest = 0
    for index in triangles.ravel():
        data += struct.pack("<H", highest - rank[int(index)])
        highest += rank[int(index)] == highest
    for side in (u == 0, v == 0, u == 32767, v == 32767):
        edge = [rank[int(k)] for k in numpy.flatnonzero(side)]
        data += struct.pack(f"<I{len(edge)}H", len(edge), *edge)
    return bytes(data)


def cpu_seconds(command):
    before = seconds_of_children()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return seconds_of_children() - before


class Area:
    def __init__(self, data, scratch):
        self.scratch = scratch
        width = 180 / 2 ** LEVEL
        west, south, half = COLUMN * width - 180, ROW * width - 90, ACROSS * width / (SIDE - 1) / 2
        ends = (west - half, south - half, west + ACROSS * width + half, south + ACROSS * width + half)
        self.tif = scratch / "area.tif"
        subprocess.run(["gdalwarp", "-q", "-r", "bilinear", "-ot", "Float32", "-t_srs", "EPSG:4979", "-te", *map(repr, ends),
                        "-ts", str(SIDE), str(SIDE), data / "srtm3_sierra_nevada_basin_range.tif", self.tif], check=True)
        subprocess.run(["gdal_translate", "-q", "-of", "ENVI", self.tif, scratch / "area.raw"], check=True)
        self.nodes = numpy.fromfile(scratch / "area.raw", "<f4").reshape(SIDE, SIDE)

    def places(self, z):
        """The tiles of a level: names, and the nodes below."""
        tiles, cells = ACROSS << z - LEVEL, CELLS << FINEST - z
        for row in range(tiles):
            for column in range(tiles):
                x, y = (COLUMN << z - LEVEL) + column, ((ROW + ACROSS) << z - LEVEL) - 1 - row
                yield (x, y), self.nodes[row * cells:(row + 1) * cells + 1, column * cells:(column + 1) * cells + 1]

    def martini(self, z):
        tiles = ACROSS << z - LEVEL
        output = self.scratch / "martini.bin"
        printed = subprocess.run(["node", HERE / "martini.mjs", self.scratch / "area.raw", str(SIDE), str(tiles),
                                  str(2 ** (FINEST - z)), repr(geometric_error(z)), output], check=True, capture_output=True, text=True)
        data, at, found = output.read_bytes(), 0, {}
        for place, window in self.places(z):
            vertices, triangles = struct.unpack_from("<2I", data, at)
            corners = numpy.frombuffer(data, "<u2", 2 * vertices, at + 8).reshape(-1, 2).astype(int)
            at += 8 + 4 * vertices
            indices = numpy.frombuffer(data, "<u4", 3 * triangles, at).reshape(-1, 3)
            at += 12 * triangles
            step = (len(window) - 1) // CELLS
            heights = window[corners[:, 1] * step, corners[:, 0] * step]
            found[place] = Tile(encode(corners[:, 0], corners[:, 1], heights, indices))
        return found, float(printed.stdout) / len(found)

    def scarp(self, program, effort):
        """The tiles of all levels, and CPU milliseconds per tile of the whole run."""
        folder = self.scratch / effort
        seconds = cpu_seconds([program, "tile", self.tif, folder, "--zoom", str(FINEST), "--cells", str(CELLS), "--quality", "1",
                               "-e", repr(geometric_error(FINEST)), "--effort", effort, "-j", "1", "--overwrite", "-q"])
        files = {tuple(map(int, (*path.parts[-3:-1], path.stem))): path for path in folder.glob("*/*/*.terrain")}
        levels = {z: {(x, y): Tile(gzip.decompress(files[z, x, y].read_bytes())) for (x, y), _ in self.places(z)} for z in LEVELS}
        return levels, 1000 * seconds / len(files)


def judge(area, z, tiles):
    errors = [tiles[place].error(window) for place, window in area.places(z)]
    shared = []
    for (x, y), tile in tiles.items():
        if other := tiles.get((x + 1, y)):
            shared.append((tile.edge(tile.u, 32767), other.edge(other.u, 0)))
        if other := tiles.get((x, y + 1)):
            shared.append((tile.edge(tile.v, 32767), other.edge(other.v, 0)))
    return {"level": z, "tiles": len(tiles), "asked": f"{geometric_error(z):.1f}",
            "triangles": f"{numpy.mean([len(tile.triangles) for tile in tiles.values()]):.0f}",
            "bytes": f"{numpy.mean([tile.bytes for tile in tiles.values()]):.0f}", "error_median": f"{numpy.median(errors):.1f}",
            "error_worst": f"{max(errors):.1f}", "edges": len(shared), "edges_differ": sum(a != b for a, b in shared),
            "edges_places_differ": sum([place for place, _ in a] != [place for place, _ in b] for a, b in shared)}


def main():
    program, data = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    install("@mapbox/martini")
    rows, seconds = [], []
    with tempfile.TemporaryDirectory() as scratch:
        area = Area(data, pathlib.Path(scratch))
        for z in LEVELS:
            tiles, milliseconds = area.martini(z)
            rows.append({"maker": "martini", **judge(area, z, tiles)})
            if z == FINEST:
                seconds.append({"maker": "martini", "cpu_ms": f"{milliseconds:.2f}"})
        for effort in ("fast", "normal", "high"):
            levels, milliseconds = area.scarp(program, effort)
            rows += [{"maker": effort, **judge(area, z, tiles)} for z, tiles in levels.items()]
            seconds.append({"maker": effort, "cpu_ms": f"{milliseconds:.2f}"})
    write_table(HERE / "tiles.csv", rows)
    write_table(HERE / "tiles_seconds.csv", seconds)


main()
