"""Heights from xarray: one variable, its coordinates, its CRS, by CF's names, independent of other packages."""
from __future__ import annotations

import re
from typing import Any, NamedTuple, Optional

from ._raster import Raster, Turn, crs_text, unpack
from .errors import InputError, UsageError

_LONGITUDES, _LATITUDES = ("lon", "long", "longitude"), ("lat", "latitude")
_X, _Y = ("x", "easting", "projection_x_coordinate"), ("y", "northing", "projection_y_coordinate")
_EAST = ("degrees_east", "degree_east", "degree_e", "degrees_e", "degreee", "degreese")
_NORTH = ("degrees_north", "degree_north", "degree_n", "degrees_n", "degreen", "degreesn")
_METRES = {"": 1.0, "m": 1.0, "metre": 1.0, "metres": 1.0, "meter": 1.0, "meters": 1.0, "km": 1000.0,
           "kilometre": 1000.0, "kilometres": 1000.0, "kilometer": 1000.0, "kilometers": 1000.0}
_UNEVEN = 1e-3  # share of a cell
#: EPSG code of a whole CRS, at the end of its WKT or in PROJ's old form.
_CODE = re.compile(r'AUTHORITY\["EPSG",\s*"(\d+)"\]\s*\]\s*$|ID\["EPSG",\s*(\d+)\]\s*\]\s*$|^\+init=epsg:(\d+)$', re.I)


class _Axis(NamedTuple):
    """A coordinate with even steps."""

    name: str
    first: float
    step: float
    is_geographic: bool


def is_dataset(source: Any) -> bool:
    return hasattr(source, "data_vars") and hasattr(source, "coords")


def _pick_variable(dataset: Any) -> tuple[Any, Any]:
    """The one variable with heights, and the variables next to it."""
    bounds = {one.attrs.get("bounds") for one in dataset.variables.values()}
    names = [name for name, one in dataset.data_vars.items() if one.ndim >= 2 and name not in bounds]
    if len(names) == 1:
        return dataset[names[0]], dataset.variables
    if not names:
        raise UsageError("the Dataset has no variable of two dimensions: heights are one of (y, x)")
    raise UsageError("the Dataset has %d variables, %s: pick one, as in dataset[%r]"
                     % (len(names), ", ".join(str(name) for name in names), names[0]))


def _word(values: Any, key: str) -> str:
    return str(values.get(key, "")).strip().lower()


def _kind(name: Any, attributes: Any) -> Optional[str]:
    """"lon", "lat", "x", "y" by CF's units and names; else None."""
    units, standard = _word(attributes, "units"), _word(attributes, "standard_name")
    if standard in ("grid_longitude", "grid_latitude"):
        return "x" if standard == "grid_longitude" else "y"
    if units in _EAST or standard == "longitude":
        return "lon"
    if units in _NORTH or standard == "latitude":
        return "lat"
    label = str(name).lower()
    if not units or units.startswith("degree"):
        if label in _LONGITUDES:
            return "lon"
        if label in _LATITUDES:
            return "lat"
    axis = _word(attributes, "axis")
    if standard == _X[-1] or axis == "x" or label in _X + _LONGITUDES:
        return "x"
    if standard == _Y[-1] or axis == "y" or label in _Y + _LATITUDES:
        return "y"
    return None


def _kind_of_dim(array: Any, dim: Any) -> Optional[str]:
    return _kind(dim, array.coords[dim].attrs if dim in array.coords else {})


def _as_rows(array: Any, name: str) -> Any:
    """Converts to (y, x): removes dimensions of one step, and transposes (x, y)."""
    kinds = {dim: _kind_of_dim(array, dim) for dim in array.dims}
    needless = [dim for dim, size in zip(array.dims, array.shape) if size == 1 and kinds[dim] is None]
    if array.ndim > 2 and needless:
        array = array.isel({dim: 0 for dim in needless[:array.ndim - 2]})
    if array.ndim != 2:
        other = next((dim for dim in array.dims if kinds[dim] is None), array.dims[0]) if array.ndim else "band"
        raise UsageError("%s has %d dimensions (%s), and heights have two: pick one, as in array.isel(%s=0)"
                         % (name, array.ndim, ", ".join(str(dim) for dim in array.dims), other))
    first, second = (kinds[dim] for dim in array.dims)
    if first in ("x", "lon") and second not in ("x", "lon") or second in ("y", "lat") and first not in ("y", "lat"):
        return array.transpose()
    return array


def _placed_dims(array: Any) -> list[str]:
    """Dimensions that have coordinates."""
    return [str(dim) for dim in array.dims if dim in array.coords]


def _line_of(np: Any, array: Any, dim: Any, name: str) -> Optional[_Axis]:
    """The coordinate along a dimension. InputError unless all of its steps are even."""
    if dim not in array.coords:
        return None
    coordinate = array.coords[dim]
    values = np.asarray(coordinate.values)
    if values.dtype.kind not in "iuf":
        raise InputError("the coordinate %s of %s is no number, but %s: drop all, as in array.drop_vars(%r)"
                         % (dim, name, values.dtype, _placed_dims(array)))
    kind = _kind(dim, coordinate.attrs)
    places = values.astype(np.float64)
    if not np.isfinite(places).all():
        raise InputError("the coordinate %s of %s has numbers that are not finite" % (dim, name))
    if kind == "lon":  # across the meridian where longitudes wrap
        turns = np.cumsum(np.round(np.diff(places) / 360))
        places[1:] -= 360 * turns
    step = (places[-1] - places[0]) / (len(places) - 1) if len(places) > 1 else 1.0
    off = np.abs(places - (places[0] + step * np.arange(len(places))))
    own = 4 * float(np.finfo(values.dtype).eps) * np.abs(values).max() if values.dtype.kind == "f" else 0.0
    if step == 0 and off.max() == 0:
        raise InputError("the coordinate %s of %s is %.10g everywhere, so it tells no place: correct it, or drop all "
                         "for x and y in samples, as in array.drop_vars(%r)" % (dim, name, places[0], _placed_dims(array)))
    if step == 0 or off.max() > _UNEVEN * abs(step) + own:
        steps = np.abs(np.diff(places))
        raise InputError("the coordinate %s of %s has uneven steps, %.6g to %.6g, and Scarp's rasters have cells of one "
                         "size: put it on even ones first, as in array.interp(%s=numpy.linspace(%.10g, %.10g, %d))"
                         % (dim, name, steps.min(), steps.max(), dim, places[0], places[-1], len(places)))
    units = _word(coordinate.attrs, "units")
    if kind == "lat" and np.abs(places).max() > 90.1:
        raise InputError("the coordinate %s of %s reaches %.6g, which is no latitude in degrees: rename it to y if it is "
                         "a length" % (dim, name, np.abs(places).max()))
    if kind in ("x", "y") and units.startswith("rad"):
        raise InputError("the coordinate %s of %s is in radians: warp it to a CRS first, as with array.rio.reproject()"
                         % (dim, name))
    scale = _METRES.get(units, 1.0) if kind in ("x", "y") else 1.0
    return _Axis(str(dim), places[0] * scale, step * scale, kind in ("lon", "lat"))


def _mapping_of(array: Any, beside: Any) -> Optional[Any]:
    """The attributes of the variable with its CRS."""
    named = array.encoding.get("grid_mapping") or array.attrs.get("grid_mapping")
    for name in ([str(named).split(":")[0].strip()] if named else []) + ["spatial_ref", "crs"]:
        for where in (array.coords, beside):
            if name in where and where[name].ndim == 0:
                return where[name].attrs
    return None


def _crs_of(array: Any, mapping: Any) -> Any:
    """The CRS by its grid mapping, its own attributes, or rioxarray's accessor if set."""
    for attributes in (mapping or {}, array.attrs):
        for key in ("crs_wkt", "spatial_ref", "crs", "proj4", "proj4text", "proj4_params", "proj4_string", "epsg_code",
                    "epsg"):
            value = attributes.get(key)
            if value is None or value == "":
                continue
            text = crs_text(int(value) if isinstance(value, float) else value)
            code = _CODE.search(text)
            return "EPSG:" + (code[1] or code[2] or code[3]) if code else text
    if mapping and mapping.get("grid_mapping_name"):
        if mapping["grid_mapping_name"] == "latitude_longitude" and "semi_major_axis" not in mapping:
            return "EPSG:4326"
        try:
            import pyproj
            return pyproj.CRS.from_cf(dict(mapping)).to_wkt()
        except ImportError:
            raise InputError("the CRS of %s is told by CF's numbers (%s), which pyproj reads: install it, or give crs"
                             % (_name_of(array), mapping["grid_mapping_name"])) from None
        except Exception as error:  # whatever pyproj finds wrong
            raise InputError("the CRS of %s is no CRS: %s" % (_name_of(array), error)) from error
    return getattr(getattr(array, "rio", None), "crs", None)


def _geotransform_of(mapping: Any) -> Optional[tuple[float, ...]]:
    text = (mapping or {}).get("GeoTransform")
    try:
        numbers = tuple(float(number) for number in str(text).split())
    except ValueError:
        return None
    return numbers if len(numbers) == 6 else None


def _refuse_curved(array: Any, name: str) -> None:
    for other, coordinate in array.coords.items():
        if coordinate.ndim == 2 and _kind(other, coordinate.attrs) is not None:
            raise InputError("%s lies on a bent grid, for its coordinate %s has two dimensions: put it on a regular one "
                             "first, as with array.rio.reproject(), or drop it for x and y in samples, as in "
                             "array.drop_vars(%r)" % (name, other, other))


def _values_of(array: Any, nodata: Optional[float]) -> tuple[Any, Optional[float]]:
    """Heights, and the nodata value. Values still packed as in the file are unpacked."""
    attributes = array.attrs
    voids = [attributes[key] for key in ("_FillValue", "missing_value", "nodata") if attributes.get(key) is not None]
    if not voids:
        voids = list(attributes.get("nodatavals", ()))[:1]  # set by xarray's own reader of rasters
    if not voids:
        void = getattr(getattr(array, "rio", None), "nodata", None)
        voids = [] if void is None else [void]
    return unpack(array.values, voids if nodata is None else [nodata], attributes.get("scale_factor", 1),
                  attributes.get("add_offset", 0))


def _name_of(array: Any) -> str:
    return str(array.name) if array.name is not None else "the DataArray"


def align(source: Any, heights: Any, name: str) -> Any:
    """Masks or tolerances in the order of the heights' dimensions. UsageError for another grid."""
    values = (_pick_variable(source)[0] if is_dataset(source) else source).squeeze()
    if set(values.dims) != set(heights.dims):
        raise UsageError("the dimensions of %s are (%s), and those of the heights (%s)"
                         % (name, ", ".join(map(str, values.dims)), ", ".join(map(str, heights.dims))))
    for dim in heights.dims:
        if dim in values.coords and dim in heights.coords and not values.coords[dim].equals(heights.coords[dim]):
            raise UsageError("the coordinate %s of %s is not that of the heights: as in %s.reindex_like(heights)"
                             % (dim, name, name))
    return values.transpose(*heights.dims).values


def read(source: Any, has_place: bool, nodata: Optional[float]) -> Raster:
    """Reads a DataArray, or a Dataset of one. `has_place`: the caller gives a transform, so coordinates are ignored."""
    import numpy as np
    array, beside = _pick_variable(source) if is_dataset(source) else (source, {})
    name = _name_of(array)
    mapping, crs = _mapping_of(array, beside), None
    rows = _as_rows(array, name)
    samples, void = _values_of(rows, nodata)
    is_turned = rows.dims != tuple(dim for dim in array.dims if dim in rows.dims)
    raster = Raster(samples, None, None, void, str(array.name or "heights"), str(array.attrs.get("units", "")),
                    Turn(rows, is_turned, False, False))
    if has_place:
        return raster._replace(crs=_crs_of(array, mapping))
    y, x = (_line_of(np, rows, dim, name) if min(rows.shape) > 1 else None for dim in rows.dims)
    if x is None and y is None:
        transform = _geotransform_of(mapping)
        if transform is None:
            _refuse_curved(array, name)
            return raster
        return raster._replace(transform=transform, crs=_crs_of(array, mapping))
    if x is None or y is None:
        raise InputError("%s has coordinates along %s and none along its other dimension: give both or none"
                         % (name, (x or y).name))  # type: ignore[union-attr]
    if x.is_geographic != y.is_geographic:
        raise InputError("%s has the coordinates %s and %s, of which one is in degrees and the other is not"
                         % (name, y.name, x.name))
    crs = _crs_of(array, mapping)
    if crs is None and x.is_geographic:
        crs = "EPSG:4326"
    # Orders samples from north to south, and from west to east.
    turn = raster.turn._replace(flips_rows=y.step > 0, flips_cols=x.step < 0)
    west, north = (axis.first + axis.step * (count - 1 if flips else 0) - abs(axis.step) / 2 * sign
                   for axis, count, flips, sign in ((x, rows.shape[1], turn.flips_cols, 1),
                                                    (y, rows.shape[0], turn.flips_rows, -1)))
    transform = (west, abs(x.step), 0.0, north, 0.0, -abs(y.step))
    return raster._replace(samples=turn.flip(samples), transform=transform, crs=crs, turn=turn,
                           is_in_degrees=x.is_geographic)
