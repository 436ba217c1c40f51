"""Pictures: curves, meshes as surfaces, images side by side."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy
from matplotlib.collections import PolyCollection
from PIL import Image

COLOURS = ("#1f5fa8", "#d1611f", "#2d8a4e", "#a2318f", "#7a6a2a", "#555555", "#c02b3c", "#1798a3")
STYLES = {"line": {"lw": 1.6}, "points": {"ls": "", "marker": "o", "mfc": "none", "ms": 6, "mew": 1.4},
          "both": {"lw": 1.6, "marker": "o", "ms": 3}, "dashes": {"lw": 1.2, "ls": "--"}}
PNG = {"metadata": {"Software": None}}
TO_LIGHT = numpy.array([-0.64, 0.24, 0.73])  # right, away and up
AMBIENT, GROUND, INK = 0.24, 0.92, "#141414cc"


class Plot:
    def __init__(self, title, x_label, y_label, log_x=True, log_y=False, key="best"):
        self.title, self.key = title, key
        self.figure, self.axes = plt.subplots(figsize=(9, 5.4), dpi=100)
        self.axes.set(title=title, xlabel=x_label, ylabel=y_label, xscale="log" if log_x else "linear",
                      yscale="log" if log_y else "linear")
        self.axes.grid(color="#dddddd")
        self.axes.spines[["top", "right"]].set_visible(False)

    def curve(self, points, style, colour, title=None):
        """Points are (x, y); curves of one colour belong together."""
        if points:
            self.axes.plot(*zip(*points), color=COLOURS[colour % len(COLOURS)], label=title, **STYLES[style])

    def save(self, path):
        self.axes.legend(loc=self.key, frameon=False)
        self.figure.tight_layout()
        self.figure.savefig(path, **PNG)
        plt.close(self.figure)


def full_mesh(heights):
    """Positions and triangles of the full grid: two triangles a cell."""
    rows, cols = heights.shape
    col, row = numpy.meshgrid(numpy.arange(cols), numpy.arange(rows))
    at = numpy.arange(rows * cols).reshape(rows, cols)
    a, b, c, d = at[:-1, :-1].ravel(), at[:-1, 1:].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel()
    positions = numpy.stack([col, rows - 1 - row, heights], 2).reshape(-1, 3).astype(float)
    return positions, numpy.concatenate([numpy.stack([a, c, b], 1), numpy.stack([b, c, d], 1)])


def draw_surfaces(path, heights, meshes, turn=(0.8, 0.6), up=(0.8, 0.6), relief=0.2, lines=()):
    """Meshes side by side in parallel projection, lit from the upper left.

    turn, up: cosine and sine of the surface's rotation and the eye's elevation; up = (0, 1) draws a map. relief: height
    of the field's relief relative to its longer side. lines: width of each mesh's edges in pixels; 0 for none. All
    meshes have the place and scale of the field.
    """
    rows, cols = heights.shape
    z_scale = relief * (max(rows, cols) - 1) / (heights.max() - heights.min())
    turning = numpy.array([[turn[0], -turn[1], 0], [turn[1], turn[0], 0], [0, 0, z_scale]])

    def project(positions):
        turned = positions @ turning.T
        return turned, numpy.stack([turned[:, 0], up[1] * turned[:, 1] + up[0] * turned[:, 2]], 1)

    low, high = (extreme(project(full_mesh(heights)[0])[1], 0) for extreme in (numpy.min, numpy.max))
    width, height = high - low
    figure, panels = plt.subplots(1, len(meshes), figsize=(9, 9 / len(meshes) * height / width + 0.1), dpi=100)
    for axes, (positions, triangles), line in zip(panels, meshes, lines):
        turned, seen = project(positions)
        corners = turned[triangles]
        normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        light = numpy.maximum(0, normals @ TO_LIGHT) / numpy.linalg.norm(normals, axis=1)
        greys = GROUND * (AMBIENT + (1 - AMBIENT) * light)
        order = numpy.argsort(-corners[:, :, 1].sum(1), kind="stable")  # the farthest first
        colours = numpy.repeat(numpy.minimum(greys[order], 1)[:, None], 3, 1)
        axes.add_collection(PolyCollection(seen[triangles][order], facecolors=colours, antialiased=line > 0,
                                           edgecolors=INK if line else colours, linewidths=0.72 * (line or 0.3)))
        margin = 0.01 * width
        axes.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin), aspect="equal")
        axes.axis("off")
    figure.subplots_adjust(0, 0, 1, 1, 0.02)
    figure.canvas.draw()
    save_few_colours(path, numpy.asarray(figure.canvas.buffer_rgba())[:, :, :3])
    plt.close(figure)


def save_few_colours(path, pixels):
    """Five bits per colour, for a small file."""
    pixels = (pixels >> 3).astype(int) * 255 // 31
    Image.fromarray(pixels.astype(numpy.uint8)).save(path, optimize=True)


def middle(pixels, side):
    top, left = ((size - min(size, side)) // 2 for size in pixels.shape[:2])
    return pixels[top:top + side, left:left + side]


def draw_images(path, pictures):
    """Side by side, with the same height."""
    gap = numpy.full((pictures[0].shape[0], 4, 3), 255, numpy.uint8)
    strips = [part for picture in pictures for part in (picture, gap)][:-1]
    save_few_colours(path, numpy.concatenate(strips, 1))
