#!/usr/bin/env python3
"""Counts differences, normals included, between decoded edges of neighbouring tiles on all kinds of terrain.

  borders.py SCARP DATA     SCARP: the program; DATA: the open set of rasters. Writes borders.csv.

`scarp tile check` decodes all tiles and compares both sides of each edge, and all tiles at each corner; it shares no
code with their encoder. Exit code 1 if any differs. Needs gdal-bin."""

import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from harness import write_table  # noqa: E402

# land, raster, options
LAND = [
    ("steep", "N27E086.hgt", ["--vertical", "egm96", "--te", "86.6", "27.7", "87", "28", "--zoom", "12"]),
    ("steep, nodata", "rainier_srtm_voids.tif", ["--vertical", "egm96"]),
    ("nodata all over", "wahoo_swath_nan.tif", ["--vertical", "none"]),
    ("flat, lidar", "gabilan_lidar_1m.tif", ["--vertical", "none"]),
    ("urban, lidar", "athens_dsm_1m.tif", ["--vertical", "none"]),
    ("coast", "cape_town_srtm_sea_nodata.tif", ["--vertical", "egm96"]),
    ("polar", "antarctica_bedmap.tif", ["--vertical", "none"]),
    ("across 180°", "srtm3_sierra_nevada_basin_range.tif", ["--vertical", "none"]),
]


def place_across_180(raster, scratch):
    """The raster with its middle on the antimeridian."""
    moved = scratch / "across_180.tif"
    subprocess.run(["gdal_translate", "-q", "-a_ullr", "178", "40", "182", "36", raster, moved], check=True)
    return moved


def count_edges(program, raster, options, kind, scratch):
    tiles = scratch / "set"
    made = subprocess.run([program, "tile", raster, tiles, "--of", kind, "--effort", "fast", *options, "--overwrite", "-q"], text=True, capture_output=True)
    if made.returncode != 0:
        sys.exit(f"{raster}: {made.stderr}")
    checked = subprocess.run([program, "tile", "check", tiles, "--json"], text=True, capture_output=True)
    return json.loads(checked.stdout)


def main():
    program, data = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    rows = []
    for land, name, options in LAND:
        for kind in ("qm", "3dtiles"):
            with tempfile.TemporaryDirectory() as folder:
                scratch = pathlib.Path(folder)
                raster = place_across_180(data / name, scratch) if land == "across 180°" else data / name
                check = count_edges(program, raster, options, kind, scratch)
            rows.append({"land": land, "raster": name, "format": kind,
                         **{key: check[key] for key in ("tiles", "edges", "edges_apart", "corners", "corners_apart")},
                         "other_faults": sum(check["faults"].values()) - check["faults"]["border"]})
            print(*rows[-1].values(), sep="  ", flush=True)
    write_table(HERE / "borders.csv", rows)
    edges, apart = (sum(row[key] for row in rows) for key in ("edges", "edges_apart"))
    print(f"{edges:,} shared edges, {apart:,} differ")
    sys.exit(apart + sum(row["corners_apart"] + row["other_faults"] for row in rows) > 0)


main()
