#!/usr/bin/env python3
"""Packs the grid of EGM96 for the program: data/egm96.bin, which src/globe/egm96.cpp reads.

The grid has 721 x 1440 heights of the geoid above the ellipsoid of WGS 84, 15 minutes of arc apart. They are rounded to
centimetres. Second differences along the rows, then along the columns, from the north-western node on, are packed in
Rice code. A number n >= 0 stands for n / 2 or -(n + 1) / 2. It is written as n >> k ones, a zero, and the last k bits
of n. k adapts to the preceding differences in the row. Bits fill 64-bit words, the highest first.

usage: make_egm96.py /usr/share/proj/egm96_15.gtx data/egm96.bin       (Debian's proj-data)
"""

import array
import math
import struct
import sys

ROWS, COLS = 721, 1440


def read_centimetres(path):
    """Rows of the grid, the northern one first."""
    with open(path, "rb") as file:
        south, west, down, across, rows, cols = struct.unpack(">4d2i", file.read(40))
        heights = array.array("f", file.read())
    if sys.byteorder == "little":
        heights.byteswap()
    if (south, west, down, across, rows, cols) != (-90, -180, 0.25, 0.25, ROWS, COLS) or len(heights) != ROWS * COLS:
        sys.exit(f"{path} is not the grid of EGM96 at 15 minutes")
    rounded = [math.floor(100 * height + 0.5) for height in heights]
    return [rounded[row * COLS : (row + 1) * COLS] for row in reversed(range(ROWS))]


def second_differences(numbers):
    last = before = 0
    for number in numbers:
        yield number - 2 * last + before
        last, before = number, last


def pack(rows):
    along = [list(second_differences(row)) for row in rows]
    columns = [list(second_differences(column)) for column in zip(*along)]
    bits = []
    for row in zip(*columns):
        size = 32  # eight times the usual size of a difference
        for number in row:
            k = 0
            while (40 << k) < 7 * size:
                k += 1
            code = 2 * number if number >= 0 else -2 * number - 1
            bits.append("1" * (code >> k) + "0")
            if k > 0:
                bits.append(format(code & ((1 << k) - 1), f"0{k}b"))
            size += abs(number) - (size >> 3)
    text = "".join(bits)
    text += "0" * (-len(text) % 64)
    return int(text, 2).to_bytes(len(text) // 8, "big")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    packed = pack(read_centimetres(sys.argv[1]))
    with open(sys.argv[2], "wb") as file:
        file.write(packed)
    print(f"{sys.argv[2]}: {len(packed)} bytes")


if __name__ == "__main__":
    main()
