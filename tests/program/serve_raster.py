#!/usr/bin/env python3
"""Requests tiles from a server that makes them on demand.

  serve_raster.py PORT FOLDER [PID]: the folder holds the finished set of the same options. With PID the server has room
  to prepare its coarse levels; then all tiles are requested again, and many clients ask at once.
"""

import http.client
import json
import pathlib
import random
import re
import socket
import sys
import threading
import time

port, folder = int(sys.argv[1]), pathlib.Path(sys.argv[2])
server = int(sys.argv[3]) if len(sys.argv) > 3 else None


def connect():
    return http.client.HTTPConnection("127.0.0.1", port, timeout=600)


def ask(connection, path):
    connection.request("GET", path, headers={"Accept-Encoding": "gzip"})
    answer = connection.getresponse()
    answer.data = answer.read()
    return answer


def of_server(field):
    return int(re.search(rf"{field}:\s+(\d+)", pathlib.Path(f"/proc/{server}/status").read_text()).group(1))


names = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.terrain"))
kept = {name: (folder / name).read_bytes() for name in names}
finished = json.loads((folder / "layer.json").read_text())

# The same tiles, and the bound of each whose nodes were all examined.
connection = connect()
layer = json.loads(ask(connection, "/layer.json").data)
assert layer["available"] == finished["available"] and layer["bounds"] == finished["bounds"]
assert layer["description"] == finished["description"]
blocks = max(layer["maxzoom"] - 5, 0)


def compare_all():
    """Returns the levels with unknown bounds."""
    estimated, bounds = set(), {}
    for name in names:
        answer = ask(connection, f"/{name}?v={layer['version']}")
        assert answer.status == 200 and answer.data == kept[name], name
        z, bound = int(name.split("/")[0]), answer.getheader("X-Scarp-Bound")
        if bound == "estimated":
            estimated.add(z)
        else:
            bounds[z] = max(bounds.get(z, 0), float(bound))
    for z in bounds.keys() - estimated:
        assert abs(bounds[z] / finished["scarp"]["levels"][z]["bound"] - 1) < 1e-3, z
    return estimated


# Holds before the coarse levels are prepared, and even more afterwards.
assert compare_all() <= set(range(blocks))
if server is not None:
    deadline = time.monotonic() + 600
    while ask(connection, "/0/0/0.terrain").getheader("X-Scarp-Bound") == "estimated" or of_server("Threads") > 3:
        assert time.monotonic() < deadline, "the coarse levels are never prepared"
        time.sleep(0.05)
    assert not compare_all()
assert ask(connection, f"/{layer['maxzoom']}/0/0.terrain").status == 404
assert ask(connection, f"/{layer['maxzoom'] + 1}/0/0.terrain").status == 404
answer = ask(connection, "/" + names[0])
connection.request("GET", "/" + names[0], headers={"If-None-Match": answer.getheader("ETag"), "Accept-Encoding": "gzip"})
assert connection.getresponse().status == 304
connection.close()

print(len(names))
if server is None:
    sys.exit()

# Many clients at once: slow ones, some that leave before the answer, and some that send nonsense.
before = of_server("VmHWM")
wrong = []


def stroll(seed):
    draw = random.Random(seed)
    try:
        one = connect()
        for _ in range(40):
            name = draw.choice(names)
            if ask(one, "/" + name).data != kept[name]:
                wrong.append(name)
        one.close()
    except OSError as error:
        wrong.append(error)


slow = [socket.create_connection(("127.0.0.1", port), timeout=600) for _ in range(100)]
for one in slow:
    one.sendall(b"GET /" + names[-1].encode() + b" HTTP/1.1\r\nHost: x\r\nX: ")
strollers = [threading.Thread(target=stroll, args=(k,)) for k in range(50)]
for one in strollers:
    one.start()
for k in range(1500):
    with socket.create_connection(("127.0.0.1", port), timeout=600) as one:
        one.sendall((b"GET /" + names[k % len(names)].encode() + b" HTTP/1.1\r\nHost: x\r\n\r\n", b"GET /", b"\0\xff\r\n\r\n")[k % 3])
for one in strollers:
    one.join()
assert not wrong, wrong[:3]
for one in slow:
    one.close()
assert of_server("Threads") <= 3, "threads grow with clients"
assert of_server("VmHWM") - before < 60000, "memory grows with clients"
