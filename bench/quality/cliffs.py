#!/usr/bin/env python3
"""Triangles with and without --cliff at equal max error, to cliffs.csv.

    bench/quality/cliffs.py build/bin/scarp DATA [RASTER=H ...] > bench/quality/cliffs.csv

Rasters are read from DATA. Each mesh is judged by `scarp measure`; H is the height of a cliff.
"""
import json
import subprocess
import sys
import tempfile

RASTERS = {"athens_dsm_1m.tif": 3, "nrw_dom1_essen.tif": 3, "cuyuna_pits_lidar_1m.tif": 3}
ERRORS = (0.5, 1, 2)
EFFORTS = (["fast"], ["normal"], ["high"], ["high", "--min-shape", "0"])


def run(scarp, raster, error, effort, cliff, folder):
    report, mesh = f"{folder}/r.json", f"{folder}/m.glb"
    command = [scarp, "simplify", raster, mesh, "-e", str(error), "--effort", *effort, "--report", report, "--overwrite", "-q"]
    subprocess.run(command + (["--cliff", str(cliff)] if cliff else []), check=True)
    judged = subprocess.run([scarp, "measure", raster, mesh, "--fail-above", str(error), "--json"],
                            check=True, capture_output=True, text=True)
    told = json.load(open(report))
    return told["triangles"], json.loads(judged.stdout)["max_error"], (told["cliffs"] or {"walls": 0})["walls"]


def main():
    scarp, data = sys.argv[1:3]
    rasters = dict(word.split("=") for word in sys.argv[3:]) or RASTERS
    print("raster,cliff,error,effort,plain,cliffs,share,walls,plain_max,cliffs_max")
    with tempfile.TemporaryDirectory() as folder:
        for name, height in rasters.items():
            for error in ERRORS:
                for effort in EFFORTS:
                    plain = run(scarp, f"{data}/{name}", error, effort, None, folder)
                    walls = run(scarp, f"{data}/{name}", error, effort, height, folder)
                    print(name, height, error, " ".join(effort), plain[0], walls[0], f"{walls[0] / plain[0]:.3f}", walls[2],
                          f"{plain[1]:.6g}", f"{walls[1]:.6g}", sep=",", flush=True)


main()
