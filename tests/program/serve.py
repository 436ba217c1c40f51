#!/usr/bin/env python3
"""Sends correct and incorrect requests to a tile server.

  serve.py PORT FOLDER [ARCHIVE]: the server serves the set in the folder, possibly from the archive.
"""

import gzip
import http.client
import json
import pathlib
import select
import socket
import sys
import threading
import time

port, folder = int(sys.argv[1]), pathlib.Path(sys.argv[2])
archive = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None


def ask(path, method="GET", **headers):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=600)
    connection.request(method, path, headers={name.replace("_", "-"): value for name, value in headers.items()})
    answer = connection.getresponse()
    answer.data = answer.read()
    connection.close()
    return answer


def raw(data):
    with socket.create_connection(("127.0.0.1", port), timeout=600) as one:
        one.sendall(data)
        parts = []
        while part := one.recv(65536):
            parts.append(part)
        return b"".join(parts)


names = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.terrain"))
kept = {name: (folder / name).read_bytes() for name in names}

# All tiles over one connection, as stored.
connection = http.client.HTTPConnection("127.0.0.1", port, timeout=600)
for name in names:
    connection.request("GET", f"/{name}?v=1", headers={"Accept-Encoding": "gzip, deflate, br"})
    answer = connection.getresponse()
    assert answer.status == 200 and answer.read() == kept[name], name
    assert answer.getheader("Content-Encoding") == "gzip"
    assert answer.getheader("Content-Type") == "application/vnd.quantized-mesh"
    assert "immutable" in answer.getheader("Cache-Control")
connection.close()

# The header decides about compression; each form has its own tag.
name = names[len(names) // 2]
packed = ask("/" + name, Accept_Encoding="gzip")
for refused in ("", "br", "gzip;q=0", "identity, gzip;q=0.000"):
    plain = ask("/" + name, Accept_Encoding=refused)
    assert plain.data == gzip.decompress(kept[name]) and plain.getheader("Content-Encoding") is None, refused
    assert plain.getheader("Vary") == packed.getheader("Vary") == "Accept-Encoding"
    assert plain.getheader("ETag") != packed.getheader("ETag")
assert ask("/" + name, Accept_Encoding="*").data == kept[name]
assert packed.getheader("Access-Control-Allow-Origin") == "*" and packed.getheader("Cache-Control") == "no-cache"
tag = packed.getheader("ETag")
for tags in (tag, "W/" + tag, '"other", ' + tag, "*"):
    answer = ask("/" + name, Accept_Encoding="gzip", If_None_Match=tags)
    assert answer.status == 304 and answer.data == b"" and answer.getheader("ETag") == tag
assert ask("/" + name, Accept_Encoding="gzip", If_None_Match='"other"').status == 200
head = ask("/" + name, "HEAD", Accept_Encoding="gzip")
assert head.status == 200 and head.data == b"" and int(head.getheader("Content-Length")) == len(kept[name])

layer = ask("/layer.json")
assert layer.data == (folder / "layer.json").read_bytes() and layer.getheader("Content-Type") == "application/json"
assert b"/layer.json\n" in ask("/index.txt").data
page = ask("/")
assert page.getheader("Content-Type") == "text/html; charset=utf-8" and page.data.startswith(b"<!"), page.data[:60]
assert b'id="scarp-data"' in page.data or b"<svg" in page.data
assert ask("/", If_None_Match=page.getheader("ETag")).status == 304
assert layer.getheader("Date").endswith(" GMT")

# A browser's preflight request.
answer = ask("/" + name, "OPTIONS", Origin="http://example.org", Access_Control_Request_Method="GET")
assert answer.status == 204 and "GET" in answer.getheader("Access-Control-Allow-Methods")
assert ask("/" + name, "POST").status == 405 and ask("/" + name, "DELETE").status == 405
assert ask("/" + name, "PURGE").status == 501

# Missing files with a reason; nothing outside the set.
answer = ask("/3/0/0.terrain")
assert answer.status == 404 and b"no tile 3/0/0.terrain" in answer.data
assert answer.getheader("Access-Control-Allow-Origin") == "*"
for path in ("/secret", "/../secret", "/%2e%2e/secret", "/layer.json/../../secret", "//etc/passwd", "/link", "/.hidden",
             "/0/0/../0/0.terrain", "/00/0/0.terrain", "/0/0/0.terrain%00", "/%", "/%zz"):
    answer = ask(path)
    assert answer.status in (400, 404) and b"mine" not in answer.data, path

# The archive itself, in ranges.
if archive:
    whole, url = archive.read_bytes(), "/" + archive.name
    answer = ask(url)
    assert answer.data == whole and answer.getheader("Accept-Ranges") == "bytes"
    tag = answer.getheader("ETag")
    for header, want in (("bytes=0-126", whole[:127]), ("bytes=1000-", whole[1000:]), ("bytes=-77", whole[-77:]),
                         (f"bytes=5-{10 ** 12}", whole[5:]), (f"bytes=-{10 ** 12}", whole)):
        answer = ask(url, Range=header)
        assert answer.status == 206 and answer.data == want, header
        start = len(whole) - len(want) if not header.startswith("bytes=0-") else 0
        assert answer.getheader("Content-Range") == f"bytes {start}-{start + len(want) - 1}/{len(whole)}"
    assert ask(url, Range="bytes=0-9", If_Range=tag).status == 206
    assert ask(url, Range="bytes=0-9", If_Range='"other"').data == whole
    assert ask(url, If_None_Match=tag).status == 304
    answer = ask(url, Range=f"bytes={len(whole)}-")
    assert answer.status == 416 and answer.getheader("Content-Range") == f"bytes */{len(whole)}"
    for header in ("bytes=9-5", "lines=1-2", "bytes=0-1,5-6", "bytes=x", "bytes=-"):
        assert ask(url, Range=header).data == whole, header

# Invalid requests, and bytes with two readings: one answer, and the connection ends, whatever follows.
behind = b"GET /nothing HTTP/1.1\r\nHost: x\r\n\r\n"
for broken, status in (
        (b"nonsense\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nHost: y\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nX: \0\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nX: a\rb\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nX: a\r\n b\r\n\r\n", 400),
        (b"GET / HTTP/1.1\nHost: x\n\n", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nContent-Length : 40\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding : chunked\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nContent-Length: 5\r\nContent-Length: 6\r\n\r\nhello!", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nContent-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n-1\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: foo\r\n\r\n", 501),
        (b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 999999\r\n\r\n", 413),
        (b"GET / HTTP/9.9\r\nHost: x\r\n\r\n", 505),
        (b"GET /" + b"y" * 40000 + b" HTTP/1.1\r\n", 414),
        (b"GET / HTTP/1.1\r\nX: " + b"y" * 40000 + b"\r\n", 431)):
    answer = raw(broken + behind)
    assert answer.startswith(b"HTTP/1.1 %d " % status) and answer.count(b"\nDate: ") == 1, (broken[:80], answer[:200])
    assert b"Connection: close" in answer
assert raw(b"GET /layer.json HTTP/1.0\r\n\r\n").startswith(b"HTTP/1.1 200 ")
assert raw(b"GET http://elsewhere/layer.json HTTP/1.0\r\n\r\n").startswith(b"HTTP/1.1 200 ")
# Two requests at once get two answers in order; a body is not a request.
last = b"GET /nothing HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
two = raw(f"GET /{name} HTTP/1.1\r\nHost: x\r\nAccept-Encoding: gzip\r\n\r\n".encode() + last)
assert two.index(b"HTTP/1.1 200") == 0 and two.rindex(b"HTTP/1.1 404") > len(kept[name])
for first in (b"Content-Length: %d\r\n\r\n%s" % (len(behind), behind),
              b"Transfer-Encoding: chunked\r\n\r\n%x\r\n%s\r\n0\r\n\r\n" % (len(behind), behind)):
    two = raw(b"GET /layer.json HTTP/1.1\r\nHost: x\r\n" + first + last)
    assert two.startswith(b"HTTP/1.1 200") and two.count(b"\nDate: ") == 2 and two.count(b"HTTP/1.1 404") == 1, first

# Slow clients block no other client, and are dropped.
idle = [socket.create_connection(("127.0.0.1", port), timeout=600) for _ in range(200)]
slow = socket.create_connection(("127.0.0.1", port), timeout=600)


def trickle():
    try:
        for letter in b"GET / HTTP/1.1\r\nHost: x\r\nX: " + b"y" * 100:
            slow.sendall(bytes([letter]))
            time.sleep(0.3)
    except OSError:
        pass


dawdler = threading.Thread(target=trickle, daemon=True)
dawdler.start()
for k in range(50):
    assert ask("/" + names[k % len(names)], Accept_Encoding="gzip").status == 200
    assert k > 0 or not select.select(idle, [], [], 0)[0], "an answer waits for those who ask nothing"
assert idle[0].recv(1) == b"" and idle[199].recv(1) == b"", "the server waits for ever"
dawdler.join(40)
try:
    assert slow.recv(1) == b""
except ConnectionResetError:
    pass
for one in idle:
    one.close()
many = [socket.create_connection(("127.0.0.1", port), timeout=600) for _ in range(300)]
time.sleep(0.5)
for one in many[:250]:
    one.close()
assert ask("/layer.json").status == 200
print(len(names))
