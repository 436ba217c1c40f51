"""Section 4.4: data-dependent triangulation against Delaunay; its shape threshold, supersampling and meshes."""
import math
import statistics

import figures
from page import Differences, compare, change_in_percent, number
from plots import Plot, draw_surfaces, full_mesh


def rule(score, q=None):
    return ("--edges", "data", "--edge-score", score, *(() if q is None else ("--shape-threshold", f"{q:g}")))


DELAUNAY = ()
MODES = {"Delaunay": DELAUNAY, "sum, q 0.5": rule("sum", 0.5), "squares, q 0.5": rule("sqerr", 0.5), "max, q 0.5": rule("max", 0.5),
         "normals, q 0.5": rule("abn", 0.5), "sum, q 0": rule("sum", 0), "sum, q 1": rule("sum", 1), "tight": rule("tight")}
SUM = MODES["sum, q 0.5"]
FRACTIONS = (0, 1.6, 0.8, 0.4)  # supersampling; 0: off. Scape's program calls 0.8 moderate.
SHOWN_PERCENT = 0.5  # share of the samples in the pictures
SIDE, BUDGET = 256, 200  # synthetic fields
COLUMNS = {"Delaunay": DELAUNAY, "sum, q 0.5": SUM, "sum, q 0": rule("sum", 0), "normals, q 0": rule("abn", 0)}


def add_modes(study):
    """All rules at 1 %, one row a rule; the runs of each."""
    runs, rows, plain, scored = {}, [], Differences(), Differences()
    for name, options in MODES.items():
        study.note(f"edge rules: {name}")
        runs[name] = [study.program.exactly(field, field.share(1), *options, mesh=True) for field in study.fields]
        rows.append([name])
        for field, run, delaunay in zip(study.fields, runs[name], runs["Delaunay"]):
            scape = study.figure(figures.EDGES.get(name), figures.FIELDS, field)
            rows[-1] += [compare(run.rmse, scape), change_in_percent(run.rmse, delaunay.rmse)]
            (plain if name in ("Delaunay", "normals, q 0.5") else scored).add(f"{name} on {field.key}", run.rmse, scape)
    study.page.heading(2, "Data-dependent triangulation, Algorithm IV (section 4.4, page 18)")
    study.page.paragraph(
        "RMS error at 1 % of the samples. q is the threshold of shape: 0 asks the score alone, 1 the shape alone. Scarp settles "
        "the edges of all scores but normals: after the last insertion it flips any edge of the mesh where that lowers the sum of "
        "squared errors and raises no largest error, until none is left. Scape tries flips around each new vertex only. For normals "
        "the mesh is the best of the last 5 % of the vertices, as a budget yields it.")
    study.page.table(["edges"] + [cell for field in study.fields for cell in (field.key, "against Delaunay")], rows)
    better = sum(run.rmse < delaunay.rmse for run, delaunay in zip(runs["sum, q 0.5"], runs["Delaunay"]))
    best = sum(min(runs[name][k].rmse for name in MODES) == runs["tight"][k].rmse for k in range(len(study.fields)))
    study.page.list([
        plain.sentence("figures of Delaunay edges and of normals, which are not settled,"),
        scored.sentence("figures of settled edges") + " At q 1 settling does nearly all of the work; at q 0 Scape's scan also loses "
        "samples on the edges of slivers, while triangles are closed here and lose none.",
        f"The sum at q 0.5 has a smaller RMS than Delaunay on {better} of {len(study.fields)} fields; the tight rule has the smallest of "
        f"all on {best}."])
    return runs


def find_saving(study, field, options, rmse, full):
    """Percentage of vertices that a rule saves at that RMS, by logarithmic interpolation between its runs. `full`: its
    run at 1 %."""
    known_share, known_rmse = 1, full.rmse
    if known_rmse > rmse:
        return "–"
    for share in (0.9, 0.8, 0.7, 0.6):
        run = study.program.exactly(field, int(share * full.vertices), *options)
        if run.rmse > rmse:
            t = math.log(rmse / known_rmse) / math.log(run.rmse / known_rmse)
            return f"{100 * (1 - known_share * (share / known_share) ** t):.1f} %"
        known_share, known_rmse = share, run.rmse
    return "–"


def add_gains(study, runs):
    rows = []
    for field, delaunay, of_sum, pure, tight in zip(
            study.fields, *(runs[name] for name in ("Delaunay", "sum, q 0.5", "sum, q 0", "tight"))):
        study.note(f"edge rules: gain on {field.key}")
        at_5 = [study.program.exactly(field, field.share(5), *options).rmse for options in (SUM, DELAUNAY)]
        rows.append([field.key, change_in_percent(*at_5), find_saving(study, field, SUM, delaunay.rmse, of_sum),
                     find_saving(study, field, MODES["tight"], delaunay.rmse, tight),
                     *(f"{run.mesh.thin_share():.1f} %" for run in (delaunay, of_sum, pure)),
                     number(of_sum.work["samples_scanned"] / delaunay.work["samples_scanned"])])
    rows.append(["*Scape*", "−{} to −{} %".format(*figures.GAIN_AT_5), "{} to {} %".format(*figures.FEWER), "",
                 *("{:g} to {:g} %".format(*thin) for thin in figures.THIN), number(figures.DATA_SCANS)])
    study.page.paragraph(
        "What the sum at q 0.5 gains: RMS at 5 % of the samples, vertices saved at the RMS that Delaunay has at 1 % (and what the "
        "tight rule saves). What it costs: triangles with an angle below 5° (at 1 %), samples scanned.")
    study.page.table(["field", "RMS at 5 %", "fewer vertices", "fewer, tight", "thin, Delaunay", "thin, q 0.5", "thin, q 0",
                      "samples scanned against Delaunay"], rows)


def add_bounds(study, runs):
    """Triangles that each rule needs for Delaunay's max error at 1 %."""
    rows = []
    for field, delaunay in zip(study.fields, runs["Delaunay"]):
        study.note(f"edge rules: bound on {field.key}")
        first, *others = (study.program.greedy(field, "-e", repr(delaunay.max_error), *options).triangles
                          for options in (DELAUNAY, SUM, MODES["tight"]))
        rows.append([field.key, number(delaunay.max_error), first,
                     *(f"{count} ({change_in_percent(count, first)})" for count in others)])
    study.page.paragraph("Triangles that satisfy the max error of Delaunay at 1 % of the samples as a bound (against Delaunay):")
    study.page.table(["field", "max error", "Delaunay", "sum, q 0.5", "tight"], rows)


def add_times(study):
    rows = []
    for field in study.fields:
        study.note(f"edge rules: times on {field.key}")
        rounds = [[study.program.greedy(field, "-p", field.share(1), *options).seconds for options in
                   (DELAUNAY, SUM, MODES["tight"])] for _ in range(3)]
        rows.append([field.key, *(number(statistics.median(seconds[k] / seconds[0] for seconds in rounds)) for k in (1, 2))])
    study.page.paragraph(
        "*Measured once, on the machine that wrote this page:* time against Delaunay at 1 %, median of three rounds of runs in "
        "turn (Scape, sum: {} to {}).".format(*figures.DATA_TIME))
    study.page.table(["field", "sum, q 0.5", "tight"], rows)


def add_edge_rules(study):
    runs = add_modes(study)
    add_gains(study, runs)
    add_bounds(study, runs)
    add_times(study)


def add_sweep(study):
    fields, thresholds = study.choose(figures.THREE), [k / 10 for k in range(11)]
    rows, differences = [[f"{q:g}"] for q in thresholds], Differences()
    plot = Plot("The threshold of shape: sum, 1 % of the samples", "q", "RMS against Delaunay", log_x=False, key="upper center")
    for colour, field in enumerate(fields):
        study.note(f"edge rules: sweep of {field.key}")
        delaunay = study.delaunay(field, field.share(1)).rmse
        runs = [study.program.exactly(field, field.share(1), *rule("sum", q)) for q in thresholds]
        theirs = study.figure(figures.SWEEP, figures.THREE, field)
        for row, q, run, scape in zip(rows, thresholds, runs, theirs):
            row.append(compare(run.rmse, scape))
            differences.add(f"q {q:g} on {field.key}", run.rmse, scape)
        plot.curve([(q, run.rmse / delaunay) for q, run in zip(thresholds, runs)], "both", colour, field.key)
        scape_delaunay = study.figure(figures.EDGES["Delaunay"], figures.FIELDS, field)
        plot.curve([(q, scape / scape_delaunay) for q, scape in zip(thresholds, theirs)], "dashes", colour, f"{field.key}, Scape")
    study.page.heading(3, "The threshold of shape")
    study.page.paragraph("RMS of the sum at 1 % of the samples.")
    study.page.table(["q", *(field.key for field in fields)], rows)
    study.plot("sweep", plot)
    study.page.list([differences.sentence("figures") + " Settling makes the threshold matter less, most of all near q 1, where Scape's "
                     "edges are those of the shape alone."])


def add_supersampling(study):
    fields, rows, outcomes = study.choose(figures.THREE), [], []
    for q in (0.5, 0):
        better = 0
        for fraction in FRACTIONS:
            study.note(f"supersampling: q {q:g}, {fraction:g}")
            options = rule("sum", q) + (("--supersample", f"{fraction:g}") if fraction else ())
            runs = [study.program.exactly(field, field.share(1), *options, mesh=True) for field in fields]
            without = without if fraction else runs
            rows.append([f"q {q:g}, {fraction:g}" if fraction else f"q {q:g}, none"])
            for run, base in zip(runs, without):
                better += run.rmse < base.rmse
                rows[-1] += [number(run.rmse), change_in_percent(run.rmse, base.rmse), f"{run.mesh.thin_share():.1f} %",
                             number(run.work["samples_scanned"] / base.work["samples_scanned"])]
        count = (len(FRACTIONS) - 1) * len(fields)
        outcomes.append(f"at q {q:g} in {better} of {count} runs" +
                        (", for there are more thin triangles" if q == 0 and better == count else ""))
    study.page.heading(3, "Supersampling")
    study.page.paragraph(
        "A thin triangle holds few samples, perhaps none, for its score. With supersampling f the score uses the bilinear "
        "interpolant of the samples on a lattice that is ⌈(width + height) / (2 · area · f)⌉ times finer; only samples are "
        "inserted. Sum, 1 % of the samples; thin: triangles with an angle below 5°; scanned: samples and points of the lattice, "
        "in those of a run without.")
    study.page.table(["supersampling"] + [cell for field in fields for cell in
                                          (f"{field.key} RMS", "against none", "thin", "scanned")], rows)
    study.page.list([f"Supersampling lowers the RMS {', '.join(outcomes)}."])


def add_surfaces(study):
    field = study.fields[0]
    study.note(f"surfaces: {field.key}")
    vertices, heights = field.share(SHOWN_PERCENT, 4), field.heights()
    runs = [study.program.exactly(field, vertices, *options, mesh=True) for options in (DELAUNAY, SUM)]
    meshes = [(run.mesh.positions, run.mesh.triangles) for run in runs]
    study.page.heading(3, "Meshes and surfaces")
    draw_surfaces(study.picture("edges", f"{field.key} with {vertices} vertices: Delaunay edges, and data-dependent ones (sum, q "
                                         "0.5)"), heights, meshes, turn=(1, 0), up=(0, 1), relief=0.1, lines=(0.9, 0.9))
    study.page.paragraph("Data-dependent triangles lie along what is steep, long and narrow; Delaunay triangles are as round as they "
                         "can be.")
    draw_surfaces(study.picture("surfaces", f"{field.key}: all {field.samples} samples, {vertices} of them with Delaunay edges, and "
                                            "with data-dependent ones"), heights, [full_mesh(heights), *meshes],
                  turn=(0.6, -0.8), up=(0.6, 0.8), relief=0.25, lines=(0, 0, 0))


def add_synthetic(study):
    rows, differences = [], Differences()
    for style, scape in figures.SYNTHETIC.items():
        study.note(f"synthetic fields: {style}")
        field = study.program.generate(style, SIDE, SIDE)
        rows.append([style])
        for (name, options), theirs in zip(COLUMNS.items(), scape):
            run = study.program.exactly(field, BUDGET, *options)
            rows[-1].append(compare(run.max_error, theirs))
            differences.add(f"{style}, {name}", run.max_error, theirs)
    for style in ("pyramid", "diagonal-pyramid"):
        field = study.program.generate(style, SIDE, SIDE)
        rows.append([style, *(f"exact with {study.program.greedy(field, '-e', 0, *options).vertices} ({theirs})"
                              for options, theirs in zip(COLUMNS.values(), figures.PYRAMIDS))])
    study.page.heading(3, "Fields curved in one direction")
    study.page.paragraph(f"Max error at {BUDGET} vertices on the fields of `scarp generate`, which are those of Scape's genstm; "
                         "for normals of the best mesh near that budget. Pyramids: vertices that reproduce every sample.")
    study.page.table([f"field of {SIDE} × {SIDE}", *COLUMNS], rows)
    remarks = [f"**Max error of {differences.far()}:** less is better, and here a judge measures every sample of the finished mesh; "
               "Scape loses samples at q 0 (below)."] if differences.far() else []
    study.page.list(remarks + [
        differences.sentence("max errors"),
        "These fields are full of ties, whole heights in straight rows, which decide the max error at one number of vertices (here "
        "by raster order), so that figures for the same field may lie far apart in percent. At q 0 Scape may also have lost samples "
        "on the edges of slivers, and kept their errors.",
        "The cliff has a jump of 1000 between two columns: no edge rule helps as long as fewer vertices than rows are allowed."])
