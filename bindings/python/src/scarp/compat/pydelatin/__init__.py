"""pydelatin's interface: change the import, keep the code.

    from scarp.compat.pydelatin import Delatin
    from scarp.compat.pydelatin.util import decode_ele, rescale_positions

The algorithm is that of delatin: the worst sample first. `Delatin.effort = "normal"` needs about 0.57 of the triangles
for the same error.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

from ... import UsageError, simplify

if TYPE_CHECKING:
    from numpy import float32, uint32
    from numpy.typing import NDArray

__all__ = ["Delatin"]


class Delatin:
    """A mesh of `arr`, heights of (rows, columns), or flat with `height` and `width`.

    max_error is in the units of `arr`, before z_scale and z_exag. `vertices`: (N, 3) float32, x to the right, y up,
    both in samples, z times z_scale and z_exag. `triangles`: (M, 3) uint32. `error`: the largest error of a sample.
    """

    #: "fast": delatin's algorithm; "normal", "high", "max": fewer triangles.
    effort = "fast"

    def __init__(self, arr: Any, *, height: Optional[int] = None, width: Optional[int] = None, z_scale: float = 1,
                 z_exag: float = 1, max_error: float = 0.001, max_triangles: Optional[int] = None,
                 max_points: Optional[int] = None, base_height: float = 0, level: bool = False, invert: bool = False,
                 blur: float = 0, gamma: float = 0, border_size: float = 0, border_height: float = 1) -> None:
        import numpy as np
        for name, value in (("blur", blur), ("gamma", gamma), ("border_size", border_size)):
            if value:
                raise NotImplementedError("%s changes the heights before they are meshed: change the array first, "
                                          "with scipy.ndimage or numpy" % name)
        heights = np.asarray(arr, dtype=np.float32)
        if heights.ndim != 2:
            if height is None or width is None:
                raise ValueError("arr has %d dimensions: give height and width, or an array of (rows, columns)"
                                 % heights.ndim)
            heights = heights.reshape(height, width)
        if level:
            low, high = float(np.nanmin(heights)), float(np.nanmax(heights))
            heights = (heights - np.float32(low)) / np.float32(max(high - low, 1e-30))
        if invert:
            heights = np.float32(1) - heights
        greedy: dict[str, Any] = {"order": "greedy"} if self.effort == "fast" else {}
        # Positions in samples, not metres: prevents a warning about the relief.
        corners = (-0.5, 1, 0, heights.shape[0] - 0.5, 0, -1)
        mesh = simplify(heights, max_error, transform=corners, max_triangles=max_triangles or None, max_points=max_points or None,
                        effort=self.effort, **greedy)
        #: The largest |mesh - sample|, in the units of arr.
        self.error: float = mesh.max_error
        if base_height:
            lowest = float(mesh.vertices[:, 2].min())
            if not -float(base_height) < lowest:
                raise UsageError("base_height is %g, which puts the base at %g, and the lowest vertex is at %g: more than %g "
                                 "is needed" % (base_height, -float(base_height), lowest, -lowest))
            mesh = mesh.add_base(-float(base_height))
        scale = np.array([1, 1, z_scale * z_exag])
        self.vertices: NDArray[float32] = (mesh.vertices * scale).astype(np.float32)
        self.triangles: NDArray[uint32] = mesh.triangles.copy()
