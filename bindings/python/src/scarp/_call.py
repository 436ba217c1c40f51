"""Running the library: options, progress, Ctrl-C, warnings."""
from __future__ import annotations

import ctypes as C
import os
import sys
import warnings
from _signal import SIGINT, default_int_handler, getsignal, signal  # type: ignore  # `signal` makes enums: 10 us a call
from types import TracebackType
from typing import Any, Callable, Iterable, Mapping, NamedTuple, Optional, Union

from . import _abi, _values
from .errors import ScarpWarning, UsageError


class Progress(NamedTuple):
    """A snapshot of a running pass."""

    name: str  #: "read", "refine", "fit", "search", "measure", "tiles" ...
    fraction: float  #: 0 to 1 of this pass
    vertices: int  #: so far; 0 where the pass does not know it
    max_error: float  #: so far, in z units; 0 where the pass does not know it
    seconds_left: Optional[float]  #: of this pass; None before it can be told
    tiles: int  #: written so far, in the pass "tiles" of tile()
    bytes: int  #: of them


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
        if progress.tiles:
            self._bar.set_postfix_str("%d tiles, %.1f MB" % (progress.tiles, progress.bytes / 1e6), refresh=False)
        self._bar.update(100 * progress.fraction - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        elif self._tqdm is None and self._name is not None:
            sys.stderr.write("\r\x1b[K")


class _Interrupts:
    """While a call of the main thread lasts, Ctrl-C sets a flag in place of raising: in a callback it would be raised
    before any `try`, and ctypes would swallow it. Whoever has a handler of their own keeps it."""

    came = False

    @classmethod
    def begin(cls) -> bool:
        """Whether Ctrl-C sets the flag from now on: then end() must follow."""
        if getsignal(SIGINT) is not default_int_handler:
            return False
        try:
            signal(SIGINT, cls._note)
        except ValueError:  # another thread than the main one
            return False
        cls.came = False
        return True

    @classmethod
    def end(cls) -> None:
        signal(SIGINT, default_int_handler)

    @classmethod
    def _note(cls, *_: object) -> None:
        cls.came = True

    @classmethod
    def is_told(cls, *_: object) -> int:
        """A progress function that knows of Ctrl-C alone."""
        return 1 if cls.came else 0


_ASK_INTERRUPTS = _abi.ProgressFn(_Interrupts.is_told)


def text_of(name: str, value: object) -> str:
    """An option's value as the program takes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, bytes, os.PathLike)):
        return os.fsdecode(value)
    if isinstance(value, (int, float)) or hasattr(value, "__float__"):
        number: Any = value
        return str(int(number)) if hasattr(number, "__index__") else repr(float(number))
    if isinstance(value, Iterable) and not isinstance(value, Mapping):
        return " ".join(text_of(name, part) for part in value)
    raise UsageError("option %s takes a number, a text or True, not %s" % (name, type(value).__name__))


class Settings:
    """The options of one call: the struct, and by name all that is neither None nor False."""

    def __init__(self, named: Mapping[str, object]) -> None:
        self.struct = _abi.new_options()
        self.pointer = C.byref(self.struct)
        self.keep: list[object] = []
        self.is_brief = False  #: over before anybody presses Ctrl-C
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
            self.struct.threads = _values.whole_of("threads", threads, 0, 2**31 - 1)

    def close(self) -> None:
        if self.struct.named:
            _abi.lib.scarp_options_clear(self.pointer)

    def __enter__(self) -> Settings:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()


class _Teller:
    """Tells a function of Python what the library tells, and keeps what it raises."""

    def __init__(self, tell: Callable[[Progress], Any], catches: bool) -> None:
        self.tell = tell
        self.catches = catches
        self.raised: Optional[BaseException] = None

    def __call__(self, address: int, _: object) -> int:
        if self.catches and _Interrupts.came:
            return 1
        try:
            struct = _abi.Progress.from_address(address)
            name: bytes = getattr(struct, "pass")
            left = struct.seconds_left
            answer = self.tell(Progress(name.decode(), struct.fraction, struct.vertices, struct.max_error,
                                        left if left >= 0 else None, struct.tiles, struct.bytes))
            return 1 if answer is False else 0
        except BaseException as error:  # it must not end in ctypes, which would print and swallow it
            self.raised = error
            return 1


def run(settings: Settings, progress: ProgressArgument, function: Callable[..., int], *arguments: object) -> None:
    """Calls a function of the library. An exception of the progress function, and Ctrl-C, end the call and come out of
    here, and so does what the library has to complain of."""
    bar = _Bar() if progress is True else None
    tell: Any = bar if bar is not None else progress
    if tell and not callable(tell):
        raise UsageError("progress is True or a function of one argument, not %s" % type(tell).__name__)
    teller: Optional[_Teller] = None
    catches = not (settings.is_brief and not tell) and _Interrupts.begin()
    try:
        if tell:
            teller = _Teller(tell, catches)
            settings.struct.progress = _abi.ProgressFn(teller)
        elif catches:
            settings.struct.progress = _ASK_INTERRUPTS
        status = function(*arguments)
    finally:
        if catches:
            _Interrupts.end()
        if bar is not None:
            bar.close()
    if teller is not None and teller.raised is not None:
        raise teller.raised
    if catches and _Interrupts.came:
        raise KeyboardInterrupt
    if status:
        _abi.check(status)


def warn(handle: int, stacklevel: int) -> None:
    """Says what the library says of a mesh."""
    text: bytes = _abi.lib.scarp_mesh_warnings(handle)
    for sentence in text.decode().splitlines() if text else ():
        warnings.warn(sentence, ScarpWarning, stacklevel=stacklevel + 1)
