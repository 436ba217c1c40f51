"""Common parts of the experiments: the fields, the page, and Scape's figures for a field."""
import pathlib
import sys

import figures
from page import Page

EXTENSIONS = ("stm", "pgm", "tif", "asc", "dem", "hgt")
FAST_SIDE = 60


def find_file(folder, key):
    names = [f"{prefix}{key}.{extension}" for extension in EXTENSIONS for prefix in ("scape_", "")]
    return next((path for path in (pathlib.Path(folder) / name for name in names) if path.is_file()), None)


class Study:
    """`data` is the folder of the paper's fields; None: small generated fields without figures."""

    def __init__(self, program, out, data):
        self.program, self.data, self.is_fast, self.page = program, pathlib.Path(data or "."), not data, Page()
        paths = {key: find_file(self.data, key) if data else program.generate(
            "fractal", FAST_SIDE, FAST_SIDE, "--seed", seed, name=f"{key}.tif").path
                 for seed, key in enumerate(figures.FIELDS)}
        missing = [key for key, path in paths.items() if path is None]
        if missing:
            sys.exit(f"{data} has no field {', '.join(missing)}: DATA names the folder with the paper's fields")
        self.fields = [program.field(key, path) for key, path in paths.items()]
        self.images = pathlib.Path(out) / "images" / "paper"
        self.images.mkdir(parents=True, exist_ok=True)

    def note(self, what):
        print("paper:", what, file=sys.stderr, flush=True)

    def choose(self, keys):
        return [field for field in self.fields if field.key in keys]

    def find(self, key):
        return next(field for field in self.fields if field.key == key)

    def figure(self, figures_of_keys, keys, field):
        """Scape's figure for a field, or None."""
        return figures_of_keys and figures_of_keys[keys.index(field.key)]

    def delaunay(self, field, vertices):
        return self.program.exactly(field, vertices)

    def picture(self, name, caption):
        """Adds a picture to the page and returns the path of its file."""
        self.page.picture(f"images/paper/{name}.png", caption)
        return self.images / f"{name}.png"

    def plot(self, name, plot):
        plot.save(self.picture(name, plot.title))
