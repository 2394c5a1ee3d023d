"""WebSockets byte by byte, so that a server can be told what no library would send."""

import base64
import hashlib
import json
import os
import socket
import struct
from urllib.parse import urlsplit

TEXT, BINARY, CONTINUED, CLOSE, PING, PONG = 1, 2, 0, 8, 9, 10
LAST = 0x80
#: The longest message that the server takes (LM1).
LONGEST = 256 * 1024
#: Longer than any answer takes; it only keeps the script from hanging.
GUARD = 30


class Wrong(Exception):
    """Something else came than what the standard says."""


class Server:
    def __init__(self, url):
        self.at = (urlsplit(url).hostname, urlsplit(url).port or 80)
        answer = self.ask("POST", "/api/v1/sessions", {"content-type": "application/json"}, b"{}")
        status, _, body = answer
        if status != 201:
            raise SystemExit(f"no session can be begun: {status} {body[:200]!r}")
        self.session = json.loads(body)["session"]

    def connect(self):
        stream = socket.create_connection(self.at, timeout=GUARD)
        stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return stream

    def head(self, method, path, headers, version="1.1"):
        lines = [f"{method} {path} HTTP/{version}", f"host: {self.at[0]}:{self.at[1]}"]
        lines += [f"{name}: {value}" for name, value in headers.items()]
        return ("\r\n".join(lines) + "\r\n\r\n").encode()

    def ask(self, method, path, headers, body=b"", version="1.1"):
        with self.connect() as stream:
            fixed = {"content-length": len(body)} if body else {}
            ending = {} if "connection" in headers else {"connection": "close"}
            stream.sendall(self.head(method, path, {**headers, **fixed, **ending}, version) + body)
            status, told = read_head(stream)
            body = b"" if status == 101 else read_all(stream, int(told.get("content-length", 0)))
            return status, told, body

    def upgrade(self, **changes):
        """What a request for a socket is answered; a header that is None is left out."""
        headers = {
            "connection": "Upgrade",
            "upgrade": "websocket",
            "sec-websocket-version": "13",
            "sec-websocket-key": "dGhlIHNhbXBsZSBub25jZQ==",
        }
        method, version = changes.pop("method", "GET"), changes.pop("version", "1.1")
        for name, value in changes.items():
            headers[name.replace("_", "-")] = value
        headers = {name: value for name, value in headers.items() if value is not None}
        return self.ask(method, f"/api/v1/sessions/{self.session}/socket", headers, version=version)

    def socket(self):
        return Socket(self)


def read_all(stream, count):
    """So many bytes; fewer where the connection ends."""
    got = b""
    while len(got) < count:
        more = stream.recv(count - len(got))
        if not more:
            break
        got += more
    return got


def read_head(stream):
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        byte = stream.recv(1)
        if not byte:
            raise Wrong("the connection ended within a head")
        head += byte
    first, *lines = head.decode("latin-1").split("\r\n")
    headers = dict(line.split(": ", 1) for line in lines if ": " in line)
    return int(first.split(" ")[1]), {name.lower(): value for name, value in headers.items()}


def frame(first, payload=b"", mask=True, length=None):
    """A frame; `length` where its head says another than the payload has."""
    length = len(payload) if length is None else length
    bit = 0x80 if mask else 0
    if length < 126:
        head = struct.pack("!BB", first, bit | length)
    elif length < 65536:
        head = struct.pack("!BBH", first, bit | 126, length)
    else:
        head = struct.pack("!BBQ", first, bit | 127, length)
    if not mask:
        return head + payload
    key = os.urandom(4)
    pad = (key * (len(payload) // 4 + 1))[: len(payload)]
    masked = int.from_bytes(payload, "big") ^ int.from_bytes(pad, "big")
    return head + key + masked.to_bytes(len(payload), "big")


class Socket:
    """A socket that has said hello and been welcomed."""

    def __init__(self, server):
        self.stream = server.connect()
        key = base64.b64encode(os.urandom(16)).decode()
        path = f"/api/v1/sessions/{server.session}/socket"
        headers = {
            "connection": "Upgrade",
            "upgrade": "websocket",
            "sec-websocket-version": "13",
            "sec-websocket-key": key,
        }
        self.stream.sendall(server.head("GET", path, headers))
        status, told = read_head(self.stream)
        digest = hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()
        if status != 101 or told.get("sec-websocket-accept") != base64.b64encode(digest).decode():
            raise Wrong(f"the handshake is answered {status} {told}")
        self.nonce = 0
        name = base64.urlsafe_b64encode(os.urandom(12)).decode()
        self.say(frame(LAST | TEXT, json.dumps({"type": "hello", "protocol": 4, "client": name}).encode()))
        self.until(lambda first, payload: first == LAST | TEXT and b'"welcome"' in payload[:20])

    def say(self, data, chop=None):
        if chop is None:
            return self.stream.sendall(data)
        for at in range(0, len(data), chop):
            self.stream.sendall(data[at : at + chop])
        return None

    def next(self):
        """The next frame; None where the connection has ended in order."""
        head = read_all(self.stream, 2)
        if len(head) < 2:
            return None
        if head[1] & 0x80:
            raise Wrong("a server masks nothing")
        length = head[1]
        if length == 126:
            (length,) = struct.unpack("!H", read_all(self.stream, 2))
        elif length == 127:
            (length,) = struct.unpack("!Q", read_all(self.stream, 8))
        return head[0], read_all(self.stream, length)

    def until(self, is_it):
        while True:
            heard = self.next()
            if heard is None:
                raise Wrong("the connection ended")
            first, payload = heard
            if is_it(first, payload):
                return first, payload
            if first == LAST | CLOSE:
                raise Wrong(f"closed: {payload[:2].hex()} {payload[2:]!r}")

    def ask(self):
        """A `ping` of the protocol, and its number."""
        self.nonce += 1
        return json.dumps({"type": "ping", "nonce": self.nonce}).encode()

    def is_answered(self):
        """The last `ping` is answered: it was one message, and whole."""
        wanted = f'"nonce":{self.nonce},'.encode()
        self.until(lambda first, payload: first == LAST | TEXT and b'"pong"' in payload and wanted in payload)

    def goes_on(self):
        self.say(frame(LAST | TEXT, self.ask()))
        self.is_answered()

    def closes(self, *codes):
        """It closes with one of these codes, and the connection ends with nothing after it."""
        while True:
            heard = self.next()
            if heard is None:
                raise Wrong("the connection ended without a close")
            first, payload = heard
            if first == LAST | CLOSE:
                break
        code = struct.unpack("!H", payload[:2])[0] if payload else None
        if code not in codes:
            raise Wrong(f"closed with {code}, not {' or '.join(map(str, codes))}")
        payload[2:].decode()
        self.stream.shutdown(socket.SHUT_WR)
        if self.next() is not None:
            raise Wrong("something follows a close")
