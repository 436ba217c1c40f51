#!/usr/bin/env python3
"""The code of a guide, for the test that runs it.

usage: guide_blocks.py FILE LANGUAGE [NUMBER]     prints the fenced blocks of the language, or one of them (from 0)
       guide_blocks.py --check TREE               checks that each block of docs/guide and of all READMEs has a
                                                  test: tests/program/guide_blocks.tsv
"""
import pathlib
import re
import sys

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)


def blocks_of(path, language):
    return [code for tag, code in FENCE.findall(path.read_text(encoding="utf-8")) if tag == language]


def check(tree):
    claims = {}
    for line in (tree / "tests/program/guide_blocks.tsv").read_text().splitlines():
        if line and not line.startswith("#"):
            file, language, test = line.split("\t")
            claims[file, language] = test
    found = set()
    for path in sorted([tree / "README.md", *tree.glob("docs/guide/*.md"), *tree.glob("bindings/*/README.md")]):
        text, file = path.read_text(encoding="utf-8"), str(path.relative_to(tree))
        found |= {(file, tag) for tag, _ in FENCE.findall(text)}
        if re.search(r"^    \S", re.sub(r"^ {4,}hint .*$", "", FENCE.sub("", text), flags=re.M), re.M):
            found.add((file, "indented"))
    faults = [f"{file}: no test runs its blocks of '{tag}'" for file, tag in sorted(found - set(claims))]
    faults += [f"{file}: it has no block of '{tag}' any more" for file, tag in sorted(set(claims) - found)]
    for (file, tag), test in claims.items():
        name = "docs/guide" if tag in ("indented", "text") else pathlib.Path(file).name
        if name not in (tree / test).read_text():
            faults.append(f"{test} does not run the blocks of '{tag}' of {file}")
    print("\n".join(faults) or f"{len(found)} kinds of blocks have tests")
    return len(faults) > 0


def main():
    if sys.argv[1] == "--check":
        sys.exit(check(pathlib.Path(sys.argv[2])))
    blocks = blocks_of(pathlib.Path(sys.argv[1]), sys.argv[2])
    if not blocks:
        sys.exit(f"{sys.argv[1]} has no block of {sys.argv[2]}")
    print("".join(blocks) if len(sys.argv) < 4 else blocks[int(sys.argv[3])], end="")


main()
