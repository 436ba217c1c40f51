"""Sections 1 to 4: a field and its TIN, selection of points, Algorithms I, II and III, batches."""
import math

import figures
from page import Differences, compare, change_in_percent, number, with_sign
from plots import Plot, draw_surfaces, full_mesh
from program import uniform_grid

# The paper shows 65 × 65 samples in figure 1 and 512 of them in figure 2. The field is unknown.
FIGURE_SIDE, FIGURE_VERTICES, FIGURE_SEED = 65, 512, 9
SEED, OTHER_DRAWS = 1995, 5
SELECTORS = {  # options; a word for samples selected without the program
    "global error": (),
    "uniform sub-grid": "uniform",
    "random points": "random",
    "one pass, local error, 4 neighbours": ("--one-pass", "--importance", "local"),
    "one pass, local error, 8 neighbours": ("--one-pass", "--importance", "local8"),
    "one pass, curvature": ("--one-pass", "--importance", "curvature"),
    "global × local error": ("--importance", "global*local"),
    "global × (local error + 1)": ("--importance", "global*(local+1)"),
    "global × curvature": ("--importance", "global*curvature"),
    "global × (curvature + 1)": ("--importance", "global*(curvature+1)"),
    "global × √(curvature + 1)": ("--importance", "global*sqrt(curvature+1)"),
    "attenuated: global × distance": ("--importance", "global*distance"),
    "attenuated: global × √(distance + 1)": ("--importance", "global*sqrt(distance+1)")}
BATCHES = {"sequential": (), "fraction 0.95": ("--batch", "frac:0.95"), "fraction 0.9": ("--batch", "frac:0.9"),
           "fraction 0.7": ("--batch", "frac:0.7"), "fraction 0.5": ("--batch", "frac:0.5"),
           "constant = bound": ("--batch", "const"), "independent": ("--batch", "independent")}
ALGORITHMS = {"I": "brute", "II": "local", "III": "heap"}


def add_illustration(study):
    study.note("illustration")
    field = study.program.generate("fractal", FIGURE_SIDE, FIGURE_SIDE, "--seed", FIGURE_SEED)
    run = study.program.exactly(field, FIGURE_VERTICES, mesh=True)
    study.page.heading(2, "A field and its TIN (figures 1 and 2)")
    study.page.paragraph(
        f"The paper's are {FIGURE_SIDE} × {FIGURE_SIDE} samples, and a TIN of {FIGURE_VERTICES} of them. Here: `scarp generate "
        f"fractal {FIGURE_SIDE} {FIGURE_SIDE} --seed {FIGURE_SEED}`, with {2 * (FIGURE_SIDE - 1) ** 2} triangles between its "
        f"samples, and {FIGURE_VERTICES} of them, with {run.triangles}.")
    draw_surfaces(study.picture("illustration", "The field, and the TIN"), field.heights(),
                  [full_mesh(field.heights()), (run.mesh.positions, run.mesh.triangles)], up=(0.6, 0.8), relief=0.3,
                  lines=(0.35, 0.7))
    study.page.paragraph(f"Max error {number(run.max_error)}, RMS {number(run.rmse)}, of a relief of {number(field.relief)}.")


def add_memory(study):
    study.page.heading(2, "Memory")
    study.page.paragraph(
        f"Scape in a 64-bit build: about {figures.BYTES_MEASURED} bytes a vertex, samples included; counted from its structures with "
        f"4-byte pointers: {figures.BYTES_COUNTED}; named for the paper: about {figures.BYTES_OF_PAPER}. Scarp's: "
        "[Memory](speed/memory.md).")


def random_points(field, vertices, seed):
    """The corners and random other samples without repetition (splitmix64: the same on every machine)."""
    count, cols, mask, state = field.samples, field.cols, 2 ** 64 - 1, seed
    drawn = dict.fromkeys((0, cols - 1, count - cols, count - 1))
    while len(drawn) < min(vertices, count):
        state = (state + 0x9E3779B97F4A7C15) & mask
        h = ((state ^ (state >> 30)) * 0xBF58476D1CE4E5B9) & mask
        h = ((h ^ (h >> 27)) * 0x94D049BB133111EB) & mask
        drawn[(h ^ (h >> 31)) % count] = None
    return [(sample % cols, sample // cols) for sample in drawn]


def select(study, field, choice, seed=SEED):
    vertices = field.share(1, 4)
    if choice == "random":
        return study.program.through_points(field, random_points(field, vertices, seed))
    if choice == "uniform":
        return study.program.through_points(field, uniform_grid(field.cols, field.rows, vertices)[0])
    return study.program.exactly(field, vertices, *choice)


def describe_selectors(runs):
    """The content of the table in words."""
    plain, random = runs["global error"], runs["random points"]
    attenuated = [name for name in SELECTORS if name.startswith("attenuated")]
    others = [name for name in SELECTORS if name not in attenuated]
    one_pass = [(ours.rmse, drawn.rmse) for name in SELECTORS if name.startswith("one pass")
                for ours, drawn in zip(runs[name], random)]
    beaten = sum(run.rmse < best.rmse for name in others for run, best in zip(runs[name], plain))
    worse = sum(ours > drawn for ours, drawn in one_pass)
    changes = [sorted(100 * (getattr(run, error) / getattr(best, error) - 1) for name in attenuated
                      for run, best in zip(runs[name], plain)) for error in ("rmse", "max_error")]
    return [
        "Plain global error has a smaller RMS than every choice but the attenuated ones, on every field: no product with local "
        "error or curvature is worth its cost." if beaten == 0 else f"Plain global error is beaten in {beaten} of the runs.",
        f"Attenuated against plain global error: RMS {with_sign(changes[0][0], 1)} to {with_sign(changes[0][-1], 1)} %, max "
        f"error {with_sign(changes[1][0], 0)} to {with_sign(changes[1][-1], 0)} %.",
        "Every one-pass selector is worse than random points: it spends its vertices on noise and rough places, and few on "
        "large smooth shapes." if worse == len(one_pass) else
        f"One-pass selectors are worse than random points in {worse} of {len(one_pass)} runs."]


def describe_draws(study, fields):
    """The variation between random point sets: errors of further draws."""
    draws = []
    for field in fields:
        runs = [select(study, field, "random", SEED + draw) for draw in range(1, OTHER_DRAWS + 1)]
        (least, most), (least_max, most_max) = [(min(values), max(values)) for values in
                                                ([run.rmse for run in runs], [run.max_error for run in runs])]
        draws.append(f"{field.key} {number(least)} to {number(most)} (max {number(least_max)} to {number(most_max)})")
    return f"Random points in {OTHER_DRAWS} other draws, RMS: {', '.join(draws)}."


def add_selectors(study):
    fields = study.choose(figures.THREE)
    runs, rows = {}, []
    greedy, drawn, ranked, drawn_max, ranked_max = (Differences() for _ in range(5))
    for name, choice in SELECTORS.items():
        study.note(f"selectors: {name}")
        runs[name] = [select(study, field, choice) for field in fields]
        rows.append([name])
        rmse_figures, max_figures = figures.SELECTORS.get(name, (None, None))
        for field, run in zip(fields, runs[name]):
            rmse = study.figure(rmse_figures, figures.THREE, field)
            max_error = study.figure(max_figures, figures.THREE, field)
            rows[-1] += [compare(run.rmse, rmse), compare(run.max_error, max_error)]
            is_draw = isinstance(choice, str)
            (drawn if is_draw else ranked if choice else greedy).add(f"{name} on {field.key}", run.rmse, rmse)
            (drawn_max if is_draw else ranked_max).add(f"{name} on {field.key}", run.max_error, max_error)
    study.page.heading(2, "What is worth inserting (section 3: importance measures)")
    study.page.paragraph(
        "The same Delaunay triangulation of 1 % of the samples; only their choice differs. Uniform: a sub-grid of about as many "
        "vertices, borders included. Attenuated: the error counts for less near chosen vertices, here by the distance from the "
        "nearest corner of the sample's triangle, in samples; the paper's formula is not known.")
    study.page.table(["selector"] + [cell for field in fields for cell in (f"{field.key} RMS", "max")], rows)
    remarks = describe_selectors(runs) + [
        describe_draws(study, fields), greedy.sentence("RMS errors of plain global error"),
        drawn.sentence("RMS errors of uniform and random points") +
        " The points differ: other random numbers, another rounding of the sub-grid's rows and columns.",
        ranked.sentence("RMS errors of one pass and of products") +
        " The border differs: here a pair of opposite neighbours of which one is missing is omitted, so that a plane has no local "
        "error there either. On crater and ashby Scape's figures for one pass result within about 1 % where such a pair counts as 0 "
        "(4 neighbours), and where the mean is that of the existing neighbours (8 neighbours)."]
    if drawn_max.far():
        remarks.append(f"**Max error of {drawn_max.far()}:** no failure. One peak or gorge, which the points hit or miss, decides "
                       "it, as in the other draws.")
    if ranked_max.far():
        remarks.append(f"**Max error of {ranked_max.far()}:** no failure. Where whole regions get no vertex, one sample more or "
                       "less at the border decides the worst of them.")
    study.page.list(remarks)


def run_algorithms(study, field, vertices, mesh=False):
    study.note(f"algorithms: {field.key}, {vertices} vertices")
    return [study.program.greedy(field, "-p", vertices, "--algorithm", word, mesh=mesh) for word in ALGORITHMS.values()]


def add_algorithms(study):
    rows, all_same = [], True
    fields = study.choose(("crater", "ashby", "ozark"))
    for field in fields:
        vertices = field.share(0.1, 8)
        rounds = [run_algorithms(study, field, vertices, mesh=True) for _ in range(3)]
        one, two, three = (run.work for run in rounds[0])
        same = len({run.mesh.content for run in rounds[0]}) == 1
        all_same = all_same and same
        seconds = [min(runs[k].seconds for runs in rounds) for k in range(3)]
        rows.append([field.key, vertices, *(number(work["samples_scanned"] / 1e6) for work in (one, two, three)),
                     number(one["samples_scanned"] / three["samples_scanned"]), two["queue_moves"], three["queue_moves"],
                     "yes" if same else "no", number(seconds[0] / seconds[2]), number(seconds[1] / seconds[2])])
    study.page.heading(2, "Algorithms I, II and III (section 4, pages 8, 11 and 13)")
    study.page.table(["field", "m", "million samples scanned, I", "II", "III", "I / III", "triangles searched, II",
                      "entries moved, III", "same mesh", "time I / III (measured once)", "time II / III (measured once)"], rows)
    plot = Plot(f"Samples scanned by Algorithms I, II and III, {fields[0].key}", "vertices m", "samples scanned", log_y=True,
                key="upper left")
    stations = [2 ** k for k in range(3, 10) if 2 ** k <= fields[0].samples / 4]
    runs = [run_algorithms(study, fields[0], m) for m in stations]
    for k, (name, style) in enumerate(zip(ALGORITHMS, ("both", "points", "line"))):
        plot.curve([(m, of_m[k].work["samples_scanned"]) for m, of_m in zip(stations, runs)], style, k, name)
    study.plot("algorithms", plot)
    study.page.list([
        "All three insert the same samples in the same order: the meshes are equal to the last bit." if all_same else
        "The meshes are not all equal, which they should be.",
        "I scans every sample before each insertion, n·m of them. II and III scan only the triangles around the new vertex; II "
        "then searches all triangles for the worst, III has them in a heap."])


def scans(run):
    """Samples scanned, except the three corners of each triangle: Scape skips samples that are vertices."""
    return run.work["samples_scanned"] - 3 * run.work["triangles_scanned"]


def fit_line(points):
    """Slope and offset of y = slope · x + offset, least squares."""
    n, x, y = len(points), sum(p[0] for p in points), sum(p[1] for p in points)
    xx, xy = sum(p[0] * p[0] for p in points), sum(p[0] * p[1] for p in points)
    slope = (n * xy - x * y) / (n * xx - x * x)
    return slope, (y - slope * x) / n


def describe_line(slope, offset):
    return f"{slope:.2f} ln m {'−' if offset < 0 else '+'} {abs(offset):.1f}"


def add_cost(study):
    rows, remarks, moves, counts = [], [], [], Differences()
    plot = Plot("Samples scanned by Algorithm III", "vertices m", "samples scanned / n", key="upper left")
    for colour, field in enumerate(study.choose(("ntc", "westUS"))):
        is_compared = field.key == figures.SCAN_FIELD
        points = []
        for percent, millions in zip((0.1, 1, 10, 50), figures.SCANS.values()):
            m, scape = field.share(percent, 5), millions if is_compared else None
            study.note(f"cost: {field.key}, {m} vertices")
            run = study.delaunay(field, m)
            counts.add(f"{field.key} at {m} vertices", scans(run) / 1e6, scape)
            moves.append(run.work["queue_moves"] / run.vertices)
            points.append((m, scans(run) / field.samples))
            rows.append([field.key, run.vertices, number(run.work["samples_scanned"] / 1e6), compare(scans(run) / 1e6, scape),
                         number(run.work["triangles_scanned"] / run.vertices), number(moves[-1])])
        line = fit_line([(math.log(m), y) for m, y in points])
        plot.curve(points, "points", colour, field.key)
        plot.curve([(m, line[0] * math.log(m) + line[1]) for m, _ in points], "line", colour, describe_line(*line))
        remarks.append(f"Fitted on {field.key}: samples scanned, without corners, = n ({describe_line(*line)})" +
                       (f"; Scape: n ({describe_line(figures.SCAN_SLOPE, figures.SCAN_OFFSET)})." if is_compared else "."))
    plot.curve([(m, millions * 1e6 / 1024 ** 2) for m, millions in figures.SCANS.items()], "both", 5, "Scape")
    remarks += ["The queue moves {} to {} entries a vertex (Scape: {} to {} swaps): log m, as a heap should.".format(
                    number(min(moves)), number(max(moves)), *figures.SWAPS),
                counts.sentence("counts of samples") + " Scape skips samples that are vertices, Scarp scans the corners of each "
                "triangle: hence the column without them."]
    study.page.heading(2, "The cost of Algorithm III (section 4, page 13)")
    study.page.paragraph("Expected: O((n + m) log m) for n samples and m vertices.")
    study.page.table(["field", "m", "million samples scanned", "without corners", "triangles scanned / m",
                      "queue entries moved / m"], rows)
    study.plot("effort", plot)
    study.page.list(remarks)


def add_batches(study):
    fields = study.choose(figures.THREE)
    bounds = figures.BATCH_BOUNDS
    rows, runs, vertices, passes = [], {}, Differences(), Differences()
    for name, options in BATCHES.items():
        study.note(f"batches: {name}")
        runs[name] = [study.program.greedy(field, "-e", bound, *options) for field, bound in zip(fields, bounds)]
        rows.append([name])
        vertex_figures, pass_figures = figures.BATCHES.get(name, (None, None))
        for field, run, one_by_one in zip(fields, runs[name], runs["sequential"]):
            scape_vertices = study.figure(vertex_figures, figures.THREE, field)
            scape_passes = study.figure(pass_figures, figures.THREE, field)
            vertices.add(f"{name} on {field.key}", run.vertices, scape_vertices)
            passes.add(f"{name} on {field.key}", run.work["passes"], scape_passes)
            rows[-1] += [compare(run.vertices, scape_vertices), change_in_percent(run.vertices, one_by_one.vertices),
                         compare(run.work["passes"], scape_passes)]
    study.page.heading(2, "Insertion in batches (section 4, parallel insertion)")
    study.page.paragraph(
        "Vertices and passes until the max error is below the bound. Fraction α: a pass inserts all candidates of at least α "
        "times the largest error; constant: all that break the bound; independent (Scarp's own): all whose triangle the pass has "
        "not changed yet, worst first.")
    study.page.table(["rule"] + [cell for field, bound in zip(fields, bounds) for cell in
                                 (f"{field.key}, max error {number(bound)}", "against sequential", "passes")], rows)
    thresholds = [name for name in BATCHES if name not in ("sequential", "independent")]
    is_best = all(run.vertices >= one.vertices for name in thresholds for run, one in zip(runs[name], runs["sequential"]))
    remarks = ["Of the paper's rules, one at a time makes the smallest meshes on every field: a batch inserts samples that its "
               "earlier insertions have already mended." if is_best else
               "One at a time is not the smallest of the paper's rules on every field here."]
    if all(run.vertices > own.vertices for name in thresholds for run, own in zip(runs[name], runs["independent"])):
        remarks.append("Independent candidates need fewer vertices than any threshold on every field: none is stale when it is "
                       "inserted.")
    study.page.list(remarks + [
        vertices.sentence("counts of vertices"), passes.sentence("counts of passes") +
        " With a few dozen passes a single candidate on the limit, or one tie decided otherwise, moves all that follow."])
