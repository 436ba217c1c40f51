#!/usr/bin/env python3
"""Writes the reference of the Python package as Markdown from the docstrings of bindings/python.

usage: python_reference.py FILE.md
"""
import ast
import pathlib
import sys
import textwrap

root = pathlib.Path(__file__).resolve().parent.parent
package = root / "bindings" / "python" / "src" / "scarp"
# Public names by module.
PUBLIC = [("__init__", ["simplify", "simplify_points", "measure", "volume"]), ("mesh", ["read_mesh", "Mesh", "Report", "Volumes"]),
          ("live", ["Live", "Cell", "Changes"]), ("refiner", ["Refiner"]), ("tiles", ["tile", "Tiles"]), ("_call", ["Progress"]),
          ("errors", ["ScarpError", "UsageError", "InputError", "PromiseError", "OutputError", "Cancelled",
                      "InternalError", "ScarpWarning"]),
          ("compat/pydelatin/__init__", ["Delatin"]),
          ("compat/pydelatin/util", ["decode_ele", "rescale_positions", "latitude_adjustment"])]


def text_of(node):
    doc = ast.get_docstring(node)
    return "```text\n%s\n```\n" % doc if doc else ""


def signature(node, name):
    arguments = ast.unparse(node.args)
    for own in ("self, ", "self", "cls, "):
        if arguments.startswith(own):
            arguments = arguments[len(own):]
            break
    line = "%s(%s)" % (name, arguments)
    line += " -> " + ast.unparse(node.returns) if node.returns else ""
    return textwrap.fill(line, 115, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)


def is_property(node):
    return any(ast.unparse(decorator) == "property" for decorator in node.decorator_list)


def describe_class(node, name):
    bases = ", ".join(ast.unparse(base) for base in node.bases)
    parts = ["## %s%s\n" % (name, "(%s)" % bases if bases else ""), text_of(node)]
    lines = (package / (module + ".py")).read_text().split("\n")
    for member in node.body:
        if isinstance(member, ast.AnnAssign) and isinstance(member.target, ast.Name) and bases == "NamedTuple":
            comment = lines[member.end_lineno - 1].partition("#: ")[2]
            note = ": " + comment if comment else ""
            parts.append("- `%s: %s`%s" % (member.target.id, ast.unparse(member.annotation), note))
        if not isinstance(member, ast.FunctionDef):
            continue
        if member.name == "__init__" and name not in ("Mesh",):
            parts.append("```python\n%s\n```\n" % signature(member, name))
        if member.name.startswith("_") or not ast.get_docstring(member):
            continue
        title = member.name if is_property(member) else signature(member, member.name)
        returns = " -> " + ast.unparse(member.returns) if is_property(member) and member.returns else ""
        parts.append("### %s.%s\n" % (name, member.name))
        parts.append("```python\n%s%s\n```\n\n%s" % (title, returns, text_of(member)))
    return parts


parts = ["# Python: reference\n", "Written by `tools/python_reference.py` from the docstrings. [The guide](guide/python.md) leads through "
         "it.\n", text_of(ast.parse((package / "__init__.py").read_text()))]
for module, names in PUBLIC:
    tree = ast.parse((package / (module + ".py")).read_text())
    found = {node.name: node for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    for name in names:
        node = found[name]
        if isinstance(node, ast.ClassDef):
            parts += describe_class(node, name)
        else:
            parts += ["## %s\n" % name, "```python\n%s\n```\n" % signature(node, name), text_of(node)]
        parts.append("")
text = "\n".join(parts).rstrip() + "\n"
while "\n\n\n" in text:
    text = text.replace("\n\n\n", "\n\n")
pathlib.Path(sys.argv[1]).write_text(text, encoding="utf-8")
