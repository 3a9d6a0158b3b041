#!/usr/bin/env python3
"""Goes through the scenes of the paper that posed carries on (Badler, Manoochehri, Walters 1987), says what each of them
asks of the figure, and what came of it. Look at the viewer meanwhile.

    walkthrough.py [ADDRESS] [--pause SECONDS] [--token TOKEN]

The scene that was there is saved as "before-walkthrough" and comes back at the end.
"""
from __future__ import annotations

import argparse
import math
import sys
import time
from typing import Any, Dict, List

from posed import Posed, PosedError

BEFORE = "before-walkthrough"
SCENES = [
    ("single-reach", "The right hand reaches for a point; the pelvis has a goal of its own where it stands."),
    ("two-reaches", "Both hands reach at once, each for its own point."),
    ("unreachable", "The hand's point is out of reach, and the upper arm is pulled the other way: 40 against 10."),
    ("sitting", "Hips, back and knees are drawn to a chair: four goals that cannot all be met share what is missing."),
    ("restrained", "Seated, the right hand reaches too far, and the seat holds the lower torso: 100 against the hand."),
    ("seat-belt", "The same with a belt: the shoulder is held too, and the arm alone is left to reach."),
    ("two-hands", "Both hands go to one point, while the pelvis and one foot stay."),
    ("straighten", "Pulled at hands and ankles, a bent figure straightens."),
]


def describe(goal: Dict[str, Any]) -> str:
    text = f"    {goal['id']:<16} {goal['state']:<11} {1e3 * goal['error']:7.1f} mm away, pulls with {math.hypot(*goal['force']):6.2f}"
    causes = []
    for cause in goal.get("causes", []):
        if "goal" in cause:
            causes.append(f"{cause['goal']} holds it")
        elif "limit" in cause:
            causes.append(f"{cause['limit']} is at its limit ({cause['side']})")
        elif "pin" in cause:
            causes.append(f"the pin of {cause['pin']} holds it")
        elif "beyond_m" in cause:
            causes.append(f"{1e3 * cause['beyond_m']:.0f} mm out of reach")
    return text + (": " + ", ".join(causes) if causes else "")


def tour(station: Posed, pause: float) -> None:
    for name, story in SCENES:
        print(f"paper/{name}\n    {story}")
        revision = station.scene.new(template=f"paper/{name}")["revision"]
        pose = station.pose.get(min_revision=revision, wait_ms=10_000)
        for goal in pose["goals"]:
            print(describe(goal))
        print(f"    {pose['status']} after {pose['iterations']} iterations, {pose['solve_us']:.0f} us, cost {pose['cost']:.4g}\n")
        time.sleep(pause)


def drag(station: Posed) -> None:
    """The same figure, live: a goal that goes round is followed in the stream."""
    print("The hand follows a goal that goes round, and the stream says how far behind it is.")
    station.scene.new(template="standing")
    station.subscribe("pose", fields=["goals"], max_rate_hz=60)
    worst, frames = 0.0, 0
    for step in range(60):
        turn = 2.0 * math.pi * step / 60.0
        edit = station.goal.set(at="right_hand", position=[0.35, -0.25 + 0.1 * math.sin(turn), 1.15 + 0.1 * math.cos(turn)])
        until = time.monotonic() + 10.0
        while time.monotonic() < until:
            frame = station.next_frame("pose", 10.0)
            if frame is None or frame["revision"] >= edit["revision"]:
                break
        if frame:
            goals: List[Dict[str, Any]] = frame["figures"][0]["goals"]
            worst = max(worst, *(goal["error"] for goal in goals if goal["id"] == edit["id"]))
            frames += 1
    station.unsubscribe("pose")
    print(f"    {frames} steps, at most {1e3 * worst:.2f} mm behind\n")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("address", nargs="?", default="tcp://127.0.0.1")
    parser.add_argument("--pause", type=float, default=2.0, metavar="SECONDS", help="after each scene")
    parser.add_argument("--token", help="where the daemon asks for one")
    words = parser.parse_args()
    try:
        with Posed(words.address, token=words.token, user="walkthrough") as station:
            station.scene.save(name=BEFORE)
            try:
                tour(station, words.pause)
                drag(station)
            finally:
                station.scene.open(name=BEFORE)
    except PosedError as error:
        print(f"walkthrough: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
