"""Scarp in QGIS: a Processing provider over the program `scarp`."""


def classFactory(iface):  # the name that QGIS asks for
    from .plugin import ScarpPlugin

    return ScarpPlugin()
