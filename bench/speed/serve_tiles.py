#!/usr/bin/env python3
"""Times tiles that scarp serve makes when they are asked for: python3 serve_tiles.py SCARP RASTER [OPTION...]

Asks for up to 40 tiles of each level, spread over it, twice: first nobody has made them, then they are kept. One client
on loopback, one answer at a time. Prints milliseconds a tile, median and 95th percentile.
"""

import http.client
import json
import re
import statistics
import subprocess
import sys
import time


def tiles_of(layer, z):
    return [(x, y) for one in layer["available"][z] for y in range(one["startY"], one["endY"] + 1)
            for x in range(one["startX"], one["endX"] + 1)]


def main():
    start = time.monotonic()
    server = subprocess.Popen([sys.argv[1], "serve", *sys.argv[2:], "--port", "0"], stdout=subprocess.PIPE, text=True)
    try:
        for line in server.stdout:
            if at := re.search(r"http://127\.0\.0\.1:(\d+)/$", line):
                break
        print(f"ready after {time.monotonic() - start:.2f} s")
        client = http.client.HTTPConnection("127.0.0.1", int(at[1]))

        def ask(path):
            begun = time.monotonic()
            client.request("GET", path, headers={"Accept-Encoding": "gzip"})
            answer = client.getresponse()
            data = answer.read()
            assert answer.status == 200, path
            return 1000 * (time.monotonic() - begun), data

        layer = json.loads(ask("/layer.json")[1])
        print("level  tiles  cold median, 95 %   kept median, 95 %  [ms]")
        for z in range(layer["maxzoom"] + 1):
            tiles = tiles_of(layer, z)
            asked = tiles[::max(1, len(tiles) // 40)]
            times = [sorted(ask(f"/{z}/{x}/{y}.terrain")[0] for x, y in asked) for _ in range(2)]
            row = "  ".join(f"{statistics.median(one):8.1f} {one[int(0.95 * (len(one) - 1))]:8.1f}" for one in times)
            print(f"{z:5}  {len(tiles):5}  {row}")
    finally:
        server.terminate()
        server.wait()


main()
