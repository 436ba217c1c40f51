"""Terrain with its aerial photograph, and colour images, against uniform grids with the same number of vertices."""
import math

import numpy
from edges import SUM, rule
from page import change_in_percent, number, with_sign
from PIL import Image
from plots import Plot, draw_images, middle
from program import uniform_grid

HEIGHTS, PHOTOGRAPH, PICTURE_SIDE = "santa_barbara_elev.tif", "santa_barbara_aerial.tif", 224
EMPHASES = {"heights alone": 0, "both, emphasis 0.02": 0.02, "both, emphasis 0.1": 0.1, "both, emphasis 0.5": 0.5,
            "colours alone": 1}
MOVED_EMPHASIS, MOVED_RELIEFS = 0.1, 10  # the other table: the emphasis, and the offset of all heights in reliefs
# The paper used the mandrill; these are free.
IMAGES = {"astronaut.png": "astronaut: NASA, public domain", "kodim05.png": "Kodak 05, released for unrestricted use",
          "kodim23.png": "Kodak 23, released for unrestricted use"}
SHORTER_SIDE, IMAGE_VERTICES = 200, 400
DELAUNAY, SETTLED, NORMALS = "greedy, Delaunay", "greedy, data-dependent (sum, q 0.5)", "greedy, angles of normals (q 0.5)"
SQUARES = "high effort, least squared error"
TREATMENTS = {DELAUNAY: ("--order", "greedy"), SETTLED: ("--order", "greedy", *SUM), NORMALS: ("--order", "greedy", *rule("abn", 0.5)),
              SQUARES: ("--objective", "rms", "--effort", "high")}


def read_image(path):
    return numpy.asarray(Image.open(path).convert("RGB"))


def find_psnr(pixels, others):
    return 10 * math.log10(255 ** 2 / numpy.mean((pixels.astype(float) - others) ** 2))


class Texture:
    """A photograph over heights on the same grid, without georeference, in the scratch folder."""

    def __init__(self, study, heights, photo, name):
        self.study, self.photo = study, photo
        self.path = study.program.folder / f"{name}_photo.tif"
        Image.fromarray(photo).save(self.path)
        Image.fromarray(heights).save(study.program.folder / f"{name}.tif")
        self.field = study.program.field(name, study.program.folder / f"{name}.tif")

    def paint(self, emphasis, size, points=None):
        """A run, its picture and its PSNR.

        The error is (1 − w) |dz| + w · size / 3 · (|dr| + |dg| + |db|), with colours from 0 to 1. If bands
        have equal weights, the program gives the range of each band the weight of the relief.
        """
        ranges = (self.photo.max((0, 1)).astype(int) - self.photo.min((0, 1))).tolist()
        weight = 1
        if emphasis < 1:
            share = emphasis / (1 - emphasis) * size / self.field.relief * sum(ranges) / (3 * 255)
            weight = share / (1 + share)
        render = self.study.program.folder / f"{self.field.key}_{emphasis}_{size}.png"  # kept, like the run
        options = ("--texture", f"{self.path},weight={weight!r}", "--norm", f"weights={','.join(map(str, ranges))}", "--render", render)
        if points:
            run = self.study.program.through_points(self.field, points, *options)
        else:
            run = self.study.program.exactly(self.field, self.field.samples // 20, *options)
        picture = read_image(render)
        return run, picture, find_psnr(self.photo, picture)


def add_textured_terrain(study):
    if not (study.data / HEIGHTS).is_file() or not (study.data / PHOTOGRAPH).is_file():
        return
    heights, photo = numpy.asarray(Image.open(study.data / HEIGHTS)), read_image(study.data / PHOTOGRAPH)
    terrain = Texture(study, heights, photo, "terrain")
    field = terrain.field
    points, wide, high = uniform_grid(field.cols, field.rows, field.samples // 20)
    study.note("textured terrain")
    painted = {f"uniform grid, {wide} × {high}": terrain.paint(0, field.relief, points)}
    painted.update({name: terrain.paint(emphasis, field.relief) for name, emphasis in EMPHASES.items()})
    study.page.heading(2, "Textured terrain")
    study.page.paragraph(
        "Santa Barbara, 512 × 512 heights and an aerial photograph on the same grid; 5 % of the samples. The error is (1 − w) |dz| + "
        "w · relief / 3 · (|dr| + |dg| + |db|), colours from 0 to 1. For the relief Scape uses the highest height, Scarp highest "
        "minus lowest. The paper gives no figures.")
    study.page.table(["vertices by", "vertices", "RMS of heights", "max", "PSNR of colours"],
                     [[name, run.vertices, number(run.rmse), number(run.max_error), f"{psnr:.2f} dB"]
                      for name, (run, _, psnr) in painted.items()])
    name = "both, emphasis 0.02"
    alone, both = painted["heights alone"], painted[name]
    draw_images(study.picture("textured", "The middle of the photograph, of the mesh for heights alone, and of the mesh for both (NASA "
                                          "WorldWind sample data, USGS)"),
                [middle(picture, PICTURE_SIDE) for picture in (photo, alone[1], both[1])])
    study.page.list([f"Heights and colours in one run ({name}) against heights alone: PSNR {with_sign(both[2] - alone[2], 2)} dB, RMS of "
                     f"heights {change_in_percent(both[0].rmse, alone[0].rmse)}. Its vertices lie on edges of colour that heights "
                     "alone would not find."])
    add_moved_heights(study, terrain, heights, photo)


def add_moved_heights(study, terrain, heights, photo):
    """The effect of both definitions of colour weight on the same terrain with another zero of heights."""
    relief = terrain.field.relief
    moved = Texture(study, heights + numpy.float32(MOVED_RELIEFS * relief), photo, "moved")
    up, rows = f", all heights {number(MOVED_RELIEFS * relief)} higher", []
    for name, texture, size in (("Scape's: the highest height", terrain, terrain.field.high),
                                (f"Scape's{up}", moved, moved.field.high),
                                ("Scarp's: highest minus lowest", terrain, relief), (f"Scarp's{up}", moved, relief)):
        run, _, psnr = texture.paint(MOVED_EMPHASIS, size)
        rows.append([name, number(size), number(run.rmse), number(run.max_error), f"{psnr:.2f} dB"])
    study.page.paragraph(f"Both definitions of the relief: emphasis {MOVED_EMPHASIS:g}, the heights as they are and counted from "
                         "elsewhere.")
    study.page.table(["size of the heights", "is", "RMS of heights", "max", "PSNR of colours"], rows)
    study.page.list(["By Scape's definition land that lies higher gets other vertices, as if the emphasis were greater; by Scarp's only "
                     "the last bits of 32-bit heights change."])


def resize(pixels, cols, rows):
    """The image at a smaller size: each new pixel is the mean of the covered ones, in integers."""
    def shares(count, new_count):
        edges, old = numpy.arange(new_count + 1) * count / new_count, numpy.arange(count)
        covered = numpy.minimum(edges[1:, None], old + 1) - numpy.maximum(edges[:-1, None], old)
        return numpy.maximum(covered, 0) * new_count / count

    by_rows, by_cols = shares(pixels.shape[0], rows), shares(pixels.shape[1], cols)
    mixed = numpy.einsum("yr,rcb,xc->yxb", by_rows, pixels.astype(float), by_cols, optimize=True)
    return numpy.floor(mixed + 0.5).astype(numpy.uint8)


class Subject:
    """A small image over a flat field."""

    def __init__(self, study, path):
        pixels = read_image(path)
        rows, cols = pixels.shape[:2]
        scale = SHORTER_SIDE / min(rows, cols)
        self.name, self.study, self.folder = path.name, study, study.program.folder
        self.pixels = resize(pixels, int(scale * cols + 0.5), int(scale * rows + 0.5))
        Image.fromarray(self.pixels).save(self.folder / "image.png")

    def grid(self, vertices):
        return uniform_grid(self.pixels.shape[1], self.pixels.shape[0], vertices)

    def paint(self, vertices, options):
        """Vertices of the mesh, its picture and its PSNR."""
        render = self.folder / "render.png"
        run = self.study.program.simplify(self.folder / "image.png", "--image", "--norm", "l1", "-p", vertices, "--render", render,
                                          *options)
        picture = read_image(render)
        return run.vertices, picture, find_psnr(self.pixels, picture)

    def paint_uniform(self, points):
        script = self.folder / "points.txt"
        script.write_text("".join(f"s {col} {row}\n" for col, row in points))
        return self.paint(len(points), ("--order", "greedy", "--script", script))


def compare_treatments(subject):
    """Rows of the table, the pictures, and names of greedy rows that are worse than the grid."""
    points, wide, high = subject.grid(IMAGE_VERTICES)
    vertices, picture, of_grid = subject.paint_uniform(points)
    rows = [[subject.name, f"uniform grid, {wide} × {high}", vertices, f"{of_grid:.2f} dB"]]
    pictures, worse = [subject.pixels, picture], []
    for name, options in TREATMENTS.items():
        vertices, picture, psnr = subject.paint(len(points), options)
        rows.append(["", name, vertices, f"{psnr:.2f} dB", f"{with_sign(psnr - of_grid, 2)} dB"])
        if name != NORMALS:
            pictures.append(picture)
            worse += [name] if psnr <= of_grid else []
    return rows, [middle(picture, SHORTER_SIDE) for picture in pictures], worse


def trace(subject, colour, plot):
    """PSNR against vertices, and the number from which greedy insertion beats the grid, if any."""
    curves, vertices = {"squares": [], "greedy": [], "uniform": []}, 100
    overtakes = None
    while vertices <= (100 if subject.study.is_fast else subject.pixels.shape[0] * subject.pixels.shape[1] / 3):
        subject.study.note(f"images: {subject.name}, {vertices} vertices")
        points = subject.grid(vertices)[0]
        for name, painted in (("squares", subject.paint(len(points), TREATMENTS[SQUARES])),
                              ("greedy", subject.paint(len(points), TREATMENTS[SETTLED])), ("uniform", subject.paint_uniform(points))):
            curves[name].append((len(points), painted[2]))
        is_better = curves["greedy"][-1][1] > curves["uniform"][-1][1]
        overtakes = (overtakes or len(points)) if is_better else None
        vertices *= 2
    for (name, points), style in zip(curves.items(), ("line", "both", "dashes")):
        plot.curve(points, style, colour, subject.name + ("" if name == "greedy" else f", {name}"))
    return overtakes


def add_images(study):
    rows, pictures, worse, remarks = [], {}, [], []
    plot = Plot("Colour images: PSNR against vertices, least squares, greedy, uniform", "vertices", "PSNR, dB", key="upper left")
    for colour, name in enumerate(name for name in IMAGES if (study.data / name).is_file()):
        subject = Subject(study, study.data / name)
        new_rows, pictures[name], new_worse = compare_treatments(subject)
        rows, worse = rows + new_rows, worse + new_worse
        overtakes = trace(subject, colour, plot)
        remarks.append(f"{name}: greedy insertion is better from {overtakes} vertices on." if overtakes else
                       f"{name}: the uniform grid has the better PSNR throughout.")
    if not rows:
        return
    study.page.heading(2, "Colour images")
    study.page.paragraph(
        "The paper shows the mandrill, which is not free, at 200 × 200 pixels with 400 vertices against a uniform grid (20 × 20). Here: "
        f"other images whose shorter side is reduced to {SHORTER_SIDE} pixels, red, green and blue as channels over a flat field, the "
        "error their sum, Gouraud shading. PSNR over all pixels and colours. A budget returns the best mesh near it.")
    study.page.table(["image", "mesh", "vertices", "PSNR", "against uniform"], rows)
    for name, parts in pictures.items():
        draw_images(study.picture(f"image_{name.split('.')[0]}", "The image's middle, uniform grid, greedy insertion with Delaunay and "
                                  f"data-dependent edges, least squared error ({IMAGES[name]})"), parts)
    study.plot("image_psnr", plot)
    study.page.list([
        "Greedy insertion is not better than the uniform grid in every row. It follows the largest error, not the mean one of PSNR: "
        "vertices go to edges and highlights, whose colours then spread over large triangles." if worse else
        "Greedy insertion is better than the uniform grid on every image: its vertices go to the edges of things.",
        *remarks,
        "The last row of each image is not the paper's: `--objective rms --effort high` lowers the squared error itself. Vertices stay "
        "on pixels, with their colours.",
        "Angles of normals: Scape's ABN for colours, the sum of the angles of red, green and blue. It measures how smooth the picture is "
        "across an edge, not its error."])
