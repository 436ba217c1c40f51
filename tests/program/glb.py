"""Splits a GLB: glb.py FILE image N OUT writes its image N; glb.py FILE json prints its JSON."""
import json
import struct
import sys


def load(path):
    data = open(path, "rb").read()
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


def view_bytes(document, binary, view):
    view = document["bufferViews"][view]
    start = view.get("byteOffset", 0)
    return binary[start:start + view["byteLength"]]


def floats(document, binary, accessor):
    """Rows of numbers of a float32 accessor."""
    accessor = document["accessors"][accessor]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    assert accessor["componentType"] == 5126
    numbers = struct.unpack(f"<{width * accessor['count']}f", view_bytes(document, binary, accessor["bufferView"]))
    return [numbers[i:i + width] for i in range(0, len(numbers), width)]


if __name__ == "__main__":
    document, binary = load(sys.argv[1])
    if sys.argv[2] == "json":
        print(json.dumps(document))
    else:
        open(sys.argv[4], "wb").write(view_bytes(document, binary, document["images"][int(sys.argv[3])]["bufferView"]))
