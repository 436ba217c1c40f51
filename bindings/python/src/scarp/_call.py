"""Calls of the library: options, progress, Ctrl-C, warnings."""
from __future__ import annotations

import atexit
import ctypes as C
import os
import sys
import time
import warnings
from types import TracebackType
from typing import Any, Callable, Generator, Iterable, Mapping, NamedTuple, Optional, Union

from . import _abi, _values
from .errors import ScarpWarning, UsageError


class Progress(NamedTuple):
    """A snapshot of a running pass."""

    name: str  #: "read", "refine", "fit", "search", "measure", "tiles" ...
    fraction: float  #: 0 to 1 of this pass
    vertices: int  #: so far; 0 if the pass does not know it
    max_error: float  #: so far, in z units; 0 if the pass does not know it
    seconds_left: Optional[float]  #: estimated time left for this pass; None: no estimate yet
    tiles: int  #: written so far, in the pass "tiles" of tile()
    bytes: int  #: size of these tiles


ProgressArgument = Union[bool, None, Callable[[Progress], Any]]


def _line_on_stderr(progress: Progress) -> None:
    sys.stderr.write("\r%s %3.0f %% \x1b[K" % (progress.name, 100 * progress.fraction))
    sys.stderr.flush()


class _Bar:
    """progress=True: tqdm if installed, else a line on stderr."""

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
        if progress.tiles:
            self._bar.set_postfix_str("%d tiles, %.1f MB" % (progress.tiles, progress.bytes / 1e6), refresh=False)
        self._bar.update(100 * progress.fraction - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        elif self._tqdm is None and self._name is not None:
            sys.stderr.write("\r\x1b[K")


def text_of(name: str, value: object) -> str:
    """An option's value as the program accepts it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, bytes, os.PathLike)):
        return os.fsdecode(value)
    if isinstance(value, (int, float)) or (hasattr(value, "__float__") and not getattr(value, "ndim", 0)):
        number: Any = value
        return str(int(number)) if hasattr(number, "__index__") else repr(float(number))
    if isinstance(value, Iterable) and not isinstance(value, Mapping) and getattr(value, "ndim", 1) == 1:
        return " ".join(text_of(name, part) for part in value)
    raise UsageError("option %s takes a number, a text or True, not %s" % (name, type(value).__name__))


class Settings:
    """The options of one call: the struct, and all others, except None and False, by name."""

    def __init__(self, named: Mapping[str, object]) -> None:
        self.struct = _abi.new_options()
        self.pointer = C.byref(self.struct)
        self.keep: list[object] = []
        self.is_brief = False  #: ends before anyone can press Ctrl-C
        try:
            for name, value in named.items():
                for each in value if isinstance(value, list) else (value,):
                    if each is not None and each is not False:
                        _abi.check(_abi.lib.scarp_options_set(self.pointer, _values.text_of("an option", name),
                                                              _values.text_of(name, text_of(name, each))))
        except BaseException:
            self.close()
            raise

    def use_threads(self, threads: int) -> None:
        if threads != 0:
            number = _values.whole_of("threads", threads, 0, 2**63)
            if number < 2**31:
                self.struct.threads = number
            else:  # the library rejects it with its own number
                _abi.check(_abi.lib.scarp_options_set(self.pointer, b"threads", b"%d" % number))

    def close(self) -> None:
        if self.struct.named:
            _abi.lib.scarp_options_clear(self.pointer)

    def __enter__(self) -> Settings:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()


_beside: set[tuple[int, int]] = set()  #: calls in progress on other threads: process, which may be a fork, and listener
_ends = False


@atexit.register
def _end_calls() -> None:
    """Ends calls on daemon threads: a callback into a finished interpreter would abort the process."""
    global _ends
    _ends = True
    while any(process == os.getpid() for process, _ in tuple(_beside)):
        time.sleep(0.01)


def _is_on_main_thread() -> bool:
    threading = sys.modules.get("threading")
    return threading is None or threading.current_thread() is threading.main_thread()


def _is_false(told: object) -> bool:
    """True for Python's or numpy's False, but not for 0 and None."""
    return told is False or (type(told).__name__ in ("bool_", "bool") and not told)


def _listen(tell: Optional[Callable[[Progress], Any]], raised: list[BaseException],
            is_beside: bool) -> Generator[int, int, None]:
    """A generator whose send() receives the address of the library's progress, and returns True to cancel.

    It stores exceptions, which ctypes would print and discard. Exceptions of signal handlers, such as Ctrl-C, occur
    where Python code continues: in a function before its first `try`, but in a generator at the `yield`."""
    answer = 0
    while True:
        try:
            while True:
                address = yield answer
                if tell is not None:
                    struct = _abi.Progress.from_address(address)
                    name: bytes = getattr(struct, "pass")
                    left = struct.seconds_left
                    told = tell(Progress(name.decode(), struct.fraction, struct.vertices, struct.max_error,
                                         left if left >= 0 else None, struct.tiles, struct.bytes))
                    answer = 1 if _is_false(told) else 0
                if _ends and is_beside:
                    raise SystemExit
        except GeneratorExit:
            return
        except BaseException as error:
            raised.append(error)
            answer = 1


def run(settings: Settings, progress: ProgressArgument, function: Callable[..., int], *arguments: object) -> None:
    """Calls a function of the library. An exception of the progress function, or Ctrl-C, ends the call and is raised
    here, as are the library's errors."""
    bar = _Bar() if progress is True else None
    tell: Any = bar if bar is not None else (progress or None)
    if tell is not None and not callable(tell):
        raise UsageError("progress is True or a function of one argument, not %s" % type(tell).__name__)
    raised: list[BaseException] = []
    beside = None
    if tell is not None or not settings.is_brief:
        is_beside = not _is_on_main_thread()
        listener = _listen(tell, raised, is_beside)
        next(listener)
        settings.struct.progress = _abi.ProgressFn(listener.send)
        if is_beside:
            beside = (os.getpid(), id(listener))
            _beside.add(beside)
    try:
        status = function(*arguments)
    finally:
        if beside is not None:
            _beside.discard(beside)
        if bar is not None:
            bar.close()
    if raised:
        raise raised.pop(0)  # not stored in this frame, which its traceback references
    if status:
        _abi.check(status)


def warn(handle: int, stacklevel: int) -> None:
    """Issues the library's warnings about a mesh."""
    text: bytes = _abi.lib.scarp_mesh_warnings(handle)
    for sentence in _abi.in_words(text).splitlines() if text else ():
        warnings.warn(sentence, ScarpWarning, stacklevel=stacklevel + 1)
