#!/usr/bin/env python3
"""Fits peak memory as bytes per sample, bytes per vertex and a constant, compares it with the limits, and writes
memory.md.

First the engine alone in both orders, one thread, from samples to the frozen mesh (speed_memory, minus its baseline).
Then, if the program is built, a whole `scarp simplify --effort fast` run from GeoTIFF to GLB (peak of the process minus
that of the same run on 16×16 samples).

  memory.py --bin build/bin
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from rasters import ERRORS, HERE, make_raw

sys.path.insert(0, str(HERE.parent))
from harness import arguments_of, markdown, measure_process, report_of  # noqa: E402

CASES = ("fuji", "essen_dom", "everest", "sierra_3601")
# Bytes per sample and per vertex.
ALLOWED = {"dominant": (4.25, 72), "greedy": (5, 120), "simplify": (5, 80)}


def fit(points):
    """Least squares of relative residuals: bytes = constant + a samples + b vertices."""
    rows = [(1 / size, samples / size, vertices / size, 1.0) for samples, vertices, size in points]
    # Normal equations, solved by elimination.
    matrix = [[sum(row[i] * row[j] for row in rows) for j in range(4)] for i in range(3)]
    for i in range(3):
        matrix[i] = [value / matrix[i][i] for value in matrix[i]]
        for k in range(3):
            if k != i:
                matrix[k] = [x - matrix[k][i] * y for x, y in zip(matrix[k], matrix[i])]
    return [row[3] for row in matrix]


def table(title, points, allowed):
    per_sample, per_vertex = allowed
    lines = [f"## {title}", "",
             *markdown(["raster", "samples", "vertices", "peak MB", f"bytes ÷ ({per_sample}·samples + {per_vertex}·vertices)"],
                       [[name, samples, vertices, f"{size / 1e6:.1f}", f"{size / (per_sample * samples + per_vertex * vertices):.2f}"]
                        for name, samples, vertices, size in points])]
    constant, a, b = fit([point[1:] for point in points])
    lines += ["", f"Fitted: **{a:.2f} bytes a sample + {b:.0f} bytes a vertex** {constant / 1e6:+.1f} MB.", ""]
    return lines


def main():
    options = arguments_of(__doc__).parse_args()
    program = options.bin / "scarp"
    engine, whole, baseline = {"dominant": [], "greedy": []}, [], None

    def simplify(raster, error):
        return measure_process([program, "simplify", raster, Path(scratch) / "mesh.glb", "-e", error, "--effort", "fast", "-q",
                                "--overwrite"])["peak"]

    with tempfile.TemporaryDirectory() as scratch:
        for name in CASES:
            raster = make_raw(name, scratch, options.bin)
            if raster is None:
                continue
            raw = raster[0]
            tif = Path(scratch) / f"{name}.tif"
            subprocess.run(["gdal_translate", "-q", "-co", "TILED=YES", raw, tif], check=True)
            if program.exists() and baseline is None:
                tiny = Path(scratch) / "tiny.tif"
                subprocess.run(["gdal_translate", "-q", "-srcwin", "0", "0", "16", "16", raw, tiny], check=True)
                baseline = simplify(tiny, 1)
            for error in (*ERRORS[name], ERRORS[name][-1] / 4):
                for order, rows in engine.items():
                    report = report_of([options.bin / "speed_memory", *raster, error, "--order", order])
                    rows.append((name, report["samples"], report["vertices"], report["bytes"]))
                    print(order, *rows[-1], flush=True)
                if program.exists():
                    whole.append((name, report["samples"], report["vertices"], simplify(tif, error) - baseline))
                    print("  simplify", *whole[-1], flush=True)
            tif.unlink()
            raw.unlink()
    lines = ["# Memory", "",
             "Written by `memory.py` (see `bench/README.md`). Peak resident memory, samples included, next to what is",
             "allowed. The engine: one thread, from samples to the frozen mesh in order; with N threads N tiles are at work.", ""]
    for order, rows in engine.items():
        lines += table(f"Engine, {order} order", rows, ALLOWED[order])
    if whole:
        lines += table("`scarp simplify --effort fast` from GeoTIFF to GLB", whole, ALLOWED["simplify"])
        lines[-1:] = [f"Less the program's own {baseline / 1e6:.1f} MB (a raster of 16 × 16 samples).", ""]
    (HERE / "memory.md").write_text("\n".join(lines).rstrip() + "\n")


if __name__ == "__main__":
    sys.exit(main())
