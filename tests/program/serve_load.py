#!/usr/bin/env python3
"""Thousands of concurrent clients, most of them malicious.

  serve_load.py PORT FOLDER ARCHIVE PID: the server with that PID serves the folder's set from the archive.

Counts are fixed, and nothing is timed: an unanswered client fails the test after a minute.
"""

import http.client
import pathlib
import re
import resource
import socket
import struct
import sys
import time

port, folder, archive, server = int(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]), int(sys.argv[4])
names = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.terrain"))
kept = {name: (folder / name).read_bytes() for name in names}

hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
hard = 20000 if hard == resource.RLIM_INFINITY else hard
resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
# At most 5,000 connections, if the system allows the process so many.
share = min(1.0, (hard - 100) / 6000)


def count(n):
    return max(10, int(n * share))


def connect(**options):
    one = socket.socket()
    for name, value in options.items():
        one.setsockopt(socket.SOL_SOCKET, getattr(socket, name), value)
    one.settimeout(600)
    one.connect(("127.0.0.1", port))
    return one


def of_server(field):
    return int(re.search(rf"{field}:\s+(\d+)", pathlib.Path(f"/proc/{server}/status").read_text()).group(1))


def files_of_server():
    return len(list(pathlib.Path(f"/proc/{server}/fd").iterdir()))


def request(path, more=b""):
    return b"GET " + path.encode() + b" HTTP/1.1\r\nHost: x\r\nAccept-Encoding: gzip\r\n" + more + b"\r\n"


def read_answer(one):
    """Status and body of one answer on a persistent connection."""
    data = b""
    while b"\r\n\r\n" not in data:
        part = one.recv(65536)
        assert part, "closed in the middle"
        data += part
    head, body = data.split(b"\r\n\r\n", 1)
    length = int(re.search(rb"Content-Length: (\d+)", head).group(1))
    while len(body) < length:
        part = one.recv(65536)
        assert part, "closed in the middle"
        body += part
    assert len(body) == length
    return int(head.split()[1]), body


def drain(one):
    """All bytes until the server closes or breaks off."""
    data = b""
    try:
        while part := one.recv(65536):
            data += part
    except ConnectionResetError:
        pass
    one.close()
    return data


def check_health(rounds):
    client = http.client.HTTPConnection("127.0.0.1", port, timeout=600)
    for k in range(rounds):
        name = names[7 * k % len(names)]
        client.request("GET", "/" + name, headers={"Accept-Encoding": "gzip"})
        answer = client.getresponse()
        assert answer.status == 200 and answer.read() == kept[name], name
    client.close()


check_health(50)
memory, threads, files = of_server("VmHWM"), of_server("Threads"), files_of_server()

# Two thousand persistent connections ask in turn, twice; the second time all ask before any reads.
friends = []
for k in range(count(2000)):
    friends.append(connect())
    friends[-1].sendall(request("/" + names[k % len(names)]))
    assert read_answer(friends[-1]) == (200, kept[names[k % len(names)]])
for k, one in enumerate(friends):
    try:
        one.sendall(request("/" + names[(3 * k + 1) % len(names)]))
    except OSError:
        pass
for k, one in enumerate(friends):
    want = names[(3 * k + 1) % len(names)]
    try:
        answer = read_answer(one)
    except (AssertionError, OSError):
        # On a slow machine it may have been idle for too long: like a browser it reconnects.
        one.close()
        one = friends[k] = connect()
        one.sendall(request("/" + want))
        answer = read_answer(one)
    assert answer == (200, kept[want])

# Meanwhile: clients that send a byte now and then, endless heads, and countless headers;
slow = [connect() for _ in range(count(500))]
for letter in b"GET /layer.json HT":
    for one in slow:
        try:
            one.sendall(bytes([letter]))
        except OSError:
            pass  # dropped after 10 seconds on a slow machine
check_health(20)
endless = [connect() for _ in range(count(300))]
for one in endless:
    try:
        one.sendall(b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 3000)
    except OSError:
        pass
for one in endless:
    answer = drain(one)
    assert not answer or answer.startswith(b"HTTP/1.1 431 "), answer[:60]
# clients that request the archive, megabytes of it, and never read the answer;
deaf = [connect(SO_RCVBUF=4096) for _ in range(count(300))]
for one in deaf:
    one.sendall(request("/" + archive.name) + request("/" + names[-1]) * 20)
# clients that close one half, and must be answered nevertheless;
for k in range(count(200)):
    half = connect()
    half.sendall(request("/" + names[k % len(names)]))
    half.shutdown(socket.SHUT_WR)
    assert read_answer(half) == (200, kept[names[k % len(names)]])
    half.close()
# clients that reset the connection in the middle of a request or answer;
for k in range(count(300)):
    gone = connect()
    gone.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    gone.sendall(request("/" + archive.name)[: 9 + k % 60])
    gone.close()
# and clients that send invalid requests or paths outside the set.
for broken in (b"\0" * 100 + b"\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\xff\xfe / HTTP/1.1\r\nConnection: close\r\n\r\n",
               b"GET / HTTP/1.1\r\nno colon\r\n\r\n", b"GET /%00 HTTP/1.1\r\n\r\n", b"\x16\x03\x01\x02\x00\x01\r\n\r\n",
               b"GET / HTTP/1.1\r\nTransfer-Encoding : chunked\r\n\r\n", b"PUT /x HTTP/1.1\r\nContent-Length: 99\r\n\r\n"):
    for _ in range(count(30)):
        one = connect()
        one.sendall(broken)
        assert re.match(rb"HTTP/1.1 (400|405|505) ", drain(one)), broken
for path in ("/../secret", "/..%2fsecret", "/%2e%2e/%2e%2e/etc/passwd", "/layer.json/../../secret", "//etc/passwd", "/.//../secret",
             "/0/0/../../../secret", "/%2e%2e%5csecret", "/..\\secret", "/%252e%252e/secret", "/" + "../" * 500 + "etc/passwd"):
    one = connect()
    one.sendall(request(path, b"Connection: close\r\n"))
    answer = drain(one)
    assert re.match(rb"HTTP/1.1 40[04] ", answer) and b"mine" not in answer and b"root:" not in answer, path
check_health(50)

# More connections than an address may have: the longest idle are dropped, and active ones are answered.
crowd = [connect() for _ in range(count(2400))]
check_health(50)
for k in range(0, count(2400), 8):
    late = connect()
    late.sendall(request("/" + names[k % len(names)]))
    assert read_answer(late) == (200, kept[names[k % len(names)]])
    late.close()
assert files_of_server() <= 4096 + 64, "more connections than the server may have"
grown = of_server("VmHWM") - memory
assert grown < 160_000, f"memory grew by {grown} kB"
assert of_server("Threads") == threads, "threads grow with clients"

# All leave, and nothing remains of them.
for one in friends + slow + deaf + crowd:
    one.close()
for _ in range(600):
    if files_of_server() <= files + 2:
        break
    time.sleep(0.1)
assert files_of_server() <= files + 2, "connections are left"
check_health(50)
print(len(friends), "friends,", grown, "kB")
