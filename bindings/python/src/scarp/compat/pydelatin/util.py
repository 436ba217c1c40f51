"""pydelatin.util's interface."""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy import float32, float64
    from numpy.typing import NDArray

__all__ = ["decode_ele", "rescale_positions", "latitude_adjustment"]

#: The divisor of a three-byte number, and the offset added.
_ENCODINGS = {"mapbox": (10, -10000), "terrarium": (256, -32768)}


def decode_ele(png: Any, encoding: str) -> NDArray[float64]:
    """Heights of an image, (rows, columns, 3 or more) or (3 or 4, rows, columns); encoding: "mapbox" or "terrarium"."""
    import numpy as np
    if encoding not in _ENCODINGS:
        raise ValueError("encoding is %r: it is one of %s" % (encoding, ", ".join(_ENCODINGS)))
    bands = np.asarray(png)
    if bands.ndim != 3:
        raise ValueError("an image is an array of (rows, columns, bands), not of %s" % (bands.shape,))
    if bands.shape[0] <= 4:
        bands = np.moveaxis(bands, 0, -1)
    divisor, start = _ENCODINGS[encoding]
    heights: NDArray[float64] = bands[..., :3].astype(np.float64) @ np.array([65536, 256, 1]) / divisor + start
    return heights


def rescale_positions(vertices: Any, bounds: tuple[float, float, float, float], flip_y: bool = False) -> NDArray[float32]:
    """Vertices of a Delatin with x and y scaled to bounds: (min x, min y, max x, max y).

    flip_y: y = 0 becomes max y."""
    import numpy as np
    scaled = np.array(vertices, dtype=np.float64)
    low, high = np.array(bounds[:2], dtype=np.float64), np.array(bounds[2:], dtype=np.float64)
    share = scaled[:, :2] / np.maximum(scaled[:, :2].max(axis=0), 1e-300)
    if flip_y:
        share[:, 1] = 1 - share[:, 1]
    scaled[:, :2] = low + share * (high - low)
    return scaled.astype(np.float32)


def latitude_adjustment(lat: float) -> float:
    """The scale of Web Mercator at a latitude in degrees."""
    return math.cos(math.radians(lat))
