"""Figures of Scape 1.2, the paper's own program, measured on its own five fields, in the order of the paper's sections.

The rows of the paper's results (section 5) are those of bench/quality/reference_rows.h.
"""
import pathlib
import re
from typing import NamedTuple

FIELDS = ("crater", "ashby", "ozark", "ntc", "westUS")  # in the paper's order
THREE = ("crater", "ashby", "westUS")  # fields of the selectors, the batches and the sweep of thresholds

# Section 3: RMS and max error at 1 % of the samples, on THREE.
SELECTORS = {
    "global error": ((7.08, 5.77, 16.9), (24.3, 20.5, 57.8)),
    "uniform sub-grid": ((12.9, 9.28, 32.1), (159, 102, 364)),
    "random points": ((21.5, 15.2, 42.8), (347, 291, 460)),
    "one pass, local error, 4 neighbours": ((66.2, 42.9, 134), (420, 339, 816)),
    "one pass, local error, 8 neighbours": ((75.3, 42.9, 141), (269, 151, 639)),
    "one pass, curvature": ((72.9, 50.3, 153), (420, 339, 816)),
    "global × local error": ((14.8, 9.33, 36.4), (93, 49, 217)),
    "global × (local error + 1)": ((12.8, 7.92, 33.4), (59, 44, 227)),
    "global × curvature": ((15.6, 9.51, 39.0), (93, 51, 227)),
    "global × (curvature + 1)": ((15.1, 8.89, 37.7), (70, 47, 227)),
    "global × √(curvature + 1)": ((10.7, 7.28, 24.9), (47, 32, 123)),
}

# Section 4, Algorithm III: samples scanned on westUS, in millions, by the number of vertices.
SCAN_FIELD = "westUS"
SCANS = {1049: 17.4, 10486: 25.5, 104858: 33.2, 524288: 39.3}
SCAN_SLOPE, SCAN_OFFSET = 3.3, -6.0  # samples scanned = n (slope · ln m + offset)
SWAPS = (24, 35)  # moves in the queue per vertex

# Section 4, parallel insertion, on THREE: vertices and passes needed to reach a max error.
BATCH_BOUNDS = (24.27, 17.0, 57.83)
BATCHES = {
    "sequential": ((1542, 1810, 10486), (1538, 1806, 10482)),
    "fraction 0.95": ((1841, 2269, 12544), (350, 429, 1257)),
    "fraction 0.9": ((2003, 2385, 13376), (214, 247, 692)),
    "fraction 0.7": ((2151, 2563, 15300), (68, 77, 132)),
    "fraction 0.5": ((2252, 2784, 16035), (37, 32, 54)),
    "constant = bound": ((2349, 2928, 16857), (16, 16, 21)),
}

BYTES_MEASURED, BYTES_COUNTED, BYTES_OF_PAPER = 600, 316, 192  # memory per vertex

# Section 4.4, data-dependent triangulation: samples scanned relative to Delaunay, and time.
DATA_SCANS, DATA_TIME = 2.1, (2.6, 3.2)
# RMS at 1 % of the samples on FIELDS.
EDGES = {
    "Delaunay": (7.08, 5.77, 3.27, 4.01, 16.86),
    "sum, q 0.5": (6.22, 5.30, 2.98, 3.61, 15.09),
    "squares, q 0.5": (6.42, 5.30, 3.14, 3.79, 15.49),
    "max, q 0.5": (6.66, 5.47, 3.26, 3.99, 15.96),
    "normals, q 0.5": (7.44, 6.36, 3.62, 4.69, 19.50),
    "sum, q 0": (8.32, 7.21, 4.78, 5.64, 22.53),
    "sum, q 1": (7.08, 5.71, 3.26, 4.09, 17.36),
}
# Percentage gain of the sum at threshold 0.5: RMS at 5 % of the samples, vertices at equal RMS.
GAIN_AT_5, FEWER = (11, 14), (13, 16)
# Percentage of triangles with an angle below 5 degrees: Delaunay, threshold 0.5, threshold 0.
THIN = ((0.2, 0.9), (0.7, 4.3), (40, 53))
# RMS of the sum at thresholds 0, 0.1, … 1, on THREE.
SWEEP = ((8.32, 7.04, 6.44, 6.26, 6.16, 6.22, 6.22, 6.42, 6.64, 6.85, 7.08),
         (7.21, 5.80, 5.43, 5.27, 5.13, 5.30, 5.17, 5.20, 5.33, 5.55, 5.71),
         (22.5, 17.9, 16.6, 15.6, 15.1, 15.1, 15.0, 15.0, 15.4, 16.0, 17.4))
# Max errors on synthetic fields of 256 × 256 at 200 vertices: Delaunay, sum at 0.5, sum at 0, normals at 0.
SYNTHETIC = {
    "parabola": (2.34, 0.91, 1.00, 0.89),
    "step": (14.4, 3.35, 2.63, 2.00),
    "sharp-step": (81.4, 49.0, 19.5, 3.00),
    "diagonal-step": (41.4, 1.20, 0.83, 2.50),
    "sharp-diagonal-step": (163, 0.98, 0.92, 2.79),
    "cliff": (967, 965, 965, 963),
    "paraboloid": (256, 256, 256, 1088),
}
# Vertices that reproduce the pyramids exactly, by the same rules.
PYRAMIDS = ("9", "9", "9", "11 to 12")

# Section 5: the max error of crater is not monotone in the vertices.
SPIKES = {5000: 9.5, 7711: 6.45, 10000: 19.18, 15422: 4}
# The same greedy insertion by other programs: field, vertices, program, max error, RMS.
OTHER_PROGRAMS = (("crater", 1542, "Scape 1.2", 24.26, 7.078),
                  ("crater", 1542, "Terra 0.7", 24.25, 7.058),
                  ("crater", 1542, "delatin", 30.47, 7.067),
                  ("westUS", 10486, "Scape 1.2", 57.83, 16.858),
                  ("westUS", 10486, "delatin", 57.79, 16.851))
SECONDS_OF_1995 = 21  # not verified: for 1 % of 1024 × 1024 samples


class Row(NamedTuple):
    field: str
    vertices: int
    triangles: int
    max_error: float
    rmse: float
    seconds: float  # scan and insertions, on one core of a cloud Xeon


def reference_rows():
    """The rows of section 5, requirements for the engine."""
    header = (pathlib.Path(__file__).resolve().parent.parent / "quality/reference_rows.h").read_text()
    row = re.compile(r'\{"(\w+)", (\d+), (\d+), ([\d.]+), ([\d.]+), ([\d.]+)\}')
    return [Row(field, int(vertices), int(triangles), *map(float, rest)) for field, vertices, triangles, *rest in row.findall(header)]
