"""The algorithms: a raster or points to a mesh, a mesh against its raster, a raster to a pyramid of tiles."""

import json
import os
import tempfile

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingOutputBoolean,
    QgsProcessingOutputNumber,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterFile,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterVectorLayer,
    QgsProcessingUtils,
)

from . import options
from .arguments import arguments_of, path_of_raster, path_of_vector
from .program import run_program
from .style import style_of

LOAD = "LOAD"
MESH_LAYERS = (".2dm", ".ply")
VECTOR_LAYERS = (".gpkg", ".dxf")
RASTER_LAYERS = (".tif",)


def file_filter(row):
    return ";;".join(f"{ending[1:].upper()} (*{ending})" for ending in row["choices"])


class ScarpAlgorithm(QgsProcessingAlgorithm):
    """An algorithm that runs one command of the program with the options of its table."""

    command = ""
    title = ""
    summary = ""
    keywords = []
    without = ()  # groups of options without use here

    def createInstance(self):
        return type(self)()

    def displayName(self):
        return self.title

    def group(self):
        return "Terrain"

    def groupId(self):
        return "terrain"

    def tags(self):
        return self.keywords

    def shortHelpString(self):
        return options.help_of(options.rows_of(self.command, self.without), self.summary)

    def flags(self):
        return super().flags() | QgsProcessingAlgorithm.FlagCanCancel

    def add_options(self):
        for row in options.rows_of(self.command, self.without):
            for parameter in options.make_parameters(row):
                self.addParameter(parameter)

    def option_arguments(self, parameters, context, crs):
        return [
            part for row in options.rows_of(self.command, self.without)
            for part in arguments_of(row, self, parameters, context, crs)
        ]

    def run_with_report(self, arguments, feedback, by_output=False):
        """Runs the program, and returns its report: of a file, or of its standard output."""
        if by_output:
            return json.loads(run_program([*arguments, "--json"], feedback))
        with tempfile.TemporaryDirectory() as folder:
            report = os.path.join(folder, "report.json")
            feedback.pushInfo(run_program([*arguments, "--report", report], feedback).strip())
            with open(report, encoding="utf-8") as stream:
                return json.load(stream)


class MeshMaker(ScarpAlgorithm):
    """A mesh of heights, opened as a layer where QGIS has one for it."""

    command = "simplify"

    def add_outputs(self):
        self.addParameter(
            QgsProcessingParameterFileDestination("OUTPUT", "Mesh", file_filter(options.row_of("simplify", "OUTPUT")))
        )
        self.addParameter(
            QgsProcessingParameterBoolean(
                LOAD, "Open the mesh as a layer after running (2DM, PLY, GPKG, DXF, TIF)", defaultValue=True
            )
        )
        self.addOutput(QgsProcessingOutputNumber("TRIANGLES", "Triangles"))
        self.addOutput(QgsProcessingOutputNumber("VERTICES", "Vertices"))
        self.addOutput(QgsProcessingOutputNumber("ERROR", "Max error, proven on all samples"))
        self.addOutput(QgsProcessingOutputNumber("RMSE", "RMSE"))

    def make(self, source, parameters, context, feedback, crs, more=()):
        output = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        arguments = [
            "simplify", source, output, *more, *self.option_arguments(parameters, context, crs), "--overwrite"
        ]
        report = self.run_with_report(arguments, feedback)
        if self.parameterAsBool(parameters, LOAD, context):
            self.load_when_done(output, report, context)
        return {
            "OUTPUT": output,
            "TRIANGLES": report["triangles"],
            "VERTICES": report["vertices"],
            "ERROR": report["max_error"],
            "RMSE": report["rmse"],
        }

    def load_when_done(self, output, report, context):
        ending = os.path.splitext(output)[1].lower()
        hints = QgsProcessingUtils.LayerHint
        hint = (
            hints.Mesh if ending in MESH_LAYERS else hints.Vector if ending in VECTOR_LAYERS
            else hints.Raster if ending in RASTER_LAYERS else None
        )
        if hint is None:
            return
        name = os.path.splitext(os.path.basename(output))[0]
        details = QgsProcessingContext.LayerDetails(name, context.project(), "OUTPUT", hint)
        details.setPostProcessor(style_of(crs_of(report)))
        context.addLayerToLoadOnCompletion(output, details)


def crs_of(report):
    """CRS of the mesh; invalid for coordinates that are no CRS."""
    frame = report["frame"]
    if frame.get("kind", "source") not in ("source", "projected") or not frame["crs"]:
        return QgsCoordinateReferenceSystem()
    return QgsCoordinateReferenceSystem(frame["crs"])


class RasterToMesh(MeshMaker):
    title = "Raster to mesh (TIN)"
    summary = (
        "Turns a raster of heights into a mesh with few triangles. No valid sample is farther from the mesh than the "
        "max error, measured vertically; Scarp proves it on the finished mesh. Give a max error (20, 0.5%), a number "
        "of triangles, or both. Lakes, streams, breaklines and clip polygons are layers of the project. 2DM and PLY "
        "open as mesh layers."
    )
    keywords = ["tin", "mesh", "dem", "terrain", "simplify", "triangulation", "raster to tin", "decimate"]
    without = ("Scattered points",)

    def name(self):
        return "rastertomesh"

    def initAlgorithm(self, config=None):
        self.addParameter(QgsProcessingParameterRasterLayer("INPUT", "Raster of heights"))
        self.add_options()
        self.add_outputs()

    def processAlgorithm(self, parameters, context, feedback):
        layer = self.parameterAsRasterLayer(parameters, "INPUT", context)
        return self.make(path_of_raster(self, layer, "INPUT"), parameters, context, feedback, layer.crs())


class PointsToMesh(MeshMaker):
    title = "Points to mesh (TIN)"
    summary = (
        "Turns points with heights (a survey) into a mesh with few triangles. No point is farther from the mesh than "
        "the max error, measured vertically. Heights are z, or a field."
    )
    keywords = ["tin", "mesh", "survey", "lidar", "points", "triangulation"]
    without = ("Textures and images", "The 1995 paper's strategies", "Nodata")

    def name(self):
        return "pointstomesh"

    def initAlgorithm(self, config=None):
        self.addParameter(
            QgsProcessingParameterVectorLayer("INPUT", "Points with heights", [QgsProcessing.TypeVectorPoint])
        )
        self.add_options()
        self.add_outputs()

    def processAlgorithm(self, parameters, context, feedback):
        layer = self.parameterAsVectorLayer(parameters, "INPUT", context)
        path = path_of_vector(self, layer, "INPUT", context)
        more = ["--points"]
        file, inside = split_layer(path)
        if inside and not parameters.get("LAYER"):
            more += ["--layer", inside]
        return self.make(file, parameters, context, feedback, layer.crs(), more)


def split_layer(path):
    """FILE:LAYER in two; a drive letter is no layer."""
    file, colon, inside = path.rpartition(":")
    return (file, inside) if colon and len(file) > 1 and not os.path.exists(path) else (path, "")


class MeasureMesh(ScarpAlgorithm):
    command = "measure"
    title = "Measure a mesh against its raster"
    summary = (
        "Judges a mesh, Scarp's or another program's, at every sample of the raster: max error, RMSE, samples that the "
        "mesh does not cover, soundness. With a limit it fails where the mesh is worse."
    )
    keywords = ["tin", "mesh", "error", "rmse", "accuracy", "check"]
    without = ("Scattered points",)

    def name(self):
        return "measuremesh"

    def initAlgorithm(self, config=None):
        self.addParameter(QgsProcessingParameterRasterLayer("INPUT", "Raster of heights"))
        row = options.row_of("measure", "MESH")
        self.addParameter(QgsProcessingParameterFile("MESH", "Mesh", fileFilter=file_filter(row)))
        self.add_options()
        for name, label in (("ERROR", "Max error"), ("RMSE", "RMSE"), ("UNCOVERED", "Samples without a triangle")):
            self.addOutput(QgsProcessingOutputNumber(name, label))
        self.addOutput(QgsProcessingOutputBoolean("SOUND", "Whether the mesh is sound"))

    def processAlgorithm(self, parameters, context, feedback):
        layer = self.parameterAsRasterLayer(parameters, "INPUT", context)
        arguments = [
            "measure", path_of_raster(self, layer, "INPUT"), self.parameterAsFile(parameters, "MESH", context),
            *self.option_arguments(parameters, context, layer.crs()), "--overwrite"
        ]
        report = self.run_with_report(arguments, feedback, by_output=True)
        results = {
            "ERROR": report["max_error"],
            "RMSE": report["rmse"],
            "UNCOVERED": report["uncovered"],
            "SOUND": report["topology"]["sound"],
        }
        feedback.pushInfo(
            f"max error {results['ERROR']}, RMSE {results['RMSE']}, {results['UNCOVERED']} samples uncovered"
        )
        return results


class MakeTiles(ScarpAlgorithm):
    command = "tile"
    title = "Raster to terrain tiles"
    summary = (
        "Makes a pyramid of terrain tiles for globes (CesiumJS and others) of a raster, each with a proven error. "
        "Heights must be above the ellipsoid: say what they are above. Neighbours meet exactly."
    )
    keywords = ["tiles", "cesium", "terrain", "quantized-mesh", "3d tiles", "globe"]

    def name(self):
        return "rastertotiles"

    def initAlgorithm(self, config=None):
        self.addParameter(
            QgsProcessingParameterMultipleLayers("INPUT", "Rasters of heights", QgsProcessing.TypeRaster)
        )
        self.add_options()
        self.addParameter(
            QgsProcessingParameterFolderDestination("OUTPUT", "Folder of the tiles, in which a new one is made")
        )
        self.addOutput(QgsProcessingOutputNumber("TILES", "Tiles"))
        self.addOutput(QgsProcessingOutputNumber("LEVELS", "Levels"))

    def processAlgorithm(self, parameters, context, feedback):
        layers = self.parameterAsLayerList(parameters, "INPUT", context)
        if not layers:
            raise QgsProcessingException("Rasters of heights: choose a raster")
        folder = self.parameterAsString(parameters, "OUTPUT", context)
        output = os.path.join(folder, "terrain")
        arguments = [
            "tile", *(path_of_raster(self, layer, "INPUT") for layer in layers), output,
            *self.option_arguments(parameters, context, layers[0].crs()), "--overwrite"
        ]
        os.makedirs(folder, exist_ok=True)
        report = self.run_with_report(arguments, feedback)
        tiles = sum(level["tiles"] for level in report["levels"])
        return {"OUTPUT": output, "TILES": tiles, "LEVELS": len(report["levels"])}
