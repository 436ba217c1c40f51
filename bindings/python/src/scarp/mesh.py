"""Meshes and their measured errors."""
from __future__ import annotations

import ctypes as C
import os
from typing import TYPE_CHECKING, Any, NamedTuple, Optional

from . import _abi, _values
from ._raster import numpy_if_there
from .errors import InputError, UsageError

if TYPE_CHECKING:
    from numpy import float32, float64, uint32
    from numpy.typing import NDArray

_STOPS = ("max_error", "max_triangles", "max_points", "exact")
_EFFORTS = {0: "fast", 1: "normal", 2: "high", 3: "max"}


class Report(NamedTuple):
    """The measured error of a mesh, by brute force, against every sample. Errors are vertical, mesh minus sample, in
    the units of the heights."""

    max_error: float  #: the largest |error|
    max_error_at: Optional[tuple[int, int]]  #: its (row, column); None without a sample
    rmse: float
    mean_error: float
    mean_abs_error: float
    p50: float  #: |error| below which half of the samples lie; p95, p99 likewise
    p95: float
    p99: float
    vertices: int
    triangles: int
    samples: int  #: number of samples judged
    uncovered: int  #: valid samples without a triangle
    stray: int  #: valid samples outside every valid cell
    over: int  #: samples above their tolerance, or above fail_above
    stop: Optional[str]  #: goal that ended the run: "max_error", "max_triangles", "max_points", "exact"; None: measured
                         #: only
    effort: Optional[str]  #: "fast", "normal", "high", "max"; None: measured only
    is_cut_short: bool  #: True if a time limit ended the effort
    seconds: float


class Volumes(NamedTuple):
    """The volumes between two surfaces over the area that both cover, in units of x, y and z of the first surface."""

    cut: float  #: volume where the surface after is below the surface before
    fill: float  #: volume where the surface after is above the surface before
    net: float  #: cut - fill
    uncertainty: Optional[float]  #: bound of the three, by the max errors of the meshes; None: a mesh has none
    common_area: float  #: area that both cover
    before_outside: float  #: area of the surface before that the one after does not cover
    after_outside: float  #: area of the surface after that the one before does not cover


def report_of(struct: Any, place: Any = None) -> Report:
    """`place` maps a sample of the library to one of the source."""
    made = struct.effort in _EFFORTS
    at = (struct.max_error_row, struct.max_error_col) if struct.max_error_row >= 0 else None
    at = place(at) if place else at
    return Report(struct.max_error, at, struct.rmse, struct.mean_error, struct.mean_abs_error, struct.p50, struct.p95,
                  struct.p99, struct.vertices, struct.triangles, struct.samples, struct.uncovered, struct.stray,
                  struct.over, _STOPS[struct.stop] if made else None, _EFFORTS.get(struct.effort),
                  bool(struct.is_cut_short), struct.seconds)


_Point = C.c_double * 3


class _Memory:
    """A pointer for numpy; keeps the owner of the memory alive."""

    def __init__(self, owner: object, address: int, shape: tuple[int, ...], kind: str) -> None:
        self.owner = owner
        self.__array_interface__ = {"version": 3, "data": (address, True), "shape": shape, "typestr": kind}


def memory_of(owner: object, address: Optional[int], shape: tuple[int, int], kind: str) -> Any:
    """A read-only array of numpy on memory that `owner` keeps."""
    import numpy as np
    if not address:
        return np.empty(shape, kind)
    return np.asarray(_Memory(owner, address, shape, kind))


class Mesh:
    """A triangle mesh with its proven error. Made by simplify(), Refiner.mesh(), Mesh.from_arrays() and read_mesh()."""

    __slots__ = ("_handle", "_vertices", "_place", "_shape", "__weakref__")

    def __init__(self, handle: int, place: Any = None, shape: Optional[tuple[int, ...]] = None) -> None:
        """Becomes the owner of a handle of the library; for this package alone."""
        if not isinstance(handle, int):
            raise TypeError("meshes are made by simplify(), Refiner.mesh(), Mesh.from_arrays() and read_mesh()")
        self._handle = handle
        self._vertices: Any = None
        self._place = place  # report_of()'s
        self._shape = shape  # shape of the array from which it was made; None: unknown

    def __del__(self, free: Any = _abi.lib.scarp_mesh_free) -> None:
        if hasattr(self, "_handle"):
            free(self._handle)

    @classmethod
    def from_arrays(cls, vertices: Any, triangles: Any) -> Mesh:
        """A mesh from (N, 3) absolute positions, float64, and (M, 3) indices, uint32, counter-clockwise from above.

        Both are copied. Raises InputError for an index out of range, UsageError for other shapes."""
        import numpy as np
        try:
            positions = np.ascontiguousarray(vertices, dtype=np.float64)
            given = np.asarray(triangles)
        except (TypeError, ValueError):
            raise UsageError("vertices are an array of numbers, (N, 3), and triangles one of indices, (M, 3)") from None
        for name, array in (("vertices", positions), ("triangles", given)):
            if array.ndim != 2 or array.shape[1] != 3:
                raise UsageError("%s are an array of (N, 3), not of %s" % (name, array.shape))
        if given.dtype.kind not in "iu":
            raise UsageError("triangles are indices, and their dtype is %s" % given.dtype)
        if given.size and (given.min() < 0 or given.max() >= len(positions)):
            raise InputError("the triangles name vertices from %d to %d, and there are %d"
                             % (given.min(), given.max(), len(positions)))
        indices = np.ascontiguousarray(given, dtype=np.uint32)
        out = C.c_void_p()
        _abi.check(_abi.lib.scarp_mesh_from_arrays(positions.ctypes.data, len(positions), indices.ctypes.data,
                                                   len(indices), C.byref(out)))
        assert out.value is not None
        return cls(out.value)

    def _view(self, address: Optional[int], rows: int, columns: int, kind: str) -> Any:
        if not address:
            return None
        if numpy_if_there() is None:
            item: Any = {"<f8": C.c_double, "<f4": C.c_float, "<u4": C.c_uint32}[kind]
            array = (item * (rows * columns)).from_address(address)
            setattr(array, "_keep", self)
            code = {"<f8": "d", "<f4": "f", "<u4": "I"}[kind]
            return memoryview(array).toreadonly().cast("B").cast(code, (rows, columns))
        return memory_of(self, address, (rows, columns), kind)

    @property
    def vertex_count(self) -> int:
        """Number of vertices."""
        count: int = _abi.lib.scarp_mesh_vertex_count(self._handle)
        return count

    @property
    def triangle_count(self) -> int:
        """Number of triangles."""
        count: int = _abi.lib.scarp_mesh_triangle_count(self._handle)
        return count

    @property
    def origin(self) -> tuple[float, float, float]:
        """The origin of `offsets`: x, y, z in the mesh's frame."""
        x, y, z = _Point.from_address(_abi.lib.scarp_mesh_origin(self._handle))
        return x, y, z

    @property
    def offsets(self) -> NDArray[float64]:
        """(N, 3) float64: x, y, z from `origin`. The library's own memory, read-only; valid as long as the array
        lives."""
        return self._view(_abi.lib.scarp_mesh_positions(self._handle), self.vertex_count, 3, "<f8")  # type: ignore

    @property
    def vertices(self) -> NDArray[float64]:
        """(N, 3) float64: absolute x, y, z; z in the units of the heights. Copied once at the first use, unless the
        origin is 0."""
        origin = self.origin
        if origin == (0.0, 0.0, 0.0):
            return self.offsets  # not kept: it holds the mesh
        if self._vertices is None:
            self._vertices = self.offsets + origin
            self._vertices.flags.writeable = False
        return self._vertices  # type: ignore[no-any-return]

    @property
    def triangles(self) -> NDArray[uint32]:
        """(M, 3) uint32: vertices of each triangle, counter-clockwise from above. The library's own memory,
        read-only."""
        return self._view(_abi.lib.scarp_mesh_triangles(self._handle), self.triangle_count, 3, "<u4")  # type: ignore

    @property
    def normals(self) -> Optional[NDArray[float32]]:
        """(N, 3) float32, of unit length; None unless requested (`normals=True`)."""
        return self._view(_abi.lib.scarp_mesh_normals(self._handle), self.vertex_count, 3, "<f4")  # type: ignore

    @property
    def uvs(self) -> Optional[NDArray[float32]]:
        """(N, 2) float32, (0, 0) top left of the raster; None unless requested (`uvs=True`)."""
        return self._view(_abi.lib.scarp_mesh_uvs(self._handle), self.vertex_count, 2, "<f4")  # type: ignore

    def _measured(self) -> Any:
        struct = _abi.new_report()
        _abi.check(_abi.lib.scarp_mesh_report(self._handle, C.byref(struct)))
        return struct

    @property
    def report(self) -> Report:
        """The proof of the mesh's error. UsageError for a mesh that was not measured: see measure()."""
        return report_of(self._measured(), self._place)

    @property
    def max_error(self) -> float:
        """The largest |mesh - sample| over all samples, in the units of the heights."""
        error: float = self._measured().max_error
        return error

    @property
    def rmse(self) -> float:
        """The root mean square error."""
        error: float = self._measured().rmse
        return error

    @property
    def crs(self) -> Optional[str]:
        """CRS of x and y: "EPSG:32611", WKT; None without one."""
        return self.metadata("crs")

    @property
    def frame(self) -> Optional[str]:
        """The frame of x and y, in words."""
        return self.metadata("frame")

    def metadata(self, key: str) -> Optional[str]:
        """The mesh's metadata: "command", "frame", "crs", "origin", "error" ..., as written to files."""
        text: Optional[bytes] = _abi.lib.scarp_mesh_metadata(self._handle, _values.text_of("the key", key))
        return None if text is None else text.decode()

    def encode(self, format: Optional[str] = None) -> bytes:
        """The bytes of a file: "glb", "obj", "ply", "stl", "2dm", "vtu", "dxf", "landxml", "3mf", "svg" ... DEFAULT:
        the format for which the mesh was made (`of`), else GLB. OutputError if the format cannot hold the mesh."""
        out = C.c_void_p()
        _abi.check(_abi.lib.scarp_mesh_encode(self._handle, None if format is None else _values.text_of("the format", format),
                                              C.byref(out)))
        return _abi.take_bytes(out.value)

    def write(self, path: str | os.PathLike[str], *, overwrite: bool = True) -> None:
        """Writes a file in the format of its ending: to a temporary name first, then renamed."""
        _abi.check(_abi.lib.scarp_mesh_write(self._handle, _values.path_of(path), bool(overwrite)))

    def measure(self, source: Any, **options: Any) -> Report:
        """scarp.measure(source, self, ...)."""
        from . import measure
        return measure(source, self, **options)

    def add_base(self, z: float) -> Mesh:
        """A solid with walls along every border and a flat base at z. UsageError unless z is below all vertices."""
        out = C.c_void_p()
        _abi.check(_abi.lib.scarp_mesh_add_base(self._handle, _values.number_of("the base", z), C.byref(out)))
        assert out.value is not None
        return Mesh(out.value, self._place, self._shape)

    def to_trimesh(self, **options: Any) -> Any:
        """A trimesh.Trimesh with the same vertices and triangles."""
        import trimesh
        return trimesh.Trimesh(self.vertices, self.triangles, process=options.pop("process", False), **options)

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData."""
        import numpy as np
        import pyvista
        faces = np.empty((self.triangle_count, 4), dtype=np.int64)
        faces[:, 0] = 3
        faces[:, 1:] = self.triangles
        return pyvista.PolyData(np.array(self.vertices), faces.ravel())

    def to_meshio(self) -> Any:
        """A meshio.Mesh of one block of triangles."""
        import meshio
        return meshio.Mesh(self.vertices, [("triangle", self.triangles)])

    def to_geopandas(self) -> Any:
        """A geopandas.GeoDataFrame: a polygon with heights for each triangle, in the mesh's CRS."""
        import geopandas
        import shapely.geometry
        corners = self.vertices[self.triangles]
        polygons = [shapely.geometry.Polygon(triangle) for triangle in corners]
        return geopandas.GeoDataFrame(geometry=polygons, crs=self.crs)

    def plot(self, ax: Any = None, *, wireframe: bool = True, cmap: str = "viridis", **options: Any) -> Any:
        """Draws the mesh from above with matplotlib, coloured by height; returns the axes."""
        import matplotlib.pyplot as plt
        if ax is None:
            ax = plt.gca()
        x, y, z = self.vertices.T
        heights = z[self.triangles].mean(axis=1)
        edges = {"edgecolors": "0.25", "linewidth": 0.25} if wireframe else {}
        drawn = ax.tripcolor(x, y, self.triangles, facecolors=heights, cmap=cmap, **{**edges, **options})
        ax.set_aspect("equal")
        ax.figure.colorbar(drawn, ax=ax, label="height")
        return ax

    def view(self, source: Any = None, path: Optional[str | os.PathLike[str]] = None, *, open: bool = True,
             **options: Any) -> str:
        """Writes a page that shows the mesh, one HTML file, and opens it in a browser. The file is in a temporary
        folder unless `path` is given. With the `source` of the mesh (and its options `transform`, `nodata` ...) the
        page shows the error of every sample. Returns the path, which a notebook shows as the page itself; `open=False`
        opens no browser. InputError if the page's template is missing, PromiseError if the mesh covers no sample of the
        source."""
        import tempfile
        import webbrowser
        from pathlib import Path

        from ._view import Page, make_page
        file = Path(path if path is not None else os.path.join(tempfile.mkdtemp(prefix="scarp-"), "mesh.html"))
        file.write_text(make_page(self, source, options), encoding="utf-8")
        if open:
            webbrowser.open(file.absolute().as_uri())
        return Page(file)

    def __reduce__(self) -> Any:
        """The whole mesh, for copies and for other processes with the same version of Scarp; use write() for files."""
        out = C.c_void_p()
        _abi.check(_abi.lib.scarp_mesh_pack(self._handle, C.byref(out)))
        return _unpack, (_abi.take_bytes(out.value), self._place, self._shape)

    def __repr__(self) -> str:
        counts = "%d vertices, %d triangles" % (self.vertex_count, self.triangle_count)
        try:
            return "<scarp.Mesh: %s, max error %.4g, RMSE %.4g>" % (counts, self.max_error, self.rmse)
        except UsageError:
            return "<scarp.Mesh: %s>" % counts

    def error_facts(self) -> dict[str, Any]:
        """The facts in the file about the mesh's error: "asked", "max_error", "rmse", "samples"."""
        import json
        text = self.metadata("error")
        facts: dict[str, Any] = json.loads(text) if text else {}
        return facts


def _unpack(packed: bytes, place: Any, shape: Optional[tuple[int, ...]] = None) -> Mesh:
    out = C.c_void_p()
    _abi.check(_abi.lib.scarp_mesh_unpack(packed, len(packed), C.byref(out)))
    assert out.value is not None
    return Mesh(out.value, place, shape)


def read_mesh(path: str | os.PathLike[str]) -> Mesh:
    """Reads a mesh file: GLB, OBJ, PLY, STL, 2DM, VTU ..., recognised by its content. InputError for other files."""
    out = C.c_void_p()
    _abi.check(_abi.lib.scarp_mesh_read(_values.path_of(path), C.byref(out)))
    assert out.value is not None
    return Mesh(out.value)
