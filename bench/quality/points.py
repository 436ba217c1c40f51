#!/usr/bin/env python3
"""Triangles of points by effort at equal max error, to points.csv.

    bench/quality/points.py build/bin/scarp DATA > bench/quality/points.csv

Reads rasters, thinned to random samples, and LAS files from DATA. Each mesh is written as PLY in double and judged here
by brute force in the order of a grid of buckets: every point against every triangle near it; that of the LAZ file by
the program. Needs gdal_translate.
"""
import json
import math
import pathlib
import random
import struct
import subprocess
import sys
import tempfile

RASTERS = {"crater.tif": 0.3, "fuji.tif": 0.3, "gabilan_lidar_1m.tif": 0.2, "sierra_de_bejar_25m.tif": 0.3,
           "wahoo_swath_nan.tif": 0.2, "bigtujunga30m.tif": 0.03}  # the last two: soundings, stations
LIDAR = {"las/pdal_4_6_crop.las": 2, "las/pdal_0-0-0-0.laz": 0}  # and the class
SHARES = ("1%", "0.3%")
EFFORTS = ("fast", "normal", "high")


def thin(raster, share, path):
    """A share of the valid samples, on metres or cells, not degrees."""
    text = subprocess.run(["gdal_translate", "-q", "-of", "XYZ", raster, "/vsistdout/"], check=True,
                          stdout=subprocess.PIPE, text=True).stdout
    chance = random.Random(7)
    rows = [line.split() for line in text.splitlines() if chance.random() < share]
    scale = 100_000 if max(abs(float(row[0])) for row in rows) <= 360 else 1
    points = [(float(x) * scale, float(y) * scale, float(z)) for x, y, z in rows if -12_000 < float(z) < 9_000]
    path.write_text("x,y,z\n" + "".join(f"{x:.2f},{y:.2f},{z!r}\n" for x, y, z in points))


def read_las(path, kind):
    """The points of a class in their own coordinates; of an uncompressed file of format 0 to 5."""
    data = path.read_bytes()
    begin, = struct.unpack_from("<I", data, 96)
    length, count = struct.unpack_from("<HI", data, 105)
    scale, offset = struct.unpack_from("<3d", data, 131), struct.unpack_from("<3d", data, 155)
    points = []
    for at in range(begin, begin + length * count, length):
        if data[at + 15] & 31 == kind:
            whole = struct.unpack_from("<3i", data, at)
            points.append(tuple(w * s + o for w, s, o in zip(whole, scale, offset)))
    return points


def read_ply(path):
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    lines = head.decode("latin-1").splitlines()
    count = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    kind = "d" if "property double x" in lines else "f"
    size = 3 * struct.calcsize(kind)
    corners = [struct.unpack_from("<3" + kind, body, size * i) for i in range(count["vertex"])]
    start = size * count["vertex"]
    faces = [struct.unpack_from("<3i", body, start + 13 * i + 1) for i in range(count["face"])]
    return corners, faces


def judge(points, corners, faces):
    """The largest error, and how many points no triangle covers."""
    xs, ys = [c[0] for c in corners], [c[1] for c in corners]
    side = max(max(xs) - min(xs), max(ys) - min(ys)) / max(1, math.isqrt(len(faces)))
    buckets = {}
    for face in faces:
        a, b, c = (corners[i] for i in face)
        for col in range(math.floor(min(a[0], b[0], c[0]) / side), math.floor(max(a[0], b[0], c[0]) / side) + 1):
            for row in range(math.floor(min(a[1], b[1], c[1]) / side), math.floor(max(a[1], b[1], c[1]) / side) + 1):
                buckets.setdefault((col, row), []).append((a, b, c))
    worst, missed = 0, 0
    for x, y, z in points:
        error = None
        for a, b, c in buckets.get((math.floor(x / side), math.floor(y / side)), ()):
            whole = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            u = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / whole
            v = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / whole
            if min(u, v, 1 - u - v) < -1e-9:
                continue
            error = max(error or 0, abs(u * a[2] + v * b[2] + (1 - u - v) * c[2] - z))
        if error is None:
            missed += 1
        else:
            worst = max(worst, error)
    return worst, missed


def main():
    scarp, data = sys.argv[1], pathlib.Path(sys.argv[2])
    print("points,count,max_error,effort,triangles,ratio,judged_max,uncovered")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        inputs = []
        for raster, share in RASTERS.items():
            path = folder / (pathlib.Path(raster).stem + ".csv")
            thin(data / raster, share, path)
            points = [tuple(map(float, line.split(","))) for line in path.read_text().splitlines()[1:]]
            inputs.append((raster, path, [], points))
        for lidar, kind in LIDAR.items():
            points = read_las(data / lidar, kind) if lidar.endswith(".las") else None
            inputs.append((lidar, data / lidar, ["--class", str(kind)], points))
        for title, path, options, points in inputs:
            for share in SHARES:
                greedy = None
                for effort in EFFORTS:
                    report, mesh = folder / "r.json", folder / "m.ply"
                    subprocess.run([scarp, "simplify", path, mesh, "-e", share, "--effort", effort, "--crs", "source",
                                    "--double", "--report", report, "--overwrite", "-q", *options], check=True)
                    told = json.loads(report.read_text())
                    greedy = greedy or told["triangles"]
                    worst, missed = judge(points, *read_ply(mesh)) if points else (told["max_error"], told["uncovered"])
                    print(title, told["input"]["points"], f"{told['goal']['max_error']:.6g}", effort, told["triangles"],
                          f"{told['triangles'] / greedy:.3f}", f"{worst:.6g}", missed, sep=",", flush=True)


main()
