"""A raster's samples and position, from sources of all kinds."""
from __future__ import annotations

from typing import Any, NamedTuple, Optional


class Turn(NamedTuple):
    """The changes to a source's array for rows from north to south, and columns from west to east."""

    source: Any = None  #: the original DataArray of (y, x)
    is_transposed: bool = False
    flips_rows: bool = False
    flips_cols: bool = False

    def flip(self, rows: Any) -> Any:
        return rows[::-1 if self.flips_rows else 1, ::-1 if self.flips_cols else 1]

    def apply(self, values: Any) -> Any:
        """Applies the same changes to another array."""
        return self.flip(values.T if self.is_transposed else values)

    def place(self, rows: int, cols: int, at: Optional[tuple[int, int]]) -> Optional[tuple[int, int]]:
        """A sample's row and column in the source."""
        if at is None:
            return None
        row, col = rows - 1 - at[0] if self.flips_rows else at[0], cols - 1 - at[1] if self.flips_cols else at[1]
        return (col, row) if self.is_transposed else (row, col)


AS_GIVEN = Turn()


class Raster(NamedTuple):
    samples: Any = None
    transform: Any = None
    crs: Any = None
    nodata: Optional[float] = None
    name: Optional[str] = None
    unit: Optional[str] = None
    turn: Turn = AS_GIVEN
    is_in_degrees: bool = False  #: by the coordinates' own attributes


_loaded_numpy: Any = None


def numpy_if_there() -> Any:
    """Imported at its first use; None if it is not installed."""
    global _loaded_numpy
    if _loaded_numpy is None:
        try:
            import numpy
            _loaded_numpy = numpy
        except ImportError:
            pass
    return _loaded_numpy


def unpack(values: Any, voids: Any, scale: Any, offset: Any) -> tuple[Any, Optional[float]]:
    """Unpacks heights; returns them and the remaining nodata value."""
    np = numpy_if_there()
    scale, offset = float(1 if scale is None else scale), float(0 if offset is None else offset)
    voids = {float(void) for one in voids if one is not None for void in np.ravel(one) if void == void}
    if (scale, offset) == (1, 0) and len(voids) <= 1:
        return values, next(iter(voids), None)
    is_void = np.isin(np.ma.getdata(values), list(voids)) | np.ma.getmaskarray(values)
    return np.where(is_void, np.nan, np.ma.getdata(values).astype(np.float64) * scale + offset), None


def crs_text(crs: Any) -> str:
    if hasattr(crs, "__index__"):
        return "EPSG:%d" % int(crs)
    for name in ("to_epsg", "to_wkt", "to_string"):
        if not isinstance(crs, str) and hasattr(crs, name):
            text = getattr(crs, name)()
            if text:
                return "EPSG:%d" % text if isinstance(text, int) else str(text)
    return str(crs)
