#!/usr/bin/env python3
"""A station in use, for SOAK_SECONDS (120): a sensor leads a hand, 40 viewers watch (10 of them never read), 4 editors send
sound and broken edits, peers come and go. Every request is answered, every reading viewer gets frames to the end, memory
stays bounded, and the daemon stops cleanly.
"""
import json
import os
import random
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
POSED = os.environ.get("POSED", f"{ROOT}/build/dev/bin/posed")
SECONDS = float(os.environ.get("SOAK_SECONDS", "120"))
MAX_GROWTH_KIB = 64 * 1024  # stalled peers cost at most their queues


class Peer:
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=60)
        self.lines = self.socket.makefile("r", encoding="utf-8")
        self.next_id = 0

    def call(self, method, params):
        self.next_id += 1
        request = {"jsonrpc": "2.0", "id": self.next_id, "method": method, "params": params}
        self.socket.sendall((json.dumps(request) + "\n").encode())
        reply = json.loads(self.lines.readline())
        assert reply["id"] == self.next_id, reply
        return reply


def edit(peer, rng):
    place = [rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0, 2)]
    at = rng.choice(["left_hand", "head", "left_foot", "right_foot", "lower_torso", "no_such_limb", 7])
    method, params = rng.choice([
        ("goal.set", {"at": at, "position": place, "weight": rng.choice([0, 1, 10, 1e4, -1])}),
        ("goal.set", {"at": at, "position": place[:2]}),
        ("goal.remove", {"id": f"body.{at}.position"}),
        ("pose.reset", {"to": rng.choice(["rest", "start", "nowhere"])}),
        ("pose.get", {}), ("scene.get", {}), ("nothing.at_all", {}),
        ("figure.set", {"id": "body", "template": "tempus", "stature": rng.uniform(0.4, 2.6)}),
    ])
    reply = peer.call(method, params)
    assert ("result" in reply) != ("error" in reply), reply


def rss_kib(pid):
    with open(f"/proc/{pid}/status", encoding="ascii") as status:
        return int(re.search(r"VmRSS:\s+(\d+)", status.read()).group(1))


def main():
    with tempfile.TemporaryDirectory(prefix="posed-soak-") as folder:
        posed = subprocess.Popen([POSED, "--listen", "127.0.0.1:0", "--tracker", "simulated", "--data", folder],
                                 stdout=subprocess.PIPE, text=True)
        port = int(re.search(r":(\d+)/", posed.stdout.readline()).group(1))
        control = Peer(port)
        control.call("goal.set", {"id": "hand", "at": "right_hand", "position": [0.4, -0.3, 1.2]})
        control.call("binding.set", {"sensor": "simulated:1", "to": {"goal": "hand"}})
        end = time.monotonic() + SECONDS
        failures, frames, edits = [], [0] * 30, [0] * 4

        def guarded(work, *args):
            try:
                work(*args)
            except Exception as error:  # told below, whatever it is
                failures.append(f"{work.__name__}{args}: {error!r}")

        def view(i):
            peer = Peer(port)
            peer.call("stream.subscribe", {"stream": "pose", "max_rate_hz": 30})
            while time.monotonic() < end:
                assert peer.lines.readline(), "the stream ended"
                frames[i] += 1

        def work(i):
            rng = random.Random(i)
            peer = Peer(port)
            while time.monotonic() < end:
                if rng.random() < 0.01:
                    peer.socket.close()
                    peer = Peer(port)
                edit(peer, rng)
                edits[i] += 1

        stalled = [Peer(port) for _ in range(10)]
        for peer in stalled:
            peer.call("stream.subscribe", {"stream": "pose"})
        threads = [threading.Thread(target=guarded, args=(view, i)) for i in range(30)]
        threads += [threading.Thread(target=guarded, args=(work, i)) for i in range(4)]
        for thread in threads:
            thread.start()
        time.sleep(min(15.0, SECONDS / 4))
        before = rss_kib(posed.pid)
        for thread in threads:
            thread.join()
        growth = rss_kib(posed.pid) - before
        posed.terminate()
        code = posed.wait(60)
    print(f"{SECONDS:.0f} s: {sum(edits)} edits, {sum(frames)} frames read, memory grew by {growth} KiB")
    if min(frames) < SECONDS:
        failures.append(f"a viewer got {min(frames)} frames only")
    if growth > MAX_GROWTH_KIB:
        failures.append(f"memory grew by {growth} KiB")
    if code != 0:
        failures.append(f"posed ended with {code}")
    print("\n".join(failures))
    return 1 if failures else 0


sys.exit(main())
