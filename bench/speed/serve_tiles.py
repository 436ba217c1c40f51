#!/usr/bin/env python3
"""Times tiles that scarp serve makes on demand: python3 serve_tiles.py SCARP RASTER [OPTION...]

Requests up to 40 tiles spread over each level: first when they are not made yet, then again when they are cached. Then
it asks another server that has prepared its coarse levels. One client on loopback, one answer at a time. Prints
milliseconds a tile, median and 95th percentile.
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


class Server:
    def __init__(self):
        start = time.monotonic()
        self.process = subprocess.Popen([sys.argv[1], "serve", *sys.argv[2:], "--port", "0"], stdout=subprocess.PIPE,
                                        text=True)
        for line in self.process.stdout:
            if at := re.search(r"http://127\.0\.0\.1:(\d+)/$", line):
                break
        print(f"answers after {time.monotonic() - start:.2f} s")
        self.client = http.client.HTTPConnection("127.0.0.1", int(at[1]))
        self.start = start

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()

    def ask(self, path):
        """Milliseconds, bytes and bound of the answer."""
        begun = time.monotonic()
        self.client.request("GET", path, headers={"Accept-Encoding": "gzip"})
        answer = self.client.getresponse()
        data = answer.read()
        assert answer.status == 200, path
        return 1000 * (time.monotonic() - begun), data, answer.getheader("X-Scarp-Bound")

    def times(self, z, tiles):
        return sorted(self.ask(f"/{z}/{x}/{y}.terrain")[0] for x, y in tiles)

    def wait_until_prepared(self):
        while self.ask("/0/0/0.terrain")[2] == "estimated":
            time.sleep(0.2)
        peak = re.search(r"VmHWM:\s+(\d+)", open(f"/proc/{self.process.pid}/status").read())
        print(f"prepared after {time.monotonic() - self.start:.1f} s, {int(peak[1]) // 1000} MB at most")


def main():
    with Server() as server:
        layer = json.loads(server.ask("/layer.json")[1])
        tiles = [tiles_of(layer, z) for z in range(layer["maxzoom"] + 1)]
        asked = [level[::max(1, len(level) // 40)] for level in tiles]
        times = [[server.times(z, level) for _ in range(2)] for z, level in enumerate(asked)]
    with Server() as server:
        server.wait_until_prepared()
        for z, level in enumerate(asked):
            times[z].append(server.times(z, level))
    print("level  tiles  cold median, 95 %   kept median, 95 %  prepared med., 95 %  [ms]")
    for z, row in enumerate(times):
        columns = "  ".join(f"{statistics.median(one):8.1f} {one[int(0.95 * (len(one) - 1))]:8.1f}" for one in row)
        print(f"{z:5}  {len(tiles[z]):5}  {columns}")


main()
