#!/usr/bin/env python3
"""Rules for every file: include guards, length, programs that may run, nothing left for later, nothing of one machine.

    python3 tests/house/tree_test.py [--self-test]
"""

import os
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import tree  # noqa: E402

CODE = {".cpp", ".h", ".ts", ".mjs", ".py", ".sh", ".css", ".html", ".cmake"}
MOST_LINES = 500
# path: why it is as long as it is
LONG = {}

LATER = re.compile(r"\b(TODO|FIXME|XXX)\b")
MACHINE = re.compile(r"(?<![\w.~*-])/(work|home|root)/")


def complaints(top):
    found = []
    for path in tree.files(top):
        content = tree.text(top / path)
        if content is None:
            continue
        lines = content.split("\n")
        # A header that is compiled once for every instruction set has the guard that Highway asks for.
        once = any(line.endswith("defined(HWY_TARGET_TOGGLE)") for line in lines) if path.name.endswith("-inl.h") else "#pragma once" in lines
        if path.suffix == ".h" and not once:
            found.append(f"{path}: has no #pragma once")
        if path.suffix in CODE and len(lines) - 1 > MOST_LINES and str(path) not in LONG:
            found.append(f"{path}: {len(lines) - 1} lines, above {MOST_LINES}: split it, or say why in {Path(__file__).name}")
        if content.startswith("#!") and not os.access(top / path, os.X_OK):
            found.append(f"{path}: is a program that may not run: chmod +x, or take its first line away")
        if path.name == "package-lock.json" and '"resolved"' in content:
            found.append(f"{path}: names a registry (see omit-lockfile-registry-resolved in .npmrc)")
        for number, line in enumerate(lines, 1):
            if path.suffix in CODE and path.name != Path(__file__).name and LATER.search(line):
                found.append(f"{path}:{number}: left for later: {line.strip()[:80]}")
            if MACHINE.search(line):
                found.append(f"{path}:{number}: a path of one machine: {line.strip()[:80]}")
    for path in LONG:
        if not (top / path).exists() or len((tree.text(top / path) or "").split("\n")) - 1 <= MOST_LINES:
            found.append(f"{path}: listed as long in {Path(__file__).name}, and is not")
    return found


SOUND = {"common/a.h": "#pragma once\nint a();\n", "README.md": "See https://example.org/home/page.\n"}
SOUND |= {path: "#pragma once\n" + "\n" * MOST_LINES for path in LONG}
FAULTS = [
    ({"common/a.h": "int a();\n"}, "no #pragma once"),
    ({"common/a-inl.h": "#pragma once\n"}, "no #pragma once"),
    ({"common/a.cpp": "\n" * 501}, "501 lines"),
    ({"common/a.cpp": "// TO" + "DO: later\n"}, "a.cpp:1: left for later"),
    ({"deploy/x": "#!/bin/sh\n"}, "may not run"),
    ({"deploy/x": "cd /" + "work/posed\n"}, "x:1: a path of one machine"),
    ({"client/web/package-lock.json": '{"resolved": "https://example.org"}\n'}, "names a registry"),
]

if __name__ == "__main__":
    tree.main(complaints, SOUND, FAULTS)
