# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""A page's WebSocket, as small as it can be: text out, text in, and every way of going away."""

import base64
import json
import os
import socket
import struct


class WebSocket:
    def __init__(self, port, timeout=20):
        self.stream = socket.create_connection(("127.0.0.1", port), timeout=timeout)
        key = base64.b64encode(os.urandom(16)).decode()
        host = f"127.0.0.1:{port}"
        self.stream.sendall((f"GET /ws HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nConnection: Upgrade\r\n"
                             f"Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n").encode())
        self.reader = self.stream.makefile("rb")
        head = b""
        while not head.endswith(b"\r\n\r\n"):
            line = self.reader.readline()
            if not line:
                raise ConnectionError("no answer to the upgrade")
            head += line
        if b" 101 " not in head.split(b"\r\n")[0]:
            raise ConnectionError(head.decode(errors="replace").split("\r\n")[0])

    def frame(self, opcode, content):
        mask = os.urandom(4)
        size = len(content)
        head = struct.pack("!BB", 0x80 | opcode, 0x80 | size) if size < 126 else struct.pack("!BBH", 0x80 | opcode, 0x80 | 126, size)
        self.stream.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(content)))

    def say(self, kind, **fields):
        self.frame(1, json.dumps({"type": kind, **fields}).encode())

    def hear(self):
        """The next message; None for a picture. Answers pings."""
        text = b""
        while True:
            head = self.reader.read(2)
            if len(head) < 2:
                raise ConnectionError("closed")
            first, size = head[0], head[1] & 0x7F
            if size == 126:
                size = struct.unpack("!H", self.reader.read(2))[0]
            elif size == 127:
                size = struct.unpack("!Q", self.reader.read(8))[0]
            content = self.reader.read(size)
            if first & 0x0F == 9:
                self.frame(10, content)
                continue
            if first & 0x0F == 8:
                raise ConnectionError("closed by the station")
            if first & 0x08:
                continue
            text += content
            if first & 0x80:
                return json.loads(text) if text.startswith(b"{") else None

    def vanish(self):
        """As a page whose process is killed: no closing frame, the rest is reset."""
        self.stream.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.close()

    def close(self):
        self.reader.close()
        self.stream.close()
