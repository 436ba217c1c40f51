"""The hashes that `live.mjs hash` prints, from Python."""
import hashlib

import numpy as np
import scarp

width, height = 70, 50
state = 7


def draw(count):
    global state
    state = state * 16807 % 2147483647
    return state % count


def sample():
    return np.nan if draw(12) == 0 else draw(1000) / 64


def in_order(cell):
    """The triangles in an order of their own: that of files differs without meshoptimizer."""
    corners = [vertex.tobytes().hex() for vertex in cell.positions]
    triangles = [[corners[v] for v in triangle] for triangle in cell.triangles]
    return "".join(sorted(min(a + b + c, b + c + a, c + a + b) for a, b, c in triangles)).encode()


for effort, goals in (("fast", {"max_error": 3}), ("normal", {"max_error": 3}), ("high", {"max_error": 3}),
                      ("normal", {"max_triangles": 2000})):
    state = 7
    digest = hashlib.sha256()
    z = np.array([k % width / 8 + sample() for k in range(width * height)], np.float32).reshape(height, width)
    live = scarp.Live(z, **goals, effort=effort, cell=16, place=(-3, 5))
    version = 0
    for _ in range(40):
        changes = live.changes(version)
        version = changes.version
        for cell in changes.cells:
            digest.update(np.array([cell.slot, cell.col, cell.row], np.int32).tobytes())
            digest.update(in_order(cell))
        if draw(5) == 0:
            cols, rows = draw(9) - 4, draw(9) - 4
            live.scroll(rows, cols)
            continue
        col, row = draw(width - 1), draw(height - 1)
        cols, rows = 1 + draw(min(20, width - col)), 1 + draw(min(20, height - row))
        live.update(slice(row, row + rows), slice(col, col + cols), np.array([sample() for _ in range(cols * rows)]).reshape(rows, cols))
    print(digest.hexdigest())
