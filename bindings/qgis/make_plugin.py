#!/usr/bin/env python3
"""Packs the plugin: make_plugin.py PROGRAM OUTPUT.zip [--publish]. The same program gives the same bytes.

SCARP_PLUGIN_EMAIL is the address of who publishes it, and SCARP_PLUGIN_URL the page of the repository, whose /issues are
the tracker. Without them both are examples, which the plugin site refuses, and so does --publish.
"""

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

sys.dont_write_bytecode = True  # the sources stay as they are
import icon  # noqa: E402

HERE = Path(__file__).resolve().parent
NAME = "scarp_processing"
EXAMPLES = {"EMAIL": "none@example.org", "URL": "https://example.org/scarp"}
SHAPES = {"EMAIL": r"[^@\s]+@[^@\s]+\.[^@\s]+", "URL": r"https?://[^/\s]+\S*"}


def read_publisher(is_published):
    """The settings; SystemExit where one is missing or no address."""
    found = {}
    for key, example in EXAMPLES.items():
        value = found[key] = os.environ.get("SCARP_PLUGIN_" + key) or example
        if not re.fullmatch(SHAPES[key], value):
            sys.exit(f"SCARP_PLUGIN_{key} is '{value}': give an address such as {example}")
        if is_published and "example.org" in value:
            sys.exit(f"the plugin site wants a real address: set SCARP_PLUGIN_{key}, which is {value}")
    return found


def main():
    is_published = "--publish" in sys.argv[3:]
    program, output = sys.argv[1], Path(sys.argv[2])
    publisher = read_publisher(is_published)
    table = subprocess.run([program, "help", "--json"], check=True, stdout=subprocess.PIPE).stdout
    version = subprocess.run([program, "version"], check=True, stdout=subprocess.PIPE, text=True).stdout.split()[1]
    files = {path.name: path.read_bytes() for path in (HERE / NAME).glob("*.py")}
    files["options.json"] = table
    metadata = (HERE / NAME / "metadata.txt.in").read_text()
    for key, value in {"VERSION": version, **publisher}.items():
        metadata = metadata.replace(f"@{key}@", value)
    files["metadata.txt"] = metadata.encode()
    files["icon.png"] = icon.draw()
    files["LICENSE"] = (HERE.parent.parent / "LICENSE").read_bytes()
    output.parent.mkdir(parents=True, exist_ok=True)
    whole = output.with_name(output.name + ".part")
    with zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(files):
            entry = zipfile.ZipInfo(f"{NAME}/{name}", (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, files[name])
    whole.replace(output)
    note = "" if is_published else "; to upload it, set SCARP_PLUGIN_EMAIL and SCARP_PLUGIN_URL, and add --publish"
    print(f"{output}: {output.stat().st_size} bytes{note}")


if __name__ == "__main__":
    main()
