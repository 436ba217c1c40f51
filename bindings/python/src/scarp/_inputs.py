"""Converts arrays, datasets and paths to fields of the library."""
from __future__ import annotations

import ctypes as C
import functools
import os
from typing import Any, NamedTuple, Optional

from . import _abi, _values
from ._raster import AS_GIVEN, Raster, Turn, crs_text, numpy_if_there, unpack
from .errors import InputError, UsageError

_GRID, _SOURCE, _DEGREES = 0, 1, 2
_LARGEST_SIDE = 2**31 - 1
_SMALL = 2**14  # samples


class Input(NamedTuple):
    """The input of a call: a path, or a struct and the data behind its pointers."""

    path: Optional[bytes]
    field: Any
    keep: Any
    turn: Turn = AS_GIVEN

    def place(self) -> Any:
        """The map from a sample's row and column to those in the source; None if they are the same."""
        if self.turn[1:] == AS_GIVEN[1:]:
            return None
        return functools.partial(self.turn._replace(source=None).place, self.field.rows, self.field.cols)

    def is_small(self) -> bool:
        """True if simplification needs less than some 0.1 s with default options."""
        return self.path is None and bool(self.field.rows * self.field.cols <= _SMALL)


_NO_PLACE = Raster()


def shape_of(source: Any) -> Optional[tuple[int, ...]]:
    """Shape of an array, or of rows; None for sources with a position."""
    if _is_path(source) or hasattr(source, "coords") or hasattr(source, "read"):
        return None
    shape = getattr(source, "shape", None)
    if shape is None and isinstance(source, (list, tuple)):
        shape = (len(source), len(source[0]) if source and hasattr(source[0], "__len__") else 0)
    return None if shape is None else tuple(shape)


def looks_like_points(source: Any) -> bool:
    """Rows of three numbers."""
    shape = shape_of(source)
    return shape is not None and len(shape) == 2 and shape[1] == 3


def _is_path(source: object) -> bool:
    return isinstance(source, (str, bytes, os.PathLike))


def _has_file_reader(path: str) -> bool:
    """True if the library itself reads the file: PGM, STM, LAS and text of points always, others with GDAL."""
    own = (".pgm", ".stm", ".las", ".laz", ".csv", ".tsv", ".xyz", ".txt")
    return bool(_abi.lib.scarp_has_gdal()) or path.lower().endswith(own)


def _read_dataset(dataset: Any, band: int, name: str, nodata: Optional[float]) -> Raster:
    """A rasterio dataset."""
    if getattr(dataset, "closed", False):
        raise InputError("the dataset %s is closed: open it again, or simplify within its `with`" % name)
    band = _values.whole_of("band", band, -_LARGEST_SIDE, _LARGEST_SIDE)
    if not 1 <= band <= dataset.count:
        raise InputError("%s has %d band%s; there is no band %d"
                         % (name, dataset.count, "" if dataset.count == 1 else "s", band))
    transform = dataset.transform
    located = dataset.crs is not None or not getattr(transform, "is_identity", False)
    flags = [flag.name for flag in dataset.mask_flag_enums[band - 1]]
    try:
        samples = dataset.read(band, masked="nodata" not in flags and "all_valid" not in flags)
    except Exception as error:  # opened for writing, or damaged
        if not isinstance(error, OSError) and not type(error).__module__.startswith("rasterio"):
            raise
        raise InputError("the dataset %s cannot be read: %s" % (name, error)) from error
    samples, nodata = unpack(samples, [dataset.nodatavals[band - 1] if nodata is None else nodata],
                             dataset.scales[band - 1], dataset.offsets[band - 1])
    return Raster(samples, transform if located else None, dataset.crs, nodata, name, dataset.units[band - 1])


def _refuse(path: str, error: Exception) -> InputError:
    sentence = str(error)
    return InputError(sentence if path and sentence.startswith(path) else "%s: %s" % (path, sentence))


def _read_path(path: str, band: int, nodata: Optional[float]) -> Raster:
    """Reads a file by rasterio, else by GDAL's own Python."""
    try:
        import rasterio
    except ImportError:
        pass
    else:
        try:
            with rasterio.open(path) as dataset:
                return _read_dataset(dataset, band, os.path.basename(path), nodata)
        except (rasterio.errors.RasterioError, OSError, UnicodeError) as error:
            raise _refuse(path, error) from error
    try:
        from osgeo import gdal
    except ImportError:
        raise InputError("%s: this build of Scarp has no GDAL, and neither rasterio nor osgeo.gdal is installed: "
                         "pip install rasterio" % path) from None
    gdal.UseExceptions()
    try:
        dataset = gdal.Open(path)
        gdal_band = dataset.GetRasterBand(band)
        transform = dataset.GetGeoTransform(can_return_null=True)
        samples, nodata = unpack(gdal_band.ReadAsArray(), [gdal_band.GetNoDataValue() if nodata is None else nodata],
                                 gdal_band.GetScale(), gdal_band.GetOffset())
        return Raster(samples, transform, dataset.GetProjection() or None, nodata, os.path.basename(path),
                      gdal_band.GetUnitType())
    except RuntimeError as error:
        raise _refuse(path, error) from error


def _geotransform(transform: Any) -> tuple[float, ...]:
    """GDAL's six numbers of pixel corners, from rasterio's Affine or from six numbers in GDAL's order."""
    if all(hasattr(transform, letter) for letter in "abcdef"):
        t = transform
        numbers: tuple[Any, ...] = (t.c, t.a, t.b, t.f, t.d, t.e)
    else:
        try:
            numbers = tuple(transform)
        except TypeError:
            numbers = ()
    if len(numbers) != 6:
        raise UsageError("transform is an Affine, or GDAL's six numbers x0, dx, rx, y0, ry, dy: %d were given"
                         % len(numbers))
    return tuple(_values.number_of("each of the six numbers of transform", number) for number in numbers)


def _is_geographic(crs: Any) -> Optional[bool]:
    """None: unknown."""
    if hasattr(crs, "is_geographic"):
        return bool(crs.is_geographic)
    text = crs_text(crs)
    if text.startswith(("GEOGCS", "GEOGCRS", "+proj=longlat")):
        return True
    if text.upper() in ("EPSG:4326", "EPSG:4258", "EPSG:4269", "OGC:CRS84", "WGS84"):
        return True
    if text.startswith(("PROJCS", "PROJCRS")):
        return False
    for module, maker in (("rasterio.crs", "from_user_input"), ("pyproj", "from_user_input")):
        try:
            crs_class = getattr(__import__(module, fromlist=["CRS"]), "CRS")
            return bool(getattr(crs_class, maker)(crs).is_geographic)
        except ImportError:
            continue
        except (ValueError, RuntimeError) as error:
            raise UsageError("the CRS %s: %s" % (text, error)) from error
    return None


def frame_of_points(crs: Any) -> int:
    """The frame for a library that knows no CRS."""
    return _DEGREES if not _abi.lib.scarp_has_gdal() and _is_geographic(crs) else 0


def _check_shape(shape: tuple[int, ...]) -> None:
    if len(shape) != 2:
        raise UsageError("heights are an array of (rows, columns), not of %d dimension%s%s"
                         % (len(shape), "" if len(shape) == 1 else "s",
                            ": pick one band, as in z[0]" if len(shape) == 3 else ""))
    if max(shape) > _LARGEST_SIDE:
        raise InputError("%d x %d samples: a side may have at most %d" % (shape[1], shape[0], _LARGEST_SIDE))


def _as_float32(np: Any, z: Any) -> tuple[Any, float]:
    """The samples as C-contiguous float32 (not copied if they already are), and the largest rounding."""
    mask = np.ma.getmask(z) if isinstance(z, np.ma.MaskedArray) else np.ma.nomask
    if isinstance(z, np.ma.MaskedArray):
        z = z.data
    z = np.asarray(z)
    if z.dtype.kind not in "iuf":
        raise UsageError("heights are numbers, and the array's dtype is %s: convert it, as in z.astype('float32')"
                         % z.dtype)
    _check_shape(z.shape)
    if mask is not np.ma.nomask and mask.any():
        z = np.where(mask, np.float32(np.nan), z)  # values below a mask may be anything
    if z.dtype.type is np.float64 and z.flags.c_contiguous and z.flags.aligned and z.dtype.isnative:
        samples = np.empty(z.shape, np.float32)
        rounding = _abi.lib.scarp_round_samples(z.ctypes.data, z.size, samples.ctypes.data)
    else:
        with np.errstate(over="ignore"):  # the library warns of infinities
            samples = np.ascontiguousarray(z, dtype=np.float32)
        is_rounded = z.dtype.itemsize > (4 if z.dtype.kind == "f" else 2)
        rounding = _largest_rounding(np, z, samples) if is_rounded else 0.0
    return samples, rounding


def _largest_rounding(np: Any, given: Any, samples: Any) -> float:
    """The largest rounding, from a few rows at a time."""
    largest = 0.0
    wide = given.dtype if given.dtype.kind == "f" and given.dtype.itemsize > 8 else np.float64
    rows = max(1, _SMALL // max(samples.shape[1], 1))
    with np.errstate(invalid="ignore", over="ignore"):
        for first in range(0, len(samples), rows):
            difference = np.abs(given[first:first + rows].astype(wide) - samples[first:first + rows])
            most = difference.max(initial=0.0)
            if not most < np.inf:  # the largest among nodata: no roundings
                most = difference.max(initial=0.0, where=np.isfinite(difference))
            largest = max(largest, float(most))
    return largest + (_rounding_of_integers(np, given) if given.dtype.kind in "iu" else 0.0)


def _rounding_of_integers(np: Any, given: Any) -> float:
    """Max distance of integers from float64, which holds all up to 2^53."""
    farthest = max(-int(given.min(initial=0)), int(given.max(initial=0)))
    return float(np.spacing(float(farthest))) / 2 if farthest > 2**53 else 0.0


def _from_buffer(z: Any) -> tuple[int, int, int, Any]:
    """Rows, columns and address of float32 samples in an object with the buffer protocol, for use without numpy."""
    try:
        view = memoryview(z)
    except TypeError:
        raise UsageError("heights are a two-dimensional array of float32, not %s" % type(z).__name__) from None
    _check_shape(view.shape or ())
    if view.format not in ("f", "<f", "=f") or not view.c_contiguous:
        raise UsageError("without numpy heights are C-contiguous float32 ('f'), not '%s': install numpy" % view.format)
    flat = view.cast("B")
    keep = (C.c_char * len(flat)).from_buffer(flat) if not view.readonly else \
        (C.c_char * len(flat)).from_buffer_copy(flat)
    assert view.shape is not None
    return view.shape[0], view.shape[1], C.addressof(keep), keep


def grid_values(values: Any, source: Input, name: str) -> Any:
    """A mask or tolerances on the grid of the heights, as float32."""
    np, turn = numpy_if_there(), source.turn
    if np is None:
        raise UsageError("%s needs numpy" % name)
    if turn.source is not None and _is_of_xarray(values):
        from . import _xarray
        values, turn = _xarray.align(values, turn.source, name), turn._replace(is_transposed=False)
    if isinstance(values, np.ma.MaskedArray):
        values = values.astype(np.float32).filled(np.nan)
    try:
        array = np.ascontiguousarray(values, dtype=np.float32)
    except (TypeError, ValueError):
        raise UsageError("%s is an array of numbers, (rows, columns)" % name) from None
    rows, cols = source.field.rows, source.field.cols
    expected = (cols, rows) if turn.is_transposed else (rows, cols)
    if array.shape != expected:
        raise UsageError("%s has the shape %s, and the heights have %s" % (name, array.shape, expected))
    return np.ascontiguousarray(turn.apply(array))


def is_row(values: Any) -> bool:
    """True for an array or a sequence of one dimension."""
    np = numpy_if_there()
    return np is not None and not _is_path(values) and values is not None and bool(np.ndim(values) == 1)


def point_values(values: Any, points: Any, count: int, name: str) -> Any:
    """Bounds of points, as float32 rounded down; without the rows of points that have a masked number."""
    np = numpy_if_there()
    if isinstance(values, np.ma.MaskedArray):
        values = values.astype(np.float64).filled(np.inf)
    try:
        given = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise UsageError("%s is an array of numbers, one for each point" % name) from None
    if given.shape != (len(points),):
        raise UsageError("%s has the shape %s, and there are %d points: it is an array of (%d,)"
                         % (name, given.shape, len(points), len(points)))
    bad = np.flatnonzero(~(given >= 0))
    if bad.size:
        raise UsageError("%s[%d] is %g: it must be at least 0, and infinity is no bound" % (name, bad[0], given[bad[0]]))
    mask: Any = points.mask if isinstance(points, np.ma.MaskedArray) else np.ma.nomask
    if mask is not np.ma.nomask:
        given = given[~mask.any(axis=1)]
    assert len(given) == count
    with np.errstate(over="ignore"):
        array = given.astype(np.float32)
    above = array > given
    array[above] = np.nextafter(array[above], np.float32(0))
    return np.ascontiguousarray(array)


def _is_of_xarray(source: Any) -> bool:
    """A DataArray or a Dataset."""
    return all(hasattr(source, name) for name in ("dims", "coords")) and \
        any(hasattr(source, name) for name in ("values", "data_vars"))


def read(source: Any, *, band: int = 1, transform: Any = None, crs: Any = None, nodata: Optional[float] = None,
         wants_array: bool = False) -> Input:
    """Converts the source for the library. Arguments override the source's own attributes."""
    np = numpy_if_there()
    nodata = None if nodata is None else _values.number_of("nodata", nodata)
    if np is not None and type(source) is np.ndarray:  # the most frequent first
        raster = _NO_PLACE
    elif _is_path(source):
        path = _values.path_of(source)
        if _has_file_reader(os.fsdecode(path)) and not wants_array and transform is None and crs is None:
            return Input(path, None, None)
        raster = _read_path(os.fsdecode(path), band, nodata)
    elif hasattr(source, "read") and hasattr(source, "transform") and hasattr(source, "crs"):
        raster = _read_dataset(source, band, os.path.basename(str(getattr(source, "name", "dataset"))), nodata)
    elif _is_of_xarray(source):
        from . import _xarray
        raster = _xarray.read(source, transform is not None, nodata)
    else:
        raster = _NO_PLACE
    field, keep = _field_of(np, source if raster is _NO_PLACE else raster.samples)
    if raster is not _NO_PLACE:
        nodata = raster.nodata
    if nodata is not None:
        field.nodata = nodata
    if raster.name is not None:
        field.name = _values.text_of("the name", raster.name)
    if raster.unit:
        field.unit = _values.text_of("the unit", raster.unit)
    is_in_degrees = transform is None and raster.is_in_degrees
    if transform is None:
        transform = raster.transform
    if transform is not None:
        _place(field, transform, raster.crs if crs is None else crs, is_in_degrees)
    elif crs is not None:
        raise UsageError("crs says what x and y of the transform are, and there is no transform")
    return Input(None, field, keep, raster.turn)


def _field_of(np: Any, samples: Any) -> tuple[Any, Any]:
    """A field of samples without a position, and the owner of the samples."""
    field = _abi.new_field()
    if np is None:
        field.rows, field.cols, field.samples, keep = _from_buffer(samples)
        return field, keep
    if (type(samples) is np.ndarray and samples.dtype.type is np.float32 and samples.flags.carray
            and samples.dtype.isnative and samples.ndim == 2 and 0 < samples.size < _LARGEST_SIDE):
        keep = C.c_char.from_buffer(samples)  # the most frequent: no conversion
        field.rows, field.cols = samples.shape
        field.samples = C.addressof(keep)
        return field, keep
    keep, field.sample_rounding = _as_float32(np, _as_array(np, samples))
    field.rows, field.cols = keep.shape
    field.samples = keep.ctypes.data
    return field, keep


def _as_array(np: Any, samples: Any) -> Any:
    """Any object that numpy can convert to an array."""
    if isinstance(samples, (list, tuple)):
        try:
            return np.array(samples, dtype=np.float64)
        except (TypeError, ValueError):
            raise UsageError("heights are rows of equal length of numbers") from None
    if not hasattr(samples, "__array__") and not hasattr(samples, "__array_interface__"):
        try:
            memoryview(samples)
        except TypeError:
            raise UsageError("heights are a two-dimensional array, a raster's path, an xarray.DataArray or a "
                             "rasterio dataset, not %s" % type(samples).__name__) from None
    return samples


def _place(field: Any, transform: Any, crs: Any, is_in_degrees: bool) -> None:
    """Sets the position of the samples."""
    field.geotransform[:] = _geotransform(transform)
    field.frame = _SOURCE
    if crs is not None:
        field.crs = _values.text_of("crs", crs_text(crs))
        is_geographic = _is_geographic(crs) if is_in_degrees or not _abi.lib.scarp_has_gdal() else None
        if is_in_degrees and is_geographic is False:
            raise InputError("the coordinates are in degrees, and the CRS %s is projected: give the one that they are in, "
                             "as in crs='EPSG:4326'" % crs_text(crs))
        if not _abi.lib.scarp_has_gdal() and (is_geographic or is_in_degrees):
            field.frame = _DEGREES
