"""The rasters of bench/speed, all without voids, their errors, and their conversion to raw float32 files."""

import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
SHARED = Path(os.environ.get("SCARP_SHARED", PROJECT.parent / "shared")) / "data"

# name: (file, window of gdal_translate -srcwin or None); FRACTAL: made by `scarp generate`
FRACTAL = "fractal"
RASTERS = {
    "jacksboro": ("jacksboro_fault.tif", None),
    "fuji": ("fuji.tif", None),
    "crater": ("crater.tif", None),
    "puget_1k": ("puget_sound_1k.tif", None),
    "baltoro": ("baltoro_srtm.tif", None),
    "essen_dom": ("nrw_dom1_essen.tif", None),
    "everest": ("N27E086.hgt", None),
    "sierra_3601": ("srtm3_sierra_nevada_basin_range.tif", (3600, 0, 3601, 3601)),
    "moon_4096": ("moon_gld100_caucasus_4096.tif", None),
    "fractal_4096": (FRACTAL, (0, 0, 4096, 4096)),
    "sierra_mosaic": ("srtm3_sierra_nevada_basin_range.tif", None),
}

# The errors at which the greedy order keeps about these shares of the samples, from run.py --find, rounded to three
# digits. The small rasters omit the second.
SHARES = (0.001, 0.004, 0.01, 0.05)
ERRORS = {
    "jacksboro": (274, 92.4, 30),
    "fuji": (217, 49.9, 16.9),
    "crater": (107, 24.2, 6.46),
    "puget_1k": (589, 180, 66),
    "baltoro": (912, 220, 61),
    "essen_dom": (20.6, 11.1, 4.87),
    "everest": (659, 178, 60.1),
    "sierra_3601": (238, 119, 70.8, 23.6),
    "moon_4096": (112, 37.1, 18.4, 4.62),
    "fractal_4096": (13.9, 7.43, 4.81, 2.14),
    "sierra_mosaic": (216, 110, 66, 22.2),
}

# Larger rasters have fewer rounds and a shorter warm-up.
LARGE = 2_000_000


def find_file(name):
    """The project's copy of a raster, else the one next to the project, or None."""
    for folder in (PROJECT / "data", SHARED):
        if (folder / name).is_file():
            return folder / name
    return None


def generate_fractal(folder, side, program):
    """The fractal as a file in `folder`, or None if the program was not built."""
    path = Path(folder) / f"fractal_{side}.tif"
    if not program.exists():
        return None
    if not path.exists():
        subprocess.run([program, "generate", "fractal", str(side), str(side), path, "-q"], check=True)
    return path


def make_raw(name, folder, binaries):
    """(path, cols, rows) of the raw raster, made by gdal_translate, or None if its source is missing."""
    file, window = RASTERS[name]
    source = generate_fractal(folder, window[2], binaries / "scarp") if file == FRACTAL else find_file(file)
    if source is None:
        print(f"{name}: skipped, {file} is not there", file=sys.stderr)
        return None
    return to_raw(source, window, Path(folder) / f"{name}.f32")


def to_raw(source, window, raw):
    """(raw, cols, rows): the raster, or its window (first column, first row, cols, rows), written to `raw`."""
    command = ["gdal_translate", "-q", "-of", "ENVI", "-ot", "Float32"]
    if window:
        command += ["-srcwin", *map(str, window)]
    if not raw.exists():
        subprocess.run([*command, str(source), str(raw)], check=True)
    size = {}
    for line in raw.with_suffix(".hdr").read_text().splitlines():
        key, _, value = line.partition("=")
        if key.strip() in ("samples", "lines", "byte order"):
            size[key.strip()] = int(value)
    if size["byte order"] != (0 if sys.byteorder == "little" else 1):
        raise SystemExit(f"{raw} is not in this machine's byte order")
    return raw, size["samples"], size["lines"]
