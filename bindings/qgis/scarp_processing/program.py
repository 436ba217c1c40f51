"""Runs the program: its progress becomes the feedback's, its sentence the error."""

import json
import os
import queue
import shutil
import subprocess
import threading

from processing.core.ProcessingConfig import ProcessingConfig
from qgis.core import QgsProcessingException

from .options import in_words

SETTING = "SCARP_PROGRAM"
NAME = "scarp: "
WARNING = NAME + "warning: "


def find_program():
    """The program's path: the setting, else the variable SCARP, else the PATH."""
    asked = ProcessingConfig.getSetting(SETTING) or os.environ.get("SCARP")
    found = shutil.which(asked) if asked else shutil.which("scarp")
    if found:
        return found
    where = f"{asked} is no program" if asked else "the program scarp is not on the PATH"
    raise QgsProcessingException(
        f"{where}: install Scarp, or name it under Settings, Options, Processing, Providers, Scarp"
    )


def show(arguments):
    return " ".join(f'"{part}"' if " " in part or not part else part for part in arguments)


def run_program(arguments, feedback):
    """Standard output of `scarp ARGUMENTS --json-progress`.

    Raises QgsProcessingException with the program's sentence if it fails.
    """
    command = [find_program(), *arguments, "--json-progress"]
    feedback.pushCommandInfo(show(command))
    flags = {"creationflags": subprocess.CREATE_NO_WINDOW} if os.name == "nt" else {}
    try:
        process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            encoding="utf-8", errors="replace", **flags
        )
    except OSError as error:
        raise QgsProcessingException(f"{command[0]} cannot be started: {error.strerror}") from error
    output, lines = [], queue.Queue()
    readers = [
        threading.Thread(target=lambda: output.append(process.stdout.read()), daemon=True),
        threading.Thread(target=pass_lines, args=(process.stderr, lines), daemon=True),
    ]
    for reader in readers:
        reader.start()
    sentences = hear(lines, process, feedback)
    code = process.wait()
    for reader in readers:
        reader.join()
    for stream in (process.stdout, process.stderr):
        stream.close()
    text = "".join(output)
    if feedback.isCanceled():
        raise QgsProcessingException("Scarp was cancelled; no file was written")
    if code != 0:
        if text.strip():
            feedback.pushInfo(text)
        raise QgsProcessingException("\n".join(sentences) or f"scarp ended with exit code {code}")
    return text


def pass_lines(stream, lines):
    for line in stream:
        lines.put(line.rstrip())
    lines.put(None)


def hear(lines, process, feedback):
    """Lines of JSON are progress, others warnings or, in the end, the error: returns the latter. Cancels if asked to."""
    sentences, last = [], None
    while True:
        if feedback.isCanceled():
            process.terminate()
        try:
            line = lines.get(timeout=0.1)
        except queue.Empty:
            continue
        if line is None:
            return sentences
        step = parse_step(line)
        if step is not None:
            if step["pass"] != last:
                last = step["pass"]
                feedback.setProgressText(last)
            feedback.setProgress(100 * step["fraction"])
        elif line.startswith(WARNING):
            feedback.pushWarning(in_words(line[len(WARNING):]))
        elif line:
            sentences.append(in_words(line[len(NAME):] if line.startswith(NAME) else line))


def parse_step(line):
    if not line.startswith("{"):
        return None
    try:
        step = json.loads(line)
    except ValueError:
        return None
    return step if isinstance(step, dict) and "pass" in step and "fraction" in step else None
