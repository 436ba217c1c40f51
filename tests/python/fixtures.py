"""Common parts of the tests of Scarp for Python. Parts that need a missing package are skipped.

SCARP_PROGRAM: the program, whose bytes are compared; SCARP_DEM: a raster. SCARP_SHARE=N: the search for leaks uses an
Nth (DEFAULT: a tenth) of 10,000 meshes and 1,000 refiners.
"""
import array
import os
import unittest

try:
    import numpy as np
except ImportError:
    np = None

PROGRAM = os.environ.get("SCARP_PROGRAM")
DEM = os.environ.get("SCARP_DEM")
SHARE = int(os.environ.get("SCARP_SHARE", "10"))  # repeated tasks run an Nth of their repetitions


def need(*modules):
    """Skips the test with a message if a module is missing."""
    def can_import(name):
        try:
            __import__(name)
            return True
        except ImportError:
            return False
    missing = [name for name in modules if not can_import(name)]
    return unittest.skipIf(missing, "needs " + " and ".join(missing))


def hills(rows=120, cols=160, dtype="float32"):
    y, x = np.mgrid[0:rows, 0:cols]
    return (40 * np.sin(x / 15) * np.cos(y / 11) + (x * y) % 7).astype(dtype)


def plain_hills(rows, cols):
    """Similar hills without numpy: a memoryview of float32."""
    lines = [array.array("f", [float((k + col * col) % 41) for col in range(cols)]) for k in range(41)]
    values = array.array("f")
    for row in range(rows):
        values += lines[3 * row * row % 41]
    return memoryview(values).cast("B").cast("f", (rows, cols))


def is_same(a, b):
    """Compares value by value: 0 equals -0."""
    if np is None:
        return a.offsets.tolist() == b.offsets.tolist() and bytes(a.triangles) == bytes(b.triangles)
    return np.array_equal(a.offsets, b.offsets) and np.array_equal(a.triangles, b.triangles)
