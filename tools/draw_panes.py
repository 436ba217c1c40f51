#!/usr/bin/env python3
"""Draws the picture of README.md: a detail of the bundled DEM as full grid, and as meshes by three efforts at one max
error.

usage: tools/draw_panes.py SCARP PICTURE.png

The counts are the program's for the whole DEM. Needs matplotlib, and gdal_translate for the full grid."""
import io
import json
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap
from PIL import Image

root = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "tests" / "program"))
import glb

DEM = root / "data" / "jacksboro_fault.tif"
ERROR = "20"
PANES = [("fast", "Greedy insertion"), ("normal", "Scarp"), ("high", "Scarp, high effort")]
LEFT, TOP, COLUMNS, ROWS = 180, 96, 90, 72  # the detail, in samples
LIGHT = numpy.array([-0.5, 0.5, 0.7])
TINTS = LinearSegmentedColormap.from_list("tints", ["#a3c4a8", "#d3d9b4", "#ead9ae", "#e6bf98", "#e8d4c8"])
COLOURS = 64


def read_mesh(path, width, height):
    """Columns, rows and heights of the vertices, and the triangles, of a GLB that covers the raster: x east, y up, z
    south."""
    document, binary = glb.load(path)
    (mesh,) = document["meshes"]
    part = mesh["primitives"][0]
    x, y, z = numpy.array(glb.floats(document, binary, part["attributes"]["POSITION"])).T
    indices = document["accessors"][part["indices"]]
    kind = {5123: numpy.uint16, 5125: numpy.uint32}[indices["componentType"]]
    triangles = numpy.frombuffer(glb.view_bytes(document, binary, indices["bufferView"]), kind, indices["count"])
    from_0_to = lambda values, end: (values - values.min()) / (values.max() - values.min()) * end
    return from_0_to(x, width - 1), from_0_to(z, height - 1), y, triangles.astype(int).reshape(-1, 3)


def full_grid(folder):
    """All samples of the detail, two triangles a cell."""
    window = map(str, (LEFT, TOP, COLUMNS + 1, ROWS + 1))
    subprocess.run(["gdal_translate", "-q", "-of", "XYZ", "-srcwin", *window, DEM, folder / "grid.xyz"], check=True)
    heights = numpy.loadtxt(folder / "grid.xyz")[:, 2]
    at = numpy.arange(heights.size).reshape(ROWS + 1, COLUMNS + 1)
    a, b, c, d = at[:-1, :-1].ravel(), at[:-1, 1:].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel()
    row, column = numpy.divmod(at.ravel(), COLUMNS + 1)
    return column + LEFT, row + TOP, heights, numpy.concatenate([numpy.stack([a, c, b], 1), numpy.stack([b, c, d], 1)])


def draw(axes, cell, column, row, heights, triangles, line):
    """Draws triangles tinted by height and lit from the north-west, heights exaggerated twice; and their edges."""
    at = numpy.stack([column * cell[0], -row * cell[1], 2 * heights], 1)
    corners = at[triangles]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    light = numpy.clip(normals @ LIGHT / numpy.linalg.norm(normals, axis=1), 0, 1)
    tint = TINTS((heights[triangles].mean(axis=1) - 240) / 620)[:, :3]
    faces = numpy.clip(tint * (0.42 + 0.78 * light)[:, None], 0, 1)
    axes.add_collection(PolyCollection(corners[:, :, :2], facecolors=faces, edgecolors="#2a3a44", linewidths=line))
    axes.set(xlim=(LEFT * cell[0], (LEFT + COLUMNS) * cell[0]), ylim=(-(TOP + ROWS) * cell[1], -TOP * cell[1]),
             xticks=[], yticks=[], aspect="equal")
    for spine in axes.spines.values():
        spine.set_visible(False)


def main():
    scarp, picture = sys.argv[1:]
    figure, all_axes = plt.subplots(1, 4, figsize=(16.6, 4.92), dpi=100)
    panes = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for effort, title in PANES:
            mesh, page = folder / f"{effort}.glb", folder / f"{effort}.json"
            subprocess.run([scarp, "simplify", DEM, mesh, "-e", ERROR, "--effort", effort, "--report", page, "-q"], check=True)
            report = json.loads(page.read_text())
            field = report["input"]
            panes.append((title, report["triangles"], 0.5, *read_mesh(mesh, field["cols"], field["rows"])))
        full = report["full_triangles"]
        panes.insert(0, ("Full grid", full, 0.3, *full_grid(folder)))
    for axes, (title, count, line, *mesh) in zip(all_axes, panes):
        draw(axes, (field["cell_x_m"], field["cell_y_m"]), *mesh, line)
        share = "" if count == full else f" · {100 * count / full:.1f} %"
        for y, size, weight, words in ((-0.03, 17, "bold", title), (-0.115, 15, "normal", f"{count:,} triangles{share}")):
            axes.text(0, y, words, transform=axes.transAxes, va="top", fontsize=size, fontweight=weight, color="#14181c")
    figure.subplots_adjust(left=0.004, right=0.996, top=1, bottom=0.13, wspace=0.025)
    pixels = io.BytesIO()
    figure.savefig(pixels, facecolor="white")
    Image.open(pixels).convert("RGB").quantize(COLOURS).save(picture, optimize=True)


main()
