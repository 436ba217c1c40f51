"""How a mesh that was just made is shown: its CRS, its triangles, its heights as colours."""

from qgis.core import QgsMapLayerType, QgsProcessingLayerPostProcessorInterface


# QGIS owns a style and deletes it, but calls methods that live only as long as Python knows it.
_kept = []


def style_of(crs):
    """A new style of a mesh in a CRS, which may be invalid."""
    _kept.append(MeshStyle(crs))
    return _kept[-1]


class MeshStyle(QgsProcessingLayerPostProcessorInterface):
    """QGIS calls it on the loaded layer."""

    def __init__(self, crs):
        super().__init__()
        self.crs = crs

    def postProcessLayer(self, layer, context, feedback):
        # 2DM, PLY and DXF have no place for a CRS.
        if self.crs.isValid() and not layer.crs().isValid():
            layer.setCrs(self.crs)
        if layer.type() != QgsMapLayerType.MeshLayer:
            return
        settings = layer.rendererSettings()
        wires = settings.nativeMeshSettings()
        wires.setEnabled(True)
        wires.setLineWidth(0.1)
        settings.setNativeMeshSettings(wires)
        if layer.datasetGroupCount() > 0:
            settings.setActiveScalarDatasetGroup(0)
        layer.setRendererSettings(settings)
        layer.triggerRepaint()
