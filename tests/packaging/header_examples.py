#!/usr/bin/env python3
"""Writes the examples of the public headers as sources, one a header, and a program that runs them all.

usage: header_examples.py FOLDER_OF_HEADERS PAGE OUT

A header begins with a comment, whose lines after "// Example:" are the body of a function that returns a Result. Each
source includes its header first, which also shows that the header compiles alone. The page must name all headers.
"""
import pathlib
import sys

SOURCE = """#include <scarp/{name}.h>

#include <scarp/io.h>
#include <scarp/result.h>

#include <cstdio>

scarp::Result<void> run_{name}();
scarp::Result<void> run_{name}() {{
{body}
  return {{}};
}}
"""
MAIN = """#include <scarp/result.h>

#include <cstdio>

{declarations}
int main() {{
  int faults = 0;
  const auto show = [&](const char* name, const scarp::Result<void>& result) {{
    if (result) return;
    std::printf("the example of %s.h fails: %s\\n", name, result.error().message.c_str());
    ++faults;
  }};
{calls}
  return faults;
}}
"""


def example_of(header):
    """The lines of a header's example."""
    head = header.read_text(encoding="utf-8").split("#pragma once")[0].split("\n")
    if not head[0].startswith("// "):
        sys.exit(f"{header.name} does not begin with what one does with it")
    if "// Example:" not in head:
        sys.exit(f"{header.name} has no example")
    lines = head[head.index("// Example:") + 1:]
    lines = lines[:next((i for i, line in enumerate(lines) if line and not line.startswith("//     ") and line != "//"), len(lines))]
    return "\n".join(line.removeprefix("//   ").rstrip() for line in lines if line != "//").rstrip()


def main():
    headers, page, out = (pathlib.Path(word) for word in sys.argv[1:])
    out.mkdir(parents=True, exist_ok=True)
    names = sorted(header.stem for header in headers.glob("*.h"))
    text = page.read_text(encoding="utf-8")
    for name in names:
        if f"`{name}.h`" not in text:
            sys.exit(f"{page.name} does not name {name}.h")
        body = example_of(headers / f"{name}.h")
        (out / f"{name}.cpp").write_text(SOURCE.format(name=name, body=body), encoding="utf-8")
    (out / "main.cpp").write_text(MAIN.format(
        declarations="".join(f"scarp::Result<void> run_{name}();\n" for name in names),
        calls="\n".join(f'  show("{name}", run_{name}());' for name in names)), encoding="utf-8")


main()
