"""Terrain tiles for globes, made as they are asked for."""
from __future__ import annotations

import ctypes as C
import math
from typing import TYPE_CHECKING, Any, Optional

from . import _abi, _call, _inputs

if TYPE_CHECKING:
    from numpy import uint32
    from numpy.typing import NDArray


class Tiles:
    """The tiles of a raster, as `scarp tile` makes them: quantized-mesh, gzipped, whose edges fit and whose errors are
    proven. Needs a library with GDAL: see scarp.has_gdal.

    `source` as in simplify(); options as those of `scarp tile`: zoom=14, max_error=2, vertical="egm96", effort="high"
    ... Several threads may read tiles at once.
    """

    def __init__(self, source: Any, *, band: int = 1, transform: Any = None, crs: Any = None,
                 nodata: Optional[float] = None, threads: int = 0, progress: _call.ProgressArgument = None,
                 **options: Any) -> None:
        self._handle: Optional[int] = None
        self._input = _inputs.read(source, band=band, transform=transform, crs=crs, nodata=nodata)
        out = C.c_void_p()
        if self._input.path is not None:
            options.update({"band": None if band == 1 else band, "nodata": nodata})
        with _call.Settings(options) as settings:
            settings.struct.threads = threads
            lib = _abi.lib

            def work(pointer: Any) -> int:
                if self._input.path is not None:
                    return lib.scarp_tiles_open(self._input.path, pointer, C.byref(out))  # type: ignore[no-any-return]
                return lib.scarp_tiles_open_field(C.byref(self._input.field), pointer,  # type: ignore[no-any-return]
                                                  C.byref(out))

            _abi.check(_call.run(settings, progress, work))
        self._handle = out.value

    def __del__(self, free: Any = _abi.lib.scarp_tiles_free) -> None:
        if self._handle:
            free(self._handle)
            self._handle = None

    @property
    def max_level(self) -> int:
        """The finest level."""
        level: int = _abi.lib.scarp_tiles_max_level(self._handle)
        return level

    def list(self, level: int) -> NDArray[uint32]:
        """(N, 2) uint32: x and y of the tiles of the level, y from the south."""
        import numpy as np
        count = _abi.lib.scarp_tiles_count(self._handle, level)
        if count == 0:
            return np.empty((0, 2), dtype=np.uint32)
        values = C.string_at(_abi.lib.scarp_tiles_list(self._handle, level), 8 * count)
        return np.frombuffer(values, dtype=np.uint32).reshape(count, 2)

    def read(self, level: int, x: int, y: int) -> bytes:
        """The tile's bytes, as a server sends them with `Content-Encoding: gzip`. InputError if there is no such
        tile."""
        return self.read_with_bound(level, x, y)[0]

    def read_with_bound(self, level: int, x: int, y: int) -> tuple[bytes, Optional[float]]:
        """The same, and its proven error in metres; None for the coarsest tiles, of which nobody looked at all."""
        out, bound = C.c_void_p(), C.c_double()
        _abi.check(_abi.lib.scarp_tiles_read(self._handle, level, x, y, C.byref(out), C.byref(bound)))
        return _abi.take_bytes(out.value), None if math.isnan(bound.value) else bound.value

    def layer_json(self) -> bytes:
        """layer.json, which tells clients what tiles there are."""
        out = C.c_void_p()
        _abi.check(_abi.lib.scarp_tiles_read_file(self._handle, b"layer.json", C.byref(out)))
        return _abi.take_bytes(out.value)
