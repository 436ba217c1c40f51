"""Section 5: errors and seconds against the number of vertices."""
import datetime
import os
import pathlib

import figures
from edges import SUM
from page import Differences, compare, change_in_percent, number
from plots import Plot

SHARES = (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10)
LEAST_ROUNDS, MOST_ROUNDS, SECONDS_OF_ROUNDS = 3, 9, 0.5  # more rounds for short runs, which are more disturbed
MILLION_VERTICES = 10486  # 1 % of a million samples


def add_results(study):
    rows, triangles, max_error, rmse = [], Differences(), Differences(), Differences()
    for scape in figures.reference_rows():
        study.note(f"results: {scape.field}, {scape.vertices} vertices")
        field = study.find(scape.field)
        run = study.delaunay(field, scape.vertices)
        ours, theirs = (run.triangles, run.max_error, run.rmse), (scape.triangles, scape.max_error, scape.rmse)
        for differences, our, their in zip((triangles, max_error, rmse), ours, theirs):
            differences.add(f"{field.key} at {scape.vertices} vertices", our, their)
        rows.append([field.key, run.vertices, *map(compare, ours, theirs), f"{100 * run.max_error / field.relief:.2f} %",
                     f"{100 * run.rmse / field.relief:.2f} %"])
    study.page.heading(2, "Results (section 5, page 22)")
    study.page.paragraph("Delaunay, exactly this many vertices, corners included. Errors over all samples.")
    study.page.table(["field", "m", "triangles", "max error", "RMS", "max / relief", "RMS / relief"], rows)
    study.page.list([rmse.sentence("RMS errors"), triangles.sentence("counts of triangles"), max_error.sentence("max errors") +
                     " Ties and the first diagonal decide it, and it is not monotone in m, as below."])


def add_other_programs(study):
    rows, farthest = [], 0
    for key, vertices, program, max_error, rmse in figures.OTHER_PROGRAMS:
        run = study.delaunay(study.find(key), vertices)
        if program == "Scape 1.2":
            rows.append([key, vertices, "Scarp", number(run.max_error), number(run.rmse)])
        farthest = max(farthest, 100 * abs(run.rmse / rmse - 1))
        rows.append([key, vertices, program, number(max_error), number(rmse)])
    study.page.heading(3, "Other programs")
    study.page.paragraph("The same greedy insertion, Delaunay, by other programs. Terra is the paper's second program.")
    study.page.table(["field", "m", "program", "max error", "RMS"], rows)
    study.page.list([f"The RMS errors lie within {farthest:.1f} % of Scarp's. The max errors need not, for the same reasons."])


def stations(first, last, steps):
    """Numbers of vertices: `steps` per factor of ten, and the last."""
    numbers = []
    while first * 10 ** (len(numbers) / steps) < last:
        numbers.append(int(first * 10 ** (len(numbers) / steps) + 0.5))
    return [*numbers, int(last + 0.5)]


def add_spikes(study):
    rows, differences, crater = [], Differences(), study.find("crater")
    for vertices, scape in figures.SPIKES.items():
        run = study.delaunay(crater, vertices)
        rows.append([run.vertices, compare(run.max_error, scape)])
        differences.add(f"{vertices} vertices", run.max_error, scape)
    study.page.paragraph("The max error has spikes, where a single sample suddenly lies under a long triangle. So `scarp simplify -p` "
                         "returns the best mesh near its budget. Crater:")
    study.page.table(["m", "max error"], rows)
    if differences.far():
        study.page.list([f"**Max error at {differences.far()}:** less is better. Scape's run stops on a spike; Scarp's spikes are at "
                         "other numbers of vertices."])


def add_error_curves(study):
    study.page.heading(3, "Error against vertices")
    study.page.paragraph("Circles: Scape's rows above.")
    plots = {"rmse": Plot("RMS error against vertices", "vertices m", "RMS error, % of the relief", log_y=True, key="upper right"),
             "max_error": Plot("Max error against vertices", "vertices m", "max error, % of the relief", log_y=True,
                               key="upper right")}
    for colour, field in enumerate(study.fields):
        study.note(f"error curves: {field.key}")
        of_field = [row for row in figures.reference_rows() if row.field == field.key and row.vertices <= field.samples / 10 + 1]
        for error, (name, steps, style) in {"rmse": ("rms_error", 4, "both"), "max_error": ("max_error", 8, "line")}.items():
            runs = [(m, study.delaunay(field, m)) for m in stations(10, field.samples / 10, steps)]
            percent = [(m, 100 * getattr(run, error) / field.relief) for m, run in runs if getattr(run, error) > 0]
            plots[error].curve(percent, style, colour, field.key)
            plots[error].curve([(row.vertices, 100 * getattr(row, error) / field.relief) for row in of_field], "points", colour)
    study.plot("rms_error", plots["rmse"])
    study.plot("max_error", plots["max_error"])
    add_spikes(study)


def add_edge_curves(study):
    errors = Plot("RMS error against vertices: data-dependent edges, and Delaunay (dashes)", "vertices m",
                  "RMS error, % of the relief", log_y=True, key="upper right")
    ratios = Plot("RMS error of data-dependent edges (sum, q 0.5) against Delaunay", "vertices m, % of the samples",
                  "ratio of RMS errors", key="upper right")
    better = count = 0
    for colour, field in enumerate(study.fields):
        study.note(f"edge curves: {field.key}")
        runs = [(share, field.share(share), study.program.exactly(field, field.share(share, 4), *SUM).rmse,
                 study.delaunay(field, field.share(share, 4)).rmse) for share in SHARES]
        errors.curve([(m, 100 * ours / field.relief) for _, m, ours, _ in runs], "line", colour, field.key)
        errors.curve([(m, 100 * delaunay / field.relief) for _, m, _, delaunay in runs], "dashes", colour)
        ratios.curve([(share, ours / delaunay) for share, _, ours, delaunay in runs], "both", colour, field.key)
        better += sum(ours < delaunay for *_, ours, delaunay in runs)
        count += len(runs)
    study.page.heading(3, "Delaunay and data-dependent edges against vertices")
    study.plot("edge_rms", errors)
    study.plot("edge_ratio", ratios)
    study.page.list([f"Data-dependent edges have the smaller RMS in {better} of {count} runs."])


def describe_machine():
    """"2026-11-23, AMD EPYC, 2 logical processors, load 0.8\""""
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    names = [line.split(": ")[1] for line in cpuinfo.read_text().splitlines() if line.startswith("model name")] if cpuinfo.exists() else []
    today = datetime.datetime.now(datetime.timezone.utc).date()
    return f"{', '.join([str(today), *names[:1]])}, {os.cpu_count()} logical processors, load {os.getloadavg()[0]:.1f}"


def least_seconds(study, field, vertices, options):
    rounds = []
    while not rounds or not study.is_fast and (len(rounds) < LEAST_ROUNDS or
                                               len(rounds) < MOST_ROUNDS and sum(rounds) < SECONDS_OF_ROUNDS):
        rounds.append(study.program.greedy(field, "-p", vertices, *options).seconds)
    return min(rounds)


def add_seconds(study):
    machine, rows, million = describe_machine(), [], 0
    for scape in figures.reference_rows():
        study.note(f"seconds: {scape.field}, {scape.vertices} vertices")
        field = study.find(scape.field)
        delaunay, data = (least_seconds(study, field, scape.vertices, options) for options in ((), SUM))
        if scape.vertices == MILLION_VERTICES:
            million = max(million, delaunay)
        rows.append([field.key, scape.vertices, f"{scape.seconds:g}", f"{delaunay:.3f}", f"{field.samples / 1e6 / delaunay:.2f}",
                     f"{data:.3f}", f"{data / delaunay:.2f}"])
    study.page.heading(3, "Seconds")
    study.page.paragraph(
        f"*Measured once, on the machine that wrote this page ({machine}):* what the program reports of its triangulation, without "
        f"reading, judging and writing, on one thread, in the greedy order; the least of {LEAST_ROUNDS} to {MOST_ROUNDS} runs. Scape's "
        "seconds are another machine's: one core of a cloud Xeon, g++ 12 -O2, the same part of the work.")
    study.page.table(["field", "m", "Scape, Delaunay, s", "Delaunay, s", "million samples a second", "sum, q 0.5, s", "ratio"], rows)
    study.page.list([
        f"The paper's abstract: a field of a million samples \"quite accurately\" in under a minute, on a workstation of 1995. Here 1 % "
        f"of such a field takes {million:.2f} s.",
        f"Not verified, for the text is not at hand: {figures.SECONDS_OF_1995} s for a field of 1024 × 1024 and 1 % of its samples, on an "
        f"SGI Indigo2 (R4400, 150 MHz), that is {figures.SECONDS_OF_1995 / million:.0f} times as long; data-dependent edges three to four "
        "times as long as Delaunay's (Scape, measured: {} to {}).".format(*figures.DATA_TIME),
        "The default, the dominant order, is faster ([performance](performance.md))."])
