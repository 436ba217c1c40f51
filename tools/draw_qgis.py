#!/usr/bin/env python3
"""Draws pictures of the plugin for QGIS without a screen: draw_qgis.py PLUGINS PROGRAM DEM OUT. PLUGINS contains the
unpacked plugin."""

import os
import sys

plugins, program, dem, out = sys.argv[1:5]
sys.path[:0] = ["/usr/share/qgis/python/plugins", plugins]
from qgis.core import (  # noqa: E402
    QgsApplication, QgsMapRendererParallelJob, QgsMapSettings, QgsProcessingContext, QgsProcessingFeedback,
    QgsProcessingUtils, QgsProject, QgsRasterLayer,
)
from qgis.PyQt.QtCore import QSize, QTimer  # noqa: E402

application = QgsApplication([], True)
application.initQgis()
from processing.core.Processing import Processing  # noqa: E402
from processing.core.ProcessingConfig import ProcessingConfig  # noqa: E402
from processing.gui.AlgorithmDialog import AlgorithmDialog  # noqa: E402

Processing.initialize()
import scarp_processing  # noqa: E402

plugin = scarp_processing.classFactory(None)
plugin.initProcessing()
ProcessingConfig.setSettingValue("SCARP_PROGRAM", program)
registry = QgsApplication.processingRegistry()

project = QgsProject.instance()
project.addMapLayer(QgsRasterLayer(dem, "dem"))
dialog = AlgorithmDialog(registry.createAlgorithmById("scarp:rastertomesh"), False, None)
dialog.resize(900, 620)
dialog.show()


def grab():
    dialog.grab().save(os.path.join(out, "qgis_dialog.png"))
    dialog.close()
    application.quit()


QTimer.singleShot(1500, grab)
application.exec_()

context = QgsProcessingContext()
context.setProject(project)
parameters = {"INPUT": dem, "MAX_ERROR": "20", "CRS": "EPSG:32616", "OUTPUT": "tin.2dm"}
_, fine = registry.createAlgorithmById("scarp:rastertomesh").run(parameters, context, QgsProcessingFeedback())
assert fine
[(path, details)] = context.layersToLoadOnCompletion().items()
layer = QgsProcessingUtils.mapLayerFromString(path, context, True, details.layerTypeHint)
details.postProcessor().postProcessLayer(layer, context, QgsProcessingFeedback())
settings = QgsMapSettings()
settings.setLayers([layer])
settings.setDestinationCrs(layer.crs())
settings.setExtent(layer.extent())
settings.setOutputSize(QSize(900, 880))
job = QgsMapRendererParallelJob(settings)
job.start()
job.waitForFinished()
job.renderedImage().save(os.path.join(out, "qgis_layer.png"))
