"""Writes rasters of a terrain to drop on the viewer's page: .hgt, web tiles, 16-bit PNGs, one interlaced, one
truncated."""
import math
import struct
import zlib

side = 65
heights = [[int(500 + 200 * math.sin(row / 9) * math.cos(col / 7) + (row * col) % 5) for col in range(side)] for row in range(side)]
open("N36W085.hgt", "wb").write(b"".join(struct.pack(">h", z) for row in heights for z in row))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


WHOLE, INTERLACED = ((0, 0, 1, 1),), ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2))


def write_png(name, depth, color, bytes_a_pixel, pixel_of, passes=WHOLE):
    """Each row has another filter. Passes: first column and row, and the steps."""
    def filtered(kind, row, above):
        out = bytearray()
        for k, byte in enumerate(row):
            left, up, corner = row[k - bytes_a_pixel] if k >= bytes_a_pixel else 0, above[k], above[k - bytes_a_pixel] if k >= bytes_a_pixel else 0
            near = min((left, up, corner), key=lambda value: abs(left + up - corner - value))
            out.append(byte - (0, left, up, (left + up) // 2, near)[kind] & 255)
        return bytes([kind]) + out

    pixels = b""
    for left, top, across, down in passes:
        rows = [b"".join(map(pixel_of, row[left::across])) for row in heights[top::down]]
        pixels += b"".join(filtered(k % 5, row, rows[k - 1] if k else bytes(len(row))) for k, row in enumerate(rows))
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, depth, color, 0, 0, int(passes is INTERLACED))) +
                           chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b""))


write_png("terrarium.png", 8, 2, 3, lambda z: struct.pack(">HB", z + 32768, 0))
write_png("mapbox.png", 8, 6, 4, lambda z: struct.pack(">I", (z + 10000) * 10 + z % 7)[1:] + (b"\0" if z > 690 else b"\xff"))
open("cut.png", "wb").write(open("terrarium.png", "rb").read()[:900])
write_png("grey16.png", 16, 0, 2, lambda z: struct.pack(">H", 50 * z))
write_png("interlaced.png", 16, 0, 2, lambda z: struct.pack(">H", 50 * z), INTERLACED)
