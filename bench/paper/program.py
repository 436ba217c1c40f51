"""The scarp program for the experiments: runs with reports, their meshes, and fields."""
import functools
import json
import pathlib
import subprocess
from dataclasses import dataclass

import numpy
from PIL import Image

THIN_DEGREES = 5
# At a budget a run returns the best mesh of its last 5 % of vertices. Only products with a feature of the raster always
# return the last mesh, like Scape. Heights this small have features that vanish next to 1, so the product equals the
# error; a power of two changes no digit.
SMALL = 2.0 ** -100
EXACT = ("--z-scale", repr(SMALL), "--importance", "global*(local+1)")


@dataclass
class Mesh:
    positions: numpy.ndarray  # vertices × 3: column, row from below, height
    triangles: numpy.ndarray  # triangles × 3
    content: bytes  # the file without its header

    def thin_share(self):
        """Percentage of triangles with an angle below 5 degrees, seen from above."""
        corners = self.positions[self.triangles][:, :, :2].astype(float)
        to_next, to_last = numpy.roll(corners, -1, 1) - corners, numpy.roll(corners, 1, 1) - corners
        cross = numpy.abs(to_next[..., 0] * to_last[..., 1] - to_next[..., 1] * to_last[..., 0])
        angles = numpy.degrees(numpy.arctan2(cross, (to_next * to_last).sum(2)))
        return 100 * (angles.min(1) < THIN_DEGREES).mean()


@dataclass
class Run:
    report: dict
    mesh: Mesh
    scale: float = 1  # ratio of the heights to those of the field

    def __post_init__(self):
        self.vertices, self.triangles = self.report["vertices"], self.report["triangles"]
        if "rmse" in self.report:  # errors of heights, which an image lacks
            self.max_error, self.rmse = self.report["max_error"] / self.scale, self.report["rmse"] / self.scale
        self.work, self.seconds = self.report["work"], self.report["seconds"]["refine"]
        if self.mesh is not None and self.scale != 1:
            self.mesh.positions = self.mesh.positions / numpy.float32([1, 1, self.scale])


@dataclass(frozen=True)
class Field:
    key: str
    path: str
    cols: int
    rows: int
    low: float
    high: float

    @property
    def samples(self):
        return self.cols * self.rows

    @property
    def relief(self):
        return self.high - self.low

    def share(self, percent, least=0):
        """The rounded percentage of the samples: the paper's numbers of vertices."""
        return max(int(percent / 100 * self.samples + 0.5), least)

    def heights(self):
        """Rows × columns."""
        if not self.path.endswith(".stm"):
            return numpy.asarray(Image.open(self.path), dtype=float)
        samples = pathlib.Path(self.path).read_bytes()[-2 * self.samples:]
        return numpy.frombuffer(samples, ">u2").reshape(self.rows, self.cols).astype(float)


def read_mesh(path):
    """Reads a binary PLY of the program."""
    header, content = pathlib.Path(path).read_bytes().split(b"end_header\n", 1)
    words, is_vertex, properties = header.decode().split("\n"), False, []
    counts = {line.split()[1]: int(line.split()[2]) for line in words if line.startswith("element ")}
    for line in words:
        if line.startswith("element "):
            is_vertex = line.startswith("element vertex")
        elif line.startswith("property ") and is_vertex:
            properties.append((line.split()[2], {"float": "<f4", "double": "<f8", "uchar": "u1"}[line.split()[1]]))
    vertices = numpy.frombuffer(content, properties, counts["vertex"])
    faces = numpy.frombuffer(content, [("n", "u1"), ("v", "<u4", 3)], counts["face"], vertices.nbytes)
    return Mesh(numpy.stack([vertices[axis] for axis in "xyz"], 1).astype(float), faces["v"].astype(int), content)


class Program:
    """Runs the program in a scratch folder."""

    def __init__(self, path, folder):
        self.path, self.folder = str(path), pathlib.Path(folder)

    def call(self, *words):
        done = subprocess.run([self.path, *map(str, words)], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{self.path} {' '.join(map(str, words))}: {done.stderr.strip()}")
        return done.stdout

    def field(self, key, path):
        raster = json.loads(self.call("info", path, "--no-suggest", "--json"))["input"]
        return Field(key, str(path), raster["cols"], raster["rows"], raster["min"], raster["max"])

    def generate(self, style, cols, rows, *options, name=None):
        path = self.folder / (name or f"{style}.tif")
        self.call("generate", style, cols, rows, path, "--overwrite", *options)
        return self.field(style, path)

    def simplify(self, raster, *options, mesh=False, scale=1):
        """One run on one thread. `mesh`: also reads the mesh."""
        ply, report = self.folder / "mesh.ply", self.folder / "report.json"
        self.call("classic", raster, ply, "--crs", "grid", "--report", report, "--overwrite", "-q", "-j", 1, *options)
        return Run(json.loads(report.read_text()), read_mesh(ply) if mesh else None, scale)

    def greedy(self, field, *options, mesh=False):
        """Greedy insertion, modified by the options."""
        return self.simplify(field.path, "--order", "greedy", *options, mesh=mesh)

    @functools.lru_cache(maxsize=None)
    def exactly(self, field, vertices, *options, mesh=False):
        """Greedy insertion up to exactly so many vertices."""
        vertices = max(vertices, 4)
        run = self.greedy(field, "-p", vertices, *options, mesh=mesh)
        # The angle of normals depends on the size of heights: there the best mesh near the budget must suffice.
        if run.vertices == vertices or run.report["stopped_by"] != "max_points" or "abn" in options:
            return run
        return self.simplify(field.path, "-p", vertices, *EXACT, *options, mesh=mesh, scale=SMALL)

    def through_points(self, field, points, *options, mesh=False):
        """The mesh of these samples, (column, row) each."""
        script = self.folder / "points.txt"
        script.write_text("".join(f"s {col} {row}\n" for col, row in points))
        return self.greedy(field, "-p", len(points), "--script", script, *options, mesh=mesh)


def uniform_grid(cols, rows, vertices):
    """Evenly spaced samples, borders included: about so many, with the numbers of columns and rows."""
    wide = min(max(int((vertices * cols / rows) ** 0.5 + 0.5), 2), cols)
    high = min(max(int(vertices / wide + 0.5), 2), rows)
    at_col = [(2 * i * (cols - 1) + wide - 1) // (2 * (wide - 1)) for i in range(wide)]
    at_row = [(2 * j * (rows - 1) + high - 1) // (2 * (high - 1)) for j in range(high)]
    return [(col, row) for row in at_row for col in at_col], wide, high
