"""Interfaces of other packages, implemented by Scarp."""
