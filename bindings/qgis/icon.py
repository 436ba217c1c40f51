"""The plugin's icon, drawn: a hill of triangles, as PNG."""

import struct
import zlib

SIDE, FINE = 64, 4  # pixels; samples of a pixel along each side

# Corners in a square of 64, y downwards, and their triangles from light to shade.
CORNERS = ((4, 56), (22, 30), (36, 8), (30, 40), (46, 34), (60, 56), (28, 56), (44, 56))
TRIANGLES = (
    (0, 1, 6, (126, 186, 120)), (1, 3, 6, (96, 160, 98)), (1, 2, 3, (208, 220, 196)), (2, 4, 3, (120, 140, 122)),
    (3, 4, 7, (70, 116, 84)), (3, 7, 6, (82, 138, 90)), (4, 5, 7, (52, 92, 72)),
)


def color_at(x, y):
    """Red, green, blue and cover."""
    for a, b, c, color in TRIANGLES:
        sides = []
        for first, second in ((a, b), (b, c), (c, a)):
            (x0, y0), (x1, y1) = CORNERS[first], CORNERS[second]
            sides.append((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0))
        if min(sides) >= 0 or max(sides) <= 0:
            return (*color, 255)
    return (0, 0, 0, 0)


def pixel(col, row):
    found = [color_at(col + (i + 0.5) / FINE, row + (j + 0.5) / FINE) for i in range(FINE) for j in range(FINE)]
    covered = [one for one in found if one[3]]
    if not covered:
        return bytes(4)
    return bytes([*(sum(one[k] for one in covered) // len(covered) for k in range(3)), 255 * len(covered) // len(found)])


def draw():
    """The bytes of the PNG."""
    rows = b"".join(b"\0" + b"".join(pixel(col, row) for col in range(SIDE)) for row in range(SIDE))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
