#!/usr/bin/env python3
"""access_test.py BUILD_DIR: walks PROTOCOL.md's table of who may call what, with every example of a request: without a
token, with a wrong one, and as a viewer, an editor and an operator.

The last line says "N passed, N failed".
"""
import hashlib
import json
import re
import secrets
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
ROLES = ["none", "viewer", "editor", "operator"]
PATIENCE = 60


def table():
    """{method: role} of PROTOCOL.md."""
    text = (TOP / "proto" / "PROTOCOL.md").read_text(encoding="utf-8")
    roles = {}
    for role, methods in re.findall(r"^\| `(none|viewer|editor|operator)` \| (.*) \|$", text, re.M):
        for method in re.findall(r"`([a-z.]+)`", methods):
            assert method not in roles, f"{method} stands twice in the table"
            roles[method] = role
    return roles


def requests():
    """{method: its examples}"""
    found = {}
    for path in sorted((TOP / "proto" / "examples").glob("*.json")):
        request = json.loads(path.read_text(encoding="utf-8")).get("request")
        if request and path.stem != "error":
            found.setdefault(request["method"], []).append(request)
    return found


class Peer:
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self.lines = self.socket.makefile("r", encoding="utf-8")

    def code(self, request):
        """The error's code, or "" where the request was granted."""
        self.socket.sendall((json.dumps(request) + "\n").encode())
        while True:
            reply = json.loads(self.lines.readline())
            if reply.get("id") == request["id"]:
                return reply["error"]["data"]["code"] if "error" in reply else ""

    def hello(self, token):
        params = {} if token is None else {"token": token}
        return self.code({"jsonrpc": "2.0", "id": "hello", "method": "session.hello", "params": params})

    def close(self):
        self.lines.close()
        self.socket.close()


def complaints(port, tokens):
    needed, examples = table(), requests()
    if set(needed) != set(examples):
        yield f"the table and the examples differ: {sorted(set(needed) ^ set(examples))}"
    who = [("no token", None, "none"), ("a wrong token", secrets.token_urlsafe(32), "none")]
    who += [(f"the {role}'s token", tokens[role], role) for role in ROLES[1:]]
    for method in sorted(set(needed) & set(examples)):
        for name, token, role in who:
            # No more than a session.hello of its own may precede what is tried.
            allowed = ROLES.index(role) >= ROLES.index(needed[method])
            expected = [None] if allowed else ["unauthorized"] if role == "none" else ["forbidden"]
            peer = Peer(port)
            hello = peer.hello(token) if token else ""
            if hello != ("" if role != "none" or token is None else "unauthorized"):
                yield f"session.hello with {name}: {hello!r}"
            for example in examples[method]:
                request = dict(example)
                if method == "session.hello":  # each brings its own token, or none
                    request["params"] = {**request["params"], **({"token": token} if token else {})}
                    expected = ["unauthorized"] if role == "none" else [""]
                code = peer.code(request)
                fine = code in expected if expected != [None] else code not in ("unauthorized", "forbidden")
                yield None if fine else f"{method} with {name}: {code!r}, expected {expected}"
            peer.close()


def main():
    posed = Path(sys.argv[1]) / "bin" / "posed"
    with tempfile.TemporaryDirectory(prefix="posed-access-") as folder:
        tokens = {role: secrets.token_urlsafe(32) for role in ROLES[1:]}
        file = Path(folder) / "tokens"
        file.write_text("".join(f"{role} {role}s sha256:{hashlib.sha256(token.encode()).hexdigest()}\n"
                                for role, token in tokens.items()), encoding="utf-8")
        process = subprocess.Popen([posed, "--listen", "127.0.0.1:0", "--data", folder, "--auth.tokens", file, "--log", "error"],
                                   stdout=subprocess.PIPE, text=True)
        try:
            port = int(re.search(r":(\d+)/", process.stdout.readline()).group(1))
            passed = failed = 0
            for complaint in complaints(port, tokens):
                passed += complaint is None
                failed += complaint is not None
                if complaint:
                    print(complaint)
        finally:
            process.terminate()
            process.wait(PATIENCE)
            process.stdout.close()
    print(f"{passed} passed, {failed} failed")
    sys.exit(failed > 0 or passed == 0)


if __name__ == "__main__":
    main()
