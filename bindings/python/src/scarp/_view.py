"""The page that shows a mesh in a browser."""
from __future__ import annotations

import base64
import ctypes
import html
import json
import os
import shutil
from typing import Any, Optional

from . import _abi, _inputs
from .errors import InputError

_PLACE = "<!--SCARP-DATA-->"


def _read_template() -> str:
    """The template in the package, else that of the program."""
    paths = [os.path.join(os.path.dirname(__file__), "viewer.html")]
    program = shutil.which("scarp")
    if program is not None:
        prefix = os.path.dirname(os.path.dirname(os.path.realpath(program)))
        paths.append(os.path.join(prefix, "share", "scarp", "viewer.html"))
    for path in paths:
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                return file.read()
    raise InputError("the viewer's page %s is not there: 'make viewer' in Scarp's sources builds it, and 'make python' "
                     "then puts it into the wheel" % paths[-1])


def _affine(field: Any, to_source: Optional[list[float]]) -> list[float]:
    """Maps column and row of a sample's centre to x and y of the mesh."""
    g = list(field.geotransform) if field.frame else [-0.5, 1.0, 0.0, field.rows - 0.5, 0.0, -1.0]
    source = [g[0] + (g[1] + g[2]) / 2, g[1], g[2], g[3] + (g[4] + g[5]) / 2, g[4], g[5]]
    t = to_source or [0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    determinant = t[1] * t[5] - t[2] * t[4]
    affine = [0.0] * 6
    for k in range(3):
        x, y = source[k] - (t[0] if k == 0 else 0), source[k + 3] - (t[3] if k == 0 else 0)
        affine[k], affine[k + 3] = (t[5] * x - t[2] * y) / determinant, (t[1] * y - t[4] * x) / determinant
    return affine


def _describe(field: Any, to_source: Optional[list[float]]) -> dict[str, Any]:
    nodata = None if field.nodata != field.nodata else field.nodata
    return {"name": field.name.decode() if field.name else "heights", "cols": field.cols, "rows": field.rows,
            "affine": _affine(field, to_source), "type": "float32", "nodata": nodata,
            "samples": base64.b64encode(ctypes.string_at(field.samples, 4 * field.cols * field.rows)).decode()}


class Page(str):
    """The path of a page. A notebook shows the page itself."""

    def _repr_html_(self) -> str:
        with open(self, encoding="utf-8") as file:
            page = html.escape(file.read())
        return '<iframe title="scarp" style="width: 100%%; height: 600px; border: 0" srcdoc="%s"></iframe>' % page


def make_page(mesh: Any, source: Any, options: dict[str, Any]) -> str:
    """The page's text, with the mesh and its raster, if any. Called by a method of Mesh."""
    glb = mesh.encode("glb")
    data: dict[str, Any] = {"scarp": _abi.lib.scarp_version().decode(), "field": None, "metres": None, "unit": None,
                            "meshes": [{"name": "mesh", "bytes": len(glb), "glb": base64.b64encode(glb).decode()}]}
    if source is not None:
        given = _inputs.read(source, wants_array=True, **options)
        _abi.check(_abi.lib.scarp_measure(ctypes.byref(given.field), mesh._handle, None, ctypes.byref(_abi.new_report())))
        told = mesh.metadata("to_source")
        data["field"] = _describe(given.field, json.loads(told) if told else None)
    script = '<script type="application/json" id="scarp-data">%s</script>' % json.dumps(data).replace("<", "\\u003c")
    return _read_template().replace(_PLACE, script, 1)
