#!/usr/bin/env python3
"""A server full of clients that never read still serves the others.

  serve_fair.py PORT FOLDER LARGE PID: the server with that PID has 1,000 places and serves the folder with the file
  LARGE of some megabytes.

Counts are fixed, and nothing is timed: actions of deaf and other clients are interleaved.
"""

import http.client
import pathlib
import resource
import socket
import sys
import time

port, folder, large, server = int(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3], int(sys.argv[4])
names = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.terrain"))
largest = max(names, key=lambda name: (folder / name).stat().st_size)
PLACES, DEAF, AT_ONCE = 1000, 1050, 160
hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
resource.setrlimit(resource.RLIMIT_NOFILE, (5000, hard))
deaf = []


def request(path):
    return f"GET /{path} HTTP/1.1\r\nHost: x\r\nAccept-Encoding: gzip\r\n\r\n".encode()


def connect(address, buffer=None):
    one = socket.socket()
    if buffer:
        one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
    one.settimeout(600)
    one.bind((address, 0))
    one.connect(("127.0.0.1", port))
    return one


def add_deaf(count, path):
    for _ in range(count):
        one = connect("127.0.0.1", 2048)
        try:
            one.sendall(request(path) * AT_ONCE)
        except OSError:
            pass
        deaf.append(one)


def check_served(address, rounds):
    for k in range(rounds):
        client = http.client.HTTPConnection("127.0.0.1", port, timeout=600, source_address=(address, 0))
        for name in (names[7 * k % len(names)], names[(7 * k + 3) % len(names)]):
            client.request("GET", "/" + name, headers={"Accept-Encoding": "gzip"})
            answer = client.getresponse()
            assert answer.status == 200 and answer.read() == (folder / name).read_bytes(), name
        client.close()


def ask(one):
    one.sendall(request(names[0]))
    answer = b""
    while not answer.endswith(want):
        part = one.recv(65536)
        assert part, "closed"
        answer += part


# Another address keeps its places, however many requests the first one sends.
want = (folder / names[0]).read_bytes()
friends = [connect("127.0.0.2") for _ in range(100)]
for one in friends:
    ask(one)
asked = time.monotonic()
add_deaf(DEAF, largest)
files = len(list(pathlib.Path(f"/proc/{server}/fd").iterdir()))
assert files < PLACES / 2 + len(friends) + 50, f"{files} files are open for one address and {len(friends)} friends"
# After 10 seconds without a request good clients are dropped, too; so slow a machine proves nothing here.
if time.monotonic() - asked < 8:
    for one in friends:
        ask(one)
check_served("127.0.0.1", 10)
check_served("127.0.0.2", 10)

# A slow download completes, though more deaf clients than places keep coming from its own address.
add_deaf(DEAF, large)
slow = connect("127.0.0.1", 32768)
slow.sendall(request(large))
data = b""
whole = (folder / large).read_bytes()
while not data.endswith(whole[-1000:]):
    part = slow.recv(65536)
    assert part, f"cut off after {len(data)} bytes"
    data += part
    if len(data) // 65536 > len(deaf) // 8 - 2 * DEAF // 8:
        add_deaf(8, large)
assert data.split(b"\r\n\r\n", 1)[1] == whole
assert len(deaf) > 3 * DEAF - 100, len(deaf)
check_served("127.0.0.1", 10)
check_served("127.0.0.2", 10)
print(len(deaf), "deaf clients")
