#!/usr/bin/env python3
"""Reads every #include of the library and the program and fails on a step upwards or sideways between rooms, on a
namespace of another room, and on reserved words outside their files.

A room is a folder of src/ (or the passes src/*.cpp, the door include/scarp, the program apps/). ROOMS below is the
table of docs/design.md, "Rooms and floors": change both together (`--table` prints it as Markdown).

usage: check_floors.py [TREE] [--table]
"""

import functools
import pathlib
import re
import sys

MAX_LINES = 600

# room: (floor, rooms it may include, further rooms whose public functions it may use, contents).
# Rooms on one floor must not include each other. A use of a public function, or of a class with functions, is a step to
# the room that implements it; values are free.
ANY = None  # the public functions of all rooms on lower floors
SESSION = [f"session/{room}" for room in ("text", "table", "options", "inputs", "plan", "reports", "tasks")]
ROOMS = {
    "door": (0, [], [], "`include/scarp`: the public headers, each a manual"),
    "base": (0, [], [], "lattice points, exact integers, arrays, a tree of boxes, threads, memory budget, progress"),
    "las": (1, ["base"], [], "LAS and LAZ: bytes to points"),
    "grid": (1, ["base"], [], "rasters: outline, frames, runs, rows; `sources/`: samples that are not one array"),
    "geom": (1, ["base"], [], "predicates, planes, the scan of a triangle and its kernels, arrangements of lines"),
    "globe": (2, ["base", "grid"], [], "places on a globe or a plane: the ellipsoid, grids of tiles, geoids"),
    "mesh": (2, ["base"], ["grid"], "the Mesh value: order, solids, print tiles, half-edges"),
    "tin": (2, ["base", "geom"], [], "triangulations and their assembly; no heights"),
    "metric": (2, ["base", "grid", "geom"], [],
               "how far a triangle is from its samples, and how far it may be: tolerances, regions, importance"),
    "io": (3, ["base", "las", "grid", "mesh", "globe"], [], "bytes to values and back: `mesh/`, `raster/`, `points/`, `tiles/`, `gdal/`"),
    "measure": (3, ["base", "grid", "mesh"], ["metric"], "judging a mesh, without knowing how it was made"),
    "refine": (3, ["base", "grid", "geom", "tin", "metric"], [],
               "insertion: greedy, locally dominant, scattered points, the textbook"),
    "fit": (3, ["base", "grid", "geom", "tin"], [], "fewer and better vertices within the bound"),
    "lines": (3, ["base", "grid", "geom", "tin", "metric"], [], "lines on the lattice, and as constraints in a triangulation; cuts"),
    "tiles/nodes": (3, ["base", "grid", "globe"], [], "heights by place: of rasters, raised, stacked, held, decimated"),
    "draw": (4, ["base", "grid", "geom", "mesh"], ["io"], "pictures of fields, meshes and errors"),
    "shape": (4, ["base", "grid", "geom", "tin", "metric", "refine", "fit", "lines"], ["mesh"], "angles and lengths for simulation"),
    "features": (4, ["base", "grid", "geom", "lines"], [], "the land's own lines: walls, ridges, valleys, lakes, rivers, flats"),
    "pieces": (5, ["base", "grid", "geom", "mesh", "tin", "metric", "refine", "fit", "lines", "shape"], ["io", "features", "globe"],
               "a window worked on alone, borders first: tiles, strips, seams, freezing"),
    "tiles/water": (5, ["base", "grid", "globe"], ["tiles/nodes", "features"], "lakes and rivers on nodes, and masks of them"),
    "simplify": (6, ["base", "grid", "geom", "mesh", "tin", "metric", "io", "measure", "refine", "fit", "lines", "shape",
                     "features", "pieces"], ["globe"], "the list: the door, the passes, budgets, the proof, scattered points"),
    "check": (6, ["base", "grid", "io"], ["globe", "mesh", "tiles/nodes"],
              "finished sets of tiles, judged without knowing how they were made"),
    "tiles/mesh": (7, ["base", "globe"], ["grid", "mesh", "tiles/nodes", "simplify"],
                   "one tile: its nodes, lines, edges, mesh, and the judge of what clients decode"),
    "live": (7, ["base", "grid"], ["simplify"], "fields that change: cells, their borders, and what readers see"),
    "tiles/pyramid": (8, ["base", "globe", "tiles/nodes", "tiles/mesh", "tiles/water"], ["grid", "pieces", "simplify"],
                      "levels, blocks, and what these hand to the levels above"),
    "jobs": (9, ["base", "grid", "io", "tiles/mesh", "tiles/water"], ANY,
             "what runs the engine of tiles: plans of jobs, blocks in parts, estimate, survey, sets made on demand"),
    "session/text": (7, [], [], "numbers and sentences for people: text, names of files, clocks, the type of reports"),
    "session/table": (8, ["session/text"], ["base", "io", "pieces"], "the tables of options and of formats, and what is made of them: help, proposals for unknown words"),
    "session/options": (10, ["session/text", "session/table"], ANY, "the arguments of each command: registered, parsed, spelled canonically"),
    "session/inputs": (11, ["session/text", "session/options"], ANY, "the files that options name, read: channels, companions, lines, waters, zones"),
    "session/plan": (11, ["session/text", "session/table", "session/options"], ANY, "what a command will do, decided before its work: plans, conflicts, outputs"),
    "session/reports": (12, ["session/text", "session/options", "session/inputs", "session/plan"], ANY, "what a run came to, as JSON, lines of a summary and warnings"),
    "session/tasks": (13, ["session/text", "session/table", "session/options", "session/inputs", "session/plan", "session/reports"], ANY,
                     "the commands without their terminal: simplify, measure, points, tiles"),
    "apps": (14, SESSION, ANY, "the program: commands in a terminal, the server of tiles"),
}

# Headers of rooms that the session and the program may include like public ones: documented alike, but not installed
# and without promises.
SHOWN = [
    "base/after_allocation.h",
    "base/alike.h",
    "check/level_meshes.h",
    "grid/generate.h",
    "io/commands.h",
    "io/gzip.h",
    "io/lend.h",
    "io/raster/crs_description.h",
    "io/raster/height_unit.h",
    "jobs/live_tiles.h",
    "measure/judge.h",
    "pieces/conflicts.h",
    "simplify/zones.h",
    "tiles/water/tile_waters.h",
]

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

# Words that only some files may use: (pattern, files that may, why).
WORDS = [
    (r"quality\.effort\b(?!\s*=[^=])", [r"src/pieces/(recipe|conflicts|checks)\.cpp$", r"src/simplify/point_recipe\.cpp$", r"src/session/", r"apps/"],
     "what an effort means is decided in the recipe of a run (src/pieces/recipe.h): read Recipe::traits"),
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


# Namespaces of rooms whose names differ from the room's. The public functions simplify() and measure() have the other two.
NAMESPACES = {"base": None, "simplify": "run", "measure": "judge", "session": "cli"}


def judge_namespace(path, line):
    """The fault of the beginning of a namespace in a file of src, or None. Public names are in scarp itself."""
    match = re.match(r"namespace scarp(?:::(\w+))?", line)
    if not match:
        return None
    room = path.parts[1] if path.parts[0] == "src" else "session"
    own = NAMESPACES.get(room, room)
    allowed = {None, own} | ({"gdal"} if path.parts[1:3] == ("io", "gdal") else set())
    allowed |= {"HWY_NAMESPACE", "detail"} if room == "base" else set()
    return None if match.group(1) in allowed else f"the names of this room are in scarp{'::' + own if own else ''}"


def room_of_header(header):
    """The room of a header as `#include "header"` names it; "loose" if in none."""
    parts = header.split("/")
    depth = 2 if parts[0] in ("session", "tiles") else 1
    return "/".join(parts[:depth]) if len(parts) > depth else "loose"


def bare(text):
    """The text without comments, strings and directives."""
    text = re.sub(r'//[^\n]*|"(?:\\.|[^"\\\n])*"', " ", text)
    return re.sub(r"^[ \t]*#.*(?:\\\n.*)*$", "", text, flags=re.M)


def declared_functions(text):
    """Names of the functions and member functions that a header declares without a body: `f`, `Type::f`."""
    scopes, words = [], ""
    tokens = re.finditer(r"[{};]|[^{};]+", bare(text))
    for token in tokens:
        token = token.group()
        if token == "{":
            scope = re.search(r"\b(namespace|struct|class)\b\s*(\w*)[^;()]*$", words)
            if scope and not re.search(r"\benum\b", words):
                scopes.append(scope.group(2) if scope.group(1) != "namespace" else "")
                words = ""
                continue
            depth = 1
            while depth:  # a body, an enumeration or a value
                inner = next(tokens).group()
                depth += (inner == "{") - (inner == "}")
            words = "" if re.search(r"\)[\s\w]*(:[^:].*)?$", words, re.S) and not re.search(r"=\s*$", words) else words + "0"
        elif token == "}":
            scopes, words = scopes[:-1], ""
        elif token == ";":
            words = re.sub(r"\b(public|private|protected)\s*:", "", words).strip()
            name = re.match(r"(?:[^()=]*[\s*&>])?(~?\w+|operator\W+?)\(", words)
            if name and not re.match(r"using|friend|typedef|static_assert", words) and not re.search(r"=\s*(0|delete|default)$", words):
                yield "::".join(filter(None, [*scopes, name.group(1)]))
            words = ""
        else:
            words += token


# `Type name(` at the beginning of a line, or `Type Class::name(`; its body follows the parameters.
DEFINITION = re.compile(r"^(?![ \t}]|return|else|using|namespace)(?:[^;{}()\n=]*[\s*&>])?((?:\w+::)*(?:~?\w+|operator\W+?))\(", re.M)
STUBS = "src/simplify/without_lines.cpp"  # replaces rooms of lines in a build without them


def defined_functions(text):
    """Names of the functions that a source of namespace scarp defines, except in nameless namespaces."""
    text = re.sub(r"^namespace \{.*?^\}", "", bare(text), flags=re.M | re.S)
    if not re.search(r"^namespace scarp(::gdal)? \{", text, re.M):
        return
    for match in DEFINITION.finditer(text):
        at, depth = match.end(), 1
        while at < len(text) and depth:
            depth += (text[at] == "(") - (text[at] == ")")
            at += 1
        if re.match(r"[\s\w]*(:[^:;]|\{|=\s*default)", text[at:at + 80]):
            yield match.group(1)


@functools.cache
def public_functions(tree):
    """By name, public functions and classes with functions: the header that declares each, the rooms that define it."""
    found = {}
    texts = {path.stem: path.read_text(encoding="utf-8") for path in sorted((tree / "include/scarp").glob("*.h"))}
    for header, text in texts.items():
        classes = set(re.findall(r"^class (\w+)", text, re.M))
        for name in declared_functions(text):
            kind, _, member = name.partition("::")
            if not member or kind in classes:
                found.setdefault(kind, (set(), set(), set()))[0].add(header)
                found[kind][2].add(name)
    for path in sorted((tree / "src").rglob("*.cpp")):
        if path.relative_to(tree).as_posix() == STUBS:
            continue
        defined = {name.removeprefix("scarp::") for name in defined_functions(path.read_text(encoding="utf-8"))}
        reached = reached_headers(path, tree)[0]
        for name in defined:
            headers, rooms, names = found.get(name.partition("::")[0], ((), None, ()))
            if name in names and reached & headers:
                rooms.add(room_of(path.relative_to(tree)))
    return found


@functools.cache
def includes_of(path):
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(encoding="utf-8"), re.M)


@functools.cache
def reached_headers(path, tree):
    """The names of public headers, and other headers, that a file includes directly or indirectly."""
    public, others, pending = set(), set(), [path]
    while pending:
        for header in includes_of(pending.pop()):
            if header.startswith("scarp/"):
                file = tree / "include" / header
                if file.is_file() and file.stem not in public:
                    public.add(file.stem)
                    pending.append(file)
            elif (file := tree / "src" / header).is_file() and file not in others:
                others.add(file)
                pending.append(file)
    return public, others


# `Type name(` at the beginning of a line, indented or not.
DECLARATION = re.compile(r"^[ \t]*(?!return|else|co_return|throw)(?:(?:const|static|inline|virtual|explicit)\s+)*[\w:]+(?:<[^;={}]*>)?[&*]*\s+[&*]*(\w+)\(",
                         re.M)


@functools.cache
def own_names(path):
    """The file's own functions, including those of nameless namespaces and members, and its types."""
    text = bare(path.read_text(encoding="utf-8"))
    names = {match.group(1).rpartition("::")[2] for match in DEFINITION.finditer(text)}
    names |= set(DECLARATION.findall(text)) | set(re.findall(r"\bauto&?&? (\w+) = \[", text))
    return names | set(re.findall(r"\b(?:class|struct|using|typename)\s+(\w+)\b(?!\s*;)", text))


def judge_step(room, top):
    """The fault of a use of something that a room implements, or None."""
    floor, may_include, doors, _ = ROOMS[room]
    if top == room or top in may_include or (doors is not ANY and top in doors) or (doors is ANY and ROOMS[top][0] < floor):
        return None
    if ROOMS[top][0] == floor:
        return f"{room} and {top} are strangers on floor {floor}"
    if ROOMS[top][0] > floor:
        return f"a step upwards from {room} (floor {floor}) to {top} (floor {ROOMS[top][0]})"
    return f"{room} must not know {top}"


def judge_uses(path, room, tree):
    """Sentences about the public functions and classes that a file uses."""
    public, others = reached_headers(tree / path, tree)
    text = bare((tree / path).read_text(encoding="utf-8"))
    words = set(re.findall(r"(?<![\w.>:])(?:scarp::)?([a-z]\w*)\(|(?<![\w.>])([A-Z]\w*)\b", text))
    taken = None
    for word in sorted({one or other for one, other in words} & public_functions(tree).keys()):
        headers, rooms, _ = public_functions(tree)[word]
        faults = [judge_step(room, top) for top in sorted(rooms)]
        if not headers & public or not faults or None in faults or re.search(rf"^class {word};", text, re.M):
            continue
        taken = taken or set().union(own_names(tree / path), *(own_names(other) for other in others))
        if word not in taken:
            yield f"{path}: uses {word} of scarp/{sorted(headers & public)[0]}.h, which the room {sorted(rooms)[0]} implements: {faults[0]}"


def judge_project_include(path, room, header, tree):
    """The fault of `#include "header"` in this file, or None."""
    floor, may_include, _, _ = ROOMS[room]
    top = room_of_header(header)
    if header.startswith("scarp/"):
        return None if (tree / "include" / header).is_file() else f"there is no include/{header}"
    if header in SHOWN and (room == "apps" or room.startswith("session/")):
        return judge_step(room, top) if (tree / "src" / header).is_file() else f"there is no src/{header}"
    if room == "apps":
        if (tree / "apps" / path.parts[1] / header).is_file():
            return None
        if top in may_include and (tree / "src" / header).is_file():
            return None
        return "apps may include scarp/*.h, session/, headers of their own program and those of SHOWN only"
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
    is_public = room == "door" and path.name != "scarp.h"
    if is_public or "/".join(path.parts[1:]) in SHOWN:
        if "#pragma GCC visibility push(default)" not in lines:
            yield f"{path}: a public or shown header pushes default visibility, or a shared library hides it"
    if is_public:
        if f'#include "scarp/{path.name}"' not in (tree / path.with_name("scarp.h")).read_text(encoding="utf-8"):
            yield f"{path}: scarp.h does not include it, which has all public headers"
        lost = sorted(name for name, (headers, rooms, _) in public_functions(tree).items() if path.stem in headers and not rooms)
        if lost:
            yield f"{path}: no source of src that includes it defines {', '.join(lost)}"
    elif room != "door":
        yield from judge_uses(path, room, tree)
    if len(lines) > MAX_LINES:
        yield f"{path}: {len(lines)} lines, more than {MAX_LINES}: split it by concept"
    for number, line in enumerate(lines, 1):
        for pattern, allowed, why in WORDS:
            if re.search(pattern, line) and not any(re.match(place, path.as_posix()) for place in allowed):
                yield f"{path}:{number}: {line.strip()}: {why}"
        if path.parts[0] != "include" and (wrong := judge_namespace(path, line)):
            yield f"{path}:{number}: {line}: {wrong}"
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
    for room, (floor, may_include, doors, holds) in sorted(reversed(ROOMS.items()), key=lambda row: -row[1][0]):
        rooms = ", ".join(f"`{name}`" for name in may_include)
        known = "public functions of all rooms below" if doors is ANY else ", ".join(f"`{name}`" for name in doors)
        known = f"public functions of {known}" if doors else known
        print(f"| {floor} | `{room}` | {holds} | {'; '.join(filter(None, [rooms, known]))} |")


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
