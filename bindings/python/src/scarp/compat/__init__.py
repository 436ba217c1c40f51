"""Other packages' interfaces, for Scarp."""
