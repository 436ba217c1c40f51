"""Fields that change, and their meshes."""
from __future__ import annotations

import ctypes as C
import threading
from typing import TYPE_CHECKING, Any, NamedTuple, Optional

from . import _abi, _inputs, _values
from ._raster import numpy_if_there
from .errors import UsageError
from .mesh import Mesh, memory_of

if TYPE_CHECKING:
    from numpy import float32, uint16
    from numpy.typing import NDArray

_EFFORTS = {"fast": 0, "normal": 1, "high": 2}
_LARGEST = 2**31 - 1


class Cell(NamedTuple):
    """The mesh of a cell, ready for a GPU. The arrays are the library's memory, read-only."""

    slot: int  #: its place in a renderer's buffer: no other cell has it, even while the field moves
    version: int  #: the change that made it
    row: int  #: its first sample, on the lattice of cells
    col: int
    max_error: float  #: measured
    positions: NDArray[float32]  #: (N, 3): columns east and rows north of the first sample (so y <= 0), height
    triangles: NDArray[uint16]  #: (M, 3): counter-clockwise from above where rows run south; empty: no surface


class Changes(NamedTuple):
    """Cells that changed."""

    version: int  #: for the next call of changes()
    cells: list[Cell]  #: by slot


class _Handle:
    """Frees changes, or a cell of them, once no array needs them."""

    def __init__(self, value: Optional[int]) -> None:
        self.value = value

    def __del__(self, free: Any = _abi.lib.scarp_changes_free) -> None:
        free(self.value)


class Live:
    """A field that changes many times a second, and its mesh: an update remakes only the cells that it touches.

    source         as in simplify(), but no path; copied
    max_error      every sample, as float32, is within this of the mesh, vertically, after every change; 0 with a budget
    max_triangles  a budget: the largest number of triangles after every change. Bounds rise and fall for it; the
                   property max_error is the result. Fields of 50 cells or more mostly use at least 98 % of it,
                   unless fewer triangles keep max_error or reproduce the samples. Not with tolerance.
    effort         "fast" (DEFAULT), "normal" or "high"
    cell           steps between samples along a cell, 8 to 254. DEFAULT: 32 with "fast", else 64.
    tolerance      (rows, columns) bounds for the samples, or one number; inf: none
    place          (row, column) of the first sample on the lattice of cells
    threads        for an update that touches several cells; never changes the mesh
    level          with a budget: the property level of another field of the same shape, to get its mesh from its samples

    NaN, infinities, nodata and masked samples are voids. One thread at a time may change the field; a second one gets a
    UsageError; others may read meanwhile. A failed call changes nothing. Runs without
    Python's lock. After any changes the mesh has the bytes of one made from the final samples at the same place; with
    max_triangles, also at the same level.

    >>> live = Live(z, 0.05)
    >>> live.update(slice(10, 60), slice(20, 70), z[10:60, 20:70] + 0.3)
    >>> for cell in live.changes().cells: upload(cell.slot, cell.positions, cell.triangles)
    """

    _handle: Optional[int]

    def __init__(self, source: Any, max_error: Optional[float] = None, *, max_triangles: Optional[int] = None,
                 effort: str = "fast", cell: int = 0, band: int = 1, transform: Any = None, crs: Any = None,
                 nodata: Optional[float] = None, tolerance: Any = None, place: tuple[int, int] = (0, 0), threads: int = 1,
                 level: Optional[int] = None) -> None:
        self._handle = None
        if numpy_if_there() is None:
            raise UsageError("scarp.Live needs numpy")
        read = _inputs.read(source, band=band, transform=transform, crs=crs, nodata=nodata, wants_array=True)
        read.field.sample_rounding = 0.0
        if not isinstance(effort, str) or effort not in _EFFORTS:
            raise UsageError("effort is fast, normal or high, not %r" % (effort,))
        options = _abi.LiveOptions()
        _abi.lib.scarp_live_options_init(C.byref(options), C.sizeof(options))
        if max_error is None and max_triangles is None:
            raise UsageError("scarp.Live needs max_error or max_triangles: give max_error=0.05")
        options.max_error = _values.bound_of("max_error", 0 if max_error is None else max_error)
        if max_triangles is not None:
            options.max_triangles = _values.whole_of("max_triangles", max_triangles, 1, 2**63)
        if level is not None:
            start = C.c_int64(_values.whole_of("level", level, -2**63, 2**63 - 1))
            options.level = C.addressof(start)
        options.effort = _EFFORTS[effort]
        options.cell = _values.whole_of("cell", cell, 0, _LARGEST)
        options.threads = _values.whole_of("threads", threads, 0, _LARGEST)
        try:
            row, col = place
        except (TypeError, ValueError):
            raise UsageError("place is (row, column), not %r" % (place,)) from None
        options.row, options.col = (_values.whole_of("place", at, -_LARGEST, _LARGEST) for at in (row, col))
        bounds = None if tolerance is None else self._values("tolerances", tolerance, (read.field.rows, read.field.cols))
        if bounds is not None:
            options.tolerance = bounds.ctypes.data
        self._has_tolerance = bounds is not None
        self._shape = (read.field.rows, read.field.cols)
        self._lock = threading.Lock()  # protects the handle, not the field
        self._busy = 0
        out = C.c_void_p()
        _abi.check(_abi.lib.scarp_live_create(C.byref(read.field), C.byref(options), C.byref(out)))
        self._handle = out.value

    def close(self) -> None:
        """Frees the field. Arrays of changes() stay valid."""
        with self._lock:
            if self._busy:
                raise UsageError("another thread uses the live field: close it afterwards")
            handle, self._handle = self._handle, None
        _abi.lib.scarp_live_free(handle)

    def __enter__(self) -> Live:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self, free: Any = _abi.lib.scarp_live_free) -> None:
        if getattr(self, "_handle", None):
            free(self._handle)

    def _call(self, function: Any, *arguments: Any) -> Any:
        """Calls the library with the handle, which stays open meanwhile."""
        with self._lock:
            if self._handle is None:
                raise UsageError("the live field is closed")
            self._busy += 1
        try:
            return function(self._handle, *arguments)
        finally:
            with self._lock:
                self._busy -= 1

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)"""
        return self._shape

    @property
    def place(self) -> tuple[int, int]:
        """(row, column) of the first sample on the lattice of cells."""
        col, row = C.c_int32(), C.c_int32()
        self._call(_abi.lib.scarp_live_place, C.byref(col), C.byref(row))
        return row.value, col.value

    @property
    def transform(self) -> tuple[float, ...]:
        """GDAL's six numbers of pixel corners for the field at its current place, in the coordinates of mesh(): for
        measure(live.heights, live.mesh(), transform=live.transform)."""
        numbers = (C.c_double * 6)()
        self._call(_abi.lib.scarp_live_geotransform, numbers)
        return tuple(numbers)

    def _window(self, name: str, window: Any, size: int) -> tuple[int, int]:
        if isinstance(window, slice):
            try:
                first, end, step = window.indices(size)
            except TypeError:
                first, end, step = 0, 0, 1
            if step != 1 or end <= first:
                raise UsageError("%s is a slice with step 1 of at least one of %d, not %s" % (name, size, window))
            return first, end - first
        first = _values.whole_of(name, window, -size, size)
        return (first + size if first < 0 else first), 1

    def _values(self, name: str, given: Any, shape: tuple[int, int]) -> Any:
        import numpy as np
        try:
            if isinstance(given, np.ma.MaskedArray):
                masked: Any = given.astype(np.float64)
                given = masked.filled(np.nan if name == "heights" else np.inf)
            array = np.asarray(given)
            if array.dtype.kind not in "iuf":
                raise ValueError
            with np.errstate(over="ignore"):
                rounded = np.asarray(array, dtype=np.float32, order="C")
        except (TypeError, ValueError):
            raise UsageError("%s are an array of numbers" % name) from None
        if not np.array_equal(np.isinf(rounded), np.isinf(array)):
            raise UsageError("%s beyond what a float32 holds (3.4e38): give them in a larger unit" % name)
        if rounded.ndim == 0:
            return np.full(shape, rounded)
        if rounded.shape != shape and not (1 in shape and rounded.shape == (max(shape),)):
            raise UsageError("%s have the shape %s, and the window has %s" % (name, rounded.shape, shape))
        return rounded

    def update(self, rows: Any, cols: Any, heights: Any, tolerance: Any = None) -> None:
        """Replaces the samples of a window: `rows` and `cols` are slices, or numbers of one row or column.

        `heights`: an array of the window's shape, or one number. `tolerance`: the same, or None for no change."""
        row, row_count = self._window("rows", rows, self._shape[0])
        col, col_count = self._window("cols", cols, self._shape[1])
        array = self._values("heights", heights, (row_count, col_count))
        bounds = None if tolerance is None else self._values("tolerances", tolerance, (row_count, col_count))
        _abi.check(self._call(_abi.lib.scarp_live_update, col, row, col_count, row_count, array.ctypes.data,
                              None if bounds is None else bounds.ctypes.data))

    def set(self, row: int, col: int, height: float) -> None:
        """Replaces one sample."""
        self.update(row, col, _values.number_of("height", height))

    def scroll(self, rows: int, cols: int) -> None:
        """Moves the field `rows` down and `cols` east. New samples are void until an update."""
        _abi.check(self._call(_abi.lib.scarp_live_scroll, _values.whole_of("cols", cols, -_LARGEST, _LARGEST),
                              _values.whole_of("rows", rows, -_LARGEST, _LARGEST)))

    def changes(self, since: int = 0) -> Changes:
        """The cells that changed after the version `since`, including those that became empty; for 0, all cells with a
        surface. A cell replaces the previous one of its slot."""
        out = C.c_void_p()
        _abi.check(self._call(_abi.lib.scarp_live_changes, _values.whole_of("since", since, 0, 2**63), C.byref(out)))
        handle, cells = _Handle(out.value), []
        for k in range(_abi.lib.scarp_changes_count(handle.value)):
            one, cell = C.c_void_p(), _abi.LiveCell()
            cell.struct_size = C.sizeof(cell)
            _abi.check(_abi.lib.scarp_changes_cut(handle.value, k, C.byref(one)))
            owner = _Handle(one.value)
            _abi.check(_abi.lib.scarp_changes_cell(owner.value, 0, C.byref(cell)))
            cells.append(Cell(cell.slot, cell.version, cell.row, cell.col, cell.max_error,
                              memory_of(owner, cell.positions, (cell.vertices, 3), "<f4"),
                              memory_of(owner, cell.indices, (cell.triangles, 3), "<u2")))
        return Changes(_abi.lib.scarp_changes_version(handle.value), cells)

    def mesh(self) -> Mesh:
        """The whole field as one mesh, without a report. Moves do not change its coordinates: see transform."""
        out = C.c_void_p()
        _abi.check(self._call(_abi.lib.scarp_live_mesh, C.byref(out)))
        assert out.value is not None
        return Mesh(out.value, None, self._shape)

    @property
    def heights(self) -> NDArray[float32]:
        """A copy of the current samples."""
        import numpy as np
        samples = np.empty(self._shape, np.float32)
        _abi.check(self._call(_abi.lib.scarp_live_heights, samples.ctypes.data))
        return samples

    @property
    def max_error(self) -> float:
        """The largest measured error of a cell."""
        error: float = self._call(_abi.lib.scarp_live_max_error)
        return error

    @property
    def triangle_count(self) -> int:
        count: int = self._call(_abi.lib.scarp_live_triangle_count)
        return count

    @property
    def level(self) -> int:
        """The state of the search for the budget."""
        level: int = self._call(_abi.lib.scarp_live_level)
        return level

    @property
    def slot_count(self) -> int:
        count: int = self._call(_abi.lib.scarp_live_slot_count)
        return count

    def __reduce__(self) -> Any:
        raise TypeError("a scarp.Live is neither pickled nor copied: send its heights, or its mesh()")
