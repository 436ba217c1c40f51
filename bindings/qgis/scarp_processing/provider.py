"""The provider: Scarp's algorithms, and the setting for the program's path."""

import os

from processing.core.ProcessingConfig import ProcessingConfig, Setting
from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .algorithms import MakeTiles, MeasureMesh, PointsToMesh, RasterToMesh
from .program import SETTING


class ScarpProvider(QgsProcessingProvider):
    def id(self):
        return "scarp"

    def name(self):
        return "Scarp"

    def longName(self):
        return "Scarp: terrain meshes with a proven error"

    def icon(self):
        return QIcon(os.path.join(os.path.dirname(__file__), "icon.png"))

    def load(self):
        ProcessingConfig.addSetting(
            Setting(self.name(), SETTING, "Program scarp (empty: the one on the PATH)", "", valuetype=Setting.FILE)
        )
        ProcessingConfig.readSettings()
        self.refreshAlgorithms()
        return True

    def unload(self):
        ProcessingConfig.removeSetting(SETTING)

    def loadAlgorithms(self):
        for algorithm in (RasterToMesh, PointsToMesh, MeasureMesh, MakeTiles):
            self.addAlgorithm(algorithm())

    def defaultRasterFileExtension(self):
        return "tif"
