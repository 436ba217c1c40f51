#!/usr/bin/env python3
"""Writes the survey of data/examples from the bundled DEM, in UTM zone 16: a site of 3 x 2.4 km.

    tools/make_example_survey.py

stations.txt: stations as number, northing, easting, height, code. road.geojson: the edges of a road, with heights.
site_boundary.geojson: the polygon of the site. ground.las: a flight over it, ground and trees. Needs GDAL's programs.
"""
import json
import math
import os
import random
import struct
import subprocess

WEST, SOUTH, WIDTH, HEIGHT = 740_000, 4_019_000, 3_000, 2_400
STEP = 30

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "examples"))
random.seed(1)
warped = subprocess.run(["gdalwarp", "-q", "-of", "XYZ", "-t_srs", "EPSG:32616", "-tr", str(STEP), str(STEP), "-r",
                         "bilinear", "-te", str(WEST), str(SOUTH), str(WEST + WIDTH), str(SOUTH + HEIGHT), "-ot",
                         "Float32", "dem.tif", "/vsistdout/"], check=True, stdout=subprocess.PIPE, text=True).stdout
nodes = [float(line.split()[2]) for line in warped.splitlines()]
cols = WIDTH // STEP
rows = [nodes[i:i + cols] for i in range(0, len(nodes), cols)]


def height(x, y):
    """Bilinear between the centres of cells."""
    col = min(max((x - WEST) / STEP - 0.5, 0), len(rows[0]) - 1.001)
    row = min(max((SOUTH + HEIGHT - y) / STEP - 0.5, 0), len(rows) - 1.001)
    c, r = int(col), int(row)
    u, v = col - c, row - r
    return ((rows[r][c] * (1 - u) + rows[r][c + 1] * u) * (1 - v) +
            (rows[r + 1][c] * (1 - u) + rows[r + 1][c + 1] * u) * v)


def anywhere():
    return WEST + WIDTH * random.random(), SOUTH + HEIGHT * random.random()


def write_geojson(path, name, geometry):
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32616"}}
    features = [{"type": "Feature", "properties": {"name": name}, "geometry": g} for g in geometry]
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"type": "FeatureCollection", "crs": crs, "features": features}, file)
        file.write("\n")


with open("stations.txt", "w", encoding="utf-8") as file:
    for number in range(1, 601):
        x, y = anywhere()
        file.write(f"{number},{y:.2f},{x:.2f},{height(x, y):.2f},GND\n")

edges = []
for side in (-4, 4):
    line = []
    for i in range(31):
        x = WEST + 300 + 80 * i
        y = SOUTH + 1200 + 300 * math.sin(i / 6) + side
        line.append([x, round(y, 2), round(height(x, y - side), 2)])
    edges.append({"type": "LineString", "coordinates": line})
write_geojson("road.geojson", "edge of the road", edges)

ring = [[WEST + 150, SOUTH + 150], [WEST + 2850, SOUTH + 200], [WEST + 2800, SOUTH + 2250], [WEST + 1500, SOUTH + 1900],
        [WEST + 200, SOUTH + 2200], [WEST + 150, SOUTH + 150]]
write_geojson("site_boundary.geojson", "site", [{"type": "Polygon", "coordinates": [ring]}])

points = []
for _ in range(1500):
    x, y = anywhere()
    is_tree = random.random() < 0.3
    z = height(x, y) + (6 + 12 * random.random() if is_tree else 0)
    points.append((round((x - WEST) * 100), round((y - SOUTH) * 100), round(z * 100), 5 if is_tree else 2))
keys = struct.pack("<4H", 1, 1, 0, 3) + struct.pack("<12H", 1024, 0, 1, 1, 3072, 0, 1, 32616, 3076, 0, 1, 9001)
vlr = struct.pack("<H16sHH32s", 0, b"LASF_Projection", 34735, len(keys), b"") + keys
low, high = ([f(p[k] for p in points) for k in range(3)] for f in (min, max))
bounds = []
for k, base in enumerate((WEST, SOUTH, 0)):
    bounds += [base + high[k] / 100, base + low[k] / 100]
header = struct.pack("<4sHHIHH8sBB32s32sHHHIIBHI5I", b"LASF", 0, 0, 0, 0, 0, b"", 1, 2, b"Scarp", b"make_example_survey.py",
                     1, 2026, 227, 227 + len(vlr), 1, 0, 20, len(points), len(points), 0, 0, 0, 0)
header += struct.pack("<12d", 0.01, 0.01, 0.01, WEST, SOUTH, 0, *bounds)
with open("ground.las", "wb") as file:
    file.write(header + vlr)
    for x, y, z, kind in points:
        file.write(struct.pack("<iiiHBBbBH", x, y, z, 0, 0b001_001, kind, 0, 0, 0))
