"""Values of parameters as the program's arguments."""

from qgis.core import QgsProcessingException, QgsProcessingUtils, QgsProviderRegistry, QgsVectorFileWriter

from . import options


def label_of(algorithm, name):
    return algorithm.parameterDefinition(name).description()


def path_of_raster(algorithm, layer, name):
    """The name under which GDAL opens a raster layer, which is what the program does too."""
    what = label_of(algorithm, name)
    if layer is None or not layer.isValid():
        raise QgsProcessingException(f"{what}: the layer cannot be read")
    provider = layer.dataProvider().name()
    if provider != "gdal":
        raise QgsProcessingException(
            f"{what}: {layer.name()} is a layer of the provider {provider}; save it as a GeoTIFF first"
        )
    return layer.source()


def path_of_vector(algorithm, layer, name, context):
    """FILE or FILE:LAYER; a layer without a file, such as one in memory, is saved to a temporary one."""
    what = label_of(algorithm, name)
    if layer is None or not layer.isValid():
        raise QgsProcessingException(f"{what}: the layer cannot be read")
    known = QgsProviderRegistry.instance().decodeUri(layer.providerType(), layer.source())
    if layer.providerType() == "ogr" and known.get("path") and not layer.subsetString():
        inside = known.get("layerName") or ""
        return known["path"] + (f":{inside}" if inside else "")
    path = QgsProcessingUtils.generateTempFilename("layer.gpkg")
    settings = QgsVectorFileWriter.SaveVectorOptions()
    settings.driverName = "GPKG"
    code, message, *_ = QgsVectorFileWriter.writeAsVectorFormatV3(
        layer, path, context.transformContext(), settings
    )
    if code != QgsVectorFileWriter.NoError:
        raise QgsProcessingException(f"{what}: {layer.name()} cannot be saved for the program: {message}")
    return path


def crs_arguments(algorithm, parameters, context, name, option):
    crs = algorithm.parameterAsCrs(parameters, name, context) if parameters.get(name) else None
    if crs is not None and crs.isValid():
        return [option, crs.authid() if crs.authid() and not crs.authid().startswith("USER:") else crs.toWkt()]
    if parameters.get(options.COORDINATES) is None:
        return []
    return [option, algorithm.parameterAsEnumString(parameters, options.COORDINATES, context)]


def arguments_of(row, algorithm, parameters, context, crs):
    """The arguments of one option; none where nothing was given."""
    name, option = options.parameter_name(row), row["name"]
    if row["value"] == "CRS":
        return crs_arguments(algorithm, parameters, context, name, option)
    if parameters.get(name) is None or parameters.get(name) == "":
        return []
    if row["type"] == "flag":
        return [option] if algorithm.parameterAsBool(parameters, name, context) else []
    if row["type"] == "choice":
        return [option, algorithm.parameterAsEnumString(parameters, name, context)]
    if options.is_extent(row):
        box = algorithm.parameterAsExtent(parameters, name, context, crs)
        if box.isNull():
            return []
        return [option, *(repr(side) for side in (box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum()))]
    if options.is_output(row):
        path = algorithm.parameterAsFileOutput(parameters, name, context)
        return [option, path] if path else []
    if options.is_vector(row):
        layers = (
            algorithm.parameterAsLayerList(parameters, name, context) if row["repeatable"]
            else [algorithm.parameterAsVectorLayer(parameters, name, context)]
        )
        return [
            part for layer in layers
            for part in (option, path_of_vector(algorithm, layer, name, context))
        ]
    if options.is_raster(row):
        layers = (
            algorithm.parameterAsLayerList(parameters, name, context) if row["repeatable"]
            else [algorithm.parameterAsRasterLayer(parameters, name, context)]
        )
        return [part for layer in layers for part in (option, path_of_raster(algorithm, layer, name))]
    if row["type"] == "file":
        if row["repeatable"]:
            lines = algorithm.parameterAsString(parameters, name, context).splitlines()
            return [part for line in lines if line.strip() for part in (option, line.strip())]
        return [option, algorithm.parameterAsFile(parameters, name, context)]
    if options.is_plain_number(row):
        return [option, repr(algorithm.parameterAsDouble(parameters, name, context))]
    text = algorithm.parameterAsString(parameters, name, context).strip()
    return [option, text] if text else []
