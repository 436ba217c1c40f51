"""The program's options as parameters of Processing.

`options.json` is what `scarp help --json` prints. A row becomes a parameter of the kind that its type asks for, so that
QGIS offers what the program accepts; nothing here names an option, but for those that QGIS itself answers.
"""

import html
import json
import os
import re

from qgis.core import (
    QgsProcessing,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterCrs,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterEnum,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFile,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterNumber,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
    QgsProcessingParameterVectorLayer,
)

# Options that QGIS itself sets, or that only a terminal needs.
NOT_OFFERED = {
    "--help", "--help-all", "--version", "--quiet", "--timing", "--json-progress", "--json", "--report", "--overwrite",
    "--points",
}
COORDINATES = "COORDINATES"
TITLES = {"--crs": "Coordinates of the mesh", "--te": "Extent", "--of": "Format", "--roi": "Regions of interest", "--num-threads": "Threads"}
RASTERS = {"IMAGE"}
RASTER_OPTIONS = {"--mask", "--tolerance", "--texture"}


def read_table():
    with open(os.path.join(os.path.dirname(__file__), "options.json"), encoding="utf-8") as stream:
        return json.load(stream)


TABLE = read_table()
NAMES = {name: row for row in TABLE["options"] if row["name"] not in NOT_OFFERED for name in (row["name"], row["short"]) if name}


def rows_of(command, without=()):
    """The options of a command that are offered, in the program's order, but for those of some groups."""
    return [
        row for row in TABLE["options"]
        if row["command"] == command and row["name"].startswith("--") and row["name"] not in NOT_OFFERED
        and row["group"] not in without
    ]


def row_of(command, name):
    return next(row for row in TABLE["options"] if row["command"] == command and row["name"] == name)


def parameter_name(row):
    return row["name"].lstrip("-").replace("-", "_").upper()


def title_of(row):
    """The option's name as words: --max-error is "Max error"."""
    return TITLES.get(row["name"]) or row["name"].lstrip("-").replace("-", " ").capitalize()


def in_words(sentence):
    """A sentence of the program, in which options are called as the dialogs call them."""
    def replace(match):
        row = NAMES.get(match[0])
        return match[0] if row is None else f'"{title_of(row)}"'
    return re.sub(r"(?<![\w-])--?[A-Za-z][\w-]*(?![\w-]|\.\w)", replace, sentence)


def label_of(row):
    """A title and, of numbers, what they count."""
    if row["type"] not in ("number", "count") or not row["unit"] or is_extent(row):
        return title_of(row)
    short = row["value"] if len(row["unit"]) > 24 else row["unit"]
    return f"{title_of(row)} [{short}]"


def help_of(rows, command_help):
    """The text next to the parameters: what the algorithm does, then the most used options."""
    lines = "".join(f"<p><b>{title_of(row)}</b>: {html.escape(row['brief'])}.</p>" for row in rows if is_basic(row))
    return f"<p>{html.escape(command_help)}</p>{lines}"


def is_basic(row):
    """True if the program's first page of help has it."""
    return row["brief"] is not None


def is_vector(row):
    return row["value"] == "FILE[:LAYER]"


def is_raster(row):
    return row["value"] in RASTERS or row["name"] in RASTER_OPTIONS


def is_output(row):
    return row["type"] == "file" and row["value"] is not None and row["value"].startswith("FILE.")


def is_extent(row):
    return row["value"] == "XMIN YMIN XMAX YMAX"


def is_plain_number(row):
    """Numbers that have no other form, such as 0.5% or 100M."""
    return row["type"] == "number" and row["value"] and row["value"].isalpha() and not (
        row["unit"] and (" or " in row["unit"] or "%" in row["unit"]) and "metres" not in row["unit"]
    )


def make_parameters(row):
    """The parameters of a row: one, but for coordinates, which are a CRS of QGIS or one of the program's own."""
    if row["value"] != "CRS":
        return [make_parameter(row)]
    own = [choice for choice in row["choices"] if not choice.endswith(":")]
    kind = QgsProcessingParameterEnum(COORDINATES, "Coordinates that are no CRS", options=own, optional=True)
    kind.setUsesStaticStrings(True)
    kind.setHelp(row["help"])
    kind.setFlags(kind.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
    crs = QgsProcessingParameterCrs(parameter_name(row), title_of(row) + ": a CRS", optional=True)
    crs.setHelp(row["help"])
    return [crs, kind]


def make_parameter(row):
    """The parameter of a row: optional, advanced unless the program's first page of help has it."""
    name, label = parameter_name(row), label_of(row)
    if row["type"] == "flag":
        parameter = QgsProcessingParameterBoolean(name, label, defaultValue=False, optional=True)
    elif row["type"] == "choice":
        parameter = QgsProcessingParameterEnum(name, label, options=row["choices"], optional=True)
        parameter.setUsesStaticStrings(True)
    elif is_extent(row):
        parameter = QgsProcessingParameterExtent(name, label, optional=True)
    elif is_output(row):
        endings = " ".join("*" + one for one in row["choices"])
        parameter = QgsProcessingParameterFileDestination(
            name, label, f"{row['choices'][0][1:].upper()} ({endings})", optional=True, createByDefault=False
        )
    elif is_vector(row) and row["repeatable"]:
        parameter = QgsProcessingParameterMultipleLayers(name, label, QgsProcessing.TypeVectorAnyGeometry, optional=True)
    elif is_vector(row):
        parameter = QgsProcessingParameterVectorLayer(name, label, optional=True)
    elif is_raster(row) and row["repeatable"]:
        parameter = QgsProcessingParameterMultipleLayers(name, label, QgsProcessing.TypeRaster, optional=True)
    elif is_raster(row):
        parameter = QgsProcessingParameterRasterLayer(name, label, optional=True)
    elif row["type"] == "file" and row["value"] == "FILE":
        parameter = QgsProcessingParameterFile(name, label, optional=True)
    elif row["type"] == "count" and row["value"].isalpha():
        # Text, for counts may be 50k; a number does as well.
        parameter = QgsProcessingParameterString(name, label, optional=True)
    elif is_plain_number(row):
        parameter = QgsProcessingParameterNumber(name, label, QgsProcessingParameterNumber.Double, optional=True)
    else:
        shape = f": {row['value']}" if row["type"] in ("text", "file") else ""
        more = ", one a line" if row["repeatable"] else ""
        parameter = QgsProcessingParameterString(
            name, label + shape + more, optional=True, multiLine=row["repeatable"]
        )
    parameter.setHelp(row["help"])
    if not is_basic(row):
        parameter.setFlags(parameter.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
    return parameter
