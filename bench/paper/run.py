#!/usr/bin/env python3
"""Repeats the experiments of the 1995 paper with the scarp program, and writes a page with pictures.

usage: bench/paper/run.py SCARP DATA OUT     the paper's fields in DATA: writes OUT/paper.md and OUT/images/paper
       bench/paper/run.py SCARP --fast OUT   small generated fields, and images of this folder: for a test

SCARP is the program. DATA contains crater, ashby, ozark, ntc and westUS as .stm, .pgm or .tif files, also named
scape_crater.stm and so on. For the experiments with colours it may contain astronaut.png, kodim05.png, kodim23.png and
the pair santa_barbara_elev.tif, santa_barbara_aerial.tif. Needs matplotlib.
"""
import pathlib
import sys
import tempfile

try:
    import colours
except ImportError as error:
    sys.exit(f"bench/paper/run.py needs {error.name}: install the Debian package python3-matplotlib")
import edges
import insertion
import results
from program import Program
from study import Study

EXPERIMENTS = (insertion.add_illustration, insertion.add_memory, insertion.add_selectors, insertion.add_algorithms,
               insertion.add_cost, insertion.add_batches, edges.add_edge_rules, edges.add_sweep, edges.add_supersampling,
               edges.add_surfaces, edges.add_synthetic, results.add_results, results.add_other_programs,
               results.add_error_curves, results.add_edge_curves, results.add_seconds, colours.add_textured_terrain,
               colours.add_images)


def add_header(study):
    study.page.heading(1, "The experiments of the 1995 paper")
    study.page.paragraph(
        f"Written by `make paper` with Scarp {study.program.call('version').split()[1]}, not edited by hand. It repeats the known experiments "
        "of M. Garland and P. S. Heckbert, *Fast Polygonal Approximation of Terrains and Height Fields* (CMU-CS-95-181, 1995): the paper.")
    study.page.paragraph(
        "In brackets: the figure of Scape 1.2, the paper's own program, on the same fields (`bench/paper/figures.py`), and Scarp's "
        "difference from it. The fields are the paper's five: Crater Lake, Ashby Gap, Ozark, the National Training Center (ntc) and the "
        "western US. Errors are vertical, in metres, over all samples.")
    study.page.paragraph(
        "Sections, pages and figures in brackets are the paper's. Only its first pages, with its contents, and the sources of its programs "
        "were at hand; claims beyond these are marked as not verified.")
    study.page.paragraph("Times are marked as measured once; all other numbers are the same on every run and machine.")
    study.page.table(["field", "size", "samples n", "heights"],
                     [[field.key, f"{field.cols} × {field.rows}", field.samples, f"{field.low:g} to {field.high:g}"]
                      for field in study.fields])


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    scarp, data, out = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        study = Study(Program(pathlib.Path(scarp).resolve(), folder), out, None if data == "--fast" else data)
        add_header(study)
        for add_experiment in EXPERIMENTS:
            add_experiment(study)
        page = pathlib.Path(out) / "paper.md"
        page.write_text(study.page.text(), encoding="utf-8")
    print(f"{page}, {sum(part.startswith('![') for part in study.page.parts)} pictures")


main()
