"""Other packages' interfaces, by Scarp."""
