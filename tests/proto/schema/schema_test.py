#!/usr/bin/env python3
"""The schemas of proto/schema and the daemon agree about documents.

    schema_test.py TOP DOCUMENT_CHECK
"""

import copy
import json
import subprocess
import sys
import unittest
from pathlib import Path

try:
    import jsonschema
except ImportError:
    print("SKIPPED: python3-jsonschema is not here")
    sys.exit(0)

TOP, CHECK = Path(sys.argv[1]), sys.argv[2]
NONE = object()


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


SCHEMAS = {name: read(TOP / f"proto/schema/{name}.schema.json") for name in ("figure", "scene")}


def bundled(node, inside=""):
    """The scene's schema with the figure's as one of its $defs: versions of jsonschema resolve files differently."""
    if isinstance(node, list):
        return [bundled(item, inside) for item in node]
    if not isinstance(node, dict):
        return node
    node = {key: bundled(value, inside) for key, value in node.items() if not (inside and key == "$id")}
    ref = node.get("$ref")
    if isinstance(ref, str):
        node["$ref"] = (ref.replace("figure.schema.json#", "#/$defs/figure_document")
                        .replace("figure.schema.json", "#/$defs/figure_document") if not inside
                        else ref.replace("#", inside))
    return node


BUNDLE = bundled(SCHEMAS["scene"])
BUNDLE["$defs"]["figure_document"] = bundled(SCHEMAS["figure"], "#/$defs/figure_document")
VALIDATORS = {
    "figure": jsonschema.Draft202012Validator(SCHEMAS["figure"]),
    "scene": jsonschema.Draft202012Validator(BUNDLE),
}


def ask(*lines):
    answer = subprocess.run([CHECK], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True)
    return answer.stdout.splitlines()


def daemon(kind, document):
    return ask(f"{kind} {json.dumps(document)}")[0]


def schema(kind, document):
    return [f"{error.json_path}: {error.message[:200]}" for error in VALIDATORS[kind].iter_errors(document)]


def changed(document, path, value):
    """A copy with the value at the path, a JSON pointer; NONE: without it."""
    document = copy.deepcopy(document)
    *parents, last = path.strip("/").split("/")
    place = document
    for part in parents:
        place = place[int(part) if isinstance(place, list) else part]
    if isinstance(place, list):
        last = int(last)
    if value is NONE:
        del place[last]
    else:
        place[last] = value
    return document


TEMPUS = json.loads(ask("tempus 1.75")[0])
HINGED = {
    "format": "posed.figure/1", "root": "base",
    "segments": [
        {"name": "base", "joint": {"name": "j0", "type": "fixed", "position": [0, 0, 0]}, "touch_point": [0, 0, 1]},
        {"name": "door", "parent": "base", "touch_point": [1, 0, 0],
         "joint": {"name": "j1", "type": "hinge", "position": [0, 0, 1], "axes": [[0, 0, 1]], "limits": [[0, 1.5]]},
         "shape": [{"kind": "capsule", "from": [0, 0, 0], "to": [1, 0, 0], "radius": 0.1},
                   {"kind": "box", "center": [0, 0, 0], "half_size": [1, 1, 0]}]},
        {"name": "drawer", "parent": "base", "touch_point": [0, 1, 0], "mass": 0,
         "joint": {"name": "j2", "type": "prismatic", "position": [0, 0, 1], "quat_xyzw": [0, 0, 0, 1],
                   "axes": [[0, 1, 0]], "limits": [None], "bend_axis": [0, 0, 0]}}],
    "sites": {"knob": {"segment": "door", "point": [0.9, 0, 0]}, "door/edge": {"segment": "door", "point": [1, 0, 0]}},
    "mirror": [["door", "drawer"]], "aliases": {"flap": "door"}, "lever": 0.5,
}
BALLS = {
    "format": "posed.figure/1", "root": "a",
    "segments": [
        {"name": "a", "touch_point": [0, 0, 1],
         "joint": {"name": "j", "type": "ball", "position": [0, 0, 0], "twist": [-1, 0.5], "limits": [],
                   "swing": {"ellipse": [0.8, 3.1], "center": [0, 0, 1]}}},
        {"name": "b", "parent": "a", "touch_point": [0, 0, 1],
         "joint": {"name": "k", "type": "ball", "position": [0, 0, 1],
                   "swing": {"polygon": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}}}],
}
SCENE = {
    "format": "posed.scene/1",
    "figures": {"body": {"template": "tempus", "stature": 1.6, "label": "Ana", "user": {"a": [1]},
                         "pins": {"left_foot": {"hold": "pose", "position": [0, 0.1, 0], "quat_xyzw": [0, 0, 0, 1]},
                                  "head": {"hold": "orientation"}}},
                "cabinet": {"document": HINGED, "q": [0.5, 0.1]}},
    "goals": {
        "g1": {"figure": "body", "at": "right_hand/fingertip", "position": [0.5, -0.3, 1.2], "kind": "position",
               "relative_to": "world", "weight": 0, "priority": 0, "tolerance": 0.01, "enabled": False, "user": None},
        "g2": {"figure": "cabinet", "at": {"segment": "door", "point": [1, 0, 0]}, "position": [1, 0, 1]},
        "g3": {"figure": "cabinet", "at": "/knob", "position": [1, 0, 1]},
        "turn": {"figure": "body", "at": "head", "orientation": {"quat_xyzw": [0, 0, 0, 1]}, "priority": -100},
        "hold": {"figure": "body", "at": "head", "kind": "pose", "position": [0, 0, 1],
                 "orientation": {"quat_xyzw": [0, 0, 1, 0]}, "weight": {"position": 1, "orientation": 0},
                 "relative_to": {"figure": "cabinet", "segment": "door"}},
        "look": {"figure": "body", "at": "head/eyes", "aim": {"axis": [2, 0, 0], "point": [1, 1, 1]},
                 "relative_to": {"sensor": "liberty:2"}},
        "face": {"figure": "body", "at": "head", "aim": {"axis": [2, 0, 0], "direction": [0, 1, 0]},
                 "relative_to": {"segment": "neck"}},
        "seat": {"figure": "body", "at": "lower_torso", "position": [0, 0, 0.1], "relative_to": {"object": "chair"}},
        "table": {"figure": "body", "at": "left_hand", "plane": {"point": [0, 0, 1], "normal": [0, 0, 3], "side": "above"}},
        "rail": {"figure": "body", "at": "left_hand", "line": {"point": [0, 0, 1], "direction": [0, 1, 0]}},
        "apart": {"figure": "body", "at": "left_hand", "distance": {"to": "head", "length": 0.3, "compare": "at_least"}},
        "stand": {"figure": "body", "balance": {"support": ["left_foot", {"segment": "head", "point": [0, 0, 0]}], "margin": 0.1}},
        "calm": {"figure": "body", "posture": {"pose": "start"}},
        "bend": {"figure": "body", "posture": {"joints": {"left_elbow": {"deviation": 1}, "waist": [0, 0, 0, 1]}}},
        "shut": {"figure": "cabinet", "posture": {"joints": {"j1": 0.2, "j2": [0.1]}}}},
    "objects": {"chair": {"position": [1, 0, 0.5], "quat_xyzw": [0, 0, 0, 1], "label": "blue", "user": {"a": 1},
                          "shape": [{"kind": "box", "center": [0, 0, 0], "half_size": [0.2, 0.2, 0.02]}]},
                "table": {"position": [0, 0, 0]}},
    "cameras": {"main": {"position": [2, 0, 1.5], "quat_xyzw": [0, 0, 1, 0], "fov_y": 0.9, "label": "door", "user": [1]},
                "eyes": {"position": [0.1, 0, 0], "relative_to": {"segment": "head", "figure": "body"}},
                "wand": {"position": [0, 0, 0], "relative_to": {"sensor": "liberty:1"}},
                "seat": {"position": [0, 0, 1], "relative_to": {"object": "chair"}}},
    "bindings": {"b1": {"sensor": "simulated:1", "to": {"goal": "g1"}, "axes": ["x", "z"], "mode": "relative",
                        "scale": -2, "label": ""},
                 "b2": {"sensor": "simulated:2", "to": {"object": "table"}, "axes": ["x", "rx"],
                        "clutch": {"button": 0}, "offset": {"position": [0, 0, 0.1]}},
                 "b3": {"sensor": "simulated:2", "to": {"camera": "main"},
                        "filter": {"one_euro": {"min_cutoff_hz": 1, "beta": 3, "d_cutoff_hz": 1}, "predict_ms": 20}},
                 "b4": {"sensor": "simulated:3", "to": {"joint": "neck", "figure": "body"}, "axes": ["rz"]}},
}

DOOR = "/segments/1"
BROKEN_FIGURES = [  # a path of HINGED and the value that breaks it
    ("/format", "posed.figure/2"), ("/format", NONE), ("/root", NONE), ("/root", 7), ("/segments", []),
    ("/segments", NONE), ("/surplus", 1), ("/lever", 0), ("/lever", "0.25"), ("/segments/0/parent", "door"),
    (DOOR + "/parent", NONE), (DOOR + "/parent", ""), (DOOR + "/name", "a b"), (DOOR + "/name", "x" * 65),
    (DOOR + "/surplus", 1), (DOOR + "/mass", -1), (DOOR + "/touch_point", NONE), (DOOR + "/touch_point", [0, 0]),
    (DOOR + "/touch_point", [0, 0, 1e5]), (DOOR + "/joint", NONE), (DOOR + "/joint/name", NONE),
    (DOOR + "/joint/type", "free"), (DOOR + "/joint/type", "knot"), (DOOR + "/joint/type", "universal"),
    (DOOR + "/joint/type", "ball"), (DOOR + "/joint/position", NONE), (DOOR + "/joint/quat_xyzw", [0, 0, 0]),
    (DOOR + "/joint/quat_xyzw", [0, 0, 0, 2]), (DOOR + "/joint/axes", NONE), (DOOR + "/joint/axes", [[0, 0, 2]]),
    (DOOR + "/joint/axes", [[0, 0, 1], [0, 1, 0]]), (DOOR + "/joint/limits", [[0, 1], [0, 1]]),
    (DOOR + "/joint/limits", [[0]]), (DOOR + "/joint/limits", [0]), (DOOR + "/joint/bend_axis", [0, 0, 3]),
    (DOOR + "/joint/surplus", 1), (DOOR + "/shape", {}), (DOOR + "/shape/0/radius", NONE),
    (DOOR + "/shape/0/radius", -0.1), (DOOR + "/shape/0/kind", "box"), (DOOR + "/shape/0/kind", "cone"),
    (DOOR + "/shape/1/half_size", [1, -1, 1]), (DOOR + "/shape/1/surplus", 1), ("/sites/knob/segment", NONE),
    ("/sites/knob/point", [0, 0]), ("/sites/knob/surplus", 1), ("/sites/a b", {"segment": "door", "point": [0, 0, 0]}),
    ("/sites/a~b~c", {"segment": "door", "point": [0, 0, 0]}), ("/mirror/0", ["door"]), ("/mirror/0", ["door", "door"]),
    ("/aliases/a b", "door"), ("/aliases/flap", 7),
    (DOOR + "/joint/swing", {"ellipse": [1, 1]}), (DOOR + "/joint/twist", [0, 1]),
]
BROKEN_BALLS = [  # a path of BALLS
    ("/segments/0/joint/swing", {}), ("/segments/0/joint/swing/ellipse", [1]), ("/segments/0/joint/swing/ellipse", [0, 1]),
    ("/segments/0/joint/swing/ellipse", [1, 4]), ("/segments/0/joint/swing/center", [0, 0, 2]),
    ("/segments/0/joint/swing/polygon", [[1, 0, 0], [0, 1, 0], [0, 0, 1]]), ("/segments/0/joint/twist", [0]),
    ("/segments/0/joint/twist", [-4, 0]), ("/segments/0/joint/type", "fixed"), ("/segments/0/joint/limits", [None] * 3),
    ("/segments/1/joint/swing/polygon", [[1, 0, 0], [0, 1, 0]]), ("/segments/1/joint/swing/polygon/0", [2, 0, 0]),
    ("/segments/1/joint/swing/center", [0, 0, 1]),
]
BROKEN_SCENES = [  # a path of SCENE
    ("/format", "posed.scene/2"), ("/format", NONE), ("/figures", NONE), ("/goals", NONE), ("/bindings", NONE),
    ("/figures", []), ("/surplus", 1), ("/objects", []), ("/objects/chair/position", NONE),
    ("/objects/chair/position", [0, 0]), ("/objects/chair/quat_xyzw", [0, 0, 0]), ("/objects/chair/surplus", 1),
    ("/objects/chair/shape", [{"kind": "ball"}]), ("/objects/chair/shape/0/half_size", [0.2, -0.2, 0.02]),
    ("/objects/table/position", [0, 0, 2e6]), ("/goals/seat/relative_to", {"object": "a b"}),
    ("/bindings/b2/to", {"object": "table", "goal": "g1"}), ("/bindings/b2/to", {}), ("/cameras", {"main": {}}),
    ("/cameras/main/position", [0, 0]), ("/cameras/main/quat_xyzw", [0, 0, 0, 2]), ("/cameras/main/fov_y", 0),
    ("/cameras/main/fov_y", 4), ("/cameras/main/surplus", 1), ("/cameras/eyes/relative_to", "moon"),
    ("/cameras/wand/relative_to/sensor", "liberty"), ("/cameras/a b", {"position": [0, 0, 0]}),
    ("/bindings/b2/clutch", {}), ("/bindings/b2/clutch/button", 32), ("/bindings/b2/offset/position", [0, 0, 101]),
    ("/bindings/b2/offset/surplus", 1), ("/bindings/b3/filter/predict_ms", 101), ("/bindings/b3/filter/surplus", 1),
    ("/bindings/b3/filter/one_euro/beta", -1), ("/bindings/b3/filter/one_euro/min_cutoff_hz", 0),
    ("/bindings/b4/axes", ["x"]), ("/bindings/b4/to", {"figure": "body"}), ("/bindings/b4/to/goal", "g1"),
    ("/figures/a b", {"template": "tempus"}), ("/figures/body/template", "robot"), ("/figures/body/template", NONE),
    ("/figures/body/stature", 3), ("/figures/body/surplus", 1), ("/figures/body/document", HINGED),
    ("/figures/cabinet/q", ["0.5", 0.1]), ("/figures/cabinet/q", [1e7, 0]),
    ("/figures/cabinet/document/segments/1/joint/type", "free"), ("/figures/body/label", "x" * 4097),
    ("/goals/g1/figure", NONE), ("/goals/g1/at", NONE), ("/goals/g1/at", ""), ("/goals/g1/at", 7),
    ("/goals/g2/at/point", NONE), ("/goals/g2/at/surplus", 1), ("/goals/g2/at/point", [0, 0, 1e5]),
    ("/goals/g1/position", [0, 0]), ("/goals/g1/position", [0, 0, 2e6]), ("/goals/g1/weight", -1),
    ("/goals/g1/weight", 2e9), ("/goals/g1/tolerance", -1), ("/goals/g1/tolerance", [0.1, 0.1]),
    ("/goals/g1/priority", 101), ("/goals/g1/priority", 0.5),
    ("/goals/g1/kind", "aim"), ("/goals/g1/aim", {"axis": [1, 0, 0], "point": [0, 0, 0]}), ("/goals/g1/position", NONE),
    ("/goals/g1/weight", {"position": 1, "orientation": 1}), ("/goals/hold/weight", {"position": 1}),
    ("/goals/hold/weight/orientation", -1), ("/goals/hold/kind", "position"), ("/goals/hold/relative_to/segment", NONE),
    ("/goals/hold/relative_to/object", "chair"), ("/goals/hold/relative_to/sensor", "liberty:1"),
    ("/goals/look/relative_to/sensor", "liberty"), ("/goals/turn/orientation", {}),
    ("/goals/turn/orientation/quat_xyzw", [0, 0, 0, 2]), ("/goals/look/aim/axis", [0, 0, 0]),
    ("/goals/look/aim/point", NONE), ("/goals/look/aim/direction", [1, 0, 0]), ("/goals/look/at", NONE),
    ("/goals/table/plane/normal", NONE), ("/goals/table/plane/side", "below"), ("/goals/rail/line/direction", [0, 0, 0]),
    ("/goals/apart/distance/length", -1), ("/goals/apart/distance/to", NONE), ("/goals/apart/distance/compare", "less"),
    ("/goals/apart/relative_to", {"segment": "head"}), ("/goals/stand/balance/support", []), ("/goals/stand/at", "head"),
    ("/goals/stand/balance/margin", -1), ("/goals/calm/posture", {}), ("/goals/calm/posture/pose", "sitting"),
    ("/goals/calm/posture/joints", {"j1": 1}), ("/goals/bend/posture/joints/left_elbow", {"deviation": 4}),
    ("/goals/bend/posture/joints/left_elbow", {"bend": 1}), ("/goals/bend/posture/joints/left_elbow", "up"),
    ("/figures/body/pins/head/hold", "all"), ("/figures/body/pins/head/hold", NONE),
    ("/figures/body/pins/head/position", [0, 0, 1e7]), ("/figures/body/pins/head/surplus", 1),
    ("/goals/g1/relative_to", "moon"), ("/goals/g1/enabled", 1), ("/goals/g1/surplus", 1),
    ("/goals/-g", {"figure": "body", "at": "head", "position": [0, 0, 0]}), ("/bindings/b1/sensor", NONE),
    ("/bindings/b1/sensor", "simulated"), ("/bindings/b1/sensor", "simulated:0"),
    ("/bindings/b1/sensor", "simulated:257"), ("/bindings/b1/sensor", "a b:1"), ("/bindings/b1/to", NONE),
    ("/bindings/b1/to/surplus", 1), ("/bindings/b1/axes", []),
    ("/bindings/b1/axes", "x"), ("/bindings/b1/mode", "both"), ("/bindings/b1/scale", 1001),
    ("/bindings/b1/clutch", 0), ("/bindings/b1/surplus", 1),
]


class Schemas(unittest.TestCase):
    def assert_good(self, kind, document):
        self.assertEqual(schema(kind, document), [])
        self.assertEqual(daemon(kind, document), "ok")

    def assert_broken(self, kind, good, cases):
        for path, value in cases:
            document = changed(good, path, value)
            with self.subTest(path=path, value=None if value is NONE else value):
                self.assertNotEqual(schema(kind, document), [], "the schema takes it")
                self.assertNotEqual(daemon(kind, document), "ok", "the daemon takes it")

    def test_are_schemas(self):
        for kind in SCHEMAS:
            jsonschema.Draft202012Validator.check_schema(SCHEMAS[kind])

    def test_good_figures(self):
        self.assert_good("figure", TEMPUS)
        self.assert_good("figure", HINGED)
        self.assert_good("figure", BALLS)

    def test_good_scenes(self):
        self.assert_good("scene", SCENE)
        templates = sorted((TOP / "server/scene/templates").rglob("*.json"))
        self.assertGreaterEqual(len(templates), 10)
        for template in templates:
            with self.subTest(template=template.name):
                self.assert_good("scene", read(template))

    def test_examples(self):
        examples = TOP / "proto/examples"
        self.assert_good("figure", read(examples / "figure.get.json")["reply"]["result"]["document"])
        self.assert_good("scene", read(examples / "scene.get.json")["reply"]["result"]["document"])
        self.assert_good("scene", read(examples / "stream.frame.scene.json")["notice"]["params"]["data"]["document"])

    def test_broken_figures(self):
        self.assert_broken("figure", HINGED, BROKEN_FIGURES)
        self.assert_broken("figure", BALLS, BROKEN_BALLS)

    def test_broken_scenes(self):
        self.assert_broken("scene", SCENE, BROKEN_SCENES)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
