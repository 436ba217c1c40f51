#!/usr/bin/env python3
"""Fails if a line of Markdown is hard to read in a terminal: more than 160 characters outside tables and code blocks.

usage: check_words.py [TREE]
"""

import pathlib
import subprocess
import sys

MAX_CHARACTERS = 160
GENERATED = {"build", "demo", "node_modules", "shared"}  # where a tree without git has Markdown of others


def list_pages(tree):
    """The tracked pages; all pages where the tree is no checkout."""
    listed = subprocess.run(["git", "-C", str(tree), "ls-files", "-z", "*.md"], capture_output=True, text=True)
    if listed.stdout:
        return [tree / name for name in listed.stdout.split("\0") if name]
    folders = {path: path.relative_to(tree).parts[:-1] for path in tree.rglob("*.md")}
    return sorted(path for path, parts in folders.items()
                  if not any(part in GENERATED or part.startswith((".", "build-")) for part in parts))


def find_long_lines(text):
    """(number, length) of each line that is too long."""
    in_block = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            in_block = not in_block
        elif not in_block and not line.startswith(("|", "    ")) and len(line) > MAX_CHARACTERS:
            yield number, len(line)


def main():
    tree = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent)
    pages = list_pages(tree)
    if not pages:
        sys.exit(f"{tree} holds no page of Markdown")
    faults = [f"{page.relative_to(tree)}:{number}: {length} characters, at most {MAX_CHARACTERS}" for page in pages
              if page.exists() for number, length in find_long_lines(page.read_text(encoding="utf-8"))]
    print("\n".join(faults) if faults else f"no line of {len(pages)} pages is longer than {MAX_CHARACTERS} characters")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
