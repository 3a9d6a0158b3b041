"""The files of the project, for the checks that read all of them, and the frame that those checks share."""

import os
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
NOT_OURS = {".git", "build", "node_modules", "dist", "test-results", "__pycache__", ".cache"}


def files(top, *suffixes):
    """Paths relative to `top`, sorted; of these suffixes, or all."""
    found = []
    for folder, inner, names in os.walk(top):
        inner[:] = sorted(name for name in inner if name not in NOT_OURS)
        # In a linked worktree .git is a file.
        found += [Path(folder, name).relative_to(top) for name in names if name not in NOT_OURS]
    return sorted(path for path in found if not suffixes or path.suffix in suffixes)


def text(path):
    """None for what is not text."""
    try:
        return path.read_text(encoding="utf-8")
    except (UnicodeDecodeError, OSError):
        return None


def plant(top, tree):
    """Writes {"path": "text"} under `top`."""
    for path, content in tree.items():
        (top / path).parent.mkdir(parents=True, exist_ok=True)
        (top / path).write_text(content, encoding="utf-8")


def main(complaints, sound, faults):
    """With --self-test: the made-up tree `sound` must be without complaints, and each of `faults`, a list of
    (files to add, part of the complaint), must be found. Else: complaints(TOP) must be empty."""
    if sys.argv[1:] == ["--self-test"]:
        failed = 0
        for extra, expected in [({}, None)] + faults:
            with tempfile.TemporaryDirectory() as folder:
                plant(Path(folder), {**sound, **extra})
                found = complaints(Path(folder))
            fine = any(expected in line for line in found) if expected else not found
            if not fine:
                failed += 1
                print(f"planted {list(extra)}, expected {expected!r}, found {found}")
        print(f"{len(faults) + 1 - failed} of {len(faults) + 1} made-up trees judged rightly")
        sys.exit(failed > 0)
    found = complaints(TOP)
    print("\n".join(found) if found else "no complaints")
    sys.exit(len(found) > 0)
