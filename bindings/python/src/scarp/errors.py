"""Failures as exceptions: one class for each exit code of the program, the library's sentence as the message."""
from __future__ import annotations


class ScarpError(Exception):
    """Base of all that Scarp raises."""


class UsageError(ScarpError, ValueError):
    """Options that do not go together or are out of range; an array of the wrong kind."""


class InputError(ScarpError, ValueError):
    """A raster, mesh or file that cannot be read or holds nothing usable."""


class PromiseError(ScarpError):
    """The error that was asked for cannot be kept, or a mesh does not keep it."""


class OutputError(ScarpError, OSError):
    """A file that cannot be written, or a format that cannot hold the mesh."""


class Cancelled(ScarpError):
    """The progress function asked for it."""


class InternalError(ScarpError, RuntimeError):
    """A bug in Scarp."""


class ScarpWarning(UserWarning):
    """A warning of the library about its input, where it can continue."""


OF_STATUS: dict[int, type[ScarpError]] = {
    1: UsageError,
    2: InputError,
    3: PromiseError,
    4: OutputError,
    5: Cancelled,
    70: InternalError,
}
