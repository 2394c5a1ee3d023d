#!/usr/bin/env python3
"""A small client of an Espalier server: draws a stroke, saves the tree, exports it.

    pip install -r docs/client/requirements.txt
    python docs/client/draw.py http://127.0.0.1:7700

The rules are in proto/PROTOCOL.md, every message in proto/protocol.schema.json, every address in proto/openapi.json.
"""
import json
import sys
import urllib.error
import urllib.request
from uuid import uuid4

from websockets.sync.client import connect


def request(method, address, body=None):
    """Asks the HTTP API; gives the answer's body. What is refused comes as application/problem+json (ER1)."""
    data = None if body is None else json.dumps(body).encode()
    headers = {"Content-Type": "application/json"}
    try:
        with urllib.request.urlopen(urllib.request.Request(address, data, headers, method=method)) as answer:
            return answer.read()
    except urllib.error.HTTPError as refusal:
        problem = json.load(refusal)
        raise SystemExit(f"{problem['detail']} ({problem['reason']})") from None


def varint(data, at):
    """The number at a place: seven bits a byte, the lowest first; the last byte is below 128."""
    number = shift = 0
    while True:
        number |= (data[at] & 127) << shift
        if data[at] < 128:
            return number
        at, shift = at + 1, shift + 7


class Session:
    """A socket to a session: sends commands, and listens until they are durable and all growth has ended."""

    def __init__(self, server, name):
        self.socket = connect(f"{server.replace('http', 'ws', 1)}/api/v1/sessions/{name}/socket", max_size=None)
        self.commands = 0
        self.done = 0
        self.frame_bytes = 0
        self.refused = {}
        self.is_welcome = False
        # A key of this client's own: with the same one it could come back after a lost connection.
        self.send({"type": "hello", "protocol": 4, "client": uuid4().hex})
        while not self.is_welcome:
            self.listen()

    def send(self, message):
        self.socket.send(json.dumps(message))

    def command(self, **command):
        self.commands += 1
        self.send({"type": "command", "id": self.commands, "command": command})

    def listen(self):
        message = self.socket.recv(timeout=60)
        if isinstance(message, bytes):
            # A frame's header: version, kind, codec, flags in a byte each, epoch in four; then the sequence and the
            # length of the body as varints (FR3). The server sends no more than fits into its window until what has
            # come is answered (FL1).
            kind, sequence = message[1], varint(message, 8)
            self.frame_bytes += len(message)
            self.send({"type": "received", "kind": kind, "sequence": sequence})
            return
        message = json.loads(message)
        if message["type"] == "welcome":
            self.is_welcome = True
        elif message["type"] == "done":
            self.done = message["id"]
        elif message["type"] == "refused":
            self.refused[message["id"]] = message["problem"]["message"]
        elif message["type"] == "problem":
            raise SystemExit(message["problem"]["message"])

    def settle(self):
        """Waits until every command is durable and all growth has ended (CM11)."""
        while self.done < self.commands:
            self.listen()
        for fault in self.refused.values():
            raise SystemExit(fault)


def main(server):
    name = json.loads(request("POST", f"{server}/api/v1/sessions", {"seed": 7}))["session"]
    session = Session(server, name)
    session.command(kind="stroke_begin", stroke=1)
    for height in range(2, 14, 2):
        # Places and radii are in internodes; a radius of 0 would be a pencil.
        sample = {"position": [0, height, 0], "radius": 3}
        session.command(kind="stroke_move", stroke=1, samples=[sample])
    session.command(kind="stroke_end", stroke=1)
    session.settle()
    print(f"{session.frame_bytes} bytes of frames so far")

    tree = json.loads(request("POST", f"{server}/api/v1/trees", {"session": name, "name": "From a script"}))
    print(f"saved as {tree['id']}, version {tree['version']}")
    glb = request("GET", f"{server}/api/v1/sessions/{name}/tree.glb?quantised=true")
    skeleton = json.loads(request("GET", f"{server}/api/v1/sessions/{name}/tree.json"))
    print(f"{len(glb)} bytes of glTF, {len(skeleton['metamers'])} metamers in the skeleton")


if __name__ == "__main__":
    main(sys.argv[1].rstrip("/"))
