"""Finds comments and docstrings: find_comments(path, text) yields the line and the text of each.

Comments on successive lines at the same column are one. Supports C and C++, JavaScript and TypeScript, Python, shell
and CMake; other files have none.
"""
import ast
import io
import re
import tokenize

CPP = {".h", ".c", ".cpp", ".inc"}
JAVASCRIPT = {".js", ".mjs", ".ts", ".mts"}
SHELL = {".sh", ".cmake"}
BEFORE_PATTERN = "(,=:[!&|?{};+>"  # characters that precede a regular expression
SPECIAL = re.compile(r'//|/\*|\bR"|["\'`/]')
RAW_STRING = re.compile(r'R"([^(]*)\(')


def end_of_string(text, start):
    """The position after a literal that begins at `start`; a lone quote on its line is one character."""
    quote, at = text[start], start + 1
    while at < len(text) and text[at] != quote and (quote == "`" or text[at] != "\n"):
        at += 2 if text[at] == "\\" else 1
    return at + 1


def end_of_pattern(text, start):
    """The position after a regular expression of JavaScript."""
    at, in_class = start + 1, False
    while at < len(text) and text[at] != "\n" and (in_class or text[at] != "/"):
        at += 1 if text[at] == "\\" else 0
        in_class = text[at:at + 1] == "[" or (in_class and text[at:at + 1] != "]")
        at += 1
    return at + 1


def is_pattern(text, start):
    """True if the / begins a regular expression, judged by the preceding text."""
    before = text[max(0, start - 40):start].rstrip()
    return not before or before[-1] in BEFORE_PATTERN or re.search(r"\breturn$", before) is not None


def c_tokens(text, is_javascript):
    """(position, comment) of each comment, including its // or /* */."""
    at = 0
    while found := SPECIAL.search(text, at):
        start, sign = found.span()[0], found.group()
        at = found.end()
        if sign == "//":
            at = (text + "\n").index("\n", at)
            yield start, text[start:at]
        elif sign == "/*":
            at = text.index("*/", at) + 2
            yield start, text[start:at]
        elif sign == 'R"':
            raw = None if is_javascript else RAW_STRING.match(text, start)
            at = text.index(f'){raw.group(1)}"', at) + len(raw.group(1)) + 2 if raw else end_of_string(text, start + 1)
        elif sign == "/":
            at = end_of_pattern(text, start) if is_javascript and is_pattern(text, start) else at
        elif is_javascript or sign == '"' or (sign == "'" and not text[start - 1:start].isalnum()):
            at = end_of_string(text, start)


def c_comments(text, is_javascript):
    """(line, column, is alone on its line, text) of each line of a // comment, or of a /* */ comment."""
    for place, raw in c_tokens(text, is_javascript):
        start = text.rfind("\n", 0, place) + 1
        if raw.startswith("//"):
            body = re.sub(r"^//[/!]?<?\s?", "", raw)
        else:
            body = re.sub(r"\n\s*\*? ?", "\n", re.sub(r"^/\*+!?<?\s*|\s*\*/$", "", raw))
        column = place - start if raw.startswith("//") else -1
        yield text.count("\n", 0, place) + 1, column, not text[start:place].strip(), body


def python_comments(text):
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            (line, column), body = token.start, re.sub(r"^#+[!:]?\s?", "", token.string)
            yield line, column, not token.line[:column].strip(), body


def shell_comments(text):
    for line, row in enumerate(text.split("\n"), 1):
        found = re.match(r"(\s*)#(?!!)\s?(.*)", row) or re.match(r"([^\"']*\s)#\s(.*)", row)
        if found:
            yield line, len(found.group(1)), not found.group(1).strip(), found.group(2)


def join_lines(comments):
    """Joins comments on successive lines into one."""
    first = last = column = body = None
    for line, at, is_alone, text in comments:
        if first is not None and is_alone and line == last + 1 and at == column and at >= 0:
            last, body = line, f"{body}\n{text}"
            continue
        if first is not None:
            yield first, body
        first, last, column, body = line, line, at, text
    if first is not None:
        yield first, body


def docstrings(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            doc = ast.get_docstring(node)
            if doc:
                yield node.body[0].lineno, doc


def find_comments(path, text):
    if path.suffix in CPP or path.suffix in JAVASCRIPT:
        yield from join_lines(c_comments(text, path.suffix in JAVASCRIPT))
    elif path.suffix == ".py":
        yield from docstrings(text)
        yield from join_lines(python_comments(text))
    elif path.suffix in SHELL or path.name == "CMakeLists.txt":
        yield from join_lines(shell_comments(text))


def is_known(path):
    return path.suffix in CPP | JAVASCRIPT | SHELL | {".py"} or path.name == "CMakeLists.txt"
