#!/usr/bin/env python3
"""Writes data/examples/streams.geojson: a stream over the bundled DEM, from a valley in the north.

    tools/make_example_stream.py >data/examples/streams.geojson

A flood rises from the border of the raster inwards, the lowest sample next (Barnes et al. 2014). Each sample drains
into the one from which it was reached; pits drain over their lowest sill.
"""
import heapq
import json
import os
import subprocess

SOURCE = -84.2830, 36.3980  # longitude, latitude
POINTS = 170  # points of the line, a sample apart

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
text = subprocess.run(["gdal_translate", "-q", "-of", "XYZ", "data/jacksboro_fault.tif", "/vsistdout/"], check=True,
                      stdout=subprocess.PIPE, text=True).stdout
nodes = [[float(word) for word in line.split()] for line in text.splitlines()]  # from the north, from the west
west, north, _ = nodes[0]
step = nodes[1][0] - west
cols = sum(1 for node in nodes if node[1] == north)
rows = len(nodes) // cols
heights = [[node[2] for node in nodes[row * cols:(row + 1) * cols]] for row in range(rows)]

drains_into = {}
queue = [(heights[row][col], row, col) for row in range(rows) for col in range(cols)
         if row in (0, rows - 1) or col in (0, cols - 1)]
for _, row, col in queue:
    drains_into[row, col] = None
heapq.heapify(queue)
while queue:
    level, row, col = heapq.heappop(queue)
    for y in range(max(row - 1, 0), min(row + 2, rows)):
        for x in range(max(col - 1, 0), min(col + 2, cols)):
            if (y, x) not in drains_into:
                drains_into[y, x] = row, col
                heapq.heappush(queue, (max(level, heights[y][x]), y, x))

at = round((north - SOURCE[1]) / step), round((SOURCE[0] - west) / step)
course = []
while at is not None and len(course) < POINTS:
    course.append([round(west + at[1] * step, 5), round(north - at[0] * step, 5)])
    at = drains_into[at]
print('{"type": "FeatureCollection", "features": [')
print('{"type": "Feature", "properties": {"name": "a stream"}, "geometry": {"type": "LineString", "coordinates": '
      + json.dumps(course) + "}}")
print("]}")
