#!/usr/bin/env python3
"""Reads every #include of the library and the program and fails on a step upwards or sideways between rooms.

A room is a folder of src/ (or the passes src/*.cpp, the door include/scarp, the program apps/). ROOMS below is the
table of docs/design.md, "Rooms and floors": whoever changes one changes the other (`--table` prints it as Markdown).

usage: check_floors.py [TREE] [--table]
"""

import pathlib
import re
import sys

MAX_LINES = 600

# room: (floor, rooms it may include, public headers it may include, what it holds).
# Rooms on one floor are strangers: none includes another.
ANY = None
SESSION = [f"session/{room}" for room in ("text", "table", "options", "inputs", "plan", "reports", "tasks")]
ROOMS = {
    "door": (0, [], ANY, "`include/scarp`: the public headers, each a manual"),
    "base": (0, [], ["alike", "result", "progress", "version"], "lattice points, exact integers, arrays, threads, memory budget, progress"),
    "grid": (1, ["base"],
             ["border", "degrees", "edits", "frame", "generate", "height_field", "lines", "points", "progress", "result", "ridges", "strategy"],
             "rasters: outline, frames, runs, rows; `sources/`: samples that are not one array"),
    "geom": (1, ["base"], ["result"],
             "predicates, planes, the scan of a triangle and its kernels, arrangements of lines"),
    "mesh": (1, ["base"], ["mesh", "result", "solid"], "the Mesh value: order, solids, print tiles, half-edges"),
    "tin": (2, ["base", "geom"], ["result"], "triangulations and their assembly; no heights"),
    "metric": (2, ["base", "grid", "geom"],
               ["goals", "height_field", "lines", "paper", "points", "progress", "regions", "result", "simplify", "strategy", "tolerances"],
               "how far a triangle is from its samples, and how far it may be: tolerances, regions, importance"),
    "globe": (2, ["base", "grid"], ["degrees", "geoid", "result", "tile", "tile_grid"],
              "places on a globe or a plane: the ellipsoid, grids of tiles, geoids"),
    "io": (3, ["base", "grid", "mesh", "globe"],
           ["alike", "commands", "cutline", "degrees", "drape", "frame", "geoid", "glb", "globe_image", "globe_place", "gzip", "height_field", "io", "lent", "lines", "mesh", "points", "progress", "raster_lines", "result", "solid", "quality", "strategy", "tile", "tile_grid", "tile_set", "tiles3d", "version", "zones"],
           "bytes to values and back: `mesh/`, `raster/`, `points/`, `tiles/`, `gdal/`"),
    "measure": (3, ["base", "grid", "mesh"],
                ["cutline", "frame", "height_field", "judge", "measure", "mesh", "points", "progress", "result", "strategy"],
                "judging a mesh, without knowing how it was made"),
    "draw": (3, ["base", "grid", "geom", "mesh"], ["frame", "height_field", "io", "mesh", "picture", "result"],
             "pictures of fields, meshes and errors"),
    "refine": (3, ["base", "grid", "geom", "tin", "metric"], ["frame", "height_field", "points", "progress", "result", "strategy"],
               "insertion: greedy, locally dominant, scattered points, the textbook"),
    "fit": (3, ["base", "grid", "geom", "tin"], ["goals", "result"], "fewer and better vertices within the bound"),
    "lines": (3, ["base", "grid", "geom", "tin", "metric"],
              ["cutline", "edits", "frame", "height_field", "lines", "progress", "result", "rivers", "simplify", "strategy"],
              "lines on the lattice, and as constraints in a triangulation; cuts"),
    "shape": (4, ["base", "grid", "geom", "tin", "metric", "refine", "fit", "lines"],
              ["frame", "height_field", "mesh", "progress", "result", "shape", "strategy"],
              "angles and lengths for simulation"),
    "features": (4, ["base", "grid", "geom", "lines"], ANY, "the land's own lines: walls, ridges, valleys, lakes, rivers, flats"),
    "pieces": (5, ["base", "grid", "geom", "mesh", "tin", "metric", "refine", "fit", "lines", "shape"], ANY,
               "a window worked on alone, borders first: tiles, strips, seams, freezing"),
    "simplify": (6, ["base", "grid", "geom", "mesh", "tin", "metric", "io", "measure", "refine", "fit", "lines", "shape",
                     "features", "pieces"], ANY, "the list: the door, the passes, budgets, the proof, scattered points"),
    "tiles/nodes": (3, ["base", "grid", "globe"], ANY, "heights by place: of rasters, raised, stacked, held, decimated"),
    "tiles/water": (5, ["base", "grid", "globe"], ANY, "lakes and rivers on nodes, and masks of them"),
    "tiles/mesh": (7, ["base", "globe"], ANY, "one tile: its nodes, lines, edges, mesh, and the judge of what clients decode"),
    "tiles/pyramid": (8, ["base", "globe", "tiles/nodes", "tiles/mesh"], ANY, "levels, blocks, and what these hand to the levels above"),
    "check": (6, ["base", "grid", "io"], ANY, "finished sets of tiles, judged without knowing how they were made"),
    "jobs": (9, ["base", "grid", "io"], ANY,
             "what runs the engine of tiles: plans of jobs, blocks in parts, estimate, survey, sets made on demand"),
    "session/text": (7, [], ["result"], "numbers and sentences for people: text, names of files, clocks, the type of reports"),
    "session/table": (8, ["session/text"], ["alike", "conflicts", "result", "version"], "the table of options, and what is made of it: help, proposals for unknown words"),
    "session/options": (10, ["session/text", "session/table"], ANY, "the arguments of each command: registered, parsed, spelled canonically"),
    "session/inputs": (11, ["session/text", "session/options"], ANY, "the files that options name, read: channels, companions, lines, waters, zones"),
    "session/plan": (11, ["session/text", "session/table", "session/options"], ANY, "what a command will do, decided before its work: plans, conflicts, outputs"),
    "session/reports": (12, ["session/text", "session/options", "session/inputs", "session/plan"], ANY, "what a run came to, as JSON, lines of a summary and warnings"),
    "session/tasks": (13, ["session/text", "session/table", "session/options", "session/inputs", "session/plan", "session/reports"], ANY,
                     "the commands without their terminal: simplify, measure, points, tiles"),
    "apps": (14, SESSION, ANY, "the program: commands in a terminal, the server of tiles"),
}

# Headers that only some files may include: (pattern of the header, files that may, why).
RESERVED = [
    (r"(gdal|ogr|cpl|osr|vrt)[a-z_0-9]*\.h$|gdal/.*", [r"src/io/gdal/"], "GDAL is known to src/io/gdal only"),
    (r"(thread|mutex|shared_mutex|condition_variable|future|semaphore|latch|barrier|stop_token)$",
     [r"src/base/parallel\.(h|cpp)$", r"src/io/gdal/", r"src/io/spool\.cpp$", r"apps/scarp/serve/(answer_queue|preparation|served_set)\.(h|cpp)$"],
     "threads belong to src/base/parallel, locks besides to src/io/gdal where a transform serves several threads, "
     "to src/io/spool.cpp, whose input all threads share, and to what makes the answers of scarp serve, prepares them, or "
     "holds the set that they are of"),
    (r"atomic$",
     [r"src/base/parallel\.(h|cpp)$", r"src/io/gdal/", r"src/io/temporary_file\.cpp$", r"apps/"],
     "atomics belong to src/base/parallel, src/io/gdal and what a signal handler reads (src/io/temporary_file.cpp, apps)"),
    (r"hwy/.*|[a-z]*mmintrin\.h$|immintrin\.h$|x86intrin\.h$|arm_neon\.h$|wasm_simd128\.h$",
     [r"src/geom/scan_kernels[a-z_-]*\.(h|cpp)$", r"src/measure/judge_kernels_vector\.cpp$",
      r"src/fit/triangle_kernels_vector\.cpp$", r"src/base/(branchless|wasm_vectors-inl)\.h$"],
     "instruction sets are known to src/geom/scan_kernels*, src/measure/judge_kernels_vector.cpp, "
     "src/fit/triangle_kernels_vector.cpp, src/base/branchless.h and src/base/wasm_vectors-inl.h only"),
    (r"CLI/.*", [r"src/session/(table|options)/", r"apps/"], "command lines are known to src/session/table, src/session/options and apps only"),
    (r"(format|ranges)$", [r"src/io/gdal/", r"src/session/", r"apps/"], "the core builds without std::format and range views"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(path):
    """The room of a file given by its path in the tree."""
    parts = path.parts
    if parts[0] == "include":
        return "door"
    if parts[0] == "apps":
        return "apps"
    return room_of_header("/".join(parts[1:]))


def room_of_header(header):
    """The room of a header as `#include "header"` names it; "loose" where it lies in none."""
    parts = header.split("/")
    depth = 2 if parts[0] in ("session", "tiles") else 1
    return "/".join(parts[:depth]) if len(parts) > depth else "loose"


def judge_project_include(path, room, header, tree):
    """The fault of `#include "header"` in this file, or None."""
    floor, may_include, public, _ = ROOMS[room]
    top = room_of_header(header)
    if header.startswith("scarp/"):
        name = pathlib.PurePath(header).stem
        if not (tree / "include" / header).is_file():
            return f"there is no include/{header}"
        if public is not ANY and name not in public:
            return f"the room {room} must not know {header}"
        return None
    if room == "apps":
        if (tree / "apps" / path.parts[1] / header).is_file():
            return None
        if top in may_include and (tree / "src" / header).is_file():
            return None
        return "apps may include scarp/*.h, session/ and headers of their own program only"
    if room == "door":
        return "a public header may include public headers only"
    if top not in ROOMS or not (tree / "src" / header).is_file():
        return f"there is no src/{header}"
    if top == room or top in may_include:
        return None
    if ROOMS[top][0] == floor:
        return f"{room} and {top} are strangers on floor {floor}"
    if ROOMS[top][0] > floor:
        return f"a step upwards from {room} (floor {floor}) to {top} (floor {ROOMS[top][0]})"
    return f"the room {room} must not know the room {top}"


def judge_reserved(path, header):
    for pattern, allowed, why in RESERVED:
        if re.match(pattern, header) and not any(re.match(place, path.as_posix()) for place in allowed):
            return why
    return None


def judge_file(path, tree):
    """Sentences about one file."""
    room = room_of(path)
    if room not in ROOMS:
        yield f"{path}: the room {room} is not in the table of tools/check_floors.py: sources lie in folders of src/"
        return
    lines = (tree / path).read_text(encoding="utf-8").splitlines()
    if room == "door" and path.name != "scarp.h":
        if "#pragma GCC visibility push(default)" not in lines:
            yield f"{path}: a public header pushes default visibility, or a shared library hides it"
        if f'#include "scarp/{path.name}"' not in (tree / path.with_name("scarp.h")).read_text(encoding="utf-8"):
            yield f"{path}: scarp.h does not include it, which has all public headers"
    if len(lines) > MAX_LINES:
        yield f"{path}: {len(lines)} lines, more than {MAX_LINES}: split it by concept"
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quoted, header = match.group(1) == '"', match.group(2)
        wrong = judge_reserved(path, header)
        if not wrong and (quoted or room_of_header(header) in ROOMS or header.startswith("scarp/")):
            wrong = judge_project_include(path, room, header, tree)
        if wrong:
            yield f"{path}:{number}: includes {header}: {wrong}"


def sources(tree):
    for top in ("include", "src", "apps"):
        for path in sorted((tree / top).rglob("*")):
            if path.suffix in (".h", ".hpp", ".inc", ".cpp", ".cc", ".c") and path.is_file():
                yield path.relative_to(tree)


def print_table():
    print("| floor | room | holds | may include |")
    print("|---|---|---|---|")
    for room, (floor, may_include, public, holds) in reversed(ROOMS.items()):
        doors = "any public header" if public is ANY else ", ".join(f"`{name}.h`" for name in public)
        rooms = ", ".join(f"`{name}`" for name in may_include)
        print(f"| {floor} | `{room}` | {holds} | {'; '.join(filter(None, [rooms, doors]))} |")


def main(arguments):
    if "--table" in arguments:
        print_table()
        return 0
    tree = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).resolve().parent.parent)
    files = list(sources(tree))
    if not files:
        print(f"check_floors: no sources under {tree}", file=sys.stderr)
        return 2
    faults = [fault for path in files for fault in judge_file(path, tree)]
    for fault in faults:
        print(fault)
    print(f"check_floors: {len(files)} files, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
