#!/usr/bin/env python3
"""The whole line, from a tracker's bytes to what people see:
emulated LIBERTY bytes -> libusb -> decoder -> binding -> solver -> wire -> posectl watch, and a page in Chromium.

  liberty_end_to_end.py BUILD_DIR          checks what posectl watch prints
  liberty_end_to_end.py BUILD_DIR --page   and what the viewer in headless Chromium has

The last line says "N passed, N failed"; what can't run here says SKIPPED and exits with 77.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
INCH = 0.0254
# Where station 1 is put, in inches of the source's frame (X forward, Y right, Z down), one after the other.
PLACES = [(17.0, 10.0, -47.0), (14.0, 8.0, -44.0), (16.0, 14.0, -52.0)]
PATIENCE = 120


def world(place):
    x, y, z = place
    return [x * INCH, -y * INCH, -z * INCH]


class Bench:
    """posed under umockdev with the emulated device, and posectl beside it."""

    def __init__(self, build, folder):
        self.bin = os.path.join(build, "bin")
        # umockdev has itself loaded before AddressSanitizer, and locks in ways that ThreadSanitizer does not see into.
        tsan = os.environ.get("TSAN_OPTIONS", "") + f" suppressions={ROOT}/tests/support/usb_tsan.supp"
        environment = dict(os.environ, ASAN_OPTIONS="verify_asan_link_order=0", TSAN_OPTIONS=tsan)
        self.run = subprocess.Popen(
            ["umockdev-wrapper", f"{self.bin}/usb_emulated_run", "--stations", "2", "--", f"{self.bin}/posed",
             "--tracker", "liberty", "--listen", "127.0.0.1:0", "--data", folder,
             "--viewer.path", os.environ.get("POSED_VIEWER", f"{build}/share/posed/viewer")],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
        line = self.run.stdout.readline()
        found = re.search(r"http://127\.0\.0\.1:(\d+)/", line)
        if not found:
            raise RuntimeError(f"posed did not start: {line}{self.run.stderr.read()}")
        self.port = found.group(1)

    def act(self, line):
        self.run.stdin.write(line + "\n")
        self.run.stdin.flush()

    def posectl(self, *words):
        done = subprocess.run([f"{self.bin}/posectl", "--host", f"tcp://127.0.0.1:{self.port}", "--json", *words],
                              capture_output=True, text=True, timeout=PATIENCE, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"posectl {' '.join(words)}: {done.stderr}")
        return done.stdout

    def watch(self, until):
        """Reads poses from posectl watch until one suits; that one."""
        with subprocess.Popen([f"{self.bin}/posectl", "--host", f"tcp://127.0.0.1:{self.port}", "--json", "watch", "pose",
                               "--count", "20000"], stdout=subprocess.PIPE, text=True) as watch:
            try:
                for line in watch.stdout:
                    data = json.loads(line)
                    if until(data):
                        return data
                raise RuntimeError("posectl watch ended before the pose came")
            finally:
                watch.kill()

    def stop(self):
        self.act("quit")
        _, err = self.run.communicate(timeout=PATIENCE)
        return self.run.returncode, err


def goal_of(data):
    return next((g for f in data["figures"] for g in f.get("goals", []) if g["id"] == "hand"), None)


class Followed:
    """The pose in which the hand is where the sensor is; after so many frames any."""

    def __init__(self, wanted):
        self.wanted, self.frames_left = wanted, 100

    def __call__(self, data):
        goal = goal_of(data)
        if not goal or not near(goal["target"], self.wanted, 2e-6):
            return False
        self.frames_left -= 1
        return goal["state"] == "reached" or self.frames_left < 0


def near(a, b, tolerance):
    return all(abs(x - y) <= tolerance for x, y in zip(a, b))


def main():
    build = os.path.abspath(sys.argv[1])
    page = "--page" in sys.argv[2:]
    for program in ["umockdev-wrapper"] + (["node", "chromium"] if page else []):
        if not shutil.which(program):
            print(f"SKIPPED: {program} is not installed")
            return 77
    if not os.path.exists(f"{build}/bin/usb_emulated_run"):
        print("SKIPPED: the emulated USB bus was not built (umockdev's development package is missing)")
        return 77
    passed = failed = 0

    def check(name, good, told=""):
        nonlocal passed, failed
        passed, failed = passed + bool(good), failed + (not good)
        print(f"{'ok   ' if good else 'FAIL '} {name} {told if not good else ''}", flush=True)

    with tempfile.TemporaryDirectory(prefix="posed-e2e-") as folder:
        bench = Bench(build, folder)
        bench.act("pose 1 %g %g %g" % PLACES[0])
        bench.posectl("call", "goal.set", json.dumps({"id": "hand", "at": "right_hand", "position": [0.4, -0.3, 1.1]}))
        bench.posectl("call", "binding.set", json.dumps({"sensor": "liberty:1", "to": {"goal": "hand"}}))
        for place in PLACES:
            bench.act("pose 1 %g %g %g" % place)
            wanted = world(place)
            # A jump of the sensor takes the joints some frames, since a stream bounds how fast they turn.
            data = bench.watch(Followed(wanted))
            goal, figure = goal_of(data), data["figures"][0]
            check(f"the goal is where the sensor is: {wanted}", near(goal["target"], wanted, 2e-6), goal)
            check("the hand has followed it", goal["state"] == "reached" and near(goal["touch"], wanted, 1e-3), goal)
            hand = figure["world_from_segment"][segment_index(bench, "right_hand")]
            check("the hand's segment is at its touch point", abs(distance(hand[:3], wanted) - 0.0945) < 1e-3, hand)
        tracker = json.loads(bench.posectl("call", "tracker.list"))["trackers"][0]
        check("the tracker streams", tracker["state"] == "streaming" and tracker["sensors"] == ["liberty:1", "liberty:2"], tracker)
        if page:
            shot = os.environ.get("POSED_SHOT", os.path.join(folder, "liberty.png"))
            environment = dict(os.environ, POSED_URL=f"http://127.0.0.1:{bench.port}/", POSED_WANTED=json.dumps(wanted), POSED_SHOT=shot)
            code = subprocess.run(["node", "e2e/liberty.mjs"], cwd=f"{ROOT}/client/web", env=environment, check=False).returncode
            check("the page in Chromium has the same pose", code == 0)
        code, err = bench.stop()
        check("posed stopped cleanly", code == 0, err)
        check("the device was told to stop streaming", "streaming=0 claims=1" in err, err)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


def segment_index(bench, name):
    document = json.loads(bench.posectl("call", "figure.get", '{"id":"body"}'))["document"]
    return next(i for i, s in enumerate(document["segments"]) if s["name"] == name)


sys.exit(main())
