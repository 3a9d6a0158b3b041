#!/usr/bin/env python3
"""A full LIBERTY for SOAK_SECONDS (600): 16 sensors at 240 Hz on an emulated USB bus (libusb and usbfs as they are, under
umockdev), two of them leading a figure's hands, 100 viewers of its poses, and one peer of the samples. No frame of the device
is lost: its count has no gap in what the driver has captured, in all sensors. What a peer misses, because this machine lets
it wait, it is told. Memory stays as it is. SKIPPED where umockdev is not installed.
"""
import json
import multiprocessing
import os
import re
import selectors
import shutil
import socket
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BIN = os.environ.get("POSED_BIN", f"{ROOT}/build/dev/bin")  # of the daemon
EMULATOR = f"{ROOT}/build/dev/bin/usb_emulated_run"
PRINTER = f"{ROOT}/build/dev/bin/print_tracker"
SECONDS = float(os.environ.get("SOAK_SECONDS", "600"))
SENSORS, RATE, VIEWERS = 16, 240, 100
WARM_UP = min(20.0, SECONDS / 4)  # until memory has its size
MAX_GROWTH_KIB = 4 * 1024


def connect(port):
    peer = socket.create_connection(("127.0.0.1", port), timeout=60)
    peer.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return peer


def call(peer, lines, method, params):
    peer.sendall((json.dumps({"jsonrpc": "2.0", "id": 1, "method": method, "params": params}) + "\n").encode())
    reply = json.loads(lines.readline())
    assert "result" in reply, reply
    return reply["result"]


def subscribe(peer, stream):
    peer.sendall((json.dumps({"jsonrpc": "2.0", "id": 1, "method": "stream.subscribe", "params": {"stream": stream}}) + "\n").encode())


def take_all(port, until, out):
    """One peer without a cap: counts the frames of the tracker, and looks for gaps in the device's count."""
    result = {"frames": 0, "missed": 0, "missing_sensors": 0, "told": 0}
    peer = connect(port)
    subscribe(peer, "tracker")
    before, told = None, 0
    for line in peer.makefile("rb"):
        if b'"stream.lost"' in line:
            told = json.loads(line)["params"]["dropped"]
        if b'"stream.frame"' not in line:
            continue
        sensors = json.loads(line)["params"]["data"]["sensors"]
        counts = {sensor["device_count"] for sensor in sensors}
        if len(sensors) != SENSORS or len(counts) != 1:
            result["missing_sensors"] += 1
        count = max(counts)
        if before is not None:  # what is told comes before the frame that it left out others for
            result["missed"] += count - before - 1
            result["told"] += told
        before, told = count, 0
        result["frames"] += 1
        if time.monotonic() > until:
            break
    out.put(("all", result))


def view_many(port, until, out):
    """The viewers of poses: each one's numbering, less what it was told that it has lost, has no gap."""
    chosen = selectors.DefaultSelector()
    seen = []
    for i in range(VIEWERS):
        peer = connect(port)
        subscribe(peer, "pose")
        peer.setblocking(False)
        seen.append({"rest": b"", "first": None, "last": 0, "frames": 0, "lost": 0, "told": 0})
        chosen.register(peer, selectors.EVENT_READ, i)
    number = re.compile(rb'"seq":(\d+)')
    dropped = re.compile(rb'"dropped":(\d+)')
    closed = 0
    while time.monotonic() < until and closed == 0:
        for key, _ in chosen.select(1.0):
            viewer = seen[key.data]
            data = key.fileobj.recv(1 << 18)
            closed += not data
            *lines, viewer["rest"] = (viewer["rest"] + data).split(b"\n")
            for line in lines:
                if b'"stream.lost"' in line:
                    viewer["told"] = int(dropped.search(line)[1])
                elif b'"stream.frame"' in line:
                    viewer["last"] = int(number.search(line, 0, 120)[1])
                    viewer["lost"] += viewer["told"] if viewer["first"] else 0
                    viewer["told"] = 0
                    viewer["first"] = viewer["first"] or viewer["last"]
                    viewer["frames"] += 1
    out.put(("many", {"closed": closed,
                      "frames": [v["frames"] for v in seen],
                      "lost": sum(v["lost"] for v in seen),
                      # Of the frames between its first and its last one, those that it neither got nor was told of.
                      "untold": [v["last"] - v["first"] + 1 - v["frames"] - v["lost"] for v in seen]}))


def replayed(folder):
    """What the driver heard, by the same decoder: how many frames, and where the device's count has a gap."""
    [capture] = [os.path.join(folder, name) for name in os.listdir(folder)]
    frames, gaps, incomplete, before, sensors = 0, [], 0, None, SENSORS
    with subprocess.Popen([PRINTER, f"replay:{capture}@fast"], stdout=subprocess.PIPE, text=True) as replay:
        for line in replay.stdout:
            words = line.split()
            if len(words) != 10:  # its state
                if words[0] in ("failed", "silent"):
                    break
                continue
            count = int(words[9])
            if count != before:
                incomplete += sensors != SENSORS
                if before is not None and count != before + 1:
                    gaps.append([before, count])
                frames, before, sensors = frames + 1, count, 0
            sensors += 1
        replay.terminate()
    return frames, gaps, incomplete


def memory_kib(pid):
    with open(f"/proc/{pid}/status", encoding="ascii") as status:
        return int(re.search(r"VmRSS:\s+(\d+)", status.read())[1])


def daemon_of(runner):
    """The daemon's process: below the wrapper and the emulator."""
    while True:
        with open(f"/proc/{runner}/comm", encoding="ascii") as name:
            if name.read().strip() == "posed":
                return runner
        with open(f"/proc/{runner}/task/{runner}/children", encoding="ascii") as below:
            runner = int(below.read().split()[0])


def main():
    wrapper = shutil.which("umockdev-wrapper")
    if not wrapper or not os.path.exists(EMULATOR):
        print("SKIPPED: there is no umockdev (Debian: apt-get install umockdev libumockdev-dev)")
        return 77
    failures = []
    with tempfile.TemporaryDirectory(prefix="posed-soak-") as folder, tempfile.TemporaryDirectory(prefix="posed-heard-") as heard:
        run = subprocess.Popen([wrapper, EMULATOR, "--stations", str(SENSORS), "--swing", "--", f"{BIN}/posed", "--listen", "127.0.0.1:0",
                                "--tracker", "liberty", "--data", folder, "--capture", heard, "--log", "warning"], stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, text=True)
        port = int(re.search(r":(\d+)/", run.stdout.readline())[1])
        control = connect(port)
        lines = control.makefile("r", encoding="utf-8")
        for hand, sensor in (("right_hand", "liberty:1"), ("left_hand", "liberty:2")):
            call(control, lines, "goal.set", {"id": hand, "at": hand, "position": [0.4, -0.3, 1.2]})
            call(control, lines, "binding.set", {"sensor": sensor, "to": {"goal": hand}})
        for _ in range(600):
            listed = call(control, lines, "tracker.list", {})["trackers"][0]
            if len(listed["sensors"]) == SENSORS:
                break
            time.sleep(0.1)
        assert len(listed["sensors"]) == SENSORS, listed
        pid = daemon_of(run.pid)
        begun = time.monotonic()
        end = begun + SECONDS
        out = multiprocessing.Queue()
        workers = [multiprocessing.Process(target=work, args=(port, end, out)) for work in (take_all, view_many)]
        for worker in workers:
            worker.start()
        time.sleep(WARM_UP)
        before, frames_before = memory_kib(pid), call(control, lines, "tracker.list", {})["trackers"][0]["frames"]
        seconds = time.monotonic()
        worst_memory = before
        while time.monotonic() < end - 1.0:
            time.sleep(1.0)
            worst_memory = max(worst_memory, memory_kib(pid))
        listed = call(control, lines, "tracker.list", {})["trackers"][0]
        rate = (listed["frames"] - frames_before) / (time.monotonic() - seconds)
        results = dict(out.get(timeout=120) for _ in workers)
        for worker in workers:
            worker.join(60)
        run.stdin.write("quit\n")
        run.stdin.flush()
        code = run.wait(60)
        frames, gaps, incomplete = replayed(heard)
    every, many = results["all"], results["many"]
    print(f"{SECONDS:.0f} s of {SENSORS} sensors at {rate:.1f} Hz: {frames} frames, {SENSORS * frames} samples; "
          f"{len(gaps)} gaps, {incomplete} frames without all sensors, {listed['bad_bytes']} bad bytes")
    print(f"one peer of the samples: {every['frames']} frames, {every['missed']} missed, {every['told']} told")
    print(f"{VIEWERS} viewers: {min(many['frames'])} to {max(many['frames'])} poses each; {many['lost']} left out and told, "
          f"{max(map(abs, many['untold']))} untold")
    print(f"memory: {before} KiB after {WARM_UP:.0f} s, {worst_memory} KiB at most")
    if gaps or incomplete or every["missing_sensors"] or listed["bad_bytes"]:
        failures.append(f"frames are lost: gaps {gaps[:5]}")
    if every["missed"] != every["told"]:
        failures.append("the peer of the samples misses what it was not told")
    if frames < 0.98 * RATE * SECONDS or abs(rate - RATE) > 0.02 * RATE:
        failures.append(f"the device did not run at {RATE} Hz: {frames} frames")
    if many["closed"] or any(many["untold"]):
        failures.append(f"viewers miss what they were not told: {many['untold']}, {many['closed']} closed")
    if worst_memory - before > MAX_GROWTH_KIB:
        failures.append(f"memory grew by {worst_memory - before} KiB")
    if code != 0:
        failures.append(f"posed ended with {code}")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
