"""Refinement one vertex at a time."""
from __future__ import annotations

import ctypes as C
import threading
from typing import Any, Iterator, Optional

from . import _abi, _call, _inputs, _values
from .mesh import Mesh


class Refiner:
    """A mesh that grows by one vertex at a time: the sample with the largest error.

    `source` as in simplify(), but no path. Borrows the samples of a float32 array: do not change them meanwhile. Calls
    from several threads wait for each other.

    >>> refiner = Refiner(z)
    >>> refiner.run(max_error=10)       # inserted vertices
    >>> for error in refiner:           # one vertex at a time
    ...     if error < 5: break
    >>> mesh = refiner.mesh()
    """

    _handle: Optional[int]

    def __init__(self, source: Any, *, band: int = 1, transform: Any = None, crs: Any = None,
                 nodata: Optional[float] = None) -> None:
        self._input = _inputs.read(source, band=band, transform=transform, crs=crs, nodata=nodata, wants_array=True)
        self._shape = _inputs.shape_of(source)
        self._lock = threading.RLock()
        out = C.c_void_p()
        _abi.check(_abi.lib.scarp_refiner_create(C.byref(self._input.field), C.byref(out)))
        self._handle = out.value

    def __del__(self, free: Any = _abi.lib.scarp_refiner_free) -> None:
        if getattr(self, "_handle", None):
            free(self._handle)

    def insert_worst(self) -> bool:
        """Inserts the sample with the largest error; returns False once every sample is exact."""
        with self._lock:
            inserted: int = _abi.lib.scarp_refiner_insert_worst(self._handle)
        if inserted < 0:
            raise MemoryError(_abi.last_error())
        return inserted == 1

    def run(self, max_error: float = 0.0, max_vertices: Optional[int] = None, *,
            progress: _call.ProgressArgument = None) -> int:
        """Inserts until the error is at most max_error, or there are max_vertices; returns the number inserted.

        `progress` as in simplify(). Vertices inserted before a cancellation or Ctrl-C remain: run() continues from
        there."""
        inserted = C.c_uint64()
        with self._lock, _call.Settings({}) as settings:
            settings.struct.max_error = _values.bound_of("max_error", max_error)
            if max_vertices is not None:
                settings.struct.max_points = _values.whole_of("max_vertices", max_vertices, 0, 2**63)
            _call.run(settings, progress, _abi.lib.scarp_refiner_go_on, self._handle, settings.pointer,
                      C.byref(inserted))
        return inserted.value

    def __iter__(self) -> Iterator[float]:
        """Inserts vertices, and yields the remaining error after each."""
        while self.insert_worst():
            yield self.max_error

    @property
    def max_error(self) -> float:
        """The largest error over all samples, in the units of the heights."""
        with self._lock:
            error: float = _abi.lib.scarp_refiner_max_error(self._handle)
        return error

    @property
    def vertex_count(self) -> int:
        with self._lock:
            count: int = _abi.lib.scarp_refiner_vertex_count(self._handle)
        return count

    @property
    def triangle_count(self) -> int:
        with self._lock:
            count: int = _abi.lib.scarp_refiner_triangle_count(self._handle)
        return count

    def mesh(self) -> Mesh:
        """The current mesh, without a report: see measure()."""
        out = C.c_void_p()
        with self._lock:
            _abi.check(_abi.lib.scarp_refiner_mesh(self._handle, C.byref(out)))
        assert out.value is not None
        return Mesh(out.value, None, self._shape)

    def __reduce__(self) -> Any:
        raise TypeError("a scarp.Refiner is neither pickled nor copied: send its mesh(), or make another of the heights")
