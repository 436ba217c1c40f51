#!/usr/bin/env python3
"""The byte table: one hash of all output files of a run, for each set of options (options.txt) and each raster
(make_inputs.py), in memory and streamed. A failed run has its exit code there.

usage: table.py PROGRAM DEM TABLE [--update | memory | streamed]     in an empty folder; memory, streamed: those runs only

SCARP_CLIENT: the client of start_once/, with whose server the program is loaded once (program/lib.sh).

Compares with TABLE or writes it. The hash excludes the program's version, which most files contain."""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import zipfile

# File, height of a step or ridge, and a --memory too small for the samples: `hills` and `coast` stay in their file,
# `fault` and `town` are kept in 16 bits.
RASTERS = {"fault": ("fault.tif", 80, "72900k"), "hills": ("hills.bil", 200, "72260k"),
           "coast": ("coast.bil", 200, "72260k"), "town": ("town.bil", 8, "72260k")}
FILES = {"lines": "lines.geojson", "hard": "hard.geojson", "river": "river.geojson", "pond": "pond.geojson", "site": "site.geojson",
         "cut": "cut.geojson", "mask": "mask.bil", "near": "near.bil", "photo": "photo.ppm", "steps": "steps.txt"}


def contents(path):
    """Contents of a file, or of each file in an archive, whose checksums depend on the version."""
    if not zipfile.is_zipfile(path):
        return [(path.name, path.read_bytes())]
    with zipfile.ZipFile(path) as archive:
        return [(name, archive.read(name)) for name in archive.namelist()]


def hash_of(folder, version):
    digest = hashlib.sha256()
    for path in sorted(folder.iterdir()):
        for name, data in contents(path):
            digest.update(name.encode() + b"\0" + version.sub(rb"\1", data))
    return digest.hexdigest()[:12]


def run(program, version, number, line, raster, is_streamed):
    words = line.split()
    from_points = words[0] == "points"
    ending, options = words[from_points], words[1 + from_points:]
    source, step, memory = RASTERS[raster]
    names = {key: os.path.abspath(f"{raster}.{end}") for key, end in FILES.items()} | {"step": step}
    source = f"{raster}.points.csv" if from_points else source
    folder = pathlib.Path(f"{number}.{raster}.{'streamed' if is_streamed else 'memory'}")
    folder.mkdir()
    words = ["simplify", source, str(folder / f"out.{ending}"), *(word.format(**names) for word in options),
             *(["--memory", memory] if is_streamed else []), "-q", "-j", "1"]
    messages = pathlib.Path(f"{folder}.messages")
    with open(messages, "wb") as file:
        code = subprocess.run([*program, *words], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=file, close_fds=False).returncode
    if code:
        return f"exit {code}", messages.read_text().strip().replace(os.getcwd() + "/", "")
    return hash_of(folder, version), ""


def main():
    program, dem, table = (os.path.abspath(path) for path in sys.argv[1:4])
    left_out = {"memory": ["streamed"], "streamed": ["memory"]}.get(sys.argv[-1], [])
    number = subprocess.run([program, "--version"], stdout=subprocess.PIPE, check=True).stdout.split()[-1]
    version = re.compile(rb"([Ss]carp[ -~]{1,80}?)" + re.escape(number))
    lines = (pathlib.Path(__file__).parent / "options.txt").read_text().splitlines()
    lines = [line for line in lines if line and not line.startswith("#")]
    formats = json.loads(subprocess.run([program, "help", "--json"], stdout=subprocess.PIPE, check=True).stdout)["formats"]
    endings = [each["endings"][0][1:] for each in formats if not each["solids_only"]]
    lines = [line.replace("MESH", ending, 1) for line in lines for ending in (endings if line.startswith("MESH ") else [""])]
    subprocess.run([sys.executable, str(pathlib.Path(__file__).parent / "make_inputs.py"), dem], check=True)
    jobs = [(number, line, raster, is_streamed) for number, line in enumerate(lines) for raster in RASTERS
            for is_streamed in (False, True) if not (is_streamed and line.startswith("points"))
            and ("streamed" if is_streamed else "memory") not in left_out]
    start = [os.environ["SCARP_CLIENT"], program] if "SCARP_CLIENT" in os.environ else [program]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 2) as pool:
        results = list(pool.map(lambda job: run(start, version, *job), jobs))
    rows, sentences = {}, {}
    for (_, line, raster, is_streamed), (result, sentence) in zip(jobs, results):
        row = f"{line} | {'streamed' if is_streamed else 'memory'}"
        rows.setdefault(row, {})[raster] = result
        sentences[row, raster] = sentence
    text = "".join(f"{row} | {' '.join(f'{raster}={result}' for raster, result in of.items())}\n" for row, of in rows.items())
    if "--update" in sys.argv:
        pathlib.Path(table).write_text(text)
    had = dict(line.rsplit(" | ", 1) for line in pathlib.Path(table).read_text().splitlines()
               if line.split(" | ")[-2] not in left_out)
    have = dict(line.rsplit(" | ", 1) for line in text.splitlines())
    faults = [row for row in {**had, **have} if had.get(row) != have.get(row)]
    for row in faults:
        print(f"{row}\n  was {had.get(row)}\n  is  {have.get(row)}")
        print("".join(f"  {raster}: {sentences[row, raster]}\n" for raster in RASTERS if sentences.get((row, raster))), end="")
    if "--sentences" in sys.argv:
        for (row, raster), sentence in sentences.items():
            if sentence:
                print(f"{row} | {raster}: {sentence}")
    refused = sum(result.startswith("exit") for of in rows.values() for result in of.values())
    print(f"byte table: {len(lines)} sets of options, {len(jobs)} runs, {refused} refused, {len(faults)} rows differ")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
