#!/usr/bin/env python3
"""posectl against the real daemon: every example of its help does what it says, and edits are one's own across runs.

    python3 tests/client/cli/posectl_test.py BUILD
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]
BIN = Path(sys.argv[1] if len(sys.argv) > 1 else TOP / "build" / "dev").resolve() / "bin"
os.environ["POSED_BIN"] = str(BIN)
sys.dont_write_bytecode = True
sys.path.insert(0, str(TOP / "tests" / "client" / "python"))
from daemon import Daemon  # noqa: E402


class Posectl(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon()
        cls.folder = tempfile.TemporaryDirectory(prefix="posectl-")
        cls.environment = {**os.environ, "POSED_HOST": cls.daemon.address, "XDG_STATE_HOME": cls.folder.name,
                           "LC_ALL": "C.UTF-8", "PATH": f"{BIN}:{os.environ['PATH']}"}

    @classmethod
    def tearDownClass(cls):
        cls.daemon.close()
        cls.folder.cleanup()

    def shell(self, line, **more):
        return subprocess.run(["bash", "-c", "set -o pipefail; " + line], text=True, capture_output=True, check=False,
                              cwd=self.folder.name, env={**self.environment, **more})

    def posectl(self, *words, **more):
        done = subprocess.run([BIN / "posectl", *words], text=True, capture_output=True, check=False,
                              env={**self.environment, **more})
        self.assertEqual(done.returncode, 0, f"{words}: {done.stderr}")
        return done.stdout

    def ask(self, *words):
        return json.loads(self.posectl("--json", *words))

    def setUp(self):
        for line in ("scene new standing", "goal set right_hand 0.5 -0.3 1.2", "object set chair 0.6 0 0.45",
                     "binding set simulated:1 --goal body.right_hand.position --id hand", "camera set main 2 0 1.5",
                     "scene save monday", "tracker tip simulated:1 --offset 0.15 0 0 --name monday",
                     "tracker configure simulated --calibration none"):
            self.posectl(*line.split())

    def commands(self, *path):
        """All commands that can be given, with the examples in their help."""
        text = self.posectl("help", *path)
        _, _, listed = text.partition("Subcommands:\n")
        subs = [line.split()[0] for line in listed.split("\n\n")[0].splitlines() if line.startswith("  ") and line[2] != " "]
        _, _, examples = text.partition("Example:\n")
        if path and (examples or not subs):
            yield path, [line.strip() for line in examples.splitlines() if line.strip()]
        for sub in subs:
            yield from self.commands(*path, sub)

    def test_every_command_has_examples_and_they_work(self):
        commands = list(self.commands())
        self.assertGreater(len(commands), 40, commands)
        for path, examples in commands:
            self.assertTrue(examples, f"{path} has no example")
            if path in (("tracker", "align"), ("doctor",)):
                continue  # a hand that touches has tests/integration/trackers_page.py, a machine without fault nobody
            for line in examples:
                self.setUp()
                if path == ("redo",):
                    self.posectl("undo")
                with self.subTest(line=line):
                    done = self.shell(line)
                    self.assertEqual((done.returncode, done.stderr if path not in (("token",), ("tracker", "check")) else ""), (0, ""), line)
                    # As JSON, too, where there is an answer.
                    if path[0] not in ("view", "completion", "help", "token", "watch", "doctor"):
                        self.setUp()
                        if path == ("redo",):
                            self.posectl("undo")
                        self.assertEqual(self.shell(line.replace("posectl ", "posectl --json ", 1)).returncode, 0, line)

    def test_undo_takes_back_what_an_earlier_run_did(self):
        self.posectl("goal", "set", "left_hand", "0.4", "0.3", "1.2", "--id", "mine")
        self.assertIn("undone", self.posectl("undo"))
        self.assertNotIn("mine", [goal["id"] for goal in self.ask("goal", "list")["goals"]])
        self.posectl("redo")
        self.assertIn("mine", [goal["id"] for goal in self.ask("goal", "list")["goals"]])
        self.assertIn("(yours)", self.posectl("history"))
        # Another's are not ours.
        other = subprocess.run([BIN / "posectl", "--user", "bob", "undo"], text=True, capture_output=True, check=False,
                               env=self.environment)
        self.assertEqual(other.returncode, 1)
        self.assertIn("undo", other.stderr)

    def test_edits_are_all_or_nothing(self):
        edits = [{"method": "goal.set", "params": {"id": "a", "at": "head", "position": [0, 0, 1.7]}},
                 {"method": "goal.remove", "params": {"id": "nobody"}}]
        file = Path(self.folder.name) / "edits.json"
        file.write_text(json.dumps(edits))
        refused = self.shell(f"posectl edit apply {file}")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("/params/edits/1", refused.stderr)
        file.write_text(json.dumps(edits[:1]))
        self.assertIn("1 edits are done", self.posectl("edit", "apply", str(file), "--label", 'a "head"'))
        self.assertEqual(self.ask("history", "--limit", "1")["steps"][0]["label"], 'a "head"')
        file.write_text(json.dumps({"edits": edits[:1]}))
        self.posectl("edit", "apply", str(file))
        self.assertEqual(self.shell("posectl edit apply nowhere.json").returncode, 2)

    def test_joints_pins_objects_and_bindings(self):
        self.posectl("goal", "clear")
        self.posectl("joint", "set", "left_elbow", "--deviation", "70", "--degrees")
        self.assertIn("deviation 70", self.posectl("joint", "get", "left_elbow", "--degrees"))
        self.posectl("figure", "pin", "left_foot", "none")
        self.assertNotIn("left_foot  by left_ankle to left_lower_leg  pinned", self.posectl("figure", "get", "body"))
        self.posectl("figure", "pin", "left_hand", "position")
        self.assertEqual(self.ask("figure", "get", "body")["pins"]["left_hand"]["hold"], "position")
        self.posectl("object", "set", "desk", "1", "0", "0.7", "--quat", "0", "0", "1", "0", "--box", "0.3", "0.6", "0.02")
        desk = self.ask("object", "get", "desk")
        self.assertEqual((desk["position"], desk["quat_xyzw"], desk["shape"][0]["half_size"]), ([1, 0, 0.7], [0, 0, 1, 0], [0.3, 0.6, 0.02]))
        self.posectl("binding", "set", "simulated:2", "--object", "desk", "--axes", "x", "y", "--mode", "relative", "--id", "b")
        self.assertIn("b  simulated:2 moves object desk x y  relative", self.posectl("binding", "list"))
        self.assertEqual(self.posectl("session", "list").count("posectl 0.1.0"), 1)
        document = Path(self.folder.name) / "figure.json"
        document.write_text(json.dumps(self.ask("figure", "get", "body")["document"]))
        self.posectl("figure", "set", "twin", "--document", str(document))
        self.assertIn("twin  a figure of its own  18 segments", self.posectl("figure", "list"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=1)
