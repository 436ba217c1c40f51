"""Every remedy in Scarp's messages works.

usage: remedies.py SCARP SOURCE EXAMPLES [NAME...]     (in an empty folder)

Each row of remedies_table.py makes a situation, runs Scarp, extracts the remedy from its output, applies it, and
continues to a result. Then each message in the sources that names a command or an option must have been printed by some
row.
"""
import os
import pathlib
import re
import resource
import shlex
import shutil
import subprocess
import sys

from remedies_table import BASE, NOT_RUN, ROWS

scarp, source, examples = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
PROGRAMS = r"gdal_\w+(?:\.py)?|gdalwarp|gdalbuildvrt|ogr2ogr|xmllint|pdal|printf|echo|gunzip|iconv|tail|bunzip2|unxz|unzstd|7z|unrar|tar|git lfs"
COMMAND = re.compile(rf"\(((?:{PROGRAMS}|scarp) [^()]*)\)|'(scarp [^']*)'|(?:[:,]|as in) (scarp (?:simplify|measure|view|tile) [^(;:,]*)|"
                     rf"\b((?:{PROGRAMS}) -[^()]*?) (?:makes|gives)")
root = pathlib.Path.cwd()
printed = []


class Fault(Exception):
    pass


def shell(command, folder):
    path = f"PATH={shlex.quote(str(scarp.parent))}:{shlex.quote(str(pathlib.Path(sys.executable).parent))}:$PATH; "
    # By the servers of lib.sh.
    once = "".join(f'{name}() {{ "$SCARP_CLIENT" {shlex.quote(str(program))} "$@"; }}; ' for name, program in
                   (("scarp", scarp), ("gdal_translate", os.environ.get("SCARP_GDAL_TRANSLATE"))) if program and "SCARP_CLIENT" in os.environ)
    done = subprocess.run(["timeout", "600", "bash", "-c", path + once + command], cwd=folder, capture_output=True, text=True, errors="replace")
    printed.append(done.stdout + done.stderr)
    return done.returncode, (done.stdout + done.stderr).replace("scarp: warning: ", "")


def commands_in(text):
    found = [next(filter(None, groups)).strip() for groups in COMMAND.findall(text)]
    return [part.strip() for command in found for part in command.split("; where it holds several rasters ")]


def fill(command, values):
    for name, value in values.items():
        command = re.sub(rf"(?<![\w.-]){re.escape(name)}(?![\w.-])", value, command)
    return command


def replaced(command):
    """The file that a command reads and the one it makes."""
    words = shlex.split(command.split("&& gdal_edit.py")[0].split("&&")[-1])
    if words[0] == "ogr2ogr":
        return words[-1].removeprefix("CSV:"), words[-2]
    if words[0] in ("gunzip", "bunzip2", "unxz", "unzstd"):
        return words[-1], words[-1].rsplit(".", 1)[0]
    if words[0] == "xmllint":
        return words[-3], words[-1]
    if words[0] in ("printf", "echo", "scarp"):  # these change nothing, or a file of that name
        return None, None
    return words[-2], words[-1]


def run_clean(command, folder):
    """Returns the exit code and the output; restores the folder."""
    there = set(folder.iterdir())
    result = shell(command, folder)
    for path in set(folder.iterdir()) - there:
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    return result


def run_first(row, command, folder, results={}):
    """The run before remedies. Rows with the same situation share the result."""
    key = row["make"], command
    if key not in results:
        results[key] = run_clean(command, folder)
    return results[key]


def follow(row, folder):
    """Applies remedies like a user, until the run succeeds and no longer names the first."""
    run, first = row["run"], None
    for step in range(5):
        code, text = run_first(row, run, folder) if step == 0 else run_clean(run, folder)
        if "says" in row and step == 0 and not re.search(row["says"], text):
            raise Fault(f"{run}: prints no {row['says']!r}: {text}")
        if row.get("then") and "way" not in row:
            code, text = run_first(row, row["then"], folder)
            if code != row.get("code", 0) or (code == 0 and re.search(row["says"], text)):
                raise Fault(f"{row['then']}: exit code {code}: {text}")
            return
        found = commands_in(text)
        if code == 0 and row.get("may_go") and first is None and not found:
            return
        if code == 0 and first is not None and first not in [re.sub(r"NEW\d*", "NEW", one) for one in found]:
            return
        if not found:
            raise Fault(f"{run}: exit code {code}, and no command: {text}")
        way = found[row.get("way", 0) if step == 0 else 0]
        if first is not None and re.sub(r"NEW\d*", "NEW", way) == first:
            raise Fault(f"{run}: the remedy changes nothing: {text}")
        first = first or re.sub(r"NEW\d*", "NEW", way)
        command = fill(way, row.get("fill", {}))
        code, text = shell(command, folder)
        if code != 0:
            raise Fault(f"{command}: exit code {code}: {text}")
        if row.get("then"):
            run = row["then"]
            continue
        if command.startswith("scarp "):
            return
        old, new = replaced(command)
        if old is not None:
            is_old = lambda word: word == old or (folder / word).resolve() == pathlib.Path(old).resolve()
            words = [new if is_old(word) else word for word in shlex.split(run)]
            if new not in words:
                raise Fault(f"{run}: {command} reads none of its files")
            run = shlex.join(words)
    raise Fault(f"{row['run']}: no end of remedies")


LITERAL = r'"(?:[^"\\\n]|\\.)*"'
VERBS = "give|take|use|say|set|leave|add|choose|by|with|or|needs|allow|ask for|names|takes|put|see|is|end|mean"
NAMES = [re.compile(rf"\b(?:{PROGRAMS}) [-{{]|(?:first|again|metres|degrees|CRS|straight|coarsened|them|file) \(\{{\}}\)|"
                    r"[('\s]scarp (?:simplify|info|measure|tile|serve|view|generate) "),
         re.compile(rf"(?:\b(?:{VERBS})|[:;,(]) (?:\{{\}} )?--[a-z]"),
         re.compile(r"--[a-z-]+ (?:[A-Z]+ |\{[^}]*\} )?(?:replaces|makes|takes|overrides|cuts|says|names)\b")]
LEFT_OUT = re.compile(r"option_rows_|command_table|/help\.cpp|cannot be combined|reports/(?!(?:feature|shape|solid)_report)|changes nothing")


def sentences():
    """The messages in the sources that name a command or an option, by place."""
    for part in ("src", "apps"):
        for path in sorted((source / part).rglob("*.cpp")):
            if LEFT_OUT.search(str(path)):
                continue
            text = re.sub(r"^\s*#include.*$", "", path.read_text(), flags=re.M)
            text = re.sub(r"(^|\s)//[^\n]*", lambda m: m.group(1), text)
            for match in re.finditer(rf"{LITERAL}(?:\s*{LITERAL})*", text):
                sentence = "".join(word[1:-1] for word in re.findall(LITERAL, match.group(0)))
                sentence = sentence.replace('\\"', '"').replace("\\n", "\n").replace("\\\\", "\\")
                if any(name.search(sentence) for name in NAMES) and not LEFT_OUT.search(sentence):
                    yield f"{path.relative_to(source)}:{text.count(chr(10), 0, match.start()) + 1}", sentence


def pattern_of(sentence):
    parts = re.split(r"\{[^{}]*\}", sentence)
    return re.compile(".*?".join(re.escape(part.replace("{{", "{").replace("}}", "}").strip("\n")) for part in parts))


def main():
    chosen = sys.argv[4:]
    base = root / "base"
    base.mkdir()
    for file in examples.iterdir():
        shutil.copy(file, base / ("whole.tif" if file.name == "dem.tif" else file.name))
    code, text = shell("set -e\n" + BASE, base)
    if code != 0:
        sys.exit(f"the inputs cannot be made: {text}")
    printed.clear()
    faults = 0
    for row in ROWS:
        if chosen and row["name"] not in chosen:
            continue
        folder = root / "row"
        shutil.copytree(base, folder)
        try:
            if row.get("make"):
                before = len(printed)
                code, text = shell("set -e\n" + row["make"], folder)
                del printed[before:]
                if code != 0:
                    raise Fault(f"the situation cannot be made: {text}")
            follow(row, folder)
        except Fault as fault:
            faults += 1
            print(f"{row['name']}: {fault}")
        shutil.rmtree(folder)
        if "SCARP_TIMES" in os.environ:
            now = resource.getrusage(resource.RUSAGE_CHILDREN)
            print(f"{now.ru_utime + now.ru_stime:.2f} s after {row['name']}")
    if chosen:
        sys.exit(faults > 0)
    text = "\n".join(printed)
    count = 0
    for place, sentence in sentences():
        count += 1
        if not pattern_of(sentence).search(text) and not any(part in sentence for part in NOT_RUN):
            faults += 1
            print(f"{place}: no row prints: {sentence}")
    for part in NOT_RUN:
        named = [sentence for _, sentence in sentences() if part in sentence]
        if not named or any(pattern_of(sentence).search(text) for sentence in named):
            faults += 1
            print(f"{'a row prints' if named else 'no source says any more'}: {part}")
    print(f"{len(ROWS)} remedies, {count} sentences")
    sys.exit(faults > 0)


main()
