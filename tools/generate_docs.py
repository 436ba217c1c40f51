#!/usr/bin/env python3
"""Writes the man page, the completions and pages of all options and conflicts from the program's tables.

usage: generate_docs.py PROGRAM FOLDER

PROGRAM is build/bin/scarp, whose `help --json` prints the tables. FOLDER gets man/man1/scarp.1 (packaging/scarp.1.in,
with synopsis and options), bash-completion/completions/scarp, zsh/site-functions/_scarp,
fish/vendor_completions.d/scarp.fish doc/scarp/options.md and doc/scarp/conflicts.md: their installed places below
share/. The build runs it after linking the program.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys

WIDTH = 116
NOTE = "Written by tools/generate_docs.py from `scarp help --json`"


class Table:
    def __init__(self, program):
        table = json.loads(subprocess.run([program, "help", "--json"], check=True, stdout=subprocess.PIPE).stdout)
        self.commands = [command["name"] for command in table["commands"]]
        self.summaries = {command["name"]: command["help"] for command in table["commands"]}
        self.usages = {command["name"]: command["usage"] for command in table["commands"]}
        self.options, self.conflicts = table["options"], table["conflicts"]

    def of(self, command):
        return [option for option in self.options if option["command"] == command]

    def named(self, command):
        """The options, without arguments such as INPUT and parts such as --cutline's inset."""
        return [option for option in self.of(command) if option["name"].startswith("-") and not option["part_of"]]

    def listed(self, command):
        """The options for pages: those of simplify once, not again for classic."""
        return [option for option in self.of(command) if command != "classic" or "strategies" in option["group"]]

    def arguments(self, command):
        return [option for option in self.of(command) if not option["name"].startswith("-")]


def spelling(option):
    """--max-error; for a part, its form after the option: --cutline ...,inset"""
    return f"{option['part_of']} ...,{option['key']}" if option["part_of"] else option["name"]


def first_sentence(option):
    return re.split(r"\.(?: |$)", option["help"])[0]


def sentences(option, with_default=True):
    """The help and the rest of the table's row, as in --help."""
    text = option["help"]
    if option["range"] and " to " in option["range"]:
        text += f" From {option['range']}."
    if option["default"] and with_default:
        text += f" Default: {option['default']}."
    if option["repeatable"]:
        text += " May be given again."
    return text


# The man page.


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    text = re.sub(r"(?<![\w\\])((?:\\-){1,2}[a-z][a-z\\-]*)", r"\\fB\1\\fR", text)
    return text


def man_lines(table):
    for command in table.commands:
        yield f".SH OPTIONS OF {command.upper()}"
        group = None
        for option in table.listed(command):
            if option["group"] != group:
                group = option["group"]
                yield f'.SS "{group}"'
            yield ".TP"
            names = [name for name in (option["short"], spelling(option)) if name]
            text = ", ".join("\\fB" + name.replace("-", "\\-") + "\\fR" for name in names)
            if not option["name"].startswith("-"):
                text = f"\\fI{option['name']}\\fR"
            if option["value"]:
                text += ("=" if option["part_of"] else " ") + "\\fI" + option["value"].replace("-", "\\-") + "\\fR"
            yield text
            for sentence in re.split(r"(?<=\.) ", sentences(option)):
                line = roff(sentence)
                yield "\\&" + line if line[0] in ".'" else line


def synopsis_lines(table):
    for k, command in enumerate(table.commands):
        if k:
            yield ".br"
        words = ["\\fBscarp " + command.replace("-", "\\-") + "\\fR"]
        for word in table.usages[command].split():
            name = word.strip("[]")
            style = "B" if name.startswith("-") else "I"
            words.append(word.replace(name, f"\\f{style}{name}\\fR").replace("-", "\\-"))
        yield " ".join(words)


def man_page(table):
    template = pathlib.Path(__file__).resolve().parent.parent / "packaging" / "scarp.1.in"
    text = template.read_text(encoding="utf-8")
    return text.replace("@SYNOPSIS@", "\n".join(synopsis_lines(table))).replace("@OPTIONS@", "\n".join(man_lines(table)))


# The page of all options.


def cell(text, choices=()):
    text = re.sub(r"([*_<|])", r"\\\1", text)
    for choice in choices:  # "fast: refine only"; a default among the choices
        text = re.sub(rf"(?<![\w-]){re.escape(choice)}(?=:)|^{re.escape(choice)}(?=$|;|,| where| with)", f"`{choice}`", text)
    return re.sub(r"(?<![\w`-])(--[a-z][a-z-]*|-[a-z])(?![\w-])", r"`\1`", text)


def option_rows(options):
    has_default = any(option["default"] for option in options)
    yield "| option | meaning | default |" if has_default else "| option | meaning |"
    yield "|---|---|---|" if has_default else "|---|---|"
    for option in options:
        value = ("=" if option["part_of"] else " ") + option["value"].replace("|", "\\|") if option["value"] else ""
        name = (f"`{option['short']}`, " if option["short"] else "") + f"`{spelling(option)}{value}`"
        default = f" {cell(option['default'] or '', option['choices'])} |" if has_default else ""
        yield f"| {name} | {cell(sentences(option, False), option['choices'])} |{default}".replace("|  |", "| |")


def options_page(table):
    lines = ["# Options", "", f"All commands and options of the program. {NOTE}."]
    for command in table.commands:
        usage = " ".join(["scarp", command, table.usages[command]]).strip()
        lines += ["", f"## {command}", "", f"    {usage}", "", f"{table.summaries[command]}."]
        for group in dict.fromkeys(option["group"] for option in table.listed(command)):
            options = [option for option in table.listed(command) if option["group"] == group]
            lines += ["", f"### {command}: {group[0].lower()}{group[1:]}", "", *option_rows(options)]
    return "\n".join(lines) + "\n"


# The page of conflicts.


def setting(word):
    """`--option value` (remark)."""
    name, _, remark = word.partition(" (")
    name = name if name.endswith("samples") or name == "samples in memory" else f"`{name}`"
    return f"{name} ({remark}" if remark else name


def conflicts_page(table):
    def rows(keys, of_tiles):
        for row in table.conflicts:
            if row["tiles"] == of_tiles:
                yield "| " + " | ".join(", ".join(map(setting, row[key])) for key in keys) + f" | {row['because']} |"

    lines = [
        "# Settings that do not go together", "",
        "All settings of a simplification or of tiles can be combined, but for the pairs in these tables. The program refuses",
        "such a pair in a sentence that names both options; the library's `simplify()` fails with `kUsage` and the same reason.",
        "`find_conflicts()` of `scarp/conflicts.h` lists all conflicts of a call before it is made.", "", f"{NOTE}.", "",
        "Each setting of the first column conflicts with each of the second. Where the third column names settings, there is a",
        "conflict only if one of these is set, too.", "",
        "| setting | does not go with | if there is also | because |", "|---|---|---|---|",
        *rows(("setting", "with", "beside"), False), "",
        "Tiles (`scarp tile`, `tile plan`, `serve`): without `--grid` and `--of` the raster decides the grid, and the grid the",
        "format. `plan_pyramid()` refuses conflicts of its settings in the same way.", "",
        "| setting of tiles | does not go with | because |", "|---|---|---|", *rows(("setting", "with"), True)]
    return "\n".join(lines) + "\n"


# Completions.


def by_value(table, kind):
    """Options whose values are completed alike: {kind(option): [(command, option)]}."""
    alike = {}
    for command in table.commands:
        for option in table.named(command):
            alike.setdefault(kind(option), []).append((command, option))
    return alike


def names_of(option):
    return [name for name in (option["short"], option["name"]) if name]


def bash_kind(option):
    if option["type"] == "flag":
        return None
    if option["type"] == "file":
        return "-f"
    if option["type"] == "folder":
        return "-d"
    return f"-W '{' '.join(option['choices'])}'" if option["choices"] else ""


def bash(table):
    lines = [f"# bash completion for scarp. {NOTE}.", "", "_scarp() {",
             "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command='' options='' word",
             "  COMPREPLY=()", '  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do',
             f"    case $word in {' | '.join(table.commands)}) command=$word && break ;; esac", "  done",
             "  if [[ -z $command ]]; then",
             f"    COMPREPLY=($(compgen -W '{' '.join(table.commands)} --help --version' -- \"$current\"))",
             "    return", "  fi", "", '  case "$command $previous" in']
    for kind, members in by_value(table, bash_kind).items():
        if kind is None:
            continue
        words = [f'"{command} {name}"' for command, option in members for name in names_of(option)]
        lines += [f"    {words[0]}{'' if len(words) > 1 else ')'}"]
        for word in words[1:]:
            joined = f"{lines[-1]} | {word}"
            if len(joined) < WIDTH:
                lines[-1] = joined
            else:
                lines[-1] += " | \\"
                lines.append(f"      {word}")
        lines[-1] += ")" if len(words) > 1 else ""
        if kind:
            lines.append(f"      COMPREPLY=($(compgen {kind} -- \"$current\"))")
        lines += ["      return", "      ;;"]
    lines += ["  esac", "", "  if [[ $current == -* ]]; then", "    case $command in"]
    for command in table.commands:
        names = [option["name"] for option in table.named(command)]
        lines += [f"      {command})"] + [f"        options+=' {' '.join(names[k:k + 8])}'" for k in range(0, len(names), 8)]
        lines.append("        ;;")
    lines += ["    esac", '    COMPREPLY=($(compgen -W "$options" -- "$current"))', "    return", "  fi"]
    for command in table.commands:
        first = table.arguments(command)[:1]
        if first and first[0]["type"] != "file" and first[0]["choices"]:
            lines += [f"  if [[ $command == {command} && $COMP_CWORD -eq 2 ]]; then",
                      f"    COMPREPLY=($(compgen -W '{' '.join(first[0]['choices'])}' -- \"$current\"))", "    return", "  fi"]
    lines += ['  COMPREPLY=($(compgen -f -- "$current"))', "}", "",
              "complete -o filenames -o bashdefault -F _scarp scarp"]
    return "\n".join(lines) + "\n"


def zsh_text(text):
    return re.sub(r"([\[\]:\\])", r"\\\1", text).replace("'", "'\\''")


def zsh_action(option):
    if option["type"] == "file":
        endings = "|".join(choice.lstrip(".") for choice in option["choices"])
        return f'_files -g "*.({endings})"' if endings else "_files"
    if option["type"] == "folder":
        return "_files -/"
    return "(" + re.sub(r"([*:()'])", r"\\\1", " ".join(option["choices"])) + ")" if option["choices"] else " "


def zsh_line(option):
    names = names_of(option)
    value = ""
    if option["type"] != "flag":
        value = f":{zsh_text(option['value'] or option['name'])}:{zsh_action(option)}"
    before = "*" if option["repeatable"] else f"({' '.join(names)})" if len(names) > 1 else ""
    if option["name"] in ("--help", "--help-all", "--version"):
        before = "(- *)"
    words = "'{" + ",".join(names) + "}'" if len(names) > 1 else names[0]
    return f"'{before}{words}[{zsh_text(first_sentence(option))}]{value}'"


def zsh(table):
    lines = ["#compdef scarp", f"# zsh completion for scarp. {NOTE}.", "", "_scarp() {", "  if (( CURRENT == 2 )); then",
             "    local -a commands", "    commands=("]
    lines += [f"      '{command}:{zsh_text(table.summaries[command])}'" for command in table.commands]
    lines += ["    )", "    _describe -t commands 'command' commands",
              "    _arguments '--help[Print this help]' '--version[Print the version]'", "    return", "  fi", "",
              "  local command=$words[2]", "  shift words", "  (( CURRENT-- ))", "  case $command in"]
    for command in table.commands:
        words = [zsh_line(option) for option in table.named(command)]
        words += [f"'{k}:{option['name']}:{zsh_action(option)}'" for k, option in enumerate(table.arguments(command), 1)]
        lines += [f"    {command})", "      _arguments -s \\"] + [f"        {word} \\" for word in words[:-1]]
        lines += [f"        {words[-1]}", "      ;;"]
    lines += ["  esac", "}", "", '_scarp "$@"']
    return "\n".join(lines) + "\n"


def fish_text(text):
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def fish_kind(option):
    text = (f" -s {option['short'][1:]}" if option["short"] else "") + f" -l {option['name'][2:]}"
    if option["type"] == "file":
        text += " -r -F"
    elif option["type"] == "folder":
        text += " -x -a '(__fish_complete_directories)'"
    elif option["type"] != "flag":
        text += " -x" + (f" -a {fish_text(' '.join(option['choices']))}" if option["choices"] else "")
    return text + f" -d {fish_text(first_sentence(option))}"


def fish(table):
    lines = [f"# fish completion for scarp. {NOTE}.", ""]
    for command in table.commands:
        lines.append(f"complete -c scarp -n __fish_use_subcommand -f -a {command} -d {fish_text(table.summaries[command])}")
    for kind, members in by_value(table, fish_kind).items():
        commands = [command for command, _ in members]
        seen = f" -n '__fish_seen_subcommand_from {' '.join(commands)}'" if commands != table.commands else ""
        lines.append(f"complete -c scarp{seen}{kind}")
    for command in table.commands:
        first = table.arguments(command)[:1]
        if first and first[0]["type"] != "file" and first[0]["choices"]:
            lines.append(f"complete -c scarp -n '__fish_seen_subcommand_from {command}' -f "
                         f"-a {fish_text(' '.join(first[0]['choices']))}")
    return "\n".join(lines) + "\n"


FILES = {"man/man1/scarp.1": man_page, "bash-completion/completions/scarp": bash, "zsh/site-functions/_scarp": zsh,
         "fish/vendor_completions.d/scarp.fish": fish, "doc/scarp/options.md": options_page,
         "doc/scarp/conflicts.md": conflicts_page}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    given = parser.parse_args()
    table = Table(given.program)
    for name, make in FILES.items():
        path = given.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(make(table), encoding="utf-8")


if __name__ == "__main__":
    main()
