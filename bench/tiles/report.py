#!/usr/bin/env python3
"""Writes the tables of bench/tiles.md from tiles.csv, tiles_seconds.csv and ctb.csv.

  report.py            writes them
  report.py --check    fails if the document would change
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
DOCUMENT = HERE.parent / "tiles.md"
sys.path.insert(0, str(HERE.parent))
from tables import fill, markdown, read_table  # noqa: E402

NAMES = {"ctb": "", "martini": "martini", "fast": "Scarp `fast`", "normal": "Scarp `normal`",
         "high": "Scarp `high`"}


def number(text):
    return f"{float(text):,.0f}" if text else "–"


def row_of(row):
    differ = f"{number(row['edges_differ'])} of {number(row['edges'])}" if row["edges"] else "–"
    if row.get("edges_places_differ") not in (None, "", "0"):
        differ += f", {number(row['edges_places_differ'])} by their vertices"
    return [NAMES[row["maker"]], number(row["triangles"]), number(row["bytes"]),
            f"{float(row['error_median']):,.1f} / {float(row['error_worst']):,.1f} m", differ]


def main():
    rows, others = read_table(HERE / "tiles.csv"), read_table(HERE / "ctb.csv")
    seconds = read_table(HERE / "tiles_seconds.csv")
    header = ["triangles a tile", "bytes a tile", "true error, median / worst tile", "edges that differ"]
    tables = {f"level_{z}": markdown(["", *header], [row_of(row) for row in rows if row["level"] == str(z)]) for z in (12, 10, 8)}
    tables["ctb"] = markdown(["level, asked", *header], [[f"{row['level']}, {row['asked']} m", *row_of(row)[1:]] for row in others])
    tables["time"] = markdown(["", "CPU ms a tile"], [[NAMES[row["maker"]], f"{float(row['cpu_ms']):.1f}"] for row in seconds])
    text = DOCUMENT.read_text()
    filled = fill(text, tables)
    if "--check" in sys.argv[1:]:
        sys.exit(filled != text and f"{DOCUMENT.name} is not what bench/tiles/report.py writes")
    DOCUMENT.write_text(filled)


main()
