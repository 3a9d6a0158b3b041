#!/usr/bin/env python3
"""malformed_test.py BUILD_DIR DOCUMENT_CHECK: some hundreds of malformed lines, WebSocket messages and documents, made by a
seeded generator. Each gets one error that says where or what; what follows on the same connection is answered; nothing of
it gets into the scene; and somebody else's edits go through meanwhile.

The last line says "N passed, N failed".
"""
import base64
import json
import os
import random
import re
import socket
import struct
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
PATIENCE = 60
SEED = 1987
PING = b'{"jsonrpc":"2.0","id":"after","method":"session.ping"}'
# Any JSON may stand there, or more than one type.
FREE = {"user", "id", "weight", "at", "relative_to", "figure", "start", "joints", "document", "value", "to", "support", "limits",
        "hold", "params"}


def requests():
    found = []
    for path in sorted((TOP / "proto" / "examples").glob("*.json")):
        request = json.loads(path.read_text(encoding="utf-8")).get("request")
        if request and path.stem != "error" and len(json.dumps(request)) < 4000:
            found.append(request)
    return found


def leaves(node, place=()):
    """Paths of values that have one type, deep in."""
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, value in items:
        if key in FREE:
            continue
        yield place + (key,)
        yield from leaves(value, place + (key,))


def with_value(document, place, value):
    document = json.loads(json.dumps(document))
    node = document
    for key in place[:-1]:
        node = node[key]
    node[place[-1]] = value
    return document


def text(document):
    return json.dumps(document, ensure_ascii=False, separators=(",", ":")).encode()


def wrong_type(rng, document):
    places = list(leaves(document))
    if not places:
        return None
    place = rng.choice(places)
    value = document
    for key in place:
        value = value[key]
    other = {bool: [7, "yes"], int: ["7", [], {}], float: ["7", [], {}], str: [[], {}, False], list: ["x", {}, True],
             dict: ["x", [], True]}[type(value)] if value is not None else [[]]
    return text(with_value(document, place, rng.choice(other)))


def spoiled(rng, document):
    """(kind, bytes) of a document that is no good any more."""
    whole = text(document)
    inside = rng.randrange(1, len(whole))
    number = re.search(rb":-?[0-9][0-9.]*", whole)
    string = re.search(rb':"[^"]+"', whole)

    def instead(match, value):
        return whole[:match.start()] + b":" + value + whole[match.end():] if match else None

    yield "truncated", whole[:inside]
    yield "control", whole[:inside] + bytes([rng.choice([0, 1, 8, 11, 12, 27, 127 + 1])]) + whole[inside:]
    yield "bad UTF-8", instead(string, b'"' + rng.choice([b"\xff", b"\xc0\x80", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"\xe2\x82", b"\x80"])
                               + b'"')
    yield "deep", whole[:-1] + b',"deep":' + b"[" * rng.choice([65, 300, 100_000]) + b"1" + b"]" * 65 + b"}"
    yield "deep objects", whole[:-1] + b',"deep":' + b'{"a":' * rng.choice([65, 300, 20_000]) + b"1" + b"}" * 65 + b"}"
    yield "wrong type", wrong_type(rng, document)
    key = rng.choice(list(document))
    yield "key twice", b"{" + text({key: document[key]})[1:-1] + b"," + whole[1:]
    yield "number", instead(number, rng.choice([b"1e999", b"-1e999", b"NaN", b"Infinity", b"-Infinity", b"0x10", b"01", b"+1", b".5", b"1.",
                                                b"1e", b"--1", b"1_000"]))
    yield "escape", instead(string, rng.choice([b'"\\ud800"', b'"\\ude00"', b'"\\ud800\\u0041"', b'"\\x41"', b'"\\u12"', b'"\\"']))
    yield "mark in the middle", whole[:1] + b"\xef\xbb\xbf" + whole[1:]
    yield "not UTF-8", (whole.decode() + "\u00e4").encode(rng.choice(["utf-16-le", "utf-16", "utf-32-be", "latin-1"])).replace(b"\n", b" ")
    yield "behind it", whole + rng.choice([b"]", b"}", b"null", b" x", whole, b","])
    yield "comma", whole[:-1] + b",}"
    yield "comment", b"/* " + whole + b" */" + whole
    yield "quotes", whole.replace(b'"', b"'")
    yield "no object", rng.choice([b"1", b'"x"', b"null", b"true", b"[]", b"[1]", b"-", b"{", b"}", b"\\", b"\x00"])
    yield "unknown field", whole[:-1] + b',"surplus":1}'


def spoiled_requests(rng):
    for request in requests():
        for kind, line in spoiled(rng, request):
            if line:
                yield kind, line
        params = request.get("params", {})
        for kind, value in (("long", "x" * rng.choice([65, 4096, 100_000])), ("long", "x" * 70)):
            if "id" in params:
                yield kind, text({**request, "params": {**params, "id": value}})
        yield "unknown field", text({**request, "params": {**params, "surplus": 1}})
        yield "no version", text({key: value for key, value in request.items() if key != "jsonrpc"})
        yield "version", text({**request, "jsonrpc": rng.choice(["1.0", 2.0, None, []])})
        yield "no method", text({key: value for key, value in request.items() if key != "method"})
        yield "method", text({**request, "method": rng.choice([7, None, "", "goal", "goal.sett", "x" * 1000, "rpc.discover\u0000"])})
        yield "id", text({**request, "id": rng.choice([{}, [], True])})
        yield "params", text({**request, "params": rng.choice(["x", 7, [1], True])})


class Lines:
    """JSON lines over TCP."""
    name = "lines"

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self.stream = self.socket.makefile("rb")

    def send(self, message):
        self.socket.sendall(message + b"\n")

    def receive(self):
        return json.loads(self.stream.readline())

    def close(self):
        self.stream.close()
        self.socket.close()


class Websocket(Lines):
    name = "WebSocket"

    def __init__(self, port):
        super().__init__(port)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /ws HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        assert b"101" in self.stream.readline()
        while self.stream.readline() != b"\r\n":
            pass

    def send(self, message):
        size, mask = len(message), os.urandom(4)
        length = (struct.pack(">B", 0x80 | size) if size < 126 else struct.pack(">BH", 0xfe, size) if size < 65536
                  else struct.pack(">BQ", 0xff, size))
        masked = (int.from_bytes(message, "big") ^ int.from_bytes((mask * (size // 4 + 1))[:size], "big")).to_bytes(size, "big")
        self.socket.sendall(b"\x81" + length + mask + masked)

    def receive(self):
        _, size = self.stream.read(2)
        if size == 126:
            size, = struct.unpack(">H", self.stream.read(2))
        elif size == 127:
            size, = struct.unpack(">Q", self.stream.read(8))
        return json.loads(self.stream.read(size))


def says_where(error):
    """A path, a byte, or the thing itself in quotes or by its name."""
    data, message = error.get("data", {}), error["message"]
    if data.get("code") == "parse_error":
        return bool(re.search(r"byte \d+|the key \"|the number |deeper than", message))
    return bool(data.get("code")) and bool(data.get("path") or data["code"] in ("invalid_request", "unknown_method"))


def judged(kind, reply):
    """What is wrong with an answer, or None."""
    errors = reply if isinstance(reply, list) else [reply]
    for answer in errors:
        if "error" not in answer:
            return f"{kind}: it was taken"
        if not answer["error"].get("message") or not says_where(answer["error"]):
            return f"{kind}: the error does not say where: {json.dumps(answer['error'])[:300]}"
    return None


def over_the_wire(port, face):
    rng = random.Random(SEED)
    peer = face(port)
    for number, (kind, message) in enumerate(spoiled_requests(rng)):
        if face is Lines:
            message = message.replace(b"\n", b" ")
        peer.send(message)
        complaint = judged(kind, peer.receive())
        if complaint:
            complaint = f"{face.name} {number} {complaint}: {message[:200]!r}"
        if number % 10 == 0:
            peer.send(PING)
            after = peer.receive()
            if after.get("id") != "after" or "result" not in after:
                complaint = f"{face.name} {number} {kind}: what follows is answered {after}"
        yield complaint
    peer.close()
    for fault, code in ((b"x" * (1 << 20) + b"x", "too_large"), (b"[" + b"1," * 1000 + b"1]", "too_large")):
        peer = face(port)
        peer.send(fault)
        reply = peer.receive()
        yield None if reply["error"]["data"]["code"] == code else f"{face.name}: {len(fault)} bytes: {reply}"
        peer.close()


def documents(check):
    rng = random.Random(SEED)
    figure = json.loads((TOP / "proto/examples/figure.get.json").read_text(encoding="utf-8"))["reply"]["result"]["document"]
    scenes = [json.loads(path.read_text(encoding="utf-8")) for path in sorted((TOP / "server/scene/templates").rglob("*.json"))]
    cases = [("figure", kind, line) for _ in range(8) for kind, line in spoiled(rng, figure) if line]
    cases += [("scene", kind, line) for scene in scenes for kind, line in spoiled(rng, scene) if line]
    cases = [(what, kind, line.replace(b"\n", b" ")) for what, kind, line in cases]
    lines = b"".join(what.encode() + b" " + line + b"\n" for what, _, line in cases)
    answers = subprocess.run([check], input=lines, capture_output=True, check=True, timeout=PATIENCE * 5).stdout.splitlines()
    if len(answers) != len(cases):
        yield f"{len(answers)} answers to {len(cases)} documents"
    for (what, kind, line), answer in zip(cases, answers):
        answer = answer.decode(errors="replace")
        code, _, message = answer.partition(" ")
        place, _, message = message.partition(": ")
        where = place.startswith("/") or re.search(r"byte \d+|the key \"|the number |deeper than|object was expected", message)
        fine = code in (f"bad_{what}", "parse_error", "not_available", "unknown_segment", "unknown_figure") and where
        yield None if fine else f"{what} {kind}: {answer[:200]}: {line[:200]!r}"


def scene_of(port):
    peer = Lines(port)
    peer.send(b'{"jsonrpc":"2.0","id":1,"method":"scene.get"}')
    document = peer.receive()["result"]["document"]
    document["goals"].pop("busy", None)
    peer.close()
    for figure in document["figures"].values():
        figure.pop("q")  # which follows the goal
    return document


def main():
    build, check = Path(sys.argv[1]), sys.argv[2]
    passed = failed = edits = 0
    with tempfile.TemporaryDirectory(prefix="posed-malformed-") as folder:
        process = subprocess.Popen([build / "bin" / "posed", "--listen", "127.0.0.1:0", "--data", folder, "--log", "error"],
                                   stdout=subprocess.PIPE, text=True)
        over, refused = threading.Event(), []

        def edit(port):
            nonlocal edits
            peer = Lines(port)
            while not over.is_set():
                goal = {"id": "busy", "at": "right_hand", "position": [0.3 + edits % 10 * 0.01, -0.3, 1.2]}
                peer.send(text({"jsonrpc": "2.0", "id": edits, "method": "goal.set", "params": goal}))
                reply = peer.receive()
                edits += 1
                if "result" not in reply:
                    refused.append(reply)
            peer.close()

        try:
            port = int(re.search(r":(\d+)/", process.stdout.readline()).group(1))
            before = scene_of(port)
            busy = threading.Thread(target=edit, args=(port,))
            busy.start()
            try:
                for face in (Lines, Websocket):
                    for complaint in over_the_wire(port, face):
                        passed += complaint is None
                        failed += complaint is not None
                        if complaint:
                            print(complaint)
            finally:
                over.set()
                busy.join()
            for complaint in (f"an edit of another peer was refused: {refused[0]}" if refused else None,
                              None if edits > 10 else f"another peer came to {edits} edits only",
                              None if scene_of(port) == before else "something of it got into the scene"):
                passed += complaint is None
                failed += complaint is not None
                if complaint:
                    print(complaint)
        finally:
            process.terminate()
            process.wait(PATIENCE)
            process.stdout.close()
    for complaint in documents(check):
        passed += complaint is None
        failed += complaint is not None
        if complaint:
            print(complaint)
    print(f"{passed} passed, {failed} failed")
    sys.exit(failed > 0 or passed < 300)


if __name__ == "__main__":
    main()
