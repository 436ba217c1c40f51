#!/usr/bin/env python3
"""Draws the picture of docs/tiles.md: an area of the bundled DEM as tiles of three levels.

usage: tools/draw_tiles.py SCARP PICTURE.png

Needs matplotlib. Tiles are read by tests/program/tiles.py, without any of Scarp's code."""
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

root = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "tests" / "program"))
from tiles import read_tile

LEVEL, X, Y = 10, 544, 718  # the area: a tile of this level
LIGHT = numpy.array([-0.5, 0.5, 0.7])


def shades(x, y, heights, corners):
    """Shades of the triangles, lit from the north-west; heights are exaggerated twice. Degrees become metres."""
    at = numpy.stack([x * 90000, y * 111000, 2 * heights], axis=1)
    across = numpy.cross(at[corners[:, 1]] - at[corners[:, 0]], at[corners[:, 2]] - at[corners[:, 0]])
    return numpy.clip(across @ LIGHT / numpy.linalg.norm(across, axis=1) / numpy.linalg.norm(LIGHT), 0, 1)


def draw(axes, folder, z):
    scale, count, vertices = 2 ** (z - LEVEL), 0, 0
    side = 180 / 2 ** z
    for column in range(scale):
        for row in range(scale):
            tile = read_tile(folder / str(z) / str(X * scale + column) / f"{Y * scale + row}.terrain")
            x = -180 + side * (X * scale + column + numpy.array(tile["u"]) / 32767)
            y = -90 + side * (Y * scale + row + numpy.array(tile["v"]) / 32767)
            corners = numpy.array(tile["triangles"]).reshape(-1, 3)
            axes.tripcolor(x, y, corners, facecolors=shades(x, y, numpy.array(tile["heights"]), corners), cmap="gray", vmin=-0.2,
                           vmax=1.1, edgecolors="#20407060", linewidth=0.25)
            axes.plot(*zip(*[(x[k], y[k]) for k in range(len(x)) if 0 in (tile["u"][k], tile["v"][k])]), ".", color="#c8321e",
                      markersize=2.2)
            count += len(corners)
    for k in range(scale + 1):
        for line, at in ((axes.axvline, -180 + side * (X * scale + k)), (axes.axhline, -90 + side * (Y * scale + k))):
            line(at, color="#c8321e", linewidth=0.8)
    axes.set(xlim=(-180 + side * X * scale, -180 + side * (X + 1) * scale), ylim=(-90 + side * Y * scale, -90 + side * (Y + 1) * scale),
             xticks=[], yticks=[], aspect=1 / numpy.cos(numpy.radians(36)))
    axes.set_title(f"level {z}: {scale * scale} tile{'s' * (scale > 1)}, {count:,} triangles", fontsize=9)


with tempfile.TemporaryDirectory() as scratch:
    folder = pathlib.Path(scratch) / "globe"
    subprocess.run([sys.argv[1], "tile", root / "data" / "jacksboro_fault.tif", folder, "--vertical", "egm96", "--zoom", "12", "-q"], check=True)
    figure, axes = plt.subplots(1, 3, figsize=(13.2, 5))
    for one, z in zip(axes, (10, 11, 12)):
        draw(one, folder, z)
    figure.tight_layout()
    figure.savefig(sys.argv[2], dpi=80)
