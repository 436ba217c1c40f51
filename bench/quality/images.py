#!/usr/bin/env python3
"""Max error and PSNR of images as meshes of at most 4000 vertices, compared with a uniform grid of the same size, to
images.csv.

    bench/quality/images.py build/bin/scarp DATA [IMAGE...] > bench/quality/images.csv

Images are read from DATA. PSNR, over all bands, is of the picture that Scarp renders of its mesh. The grid's vertices
are samples, its cells are two triangles each, and its values are rounded. Max error is the largest difference of a
band.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy

IMAGES = ("kodim23.png", "astronaut.png", "kodim05.png")
VERTICES = 4000
VARIANTS = {"fast": ["--effort", "fast"], "normal": ["--effort", "normal"], "high": ["--effort", "high"],
            "normal rms": ["--effort", "normal", "--objective", "rms"]}


def read_bands(path, folder):
    """Three bands of integers from 0 to 255: (3, rows, cols)."""
    raw = Path(folder) / "bands.raw"
    subprocess.run(["gdal_translate", "-q", "-of", "ENVI", "-co", "INTERLEAVE=BSQ", "-b", "1", "-b", "2", "-b", "3",
                    str(path), str(raw)], check=True)
    size = json.loads(subprocess.run(["gdalinfo", "-json", str(path)], check=True, capture_output=True).stdout)["size"]
    return numpy.fromfile(raw, numpy.uint8).reshape(3, size[1], size[0]).astype(int)


def uniform_grid(bands, most):
    """The picture of a uniform grid and its vertices: the widest grid with at most `most` in the image's shape."""
    _, rows, cols = bands.shape
    wide = int((most * cols / rows) ** 0.5)
    high = most // wide
    at_col = numpy.round(numpy.linspace(0, cols - 1, wide)).astype(int)
    at_row = numpy.round(numpy.linspace(0, rows - 1, high)).astype(int)
    i = numpy.clip(numpy.searchsorted(at_col, numpy.arange(cols), "right") - 1, 0, wide - 2)
    j = numpy.clip(numpy.searchsorted(at_row, numpy.arange(rows), "right") - 1, 0, high - 2)
    u = ((numpy.arange(cols) - at_col[i]) / (at_col[i + 1] - at_col[i]))[None, :]
    v = ((numpy.arange(rows) - at_row[j]) / (at_row[j + 1] - at_row[j]))[:, None]
    corner = bands[:, at_row][:, :, at_col]
    nw, ne = corner[:, j][:, :, i], corner[:, j][:, :, i + 1]
    sw, se = corner[:, j + 1][:, :, i], corner[:, j + 1][:, :, i + 1]
    above = nw + u * (ne - nw) + v * (se - ne)  # the triangle of nw, ne, se
    below = nw + v * (sw - nw) + u * (se - sw)
    return numpy.round(numpy.where(u >= v, above, below)).astype(int), wide * high


def row_of(image, variant, vertices, picture, bands):
    error = picture - bands
    psnr = 10 * numpy.log10(255 ** 2 / numpy.mean(error ** 2))
    print(image, variant, vertices, numpy.abs(error).max(), f"{psnr:.2f}", sep=",", flush=True)


def main():
    scarp, data = sys.argv[1:3]
    print("image,variant,vertices,max_error,psnr")
    with tempfile.TemporaryDirectory() as folder:
        for image in sys.argv[3:] or IMAGES:
            bands = read_bands(f"{data}/{image}", folder)
            for variant, effort in VARIANTS.items():
                picture, report = f"{folder}/picture.png", f"{folder}/report.json"
                subprocess.run([scarp, "simplify", f"{data}/{image}", f"{folder}/mesh.glb", "--image", "-p", str(VERTICES),
                                *effort, "--render", picture, "--report", report, "--overwrite", "-q"], check=True)
                row_of(image, variant, json.load(open(report))["vertices"], read_bands(picture, folder), bands)
            picture, vertices = uniform_grid(bands, VERTICES)
            row_of(image, "uniform grid", vertices, picture, bands)


main()
