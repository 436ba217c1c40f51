"""CSV tables, and the documents that hold them between `<!-- table: NAME -->` and `<!-- end -->`."""

import csv
import re


def read_table(path):
    """Rows as dictionaries; none where there is no file."""
    if not path.exists():
        return []
    with open(path, newline="") as stream:
        return list(csv.DictReader(stream))


def markdown(header, rows):
    """Lines of a table."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]


def fill(text, found):
    """The text with every table filled again; those that were not found stay as they are."""
    def one(match):
        name = match.group(1)
        if name not in found:
            return match.group(0)
        return f"<!-- table: {name} -->\n" + "\n".join(found[name]) + "\n<!-- end -->"

    return re.sub(r"<!-- table: (\w+) -->\n.*?<!-- end -->", one, text, flags=re.DOTALL)
