"""Height fields to triangle meshes with a proven error bound.

>>> import numpy as np, scarp
>>> y, x = np.mgrid[0:200, 0:300]
>>> z = 50 * np.sin(x / 30) * np.cos(y / 40)
>>> mesh = scarp.simplify(z, 0.5)             # every sample within 0.5 of the mesh: proven
>>> mesh.vertices.shape, mesh.triangles.dtype, mesh.max_error <= 0.5
>>> mesh.write("hills.glb")

The functions accept these as `source`:
  - an array (rows, columns), the first row in the north. float32 is not copied. float64 and integers are rounded to
    float32, and bounds hold for the given values. NaN, infinities and masked samples are nodata.
  - an xarray.DataArray, or a Dataset of one variable, with evenly spaced coordinates, and CRS and nodata as in CF or
    rioxarray; degrees without a CRS are WGS 84. Uneven coordinates fail.
  - an open rasterio dataset
  - the path of a raster or of points
"""
from __future__ import annotations

import ctypes as C
import os
import warnings
from typing import TYPE_CHECKING, Any, Optional

from . import _abi, _call, _inputs, _raster, _values
from ._call import Progress
from .errors import (Cancelled, InputError, InternalError, OutputError, PromiseError, ScarpError, ScarpWarning,
                     UsageError)
from .live import Cell, Changes, Live
from .mesh import Mesh, Report, Volumes, read_mesh, report_of
from .refiner import Refiner
from .tiles import Tiles, tile

if TYPE_CHECKING:
    from ._call import ProgressArgument

__version__: str = _abi.lib.scarp_version().decode()
#: True if the library reads GDAL's formats and knows CRSs. Else rasterio or GDAL's own Python reads paths.
has_gdal: bool = bool(_abi.lib.scarp_has_gdal())

__all__ = ["simplify", "simplify_points", "measure", "volume", "read_mesh", "Mesh", "Report", "Volumes", "Refiner", "Live", "Cell",
           "Changes", "Tiles", "tile", "Progress", "ScarpError", "UsageError", "InputError", "PromiseError", "OutputError", "Cancelled", "InternalError",
           "ScarpWarning", "has_gdal", "__version__"]


_MOST = 2**63  # large enough to be no limit


def _finish(handle: Any, place: Any = None, shape: Optional[tuple[int, ...]] = None) -> Mesh:
    mesh = Mesh(handle, place, shape)
    _call.warn(handle, 3)
    return mesh


def _goals(settings: _call.Settings, max_error: float | str | None, max_triangles: Optional[int],
           max_points: Optional[int], threads: int) -> None:
    struct = settings.struct
    if max_error is not None and not isinstance(max_error, str):
        struct.max_error = _values.bound_of("max_error", max_error)
    if max_triangles is not None:
        struct.max_triangles = _values.whole_of("max_triangles", max_triangles, 1, _MOST)
    if max_points is not None:
        struct.max_points = _values.whole_of("max_points", max_points, 1, _MOST)
    settings.use_threads(threads)


def _lend(settings: _call.Settings, source: _inputs.Input, mask: Any, tolerance: Any,
          named: dict[str, Any]) -> None:
    """Sets mask and tolerance given as arrays; paths are options by name."""
    if mask is None and tolerance is None:
        return
    for name, values in (("mask", mask), ("tolerance", tolerance)):
        if values is None or name in named:
            continue
        if source.field is None:
            raise UsageError("%s is an array, and the heights are a file: give both as arrays, or both as files" % name)
        array = _inputs.grid_values(values, source, name)
        settings.keep.append(array)
        setattr(settings.struct, name, array.ctypes.data)


def _by_name(source: _inputs.Input, frame: str, band: int, nodata: Optional[float], mask: Any, tolerance: Any,
             max_error: float | str | None, named: dict[str, Any]) -> None:
    """Adds options that have no member in the struct to those by name."""
    if frame != "auto":
        named["crs"] = frame
    if source.path is not None:
        named["band"] = None if band == 1 else band
        named["nodata"] = nodata
    if mask is not None and isinstance(mask, (str, os.PathLike)):
        named["mask"] = mask
    if tolerance is not None and isinstance(tolerance, (str, os.PathLike)):
        named["tolerance"] = tolerance
    if isinstance(max_error, str):
        named["max_error"] = max_error


def simplify(source: Any, max_error: float | str | None = None, *, max_triangles: Optional[int] = None,
             max_points: Optional[int] = None, effort: Optional[str] = None, band: int = 1, transform: Any = None,
             crs: Any = None, nodata: Optional[float] = None, frame: str = "auto", mask: Any = None,
             tolerance: Any = None, normals: bool = False, threads: int = 0,
             progress: ProgressArgument = None, **options: Any) -> Mesh:
    """Simplifies heights to a small mesh within an error bound, or to the best mesh for a budget.

    source         see the module's help
    max_error      every sample is within this of the mesh, vertically, in the units of the heights; "0.5%" of the
                   relief; "1m", "3ft" if the file has a unit
    max_triangles, max_points   upper bounds; the first goal reached ends the run. At least one goal is required.
    effort         "fast", "normal" (DEFAULT), "high" or "max": fewer triangles for more time
    band           of a file or dataset, from 1
    transform      map to pixel corners: rasterio's Affine, or GDAL's six numbers
    crs            CRS of the transform: "EPSG:32611", an EPSG code, WKT, a CRS of rasterio or pyproj
    nodata         a value that is no height (NaN and infinities never are)
    frame          x and y of the mesh. "auto": by the transform, degrees become metres from the centre; "source": by
                   the transform, degrees do not change; "local": from the centre; "grid": columns and rows; or a CRS
                   (with GDAL)
    mask           (rows, columns) weights: weight * |error| is bounded; 0 and NaN: no bound. Or a file.
    tolerance      (rows, columns) bounds for the samples; NaN: none. Or a file.
    normals        Mesh.normals from all samples
    threads        0: all cores, or one for few samples; never changes the mesh
    progress       True: a bar; or a function of a Progress, which returns False to raise Cancelled
    options        any other option of `scarp simplify` except those for its terminal, with _ for -: `vertices="free"`,
                   `breaklines="dikes.gpkg"`, `min_angle=25`, `nodata_policy="fill"`, `of="obj"` (the format of the
                   mesh, which determines rounding and frame like the program's OUTPUT) ...

    Returns a Mesh. Raises UsageError, InputError, PromiseError, OutputError, Cancelled; warns with ScarpWarning. Runs
    without Python's lock. The same samples and options give the same bytes in Python, in C and from the program.
    """
    read = _inputs.read(source, band=band, transform=transform, crs=crs, nodata=nodata)
    if transform is None and crs is None and mask is None and tolerance is None:
        _warn_of_points(source)
    out = C.c_void_p()
    if effort is not None:
        options["effort"] = effort
    if normals:
        options["normals"] = True
    _by_name(read, frame, band, nodata, mask, tolerance, max_error, options)
    with _call.Settings(options) as settings:
        _goals(settings, max_error, max_triangles, max_points, threads)
        _lend(settings, read, mask, tolerance, options)
        settings.is_brief = read.is_small() and options.keys() <= {"effort"} and effort in (None, "fast", "normal")
        if read.path is not None:
            _call.run(settings, progress, _abi.lib.scarp_simplify_file, read.path, settings.pointer, C.byref(out))
        else:
            _call.run(settings, progress, _abi.lib.scarp_simplify, C.byref(read.field), settings.pointer, C.byref(out))
    return _finish(out.value, read.place(), _inputs.shape_of(source))


def simplify_points(points: Any, max_error: float | str | None = None, *, max_triangles: Optional[int] = None,
                    max_points: Optional[int] = None, crs: Any = None, threads: int = 0,
                    progress: ProgressArgument = None, **options: Any) -> Mesh:
    """The same for scattered points: (N, 3) of x, y, z, which Python does not copy if float64; or a path. Rows with a
    masked number are omitted.

    The mesh covers their convex hull, its vertices are points, and every point is within max_error of it. `duplicates`:
    the rule for several points at one position: "first" (DEFAULT), "last", "highest", "lowest", "mean". `nodata`:
    points with that height, and those without a finite height, are omitted. `crs` and `frame`: as in simplify();
    degrees become metres from the middle of the points. `boundary="concave:50"`: the mesh ends at a concave hull, with
    edges at most 50 long where the points allow it. Of a LAS or LAZ file, `class_="ground,water"` and `returns="last"`
    choose points. `tolerance`: (N,) bounds for the points, in addition to max_error, at least 0; infinity: none. Or
    the file of a raster.
    """
    out = C.c_void_p()
    lib = _abi.lib
    if isinstance(max_error, str):
        options["max_error"] = max_error
    tolerance = options.get("tolerance")
    is_array = tolerance is not None and not isinstance(tolerance, (str, os.PathLike))
    if is_array:
        del options["tolerance"]
    with _call.Settings(options) as settings:
        _goals(settings, max_error, max_triangles, max_points, threads)
        if isinstance(points, (str, bytes, os.PathLike)):
            if is_array:
                raise UsageError("tolerance is an array, and the points are a file: give both as arrays, or both as files")
            _call.run(settings, progress, lib.scarp_simplify_file, _values.path_of(points), settings.pointer,
                      C.byref(out))
        else:
            struct, array = _points_of(points, crs)
            settings.keep.append(array)
            if is_array:
                _lend_bounds(settings, tolerance, points, len(array))
            _call.run(settings, progress, lib.scarp_simplify_points, C.byref(struct), settings.pointer, C.byref(out))
    return _finish(out.value)


def _lend_bounds(settings: _call.Settings, tolerance: Any, points: Any, count: int) -> None:
    """Sets the bounds of `count` points, which are the rows of `points` without a masked number."""
    array = _inputs.point_values(tolerance, points, count, "tolerance")
    settings.keep.append(array)
    settings.struct.tolerance = array.ctypes.data


def _points_of(points: Any, crs: Any) -> tuple[Any, Any]:
    import numpy as np
    try:
        given = np.asarray(points)
    except ValueError:
        raise UsageError("points are rows of x, y, z") from None
    if given.dtype.kind not in "iuf":
        raise UsageError("points are numbers, and their dtype is %s" % given.dtype)
    if given.ndim != 2 or given.shape[1] != 3:
        more = given.ndim == 2 and given.shape[1] > 3
        raise UsageError("points are an array of (N, 3): x, y, z; not of %s%s"
                         % (given.shape, ": take three columns, as in points[:, :3]" if more else ""))
    if given.dtype.kind in "iu" and given.size and max(-int(given.min()), int(given.max())) > 2**53:
        raise InputError("a coordinate or height is beyond 2^53, where float64 holds no other integer than every second: "
                         "subtract a base first")
    if isinstance(points, np.ma.MaskedArray):
        masked: Any = points.mask
        if masked is not np.ma.nomask:
            given = given[~masked.any(axis=1)]
    array = np.ascontiguousarray(given, dtype=np.float64)
    struct = _abi.new_points()
    base = array.ctypes.data
    struct.x, struct.y, struct.z = base, base + 8, base + 16
    struct.count, struct.stride = len(array), 3
    if crs is not None:
        struct.crs = _values.text_of("crs", _raster.crs_text(crs))
        struct.frame = _inputs.frame_of_points(crs)
    return struct, array


_MANY_ROWS = 16  # with this many rows, an array of three columns is probably points


def _warn_of_points(source: Any) -> None:
    shape = _inputs.shape_of(source)
    if _inputs.looks_like_points(source) and shape and shape[0] >= _MANY_ROWS:
        warnings.warn("the array of %s is taken for a raster of 3 columns: if its rows are points x, y, z, call "
                      "scarp.simplify_points()" % (shape,), ScarpWarning, stacklevel=3)


def _are_points(source: Any, mesh: Mesh) -> bool:
    """Decides by the origin of the mesh if known, else by the shape of the array."""
    shape = _inputs.shape_of(source)
    if shape is None:
        return False
    if mesh.metadata("duplicates") is not None:  # metadata of a mesh of points
        return True
    return _inputs.looks_like_points(source) and shape != mesh._shape


def measure(source: Any, mesh: Any, triangles: Any = None, *, band: int = 1, transform: Any = None, crs: Any = None,
            nodata: Optional[float] = None, frame: str = "auto", mask: Any = None, tolerance: Any = None,
            points: Optional[bool] = None, threads: int = 0, progress: ProgressArgument = None, **options: Any) -> Report:
    """Judges a mesh against every sample by brute force, regardless of its origin.

    `source` and its position: as in simplify(), or points as in simplify_points(). An array is points with a mesh of
    points, and if its shape is (N, 3), unless the mesh was made from an array of that shape. With transform, nodata,
    mask or tolerance of two dimensions it is a raster. `points`, True or False, overrides this. `mesh`: a Mesh, or
    (N, 3) vertices with (M, 3) triangles. `fail_above=1.5` raises PromiseError if the error of a sample is larger. Other
    options are those of `scarp measure`: `cutline`, `script` ... Returns a Report.
    """
    if triangles is not None:
        mesh = Mesh.from_arrays(mesh, triangles)
    if not isinstance(mesh, Mesh):
        raise UsageError("a Mesh, or vertices and triangles, not %s" % type(mesh).__name__)
    lib = _abi.lib
    struct = _abi.new_report()
    bounds_points = _inputs.is_row(tolerance)
    of_rasters = {"transform": transform, "nodata": nodata, "mask": mask,
                  "tolerance": None if bounds_points else tolerance}
    given = [name for name, value in of_rasters.items() if value is not None]
    is_points = not given and _are_points(source, mesh) if points is None else bool(points)
    if is_points:
        if given:
            raise UsageError("%s is for rasters, and the source is points: leave it out" % given[0])
        if isinstance(source, (str, bytes, os.PathLike)):
            raise UsageError("points is for arrays: what a file holds, it says itself")
        field, keep = _points_of(source, crs)
        read = _inputs.Input(None, field, keep)
    else:
        read = _inputs.read(source, band=band, transform=transform, crs=crs, nodata=nodata)
    _by_name(read, frame, band, nodata, mask, tolerance, None, options)
    with _call.Settings(options) as settings:
        settings.use_threads(threads)
        if not is_points:
            _lend(settings, read, mask, tolerance, options)
        elif bounds_points:
            _lend_bounds(settings, tolerance, source, read.field.count)
        judge = lib.scarp_measure_points if is_points else lib.scarp_measure
        what = C.byref(read.field) if read.path is None else read.path
        _call.run(settings, progress, judge if read.path is None else lib.scarp_measure_file, what, mesh._handle,
                  settings.pointer, C.byref(struct))
    return report_of(struct, None if is_points else read.place())


def _surface(given: Any) -> Mesh:
    if isinstance(given, Mesh):
        return given
    if isinstance(given, (str, os.PathLike)):
        return read_mesh(given)
    raise UsageError("a Mesh, the path of one, or a level, not %s" % type(given).__name__)


def volume(before: Any, after: Any, *, threads: int = 0, progress: ProgressArgument = None) -> Volumes:
    """The volumes of cut and fill from the ground before to the ground after, exact for the triangles of both.

    `before` and `after`: a Mesh or the path of one; one of them may be a number, a level. Meshes are compared in the
    frames that their metadata name. Volumes are in the units of x, y and z. Raises InputError for meshes without common
    area, solids, and triangles that stand upright, face down or overlap. Returns Volumes.

    >>> y, x = np.mgrid[0:50, 0:80]
    >>> hill = scarp.simplify(10.0 * np.exp(-((x - 40) ** 2 + (y - 25) ** 2) / 200), 0.01)
    >>> scarp.volume(hill, 5).cut > 0         # above the level 5
    """
    levels = [isinstance(each, (int, float)) or hasattr(each, "__float__") for each in (before, after)]
    if all(levels):
        raise UsageError("both surfaces are levels: give a mesh in place of one")
    struct = _abi.new_volumes()
    with _call.Settings({}) as settings:
        settings.use_threads(threads)
        if any(levels):
            mesh, level = (_surface(after), before) if levels[0] else (_surface(before), after)
            _call.run(settings, progress, _abi.lib.scarp_measure_volume_to_level, mesh._handle,
                      _values.number_of("the level", level), settings.pointer, C.byref(struct))
        else:
            meshes = _surface(before), _surface(after)
            _call.run(settings, progress, _abi.lib.scarp_measure_volume, meshes[0]._handle, meshes[1]._handle,
                      settings.pointer, C.byref(struct))
    of = struct
    uncertainty = None if of.uncertainty != of.uncertainty else of.uncertainty
    if levels[0]:
        return Volumes(of.fill, of.cut, -of.net, uncertainty, of.common_area, of.to_outside, of.from_outside)
    return Volumes(of.cut, of.fill, of.net, uncertainty, of.common_area, of.from_outside, of.to_outside)
