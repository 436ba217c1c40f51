#!/usr/bin/env python3
"""Packs the plugin: make_plugin.py PROGRAM OUTPUT.zip. The same program gives the same bytes."""

import subprocess
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
NAME = "scarp_processing"


def main():
    program, output = sys.argv[1], Path(sys.argv[2])
    table = subprocess.run([program, "help", "--json"], check=True, stdout=subprocess.PIPE).stdout
    version = subprocess.run([program, "version"], check=True, stdout=subprocess.PIPE, text=True).stdout.split()[1]
    files = {path.name: path.read_bytes() for path in (HERE / NAME).glob("*.py")}
    files["options.json"] = table
    files["metadata.txt"] = (HERE / NAME / "metadata.txt.in").read_text().replace("@VERSION@", version).encode()
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
    print(f"{output}: {output.stat().st_size} bytes")


if __name__ == "__main__":
    main()
