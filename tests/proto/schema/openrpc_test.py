#!/usr/bin/env python3
"""openrpc_test.py TOP BUILD_DIR: proto/schema/openrpc.json, the examples, the codec and a running daemon say the same.

    the document      is what the codec's description makes of itself
    the examples      are what the document says, no field more
    what is spoiled   is refused by the schema and by the daemon
    the daemon        answers every method, and sends every stream, as the document says
"""

import json
import re
import socket
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import jsonschema
except ImportError:
    print("SKIPPED: python3-jsonschema is not here")
    sys.exit(0)

TOP, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
PATIENCE = 60


def read(name):
    return json.loads((TOP / "proto" / name).read_text(encoding="utf-8"))


RPC = read("schema/openrpc.json")
EXAMPLES = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted((TOP / "proto/examples").glob("*.json"))}
METHODS = {method["name"]: method for method in RPC["methods"]}


def placed(node, own):
    """With references that hold in one document of all schemas: versions of jsonschema resolve files differently."""
    if isinstance(node, list):
        return [placed(item, own) for item in node]
    if not isinstance(node, dict):
        return node
    node = {key: placed(value, own) for key, value in node.items() if key not in ("$id", "$schema")}
    where = node.get("$ref")
    if isinstance(where, str):
        file, _, place = where.partition("#")
        name = file.partition(".")[0] or own
        node["$ref"] = f"#/$defs/{name}{place.replace('/components/schemas', '') if name == 'openrpc' else place}"
    return node


DEFS = {"openrpc": placed(RPC["components"]["schemas"], "openrpc"),
        **{name: placed(read(f"schema/{name}.schema.json"), name) for name in ("figure", "scene")}}


def closed(node):
    """The same, but no field that it does not name."""
    if isinstance(node, list):
        return [closed(item) for item in node]
    if not isinstance(node, dict):
        return node
    node = {key: closed(value) for key, value in node.items()}
    if "properties" in node and "type" in node:
        node.setdefault("additionalProperties", False)
    return node


def validator(schema):
    return jsonschema.Draft202012Validator({"$defs": DEFS, **placed(schema, "openrpc")})


def params_schema(method):
    params = METHODS[method]["params"]
    return {"type": "object", "additionalProperties": False, "required": [param["name"] for param in params if param["required"]],
            "properties": {param["name"]: param["schema"] for param in params}}


PARAMS = {name: validator(params_schema(name)) for name in METHODS}
RESULTS = {name: validator(closed(method["result"]["schema"])) for name, method in METHODS.items()}
NOTICES = {notice["name"]: validator(closed(notice["params"])) for notice in RPC["x-notices"]}
ERROR = validator(closed({"type": "object", "required": ["code", "message", "data"],
                          "properties": {"code": {"type": "integer", "minimum": -32768, "maximum": -32000},
                                         "message": {"type": "string", "minLength": 1},
                                         "data": RPC["components"]["errors"]["error"]["data"]}}))


def faults(check, value):
    return [f"{error.json_path}: {error.message[:200]}" for error in check.iter_errors(value)]


class Daemon:
    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="posed-openrpc-")
        self.process = subprocess.Popen([BUILD / "bin/posed", "--listen", "127.0.0.1:0", "--data", self.folder.name, "--log", "error",
                                         "--tracker", "simulated"], stdout=subprocess.PIPE, text=True)
        port = int(re.search(r":(\d+)/", self.process.stdout.readline()).group(1))
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self.lines = self.socket.makefile("r", encoding="utf-8")
        self.notices = []

    def ask(self, request):
        self.socket.sendall((json.dumps(request) + "\n").encode())
        while True:
            message = json.loads(self.lines.readline())
            if "method" not in message:
                return message
            self.notices.append(message)

    def call(self, method, **params):
        return self.ask({"jsonrpc": "2.0", "id": 1, "method": method, "params": params})

    def next_notice(self):
        while not self.notices:
            self.notices.append(json.loads(self.lines.readline()))
        return self.notices.pop(0)

    def stop(self):
        self.lines.close()
        self.socket.close()
        self.process.terminate()
        self.process.wait(PATIENCE)
        self.process.stdout.close()
        self.folder.cleanup()


def spoiled(request):
    """(what, params) that no longer are what the method takes."""
    params = request.get("params", {})
    yield "an unknown field", {**params, "surplus": 1}
    for param in METHODS[request["method"]]["params"]:
        name = param["name"]
        if param["required"]:
            yield f"{name} left out", {key: value for key, value in params.items() if key != name}
        if name != "user":
            yield f"another type of {name}", {**params, name: {"surplus": [[]]}}
    for name, value in params.items():
        if isinstance(value, list) and value and isinstance(value[0], (int, float)):
            yield f"a word in {name}", {**params, name: ["x", *value[1:]]}


class OpenRpc(unittest.TestCase):
    maxDiff = 2000

    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()

    def test_it_is_what_the_codec_describes(self):
        made = subprocess.run([BUILD / "bin/openrpc_document"], capture_output=True, text=True, check=True).stdout
        held = (TOP / "proto/schema/openrpc.json").read_text(encoding="utf-8")
        self.assertEqual(held, made, "make it anew: openrpc_document > proto/schema/openrpc.json")

    def test_schemas_are_schemas(self):
        for checks in (PARAMS, RESULTS, NOTICES):
            for check in checks.values():
                check.check_schema(check.schema)

    def test_roles_are_those_of_the_protocol(self):
        text = (TOP / "proto/PROTOCOL.md").read_text(encoding="utf-8")
        table = {method: role for role, methods in re.findall(r"^\| `(none|viewer|editor|operator)` \| (.*) \|$", text, re.M)
                 for method in re.findall(r"`([a-z.]+)`", methods)}
        self.assertEqual({name: method["x-role"] for name, method in METHODS.items()}, table)

    def test_examples(self):
        for name, example in EXAMPLES.items():
            with self.subTest(example=name):
                if "notice" in example:
                    notice = example["notice"]
                    self.assertEqual(faults(NOTICES[notice["method"]], notice["params"]), [])
                    continue
                if name == "error":
                    self.assertEqual(faults(ERROR, example["reply"]["error"]), [])
                    continue
                request = example["request"]
                self.assertEqual(faults(PARAMS[request["method"]], request.get("params", {})), [])
                self.assertEqual(faults(RESULTS[request["method"]], example["reply"]["result"]), [])
        shown = {example["request"]["method"] for example in EXAMPLES.values() if "request" in example}
        self.assertEqual(shown, set(METHODS))
        self.assertEqual({example["notice"]["method"] for example in EXAMPLES.values() if "notice" in example}, set(NOTICES))

    def test_what_is_spoiled_is_refused_by_both(self):
        tried = 0
        for name, example in EXAMPLES.items():
            if "request" not in example or name == "error":
                continue
            request = example["request"]
            for what, params in spoiled(request):
                with self.subTest(example=name, spoiled=what):
                    tried += 1
                    self.assertNotEqual(faults(PARAMS[request["method"]], params), [], "the schema takes it")
                    reply = self.daemon.ask({**request, "id": 1, "params": params})
                    self.assertIn("error", reply, "the daemon takes it")
                    self.assertEqual(faults(ERROR, reply["error"]), [])
        self.assertGreater(tried, 300)

    def test_every_answer_of_the_daemon(self):
        daemon = Daemon()
        try:
            granted = set()
            for request in walk():
                reply = daemon.ask(request)
                with self.subTest(request=json.dumps(request)[:300]):
                    self.assertEqual(faults(PARAMS[request["method"]], request.get("params", {})), [])
                    if "error" in reply:
                        self.assertEqual(faults(ERROR, reply["error"]), [])
                    else:
                        granted.add(request["method"])
                        self.assertEqual(faults(RESULTS[request["method"]], reply["result"]), [], json.dumps(reply)[:500])
            self.assertEqual(granted, set(METHODS), "a method was only ever refused")
            self.follow(daemon)
        finally:
            daemon.stop()

    def follow(self, daemon):
        for stream in ("pose", "tracker", "scene", "stats"):
            self.assertIn("result", daemon.call("stream.subscribe", stream=stream))
        daemon.call("object.set", id="anvil", position=[1, 0, 0])
        seen = set()
        while len(seen) < 5:
            notice = daemon.next_notice()
            self.assertEqual(faults(NOTICES[notice["method"]], notice["params"]), [], json.dumps(notice)[:500])
            data = notice["params"].get("data", {})
            seen.add(notice["params"]["stream"] + ("-patch" if "patch" in data else ""))


def walk():
    """The examples in an order in which each finds what it is about, and is granted."""
    def call(method, **params):
        return {"jsonrpc": "2.0", "id": 1, "method": method, "params": params}

    examples = {name: example["request"] for name, example in EXAMPLES.items() if "request" in example and name != "error"}
    yield examples.pop("session.hello")
    yield call("scene.new", template="standing")
    yield call("figure.set", id="body", template="tempus", stature=1.75)
    last = ["scene.save", "scene.open", "scene.remove", "scene.new", "goal.remove", "binding.remove", "object.remove", "goal.clear", "figure.remove"]
    for name in sorted(examples, key=lambda name: (name.split(".")[1] not in ("set", "pin") if "." in name else True, name)):
        request = examples[name]
        if request["method"] in last:
            continue
        params = request.get("params", {})
        yield {**request, "params": {key: value for key, value in params.items() if key != "if_revision"}}
    yield call("object.set", id="anvil", position=[1, 0, 0])
    yield call("goal.set", id="lift", at="left_hand", position=[0.4, 0.3, 1.2])
    yield call("goal.grab", id="lift")
    yield call("goal.release", id="lift")
    yield call("goal.get", id="lift")
    yield call("object.get", id="anvil")
    yield call("binding.set", id="lead", sensor="simulated:1", to={"goal": "lift"})
    yield call("binding.get", id="lead")
    yield call("joint.set", joint="left_elbow", deviation=1.2, once="0b6f2f4e-7c1d-4a53-9a56-3f1e2d4c5b6b", force=True)
    yield call("pose.get")
    yield call("pose.set", q=[0, 0, 1, 0, 0, 0, 1] + [0, 0, 0, 1] * 17)
    yield call("solve", goals=[{"at": "right_hand", "position": [0.4, -0.3, 1.3]}])
    yield call("solve.batch", problems=[{"goals": [{"at": "right_hand", "position": [0.4, -0.3, 1.3]}]}, {"goals": [{"at": "nowhere"}]}])
    yield call("edit.apply", edits=[{"method": "goal.set", "params": {"id": "g", "at": "head", "position": [0, 0, 1.6]}},
                                    {"method": "goal.clear", "params": {}}], label="anew")
    yield call("edit.undo")
    yield call("edit.redo")
    yield call("edit.undo")
    yield call("edit.history")
    for method in ("goal.list", "object.list", "binding.list", "figure.list", "scene.list", "tracker.list", "session.list"):
        yield call(method)
    at = {"sensor": "simulated:1"}
    yield call("tracker.grab", tracker="simulated")
    yield call("tracker.touch", **at, for_ms=100, point=[1, 0, 0.8])
    yield call("tracker.align", tracker="simulated", name="monday", points=[
        {"source": [0, 0, 0], "world": [0, 0, 1]}, {"source": [1, 0, 0], "world": [1, 0, 1]}, {"source": [0, 1, 0], "world": [0, 1, 1]}])
    yield call("tracker.tip", **at, offset=[0.1, 0, 0])
    yield call("tracker.boresight", **at, for_ms=100)
    yield call("tracker.configure", tracker="simulated", calibration="monday")
    yield call("tracker.list")
    yield call("tracker.reset", tracker="simulated")
    yield call("tracker.forget", tracker="simulated", name="monday")
    yield call("tracker.release", tracker="simulated")
    yield call("stream.subscribe", stream="stats")
    yield call("stream.ack", stream="stats", seq=1)
    yield call("stream.unsubscribe", stream="stats")
    yield call("scene.save", name="monday")
    yield call("scene.open", name="monday")
    yield call("scene.remove", name="monday")
    yield call("binding.remove", id="lead")
    yield call("goal.remove", id="lift")
    yield call("object.remove", id="anvil")
    yield call("goal.clear")
    yield call("camera.remove", id="main")
    yield call("figure.remove", id="body")
    yield call("scene.new", template="paper/sitting")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
