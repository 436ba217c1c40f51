"""Terrain tiles for globes: all at once, or on request."""
from __future__ import annotations

import ctypes as C
import math
import os
import warnings
from typing import TYPE_CHECKING, Any, Optional

from . import _abi, _call, _inputs, _values
from .errors import ScarpWarning, UsageError

if TYPE_CHECKING:
    from numpy import uint32
    from numpy.typing import NDArray


_NO_TILE = 2**31 - 1  # no level, no column and no row


def tile(source: Any, out: str | os.PathLike[str], *, band: int = 1, transform: Any = None, crs: Any = None,
         nodata: Optional[float] = None, threads: int = 0, overwrite: bool = False,
         progress: _call.ProgressArgument = None, **options: Any) -> dict[str, Any]:
    """Makes all tiles of a raster, with the same bytes as `scarp tile`. Needs a library with GDAL: see scarp.has_gdal.

    source     as in simplify(); or a list of paths: at each position the first file with a height counts
    out        a folder, or one file by its ending: .pmtiles, .mbtiles, .3tz. It gets its name once all tiles are made;
               a failed or cancelled call writes nothing.
    overwrite  replaces a set made by Scarp
    options    those of `scarp tile`, with _ for -: `zoom=14`, `max_error=2`, `vertical="egm96"`, `of="3dtiles"`,
               `effort="high"`, `only="7,46,8,47"` ...

    Returns the report of `scarp tile --report`: "max_zoom", "vertical", and "levels", each with "tiles", "bytes" and
    "bound". Raises and warns like simplify().
    """
    import json
    out_bytes = C.c_void_p()
    lib = _abi.lib
    target = _values.path_of(out, "out")
    if isinstance(source, (list, tuple)) and source and all(isinstance(one, (str, bytes, os.PathLike)) for one in source):
        if transform is not None or crs is not None:
            raise UsageError("transform and crs are for arrays: files tell theirs")
        read = _inputs.Input(None, None, None)
        paths = [_values.path_of(one) for one in source]
    else:
        read = _inputs.read(source, band=band, transform=transform, crs=crs, nodata=nodata)
        paths = [] if read.path is None else [read.path]
    if paths:
        options = {"band": None if band == 1 else band, "nodata": nodata, **options}
    with _call.Settings(options) as settings:
        settings.use_threads(threads)
        if paths:
            names = (C.c_char_p * len(paths))(*paths)
            _call.run(settings, progress, lib.scarp_tile_files, names, len(paths), settings.pointer, target, bool(overwrite),
                      C.byref(out_bytes))
        else:
            _call.run(settings, progress, lib.scarp_tile, C.byref(read.field), settings.pointer, target, bool(overwrite),
                      C.byref(out_bytes))
    report: dict[str, Any] = json.loads(_abi.take_bytes(out_bytes.value))
    for sentence in report.pop("warnings"):
        warnings.warn(sentence, ScarpWarning, stacklevel=2)
    return report


class Tiles:
    """The tiles of a raster, as from `scarp tile`: quantized-mesh, gzipped, with matching edges and proven errors.
    Needs a library with GDAL: see scarp.has_gdal.

    `source` as in simplify(); options as those of `scarp tile`: zoom=14, max_error=2, vertical="egm96", effort="high"
    ... Several threads may read tiles at once.
    """

    _handle: Optional[int]

    def __init__(self, source: Any, *, band: int = 1, transform: Any = None, crs: Any = None,
                 nodata: Optional[float] = None, threads: int = 0, progress: _call.ProgressArgument = None,
                 **options: Any) -> None:
        self._input = _inputs.read(source, band=band, transform=transform, crs=crs, nodata=nodata)
        out = C.c_void_p()
        if self._input.path is not None:
            options.update({"band": None if band == 1 else band, "nodata": nodata})
        with _call.Settings(options) as settings:
            settings.use_threads(threads)
            if self._input.path is not None:
                _call.run(settings, progress, _abi.lib.scarp_tiles_open, self._input.path, settings.pointer, C.byref(out))
            else:
                _call.run(settings, progress, _abi.lib.scarp_tiles_open_field, C.byref(self._input.field),
                          settings.pointer, C.byref(out))
        self._handle = out.value

    def __del__(self, free: Any = _abi.lib.scarp_tiles_free) -> None:
        if getattr(self, "_handle", None):
            free(self._handle)

    @property
    def max_level(self) -> int:
        """The finest level."""
        level: int = _abi.lib.scarp_tiles_max_level(self._handle)
        return level

    def list(self, level: int) -> NDArray[uint32]:
        """(N, 2) uint32: x and y of the tiles of the level, y from the south."""
        import numpy as np
        level = _values.whole_of("level", level, 0, _NO_TILE)
        count = _abi.lib.scarp_tiles_count(self._handle, level)
        if count == 0:
            return np.empty((0, 2), dtype=np.uint32)
        values = C.string_at(_abi.lib.scarp_tiles_list(self._handle, level), 8 * count)
        return np.frombuffer(values, dtype=np.uint32).reshape(count, 2)

    def read(self, level: int, x: int, y: int) -> bytes:
        """The tile's bytes, for a server that sends them with `Content-Encoding: gzip`. InputError if there is no such
        tile."""
        return self.read_with_bound(level, x, y)[0]

    def read_with_bound(self, level: int, x: int, y: int) -> tuple[bytes, Optional[float]]:
        """The tile's bytes, and its proven error in metres; None for the coarsest tiles, for which not all nodes were
        examined."""
        out, bound = C.c_void_p(), C.c_double()
        place = [_values.whole_of(name, value, 0, _NO_TILE) for name, value in (("level", level), ("x", x), ("y", y))]
        _abi.check(_abi.lib.scarp_tiles_read(self._handle, *place, C.byref(out), C.byref(bound)))
        return _abi.take_bytes(out.value), None if math.isnan(bound.value) else bound.value

    def layer_json(self) -> bytes:
        """The file layer.json, which lists the tiles for clients."""
        out = C.c_void_p()
        _abi.check(_abi.lib.scarp_tiles_read_file(self._handle, b"layer.json", C.byref(out)))
        return _abi.take_bytes(out.value)

    def __reduce__(self) -> Any:
        raise TypeError("scarp.Tiles are neither pickled nor copied: open them anew")
