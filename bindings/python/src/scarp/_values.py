"""Checks and converts callers' values for the library; UsageError with a message for others."""
from __future__ import annotations

import os
from typing import Any

from .errors import UsageError


def number_of(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise UsageError("%s is a number, not %s" % (name, _shown(value))) from None


def bound_of(name: str, value: Any) -> float:
    """A number, but not NaN, which the library treats as none."""
    number = number_of(name, value)
    if number != number:
        raise UsageError("%s is NaN: give a number" % name)
    return number


def whole_of(name: str, value: Any, least: int, most: int) -> int:
    """A whole number of any type, clamped to `most`."""
    try:
        number = int(value)
        is_whole = not isinstance(value, str) and number == value
    except (TypeError, ValueError, OverflowError):
        is_whole = False
    if not is_whole:
        raise UsageError("%s is a whole number, not %s" % (name, _shown(value)))
    if number < least:
        raise UsageError("%s is %d: at least %d is needed" % (name, number, least))
    return min(number, most)


def text_of(name: str, value: Any) -> bytes:
    """UTF-8; bytes of file names that are no UTF-8 do not change."""
    if not isinstance(value, str):
        raise UsageError("%s is a text, not %s" % (name, _shown(value)))
    try:
        data = value.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        raise UsageError("%s is no text of Unicode: %s" % (name, _shown(value))) from None
    if b"\0" in data:
        raise UsageError("%s has a null character: %s" % (name, _shown(value)))
    return data


def path_of(value: Any, name: str = "the path") -> bytes:
    try:
        path = os.fspath(value)
    except TypeError:
        raise UsageError("%s is a text or an os.PathLike, not %s" % (name, _shown(value))) from None
    return text_of(name, os.fsdecode(path) if isinstance(path, bytes) else path)


def _shown(value: Any) -> str:
    text = ascii(value) if isinstance(value, (str, bytes, int, float)) else type(value).__name__
    return text if len(text) <= 60 else text[:57] + "..."
