"""The C library by ctypes: the only module with pointers. Tests compare the structs with scarp_abi_layout()."""
from __future__ import annotations

import ctypes as C
import os
import re
import sys

from .errors import OF_STATUS, InternalError

ABI_VERSION = 1


def _open() -> C.CDLL:
    """The library next to this file; else the one named by SCARP_LIBRARY; else the system's."""
    name = {"win32": "scarp_c.dll", "darwin": "libscarp_c.dylib"}.get(sys.platform, "libscarp_c.so")
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
    named = os.environ.get("SCARP_LIBRARY")
    path = named or (beside if os.path.exists(beside) else "libscarp_c.so.%d" % ABI_VERSION)
    try:
        library = C.CDLL(path)
    except OSError as error:
        raise ImportError("Scarp's library cannot be loaded: %s" % error) from error
    library.scarp_abi_version.restype = C.c_uint32
    if library.scarp_abi_version() != ABI_VERSION:
        raise ImportError("%s speaks version %d of the ABI, and this package version %d: install both anew"
                          % (path, library.scarp_abi_version(), ABI_VERSION))
    return library


lib = _open()


class Progress(C.Structure):
    _fields_ = [("struct_size", C.c_uint32), ("reserved", C.c_int32), ("pass", C.c_char_p), ("fraction", C.c_double),
                ("vertices", C.c_uint64), ("max_error", C.c_double), ("seconds_left", C.c_double),
                ("tiles", C.c_uint64), ("bytes", C.c_uint64)]


ProgressFn = C.CFUNCTYPE(C.c_int32, C.c_void_p)  # the address of a Progress; `user`, which is NULL, is ignored


class Field(C.Structure):
    _fields_ = [("struct_size", C.c_uint32), ("cols", C.c_int32), ("rows", C.c_int32), ("frame", C.c_int32),
                ("samples", C.c_void_p), ("nodata", C.c_double), ("geotransform", C.c_double * 6),
                ("sample_rounding", C.c_double), ("crs", C.c_char_p), ("name", C.c_char_p), ("unit", C.c_char_p)]


class Points(C.Structure):
    _fields_ = [("struct_size", C.c_uint32), ("frame", C.c_int32), ("x", C.c_void_p), ("y", C.c_void_p),
                ("z", C.c_void_p), ("count", C.c_uint64), ("stride", C.c_uint64), ("crs", C.c_char_p),
                ("name", C.c_char_p)]


class Options(C.Structure):
    _fields_ = [("struct_size", C.c_uint32), ("threads", C.c_int32), ("max_error", C.c_double),
                ("max_triangles", C.c_uint64), ("max_points", C.c_uint64), ("mask", C.c_void_p),
                ("tolerance", C.c_void_p), ("progress", ProgressFn), ("user", C.c_void_p), ("named", C.c_void_p)]


class Report(C.Structure):
    _fields_ = ([(name, C.c_uint32 if name == "struct_size" else C.c_int32)
                 for name in ("struct_size", "stop", "effort", "is_cut_short", "max_error_col", "max_error_row")]
                + [(name, C.c_uint64) for name in ("vertices", "triangles", "samples", "uncovered", "stray", "over")]
                + [(name, C.c_double) for name in ("max_error", "rmse", "mean_error", "mean_abs_error", "p50", "p95",
                                                   "p99", "seconds")])


class Volumes(C.Structure):
    _fields_ = ([("struct_size", C.c_uint32), ("reserved", C.c_int32)]
                + [(name, C.c_double) for name in ("cut", "fill", "net", "uncertainty", "common_area", "from_outside",
                                                   "to_outside")])


class LiveOptions(C.Structure):
    _fields_ = [("struct_size", C.c_uint32), ("threads", C.c_int32), ("max_error", C.c_double), ("effort", C.c_int32),
                ("cell", C.c_int32), ("col", C.c_int32), ("row", C.c_int32), ("tolerance", C.c_void_p),
                ("max_triangles", C.c_uint64), ("level", C.c_void_p)]


class LiveCell(C.Structure):
    _fields_ = [("struct_size", C.c_uint32), ("slot", C.c_uint32), ("version", C.c_uint64), ("col", C.c_int32),
                ("row", C.c_int32), ("vertices", C.c_uint32), ("triangles", C.c_uint32), ("positions", C.c_void_p),
                ("indices", C.c_void_p), ("max_error", C.c_double)]


STRUCTS = {"scarp_progress": Progress, "scarp_field": Field, "scarp_points": Points, "scarp_options": Options,
           "scarp_report": Report, "scarp_volumes": Volumes, "scarp_live_options": LiveOptions,
           "scarp_live_cell": LiveCell}

_P, _S, _I, _D, _U, _T = C.c_void_p, C.c_char_p, C.c_int32, C.c_double, C.c_uint64, C.c_uint32
_FUNCTIONS = {
    "scarp_version": (_S, []),
    "scarp_has_gdal": (_I, []),
    "scarp_abi_layout": (_S, []),
    "scarp_last_error": (_S, []),
    "scarp_round_samples": (_D, [_P, _U, _P]),
    "scarp_field_init": (None, [_P, _T]),
    "scarp_points_init": (None, [_P, _T]),
    "scarp_options_init": (None, [_P, _T]),
    "scarp_options_set": (_I, [_P, _S, _S]),
    "scarp_options_clear": (None, [_P]),
    "scarp_simplify": (_I, [_P, _P, _P]),
    "scarp_simplify_file": (_I, [_S, _P, _P]),
    "scarp_simplify_points": (_I, [_P, _P, _P]),
    "scarp_measure": (_I, [_P, _P, _P, _P]),
    "scarp_measure_file": (_I, [_S, _P, _P, _P]),
    "scarp_measure_points": (_I, [_P, _P, _P, _P]),
    "scarp_measure_volume": (_I, [_P, _P, _P, _P]),
    "scarp_measure_volume_to_level": (_I, [_P, _D, _P, _P]),
    "scarp_mesh_from_arrays": (_I, [_P, _U, _P, _U, _P]),
    "scarp_mesh_read": (_I, [_S, _P]),
    "scarp_mesh_vertex_count": (_U, [_P]),
    "scarp_mesh_triangle_count": (_U, [_P]),
    "scarp_mesh_origin": (_P, [_P]),
    "scarp_mesh_positions": (_P, [_P]),
    "scarp_mesh_triangles": (_P, [_P]),
    "scarp_mesh_normals": (_P, [_P]),
    "scarp_mesh_uvs": (_P, [_P]),
    "scarp_mesh_metadata": (_S, [_P, _S]),
    "scarp_mesh_warnings": (_S, [_P]),
    "scarp_mesh_report": (_I, [_P, _P]),
    "scarp_mesh_add_base": (_I, [_P, _D, _P]),
    "scarp_mesh_encode": (_I, [_P, _S, _P]),
    "scarp_mesh_write": (_I, [_P, _S, _I]),
    "scarp_mesh_pack": (_I, [_P, _P]),
    "scarp_mesh_unpack": (_I, [_S, _U, _P]),
    "scarp_mesh_free": (None, [_P]),
    "scarp_bytes_data": (_P, [_P]),
    "scarp_bytes_size": (_U, [_P]),
    "scarp_bytes_free": (None, [_P]),
    "scarp_refiner_create": (_I, [_P, _P]),
    "scarp_refiner_insert_worst": (_I, [_P]),
    "scarp_refiner_go_on": (_I, [_P, _P, _P]),
    "scarp_refiner_max_error": (_D, [_P]),
    "scarp_refiner_vertex_count": (_U, [_P]),
    "scarp_refiner_triangle_count": (_U, [_P]),
    "scarp_refiner_mesh": (_I, [_P, _P]),
    "scarp_refiner_free": (None, [_P]),
    "scarp_live_options_init": (None, [_P, _T]),
    "scarp_live_create": (_I, [_P, _P, _P]),
    "scarp_live_update": (_I, [_P, _I, _I, _I, _I, _P, _P]),
    "scarp_live_scroll": (_I, [_P, _I, _I]),
    "scarp_live_changes": (_I, [_P, _U, _P]),
    "scarp_live_mesh": (_I, [_P, _P]),
    "scarp_live_heights": (_I, [_P, _P]),
    "scarp_live_place": (None, [_P, _P, _P]),
    "scarp_live_geotransform": (None, [_P, _P]),
    "scarp_live_max_error": (_D, [_P]),
    "scarp_live_triangle_count": (_U, [_P]),
    "scarp_live_level": (C.c_int64, [_P]),
    "scarp_live_slot_count": (_T, [_P]),
    "scarp_live_free": (None, [_P]),
    "scarp_changes_version": (_U, [_P]),
    "scarp_changes_count": (_U, [_P]),
    "scarp_changes_cell": (_I, [_P, _U, _P]),
    "scarp_changes_cut": (_I, [_P, _U, _P]),
    "scarp_changes_free": (None, [_P]),
    "scarp_tile": (_I, [_P, _P, _S, _I, _P]),
    "scarp_tile_files": (_I, [_P, _U, _P, _S, _I, _P]),
    "scarp_tiles_open": (_I, [_S, _P, _P]),
    "scarp_tiles_open_field": (_I, [_P, _P, _P]),
    "scarp_tiles_max_level": (_I, [_P]),
    "scarp_tiles_count": (_U, [_P, _I]),
    "scarp_tiles_list": (_P, [_P, _I]),
    "scarp_tiles_read": (_I, [_P, _I, _T, _T, _P, _P]),
    "scarp_tiles_read_file": (_I, [_P, _S, _P]),
    "scarp_tiles_free": (None, [_P]),
}
for _name, (_result, _arguments) in _FUNCTIONS.items():
    _function = getattr(lib, _name)
    _function.restype = _result
    _function.argtypes = _arguments


# In Python the option is called `frame`, since `crs` is the transform's.
lib.scarp_name_option(b"crs", b"frame")


def in_words(sentence: bytes) -> str:
    """A message of the library, with the Python names of functions."""
    text = sentence.decode("utf-8", "replace")
    if "scarp_" not in text:
        return text
    text = re.sub(r"\bscarp_mesh_(write|encode)\(\)", r"mesh.\1()", text)
    return re.sub(r"\bscarp_(\w+)\(\)", r"scarp.\1()", text)


def last_error() -> str:
    text: bytes = lib.scarp_last_error()
    return in_words(text)


def check(status: int) -> None:
    """Raises the exception of a status other than 0, with the library's message."""
    if status:
        raise OF_STATUS.get(status, InternalError)(last_error())


# Structs initialised by the library; every call copies them.
_FIELD, _POINTS, _OPTIONS = Field(), Points(), Options()
lib.scarp_field_init(C.byref(_FIELD), C.sizeof(Field))
lib.scarp_points_init(C.byref(_POINTS), C.sizeof(Points))
lib.scarp_options_init(C.byref(_OPTIONS), C.sizeof(Options))


def new_field() -> Field:
    return Field.from_buffer_copy(_FIELD)


def new_points() -> Points:
    return Points.from_buffer_copy(_POINTS)


def new_options() -> Options:
    return Options.from_buffer_copy(_OPTIONS)


def new_report() -> Report:
    report = Report()
    report.struct_size = C.sizeof(report)
    return report


def new_volumes() -> Volumes:
    volumes = Volumes()
    volumes.struct_size = C.sizeof(volumes)
    return volumes


def take_bytes(handle: int | None) -> bytes:
    """Returns the bytes of a handle, and frees it."""
    try:
        return C.string_at(lib.scarp_bytes_data(handle), lib.scarp_bytes_size(handle))
    finally:
        lib.scarp_bytes_free(handle)


def is_layout_equal() -> bool:
    """True if the structs above have the library's memory layout."""
    text: bytes = lib.scarp_abi_layout()
    lines = text.decode().splitlines()
    ours = []
    for name, struct in STRUCTS.items():
        members = " ".join("%s:%d" % (field[0], getattr(struct, field[0]).offset) for field in struct._fields_)
        ours.append("%s %d %s" % (name, C.sizeof(struct), members))
    return sorted(lines) == sorted(ours)
