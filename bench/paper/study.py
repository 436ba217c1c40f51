"""Common parts of the experiments: the fields, the page that they write on, and Scape's figures for a field."""
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
    """`data` is the folder with the paper's fields; nothing: small fields stand for them, which Scape's figures are not
    of."""

    def __init__(self, program, out, data):
        self.program, self.data, self.is_fast = program, pathlib.Path(data or "."), data is None
        self.page, self.has_figures = Page(), not self.is_fast
        self.images = pathlib.Path(out) / "images" / "paper"
        self.images.mkdir(parents=True, exist_ok=True)
        if self.is_fast:
            self.fields = [program.generate("fractal", FAST_SIDE, FAST_SIDE, "--seed", seed, key=key, name=f"{key}.tif")
                           for seed, key in enumerate(figures.FIELDS)]
        else:
            paths = {key: find_file(self.data, key) for key in figures.FIELDS}
            missing = [key for key, path in paths.items() if path is None]
            if missing:
                raise SystemExit(f"{self.data} has no field {', '.join(missing)}: DATA names the folder with the paper's fields")
            self.fields = [program.field(key, path) for key, path in paths.items()]

    def note(self, what):
        print("paper:", what, file=sys.stderr, flush=True)

    def choose(self, keys):
        return [field for field in self.fields if field.key in keys]

    def figure(self, figures_of_keys, keys, field):
        """Scape's figure for a field, if there is one."""
        if not self.has_figures or figures_of_keys is None or field.key not in keys:
            return None
        return figures_of_keys[keys.index(field.key)]

    def delaunay(self, field, vertices):
        return self.program.exactly(field, vertices)

    def picture(self, name, caption):
        """Adds a picture to the page; the file that is to hold it."""
        self.page.picture(f"images/paper/{name}.png", caption)
        return self.images / f"{name}.png"

    def plot(self, name, plot):
        plot.save(self.picture(name, plot.title))
