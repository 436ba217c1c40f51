#!/usr/bin/env python3
"""Serves a folder on this machine only: serve.py FOLDER [PORT]. If PORT is in use or 0, uses a free one; prints the
address.

Tiles of quantized-mesh are compressed files, as the headers must declare."""

import functools
import http.server
import sys


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = http.server.SimpleHTTPRequestHandler.extensions_map | {
        ".terrain": "application/vnd.quantized-mesh", ".glb": "model/gltf-binary", ".subtree": "application/octet-stream",
        ".mjs": "text/javascript", ".wasm": "application/wasm"}

    def end_headers(self):
        if self.path.split("?")[0].endswith(".terrain"):
            self.send_header("Content-Encoding", "gzip")
        self.send_header("Access-Control-Allow-Origin", "*")
        super().end_headers()

    def log_message(self, *arguments):
        pass


def main():
    folder, port = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 8000
    handler = functools.partial(Handler, directory=folder)
    try:
        server = http.server.ThreadingHTTPServer(("127.0.0.1", port), handler)
    except OSError:  # the port is in use
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    with server:
        print(f"http://127.0.0.1:{server.server_address[1]}/", flush=True)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            pass


main()
