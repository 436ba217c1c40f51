#!/usr/bin/env python3
"""Checks the words of comments, help and docs.

usage: check_words.py [TREE]

- No comment or docstring begins with a fragment (FRAGMENTS): "Whether x" is "True if x", "Of the line" is "The max error
  of the line", "What the mesh holds" is "The contents of the mesh".
- No comment, docstring or help text has one of the words in WORDS, but in code: `take`, "left out", look().
- No line of Markdown outside tables and code blocks has one of these words (except "take" and "look"), or more than 160
  characters, which are hard to read in a terminal.
"""

import pathlib
import re
import subprocess
import sys

import comments

MAX_CHARACTERS = 160
GENERATED = {"build", "demo", "node_modules", "shared"}  # untracked files in a tree without git
FROZEN = {"tests/abi/scarp_c_1.h"}  # a released header

FRAGMENTS = ("Of", "What", "That", "Whether", "Where", "Which", "As")
# Words and their replacements.
WORDS = {
    "tell tells told telling": "print, report, show, distinguish",
    "say says said saying": "report, declare, hold",
    "look looks looked looking": "check, examine, read, scan, search",
    "take takes took taken taking": "use, accept, need, read",
    "let lets letting": "allow, keep",
    "leave/out leaves/out leaving/out left/out": "omit, exclude",
    "beside": "next to, with, in addition to",
    "nobody": "no caller, no thread, unknown",
    "lay lays laid laying": "place, drape",
    "go/on goes/on went/on going/on gone/on": "continue",
}
COMMON = set("look looks looked looking take takes took taken taking".split())  # allowed in pages
FRAGMENT = re.compile(rf"\s*({'|'.join(FRAGMENTS)})\b", re.IGNORECASE)
ADVICE = {word.replace("/", " "): advice for words, advice in WORDS.items() for word in words.split()}
WORD = re.compile(r"(?<![\w.:/$-])(%s)(?![\w(:-]|\.\w|->)" % "|".join(
    f"[{word[0].upper()}{word[0]}]{word[1:]}".replace(" ", r"\s+") for word in sorted(ADVICE, key=len, reverse=True)))
CODE = re.compile(r"``.*?``|`[^`]*`|\"[^\"]*\"|“[^”]*”", re.DOTALL)
LITERAL = r"\"(?:[^\"\\\n]|\\.)*\""
HELP = {"option_rows": re.compile(rf"\.(help|brief|by_default) =((?:\s*{LITERAL})+)"),
        "command_table": re.compile(rf"()({LITERAL})")}  # by the beginning of file names


def list_files(tree):
    """The tracked files; all files if the tree is no checkout."""
    listed = subprocess.run(["git", "-C", str(tree), "ls-files", "-z"], capture_output=True, text=True)
    if listed.stdout:
        return [tree / name for name in listed.stdout.split("\0") if name]
    folders = {path: path.relative_to(tree).parts[:-1] for path in tree.rglob("*") if path.is_file()}
    return sorted(path for path, parts in folders.items()
                  if not any(part in GENERATED or part.startswith((".", "build-")) for part in parts))


def find_page_faults(text):
    """(number, complaint) for each line of prose that is too long or has a word of WORDS, except COMMON."""
    in_block, prose = False, []
    for number, line in enumerate(text.split("\n"), 1):
        is_fence = line.lstrip().startswith("```")
        in_block ^= is_fence
        is_prose = not (is_fence or in_block or line.startswith(("|", "    ")))
        prose.append(line if is_prose else "")
        if is_prose and len(line) > MAX_CHARACTERS:
            yield number, f"{len(line)} characters, at most {MAX_CHARACTERS}"
    yield from find_words(1, "\n".join(prose), COMMON)


def find_words(line, text, allowed=frozenset()):
    """(number, complaint) for each word of WORDS in a text that begins at `line`."""
    plain = CODE.sub(lambda code: re.sub(r"[^\n]", "_", code.group()), text)
    for found in WORD.finditer(plain):
        word = " ".join(found.group().split())
        if word.lower() not in allowed:
            yield line + plain.count("\n", 0, found.start()), f'"{word}": {ADVICE[word.lower()]}'


def find_comment_faults(path, text):
    for line, comment in comments.find_comments(path, text):
        begin = FRAGMENT.match(comment)
        if begin:
            yield line, f'a comment begins with "{begin.group(1)}": use a noun or a sentence'
        yield from find_words(line, comment)


def find_help_faults(path, text):
    for name, pattern in HELP.items():
        for found in pattern.finditer(text) if path.name.startswith(name) else ():
            line = text.count("\n", 0, found.start(2)) + 1
            words = re.sub(LITERAL, lambda literal: f" {literal.group()[1:-1]} ", found.group(2)).replace('\\"', "`")
            begin = FRAGMENT.match(words)
            if begin and found.group(1) in ("help", "brief"):
                yield line, f'a help text begins with "{begin.group(1)}": use a noun or a verb'
            yield from find_words(line, words.replace("\\n", "  "))


def main():
    tree = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent)
    faults, pages, sources = [], 0, 0
    for path in list_files(tree):
        name = path.relative_to(tree)
        if not path.exists():
            continue
        if path.suffix == ".md":
            pages += 1
            found = find_page_faults(path.read_text(encoding="utf-8"))
        elif comments.is_known(path) and str(name) not in FROZEN:
            sources += 1
            text = path.read_text(encoding="utf-8", errors="replace")
            found = [*find_comment_faults(path, text), *find_help_faults(path, text)]
        else:
            continue
        faults += [f"{name}:{line}: {complaint}" for line, complaint in found]
    if pages + sources == 0:
        sys.exit(f"{tree} holds no page of Markdown and no source")
    print("\n".join(faults) if faults else f"the words of {sources} sources and {pages} pages are fine")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
