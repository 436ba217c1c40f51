"""Running the library: options, progress, Ctrl-C, warnings."""
from __future__ import annotations

import ctypes as C
import os
import sys
import threading
import warnings
from _signal import SIGINT, default_int_handler, getsignal, signal  # type: ignore  # `signal` makes enums: 10 us a call
from types import TracebackType
from typing import Any, Callable, Iterable, Mapping, NamedTuple, Optional, Union

from . import _abi
from .errors import ScarpWarning, UsageError


class Progress(NamedTuple):
    """A snapshot of a running pass."""

    name: str  #: "read", "refine", "fit", "search", "measure" ...
    fraction: float  #: 0 to 1 of this pass
    vertices: int  #: so far; 0 where the pass does not know it
    max_error: float  #: so far, in z units; 0 where the pass does not know it


ProgressArgument = Union[bool, None, Callable[[Progress], Any]]


def _line_on_stderr(progress: Progress) -> None:
    sys.stderr.write("\r%s %3.0f %% \x1b[K" % (progress.name, 100 * progress.fraction))
    sys.stderr.flush()


class _Bar:
    """progress=True: tqdm where it is installed, else a line on stderr."""

    def __init__(self) -> None:
        self._bar: Any = None
        self._tqdm: Any = None
        try:
            from tqdm.auto import tqdm
            self._tqdm = tqdm
        except ImportError:
            pass
        self._name: Optional[str] = None

    def __call__(self, progress: Progress) -> None:
        if self._tqdm is None:
            _line_on_stderr(progress)
            return
        if progress.name != self._name:
            self.close()
            self._name = progress.name
            self._bar = self._tqdm(total=100, desc=progress.name, unit="%", leave=False)
        self._bar.update(100 * progress.fraction - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        elif self._tqdm is None and self._name is not None:
            sys.stderr.write("\r\x1b[K")


class _Interrupts:
    """While it lasts, Ctrl-C in the main thread sets a flag in place of raising: in a callback it would be raised
    before any `try`, and ctypes would swallow it. Whoever has a handler of their own keeps it."""

    def __init__(self) -> None:
        self.came = False
        self._old: Any = None

    def __enter__(self) -> _Interrupts:
        if (getsignal(SIGINT) is default_int_handler
                and threading.current_thread() is threading.main_thread()):
            self._old = signal(SIGINT, self._note)
        return self

    def _note(self, *_: object) -> None:
        self.came = True

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        if self._old is not None:
            signal(SIGINT, self._old)


def text_of(name: str, value: object) -> str:
    """An option's value as the program takes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return str(os.fspath(value))
    if isinstance(value, (int, float)) or hasattr(value, "__float__"):
        number: Any = value
        return str(int(number)) if hasattr(number, "__index__") else repr(float(number))
    if isinstance(value, Iterable):
        return " ".join(text_of(name, part) for part in value)
    raise UsageError("option %s takes a number, a text or True, not %s" % (name, type(value).__name__))


class Settings:
    """The options of one call."""

    def __init__(self, named: Mapping[str, object]) -> None:
        self.struct = _abi.new_options()
        self.keep: list[object] = []
        try:
            for name, value in named.items():
                for each in value if isinstance(value, list) else [value]:
                    if each is not None:
                        _abi.check(_abi.lib.scarp_options_set(C.byref(self.struct), name.encode(),
                                                              text_of(name, each).encode()))
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        _abi.lib.scarp_options_clear(C.byref(self.struct))

    def __enter__(self) -> Settings:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()


def run(settings: Settings, progress: ProgressArgument, work: Callable[[Any], int]) -> int:
    """Calls work(pointer to the options) and returns its status. An exception of the progress function, and Ctrl-C, end
    the call and come out of here."""
    bar = _Bar() if progress is True else None
    tell: Any = bar if bar is not None else (progress or None)
    if tell is not None and not callable(tell):
        raise UsageError("progress is True or a function of one argument, not %s" % type(tell).__name__)
    raised: list[BaseException] = []
    with _Interrupts() as interrupts:

        def told(address: int, _: object) -> int:
            if interrupts.came:
                return 1
            if tell is None:
                return 0
            try:
                struct = _abi.Progress.from_address(address)
                name: bytes = getattr(struct, "pass")
                answer = tell(Progress(name.decode(), struct.fraction, struct.vertices, struct.max_error))
                return 1 if answer is False else 0
            except BaseException as error:  # it must not end in ctypes, which would print and swallow it
                raised.append(error)
                return 1

        settings.struct.progress = _abi.ProgressFn(told)
        status = work(C.byref(settings.struct))
    if bar is not None:
        bar.close()
    if raised:
        raise raised[0]
    if interrupts.came:
        raise KeyboardInterrupt
    return status


def warn(handle: int, stacklevel: int) -> None:
    """Says what the library says of a mesh."""
    text: bytes = _abi.lib.scarp_mesh_warnings(handle)
    for sentence in text.decode().splitlines():
        warnings.warn(sentence, ScarpWarning, stacklevel=stacklevel + 1)
