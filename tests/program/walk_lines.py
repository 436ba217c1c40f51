#!/usr/bin/env python3
"""Follows lines along the edges of a mesh: python3 walk_lines.py MESH.obj LINES.geojson COLS ROWS [LEAST]

Fails unless each line of the file on the raster of COLS x ROWS samples is a chain of edges: its vertices are joined in
order, and its ends are vertices. Also fails for fewer than LEAST (1) edges. Coordinates are samples, and lines end
outside only to the left.
"""
import json
import sys

SIDE, NEAR = 16, 0.006  # cell size of the index; distance from a line after rounding to the lattice

vertices, edges = [], set()
for line in open(sys.argv[1]):
    word, *rest = line.split()[:4] or [""]
    if word == "v":
        vertices.append(tuple(map(float, rest)))
    elif word == "f":
        t = [int(v.split("/")[0]) - 1 for v in rest]
        edges |= {frozenset((t[k], t[(k + 1) % 3])) for k in range(3)}
cols, rows = map(int, sys.argv[3:5])
least = int(sys.argv[5]) if len(sys.argv) > 5 else 1
cells = {}
for v, (x, y, _) in enumerate(vertices):
    cells.setdefault((int(x // SIDE), int(y // SIDE)), []).append(v)


def near(p, x, y, length):
    """The vertices of all cells at or near the segment."""
    looks = int(length / SIDE * 4) + 1
    found = {(int((p[0] + x * t / looks + dx) // SIDE), int((p[1] + y * t / looks + dy) // SIDE))
             for t in range(looks + 1) for dx in (-4, 4) for dy in (-4, 4)}
    return (v for cell in found for v in cells.get(cell, []))


def inside(p):
    return 0 <= p[0] <= cols - 1 and 0 <= p[1] <= rows - 1


def walk(p, q):
    x, y = q[0] - p[0], q[1] - p[1]
    length = (x * x + y * y) ** 0.5
    if length == 0:
        return 0
    on = []
    for v in near(p, x, y, length):
        vx, vy, vz = vertices[v]
        along = ((vx - p[0]) * x + (vy - p[1]) * y) / length
        beside = abs((vx - p[0]) * y - (vy - p[1]) * x) / length
        # Next to a hard line a sample with another height may be closer than the lattice resolves.
        other = len(p) == 3 and abs(vz - p[2] - along / length * (q[2] - p[2])) > 0.02
        if beside < NEAR and -NEAR <= along <= length + NEAR and not other:
            on.append((along, v))
    on.sort()
    if not on:
        assert max(p[0], q[0]) < 0, ("nothing on", p, q)
        return 0
    assert not inside(p) or on[0][0] < NEAR, ("no vertex at", p)
    assert not inside(q) or on[-1][0] > length - NEAR, ("no vertex at", q)
    for (_, a), (_, b) in zip(on, on[1:]):
        assert frozenset((a, b)) in edges, ("no edge", vertices[a], vertices[b])
    return len(on) - 1


walked = 0
for feature in json.load(open(sys.argv[2]))["features"]:
    geometry = feature["geometry"]
    lines = geometry["coordinates"] if geometry["type"] == "Polygon" else [geometry["coordinates"]]
    walked += sum(walk(p, q) for points in lines for p, q in zip(points, points[1:]))
assert walked >= least, walked
