"""Failures as exceptions: one class for each exit code of the program, with the library's sentence as the message."""
from __future__ import annotations


class ScarpError(Exception):
    """Base of all exceptions of Scarp."""


class UsageError(ScarpError, ValueError):
    """Options that conflict or are out of range; an array of the wrong kind."""


class InputError(ScarpError, ValueError):
    """A raster, mesh or file that cannot be read or has no usable data."""


class PromiseError(ScarpError):
    """The requested error bound cannot be met, or a mesh exceeds it."""


class OutputError(ScarpError, OSError):
    """A file that cannot be written, or a format that cannot hold the mesh."""


class Cancelled(ScarpError):
    """Cancelled by the progress function."""


class InternalError(ScarpError, RuntimeError):
    """A bug in Scarp."""


class ScarpWarning(UserWarning):
    """A warning of the library about its input; the call continues."""


OF_STATUS: dict[int, type[ScarpError]] = {
    1: UsageError,
    2: InputError,
    3: PromiseError,
    4: OutputError,
    5: Cancelled,
    70: InternalError,
}
