#!/usr/bin/env python3
"""The walk of deploy/doc/trackers.md, each command of it, against the real daemon with an emulated FASTRAK on a pty.

  trackers_page.py BUILD_DIR

Lines that begin with "    $ posectl" are run, in their order; comments "<!-- hand: ACT -->" say what the hand that holds the
sensors does before. What must come of it is checked here. The last line says "N passed, N failed".
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import threading
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(ROOT, "deploy", "doc", "trackers.md")
PATIENCE = 120
TIP = (0.12, -0.005, 0.01)  # as the page's hand has it, in posed's axes: the source's Y and Z point the other way
# Where the source stands: turned about Z, and moved.
TURN, PLACE = math.radians(10), (-0.6, -0.1, 0.7)


def source_from_world(p):
    d = [a - b for a, b in zip(p, PLACE)]
    c, s = math.cos(TURN), math.sin(TURN)
    return (c * d[0] + s * d[1], -s * d[0] + c * d[1], d[2])


class Bench:
    def __init__(self, build, folder):
        self.bin = os.path.join(build, "bin")
        self.run = subprocess.Popen(
            [f"{self.bin}/serial_emulated_run", "fastrak", f"{self.bin}/posed", "--tracker", "fastrak:{PORT}@115200",
             "--listen", "127.0.0.1:0", "--data", folder, "--viewer.path", folder],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.run.stdout.readline()
        found = re.search(r"http://127\.0\.0\.1:(\d+)/", line)
        if not found:
            raise RuntimeError(f"posed did not start: {line}{self.run.stderr.read()}")
        self.log = []
        self.reader = threading.Thread(target=lambda: self.log.extend(self.run.stderr), daemon=True)
        self.reader.start()
        self.environment = dict(os.environ, POSED_HOST=f"tcp://127.0.0.1:{found.group(1)}",
                                PATH=self.bin + os.pathsep + os.environ["PATH"])
        self.calibrated = False

    def act(self, line):
        self.run.stdin.write(line + "\n")
        self.run.stdin.flush()

    def ask(self, *words):
        done = subprocess.run(["posectl", "--json", *words], env=self.environment, capture_output=True, text=True,
                              timeout=PATIENCE, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"posectl {' '.join(words)}: {done.stderr}")
        return [json.loads(line) for line in done.stdout.splitlines()]

    def wait_for(self, stream, fits):
        """Until a frame of the stream fits."""
        with subprocess.Popen(["posectl", "--json", "watch", stream], env=self.environment, stdout=subprocess.PIPE,
                              text=True) as watch:
            alarm = threading.Timer(PATIENCE, watch.kill)
            alarm.start()
            last = ""
            try:
                for last in watch.stdout:
                    if fits(json.loads(last)):
                        return
                raise RuntimeError(f"{stream} never came to what was waited for; at last it was {last}")
            finally:
                alarm.cancel()
                watch.kill()

    def wait_for_sensors(self, fits):
        self.wait_for("tracker", lambda frame: any(fits(sensor) for sensor in frame["sensors"]))

    def hold_at(self, point):
        """The tip of station 1 on a point of the world."""
        source = source_from_world(point)
        x, y, z = (a - b for a, b in zip(source, TIP))
        self.act(f"pose 1 {x} {-y} {-z}")
        seen = point if self.calibrated else source
        self.wait_for_sensors(lambda s: s["sensor"] == "fastrak:1" and math.dist(s["position"], seen) < 5e-4)

    def align(self, command):
        """Runs it, and touches each point that it asks for."""
        run = subprocess.Popen(["bash", "-c", command], env=self.environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
        said = []
        for line in run.stderr:
            said.append(line)
            asked = re.match(r"Touch \[(\S+) (\S+) (\S+)\] with .* press Enter", line)
            if not asked:
                continue
            self.hold_at([float(v) for v in asked.groups()])
            run.stdin.write("\n")
            run.stdin.flush()
        out = run.stdout.read()
        return run.wait(PATIENCE), out, "".join(said)

    def shell(self, command):
        done = subprocess.run(["bash", "-c", command], env=self.environment, capture_output=True, text=True, timeout=PATIENCE,
                              check=False, stdin=subprocess.DEVNULL)
        return done.returncode, done.stdout, done.stderr

    def stop(self):
        subprocess.run(["kill", str(self.run.pid)], check=False)
        self.run.stdin.close()
        code = self.run.wait(PATIENCE)
        self.reader.join(PATIENCE)
        return code, "".join(self.log)


def steps():
    with open(PAGE, encoding="utf-8") as page:
        for line in page:
            if hand := re.match(r"<!-- hand: (.*) -->", line):
                yield "hand", hand.group(1)
            elif command := re.match(r"    \$ (posectl .*)", line):
                yield "command", command.group(1)


def millimetres(out):
    return [float(v) for v in re.findall(r"([\d.]+) mm off", out)]


def check(command, out, bench):
    """What must come of a command besides that it was done."""
    if command == "posectl tracker":
        assert "fastrak  streaming" in out and "fastrak:1" in out, out
    if "watch tracker" in command:
        assert out.count("\n") == 3 and "fastrak:2" in out, out
    if "watch pose" in command:
        # Brought back, the goal is where the sensor left it when it was let go.
        bench.wait_for("pose", lambda d: any(g["id"] == "reach" and math.dist(g["target"], (0.9, -0.2, 0.3)) < 1e-3
                                             for g in d["figures"][0]["goals"]))
    if "scene list" in command:
        for _ in range(100):  # the store has a thread of its own
            out = bench.shell(command)[1]
            if "fastrak.1-" in out:
                break
            time.sleep(0.1)
        assert re.search(r"fastrak\.1-\d{8}T\d{6}\.\d{3}Z", out), out
    if "watch camera" in command:
        # Twice the way of the hand, which went to the source's right while the button was held.
        bench.wait_for("camera", lambda d: math.dist(d["cameras"][0]["position"], (2, -0.2, 1.5)) < 0.01)
    if "tracker tip" in command:
        tip = bench.ask("tracker")[0]["trackers"][0]["calibrations"][0]["sensors"]["1"]["tip"]
        assert math.dist(tip["offset"], TIP) < 1e-3, tip
        assert tip["residual_m"] < 1e-3, tip
    if "tracker align" in command:
        off = millimetres(out)
        assert len(off) == 4 and max(off) < 1.0, out
        assert "monday" in out, out
        q = bench.ask("tracker")[0]["trackers"][0]["calibrations"][-1]["world_from_source"]
        assert math.dist(q[:3], PLACE) < 2e-3 and abs(q[5] - math.sin(TURN / 2)) < 2e-3, q
    if "tracker check" in command:
        assert millimetres(out)[0] < 1.0, out
    if command == "posectl tracker list":
        assert "* monday" in out, out
    if "grab" in command:
        assert "is held" in out, out
    if "tracker reset" in command:
        assert "calibration" not in bench.ask("tracker")[0]["trackers"][0], "none is chosen"


def main():
    failed = passed = 0
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(os.path.abspath(sys.argv[1]), folder)
        try:
            bench.wait_for_sensors(lambda s: s["sensor"] == "fastrak:2")
            for kind, text in steps():
                if kind == "hand":
                    bench.act(text)
                    if pose := re.match(r"pose 1 (\S+) (\S+) (\S+)$", text):
                        x, y, z = (float(v) for v in pose.groups())
                        bench.wait_for_sensors(lambda s: s["sensor"] == "fastrak:1" and math.dist(s["position"], (x, -y, -z)) < 5e-4)
                    if text.startswith("pivot"):  # it swings before it is measured, on a busy machine too
                        seen = set()
                        bench.wait_for_sensors(lambda s: s["sensor"] == "fastrak:1" and (seen.add(tuple(s["position"])) or len(seen) > 5))
                    if text.startswith("button"):
                        bench.wait_for_sensors(lambda s: s["sensor"] == "fastrak:1" and s["buttons"] == int(text[-1]))
                    continue
                if "tracker check" in text:
                    bench.hold_at([0.4, 0, 0.8] if text.endswith("0.8") else [0, 0, 0.8])
                code, out, err = bench.align(text) if "tracker align" in text else bench.shell(text)
                try:
                    assert code == 0, f"exit code {code}"
                    bench.calibrated = bench.calibrated or "tracker align" in text
                    check(text, out, bench)
                    passed += 1
                except (AssertionError, KeyError, IndexError, StopIteration, RuntimeError) as problem:
                    failed += 1
                    print(f"FAILED {text}: {problem!r}\n{out}{err}")
        finally:
            code, log = bench.stop()
        if "serial: streaming=0" not in log:
            failed += 1
            print(f"FAILED the device is left streaming ({code}): {log}")
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or passed < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
