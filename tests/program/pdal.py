#!/usr/bin/env python3
"""Replaces PDAL's `translate` if that is not installed: LAS 1.2 to text, with only the options of its writers.text."""
import re
import struct
import sys

command, source, target, *options = sys.argv[1:]
given = {}
for option in options:
    name, value = re.fullmatch(r"--writers\.text\.(order|keep_unspecified|quote_header|write_header|delimiter|precision)=(.*)", option).groups()
    given[name] = value
assert command == "translate" and target.rsplit(".", 1)[1] in ("csv", "txt", "xyz"), sys.argv
order = [re.fullmatch(r"([XYZ])(?::(\d+))?", word).groups() for word in given["order"].split(",")]
assert given["keep_unspecified"] == "false" and given.get("quote_header", "true") in ("true", "false")
with open(source, "rb") as file:
    data = file.read()
assert data[:4] == b"LASF"
offset, = struct.unpack_from("<I", data, 96)
length, count = struct.unpack_from("<HI", data, 105)
scales, offsets = struct.unpack_from("<3d", data, 131), struct.unpack_from("<3d", data, 155)
quote = '"' if given.get("quote_header", "true") == "true" else ""
with open(target, "w") as file:
    print(",".join(f"{quote}{name}{quote}" for name, _ in order), file=file)
    for k in range(count):
        point = [scale * value + shift for scale, value, shift in
                 zip(scales, struct.unpack_from("<3i", data, offset + k * length), offsets)]
        print(",".join(f"{point['XYZ'.index(name)]:.{digits or given.get('precision', 3)}f}" for name, digits in order), file=file)
