#!/usr/bin/env python3
"""Replaces a set while it is served.

  serve_replaced.py PORT OLD NEW COMMAND...: OLD and NEW are folders with the tiles of the two sets; the command puts
  the new one in place. Both are requested all the time; afterwards only the new one is served.
"""

import http.client
import pathlib
import subprocess
import sys
import threading

port, old, new, command = int(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]), sys.argv[4:]


def read(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*.terrain")}


before, after = read(old), read(new)
gone, common = sorted(before.keys() - after.keys()), sorted(before.keys() & after.keys())
assert gone and any(before[name] != after[name] for name in common)


def ask(client, name):
    client.request("GET", "/" + name, headers={"Accept-Encoding": "gzip"})
    answer = client.getresponse()
    return answer.status, answer.read()


wrong, done, asked = [], threading.Event(), threading.Event()


def stroll():
    client = http.client.HTTPConnection("127.0.0.1", port, timeout=600)
    while not done.is_set():
        for name in common + gone:
            status, body = ask(client, name)
            fits = body in (before[name], after.get(name)) if status == 200 else status == 404 and name in gone
            if not fits:
                wrong.append((name, status, body[:80]))
        asked.set()
    client.close()


strollers = [threading.Thread(target=stroll) for _ in range(2)]
for one in strollers:
    one.start()
asked.wait(60)
subprocess.run(command, check=True)
client = http.client.HTTPConnection("127.0.0.1", port, timeout=600)
assert ask(client, "layer.json") == (200, (new / "layer.json").read_bytes())
for name, body in after.items():
    assert ask(client, name) == (200, body), name
for name in gone:
    assert ask(client, name)[0] == 404, name
client.close()
done.set()
for one in strollers:
    one.join()
assert not wrong, wrong[:3]
print(len(after))
