"""The plugin's algorithms in QGIS: qgis_algorithms.py PLUGINS DATA PROGRAM."""

import filecmp
import json
import os
import re
import shutil
import subprocess
import sys

sys.path[:0] = ["/usr/share/qgis/python/plugins", sys.argv[1]]
from qgis.core import (  # noqa: E402
    QgsApplication, QgsFeature, QgsGeometry, QgsMapRendererParallelJob, QgsMapSettings, QgsMeshLayer,
    QgsProcessingContext, QgsProcessingException, QgsProcessingFeedback, QgsProcessingUtils, QgsProject, QgsVectorLayer,
)
from qgis.PyQt.QtCore import QSize  # noqa: E402

DATA, PROGRAM = sys.argv[2:4]
DEM = os.path.join(DATA, "jacksboro_fault.tif")
EXAMPLES = os.path.join(DATA, "examples")

QgsApplication.setPrefixPath("/usr", True)
application = QgsApplication([], False)
application.initQgis()
import processing  # noqa: E402
from processing.core.Processing import Processing  # noqa: E402
from processing.core.ProcessingConfig import ProcessingConfig  # noqa: E402

Processing.initialize()
import scarp_processing  # noqa: E402

plugin = scarp_processing.classFactory(None)
plugin.initProcessing()
ProcessingConfig.setSettingValue("SCARP_PROGRAM", PROGRAM)
registry = QgsApplication.processingRegistry()


class Feedback(QgsProcessingFeedback):
    """Stores messages; cancels at the first progress on request."""

    def __init__(self, cancels=False):
        super().__init__()
        self.said, self.passes, self.cancels = [], [], cancels
        self.progressChanged.connect(self.hear)

    def hear(self, percent):
        assert 0 <= percent <= 100, percent
        if self.cancels:
            self.cancel()

    def setProgressText(self, text):
        self.passes.append(text)

    def pushWarning(self, text):
        self.said.append(text)

    def pushInfo(self, text):
        self.said.append(text)


def run_scarp(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE).stdout


def refused(algorithm, parameters, *words, feedback=None):
    try:
        processing.run(algorithm, parameters, feedback=feedback or Feedback())
    except QgsProcessingException as error:
        for word in words:
            assert word in str(error), f"{algorithm} says: {error}"
        assert not re.search(r"(^|\W)--[a-z]|^scarp:", str(error)), f"{algorithm} names options of a command line: {error}"
        return
    raise AssertionError(f"{algorithm} takes {parameters}")


ids = [one.id() for one in registry.providerById("scarp").algorithms()]
assert ids == ["scarp:measuremesh", "scarp:pointstomesh", "scarp:rastertomesh", "scarp:rastertotiles"], ids

# Every option of the program that QGIS does not provide is a parameter, with the program's help.
rows = json.loads(run_scarp("help", "--json"))["options"]
offered = {one.name(): one for one in registry.algorithmById("scarp:rastertomesh").parameterDefinitions()}
taken = {"--help", "--help-all", "--version", "--quiet", "--timing", "--json-progress", "--report", "--overwrite",
         "--points"}
for row in rows:
    if row["command"] != "simplify" or not row["name"].startswith("--") or row["name"] in taken:
        continue
    name = row["name"][2:].replace("-", "_").upper()
    assert (name in offered) == (row["group"] != "Scattered points"), name
    assert name not in offered or offered[name].help() == row["help"], name

# A mesh layer with as many faces as the report; the file equals the program's.
feedback = Feedback()
made = processing.run(
    "scarp:rastertomesh",
    {"INPUT": DEM, "MAX_ERROR": 20, "CRS": "EPSG:32616", "EFFORT": "fast", "OUTPUT": "utm.2dm"}, feedback=feedback
)
run_scarp("simplify", DEM, "program.2dm", "-e", "20", "--crs", "EPSG:32616", "--effort", "fast")
assert filecmp.cmp("utm.2dm", "program.2dm", shallow=False), "QGIS and the program make different files"
layer = QgsMeshLayer(made["OUTPUT"], "mesh", "mdal")
assert layer.isValid()
assert layer.dataProvider().faceCount() == made["TRIANGLES"], made
assert layer.dataProvider().vertexCount() == made["VERTICES"], made
assert made["ERROR"] <= 20, made
assert "refine" in feedback.passes and "write" in feedback.passes, feedback.passes

# Loaded as a layer: the CRS, which 2DM cannot hold, is set, and triangles are drawn.
context = QgsProcessingContext()
project = QgsProject()
context.setProject(project)
algorithm = registry.createAlgorithmById("scarp:rastertomesh")
_, fine = algorithm.run(
    {"INPUT": DEM, "MAX_ERROR": "2%", "CRS": "EPSG:32616", "OUTPUT": "shown.2dm"}, context, Feedback()
)
assert fine
[(path, details)] = context.layersToLoadOnCompletion().items()
shown = QgsProcessingUtils.mapLayerFromString(path, context, True, details.layerTypeHint)
details.postProcessor().postProcessLayer(shown, context, Feedback())
assert shown.crs().authid() == "EPSG:32616", shown.crs().authid()
assert shown.rendererSettings().nativeMeshSettings().isEnabled()
settings = QgsMapSettings()
settings.setLayers([shown])
settings.setDestinationCrs(shown.crs())
settings.setExtent(shown.extent())
settings.setOutputSize(QSize(640, 560))
job = QgsMapRendererParallelJob(settings)
job.start()
job.waitForFinished()
picture = job.renderedImage()
colours = {picture.pixel(x, y) for x in range(0, 640, 3) for y in range(0, 560, 3)}
assert len(colours) > 100, f"a picture of {len(colours)} colours"
picture.save("shown.png")

# Lakes from a file, breaklines from a memory layer, and an extent of the project.
lines = QgsVectorLayer("LineString?crs=EPSG:4326", "walls", "memory")
feature = QgsFeature()
feature.setGeometry(QgsGeometry.fromWkt("LineString (-84.35 36.30, -84.25 36.35)"))
assert lines.dataProvider().addFeature(feature)
lines.updateExtents()
plain = {"INPUT": DEM, "MAX_ERROR": 20, "EFFORT": "fast", "OUTPUT": "plain.2dm", "LOAD": False}
bare = processing.run("scarp:rastertomesh", plain, feedback=Feedback())
lined = processing.run(
    "scarp:rastertomesh",
    {**plain, "OUTPUT": "lined.2dm", "BREAKLINES": [lines], "SOFT_BREAKLINES": True,
     "WATER": [os.path.join(EXAMPLES, "lakes.geojson")]}, feedback=Feedback()
)
run_scarp("simplify", DEM, "by_file.2dm", "-e", "20", "--effort", "fast", "--water",
          os.path.join(EXAMPLES, "lakes.geojson"))
assert not filecmp.cmp("lined.2dm", "plain.2dm", shallow=False)
assert not filecmp.cmp("lined.2dm", "by_file.2dm", shallow=False), "the line in memory has no effect"
part = processing.run(
    "scarp:rastertomesh", {**plain, "OUTPUT": "part.2dm", "TE": "-84.4,-84.2,36.2,36.4 [EPSG:4326]"},
    feedback=Feedback()
)
run_scarp("simplify", DEM, "te.2dm", "-e", "20", "--effort", "fast", "--te", "-84.4", "36.2", "-84.2", "36.4")
assert filecmp.cmp("part.2dm", "te.2dm", shallow=False)
assert part["TRIANGLES"] < bare["TRIANGLES"]

# The program's messages are shown, and nothing is left behind.
refused("scarp:rastertomesh", {"INPUT": DEM, "MAX_ERROR": 20, "OUTPUT": "x.abc"}, "x.abc", ".glb")
# In the words of the dialog.
refused("scarp:rastertomesh", {"INPUT": DEM, "OUTPUT": "x.2dm"}, "no goal is given", '"Max error" 1', '"Max triangles" or')
refused("scarp:rastertomesh", {"INPUT": DEM, "MAX_ERROR": 20, "FILL_DISTANCE": 3, "OUTPUT": "x.2dm"},
        '"Fill distance" needs "Nodata policy" fill')
refused("scarp:rastertomesh", {"INPUT": DEM, "MAX_ERROR": "much", "OUTPUT": "x.2dm"}, "much")
refused("scarp:rastertomesh", {"INPUT": DEM, "MAX_ERROR": -1, "OUTPUT": "x.2dm"}, "-1")
refused("scarp:measuremesh", {"INPUT": DEM, "MESH": "utm.2dm", "FAIL_ABOVE": "1"}, "1")
refused("scarp:rastertomesh", {"INPUT": DEM, "MAX_ERROR": 0.01, "EFFORT": "high", "OUTPUT": "x.2dm"}, "cancelled",
        feedback=Feedback(cancels=True))
ProcessingConfig.setSettingValue("SCARP_PROGRAM", DEM)
refused("scarp:rastertomesh", {"INPUT": DEM, "MAX_ERROR": 20, "OUTPUT": "x.2dm"}, f"{DEM} is no program", "Settings")
ProcessingConfig.setSettingValue("SCARP_PROGRAM", PROGRAM)
assert not [name for name in os.listdir(".") if name.startswith("x.")], os.listdir(".")

measured = processing.run("scarp:measuremesh", {"INPUT": DEM, "MESH": "utm.2dm"}, feedback=Feedback())
judged = json.loads(run_scarp("measure", DEM, "utm.2dm", "--json"))
assert (measured["ERROR"], measured["RMSE"], measured["UNCOVERED"]) == (
    judged["max_error"], judged["rmse"], judged["uncovered"]), measured
assert measured["SOUND"] is True

survey = QgsVectorLayer("PointZ?crs=EPSG:32616", "survey", "memory")
points = []
for k in range(400):
    point = QgsFeature()
    x, y = k % 20, k // 20
    point.setGeometry(QgsGeometry.fromWkt(f"PointZ ({500000 + 10 * x} {4000000 + 10 * y} {(x - 10) ** 2 + y})"))
    points.append(point)
assert survey.dataProvider().addFeatures(points)[0]
survey.updateExtents()
surveyed = processing.run(
    "scarp:pointstomesh", {"INPUT": survey, "MAX_ERROR": 1, "OUTPUT": "survey.ply"}, feedback=Feedback()
)
assert 0 < surveyed["TRIANGLES"] < 700 and surveyed["ERROR"] <= 1, surveyed

tiles = processing.run(
    "scarp:rastertotiles",
    {"INPUT": [DEM], "VERTICAL": "egm96", "ZOOM": 9, "EFFORT": "fast", "OUTPUT": "globe"}, feedback=Feedback()
)
run_scarp("tile", DEM, "by_program", "--vertical", "egm96", "--zoom", "9", "--effort", "fast")
assert os.path.samefile(tiles["OUTPUT"], "globe/terrain") and tiles["LEVELS"] == 10, tiles
for folder, _, names in os.walk("by_program"):
    for name in names:
        path = os.path.join(folder, name)
        assert filecmp.cmp(path, path.replace("by_program", "globe/terrain", 1), shallow=False), path

# The lines of docs/guide/qgis.md, in the folder of examples.
guide = os.path.join(DATA, "..", "docs", "guide", "qgis.md")
with open(guide, encoding="utf-8") as file:
    blocks = re.findall(r"^```python\n(.*?)^```$", file.read(), re.M | re.S)
shutil.copytree(EXAMPLES, "by_guide_python")
os.chdir("by_guide_python")
for block in blocks:
    exec(compile(block, "qgis.md", "exec"), {"processing": processing})
assert blocks and os.path.getsize("tin.2dm") > 0
os.chdir("..")

plugin.unload()
assert registry.providerById("scarp") is None
print("the plugin's algorithms do what they say")
