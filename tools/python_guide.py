#!/usr/bin/env python3
"""Runs the code of docs/guide/python.md and robotics.md, bindings/python/README.md and README.md from top to bottom in a
folder with the examples.

usage: tools/python_guide.py [--pictures]     --pictures: saves its pictures in docs/guide/images

Needs the package scarp on the path, numpy and matplotlib.
"""
import os
import pathlib
import re
import shutil
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
root = pathlib.Path(__file__).resolve().parent.parent
guide = (root / "docs" / "guide" / "python.md").read_text()
blocks = re.findall(r"```python\n(.*?)```", guide, re.S)
readmes = [re.findall(r"```python\n(.*?)```", (root / page).read_text(), re.S) for page in ("docs/guide/robotics.md", "bindings/python/README.md", "README.md")]
with tempfile.TemporaryDirectory() as folder:
    for example in (root / "data" / "examples").iterdir():
        shutil.copy(example, folder)
    os.chdir(folder)
    exec(compile("\n".join(blocks), "python.md", "exec"), {"__name__": "__main__"})
    for readme in readmes:
        exec(compile("\n".join(readme), "README.md", "exec"), {"__name__": "__main__"})
    drawn = sorted(pathlib.Path(folder).glob("python_*.png"))
    if not drawn:
        sys.exit("the guide draws no picture")
    if "--pictures" in sys.argv[1:]:
        for picture in drawn:
            shutil.copy(picture, root / "docs" / "guide" / "images")
    os.chdir(root)
print("%d blocks ran, %d pictures were drawn" % (len(sum(readmes, blocks)), len(drawn)))
