#!/usr/bin/env python3
"""posectl view on a real pseudo-terminal against the real daemon: what a terminal (pyte) shows, and how it is left.

    python3 tests/client/cli/view/terminal_test.py BUILD
"""
import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import termios
import time
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[4]
BIN = Path(sys.argv[1] if len(sys.argv) > 1 else TOP / "build" / "dev") / "bin"
os.environ["POSED_BIN"] = str(BIN)
sys.dont_write_bytecode = True
sys.path[:0] = [str(TOP / "tests" / "client" / "python"), str(TOP / "client" / "python")]
# A python beside Debian's finds its packages, too: pyte is plain Python.
sys.path.append("/usr/lib/python3/dist-packages")

try:
    import pyte
except ImportError:
    print("SKIPPED: python3-pyte is not here")
    sys.exit(77)

from daemon import Daemon, nobody  # noqa: E402
from posed import Posed  # noqa: E402

PATIENCE = float(os.environ.get("POSED_TEST_PATIENCE", "60"))  # seconds; nothing is measured by them
CLEAR = b"\x1b[2J"


class Shown(pyte.Screen):
    """Private sequences with a prefix that pyte does not know are none of its business."""

    def report_device_status(self, mode=0, **_):
        super().report_device_status(mode)


class Terminal:
    """posectl view in a terminal of its own, as its leader's child sees it."""

    def __init__(self, address, columns, rows, *options, environment=None, answers=True):
        self.answers = answers
        self.screen = Shown(columns, rows)
        self.screen.write_process_input = self.reply
        self.stream = pyte.ByteStream(self.screen)
        self.bytes = b""
        self.leader, self.follower = pty.openpty()
        self.resize(columns, rows)
        self.before = termios.tcgetattr(self.follower)
        env = {**os.environ, "TERM": "xterm-256color", "LC_ALL": "C.UTF-8", "COLORTERM": "", "NO_COLOR": "", **(environment or {})}
        self.process = subprocess.Popen([BIN / "posectl", "--host", address, "view", *options], stdin=self.follower,
                                        stdout=self.follower, stderr=subprocess.PIPE, env=env, preexec_fn=self.lead)

    def lead(self):
        os.setsid()
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)

    def reply(self, text):
        if self.answers:
            os.write(self.leader, text.encode())

    def resize(self, columns, rows):
        fcntl.ioctl(self.leader, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        self.screen.resize(rows, columns)

    def press(self, keys):
        os.write(self.leader, keys.encode())

    def pump(self, seconds=0.05):
        """Takes in what comes for so long; how many bytes there were."""
        taken, until = 0, time.monotonic() + seconds
        while True:
            ready, _, _ = select.select([self.leader], [], [], max(0.0, until - time.monotonic()))
            if not ready:
                return taken
            try:
                piece = os.read(self.leader, 65536)
            except OSError:
                return taken
            if not piece:
                return taken
            taken += len(piece)
            self.bytes += piece
            self.stream.feed(piece)

    def text(self):
        return "\n".join(line.rstrip() for line in self.screen.display)

    def until(self, what, says):
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            self.pump()
            if what():
                return
            if self.process.poll() is not None:
                break
        raise AssertionError(f"{says}; the screen:\n{self.text()}\n{self.process.poll()}")

    def shows(self, *parts):
        self.until(lambda: all(part in self.text() for part in parts), f"never shows {parts}")

    def ends(self):
        deadline = time.monotonic() + PATIENCE
        while self.process.poll() is None and time.monotonic() < deadline:
            self.pump()
        self.pump()
        return self.process.poll()

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.process.stderr.close()
        os.close(self.leader)
        os.close(self.follower)


def solid(text):
    """Characters that are all but filled: limbs, and not the floor."""
    return sum(0x2800 <= ord(glyph) < 0x2900 and bin(ord(glyph) - 0x2800).count("1") >= 5 for glyph in text)


class OnATerminal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon("--scene.template", "paper/two-reaches")

    @classmethod
    def tearDownClass(cls):
        cls.daemon.close()

    def view(self, columns=80, rows=24, *options, **more):
        terminal = Terminal(self.daemon.address, columns, rows, *options, **more)
        self.addCleanup(terminal.close)
        return terminal

    def restored(self, terminal):
        """The alternate screen left, the cursor there, wrapping on, and the line as it was."""
        for sequence in (b"\x1b[?1049l", b"\x1b[?25h", b"\x1b[?7h"):
            self.assertGreater(terminal.bytes.rfind(sequence), terminal.bytes.rfind(sequence[:-1] + (b"h" if sequence[-1:] == b"l" else b"l")))
        self.assertEqual(termios.tcgetattr(terminal.follower), terminal.before)
        self.assertFalse(terminal.screen.cursor.hidden)

    def test_shows_the_figure_in_four_views(self):
        for columns, rows, least in ((80, 24, 30), (200, 60, 250)):
            with self.subTest(columns=columns):
                terminal = self.view(columns, rows)
                terminal.shows("1 Top", "2 Front", "3 Side", "4 Perspective", "weight")
                terminal.until(lambda: solid(terminal.text()) > least, "has no solid figure")
                terminal.press("q")
                self.assertEqual(terminal.ends(), 0)
                self.restored(terminal)

    def test_follows_a_stream_of_60_hz_without_flicker(self):
        with Posed(self.daemon.address) as station:
            goal = station.goal.list()["goals"][0]["id"]
            binding = station.binding.set(sensor="simulated:1", to={"goal": goal})["id"]
            self.addCleanup(self.remove_binding, binding)
        for columns, rows in ((80, 24), (200, 60)):
            with self.subTest(columns=columns):
                terminal = self.view(columns, rows)
                terminal.shows("1 Top")
                terminal.until(lambda: re.search(r"\b[3-6]\d Hz", terminal.text()), "follows no fast stream")
                first = len(terminal.bytes)
                terminal.pump(2.0)
                stream = terminal.bytes[first:]
                pages = stream.count(b"\x1b[?2026h")
                self.assertNotIn(CLEAR, stream)
                self.assertGreater(pages, 20)
                self.assertLess(len(stream) / pages, columns * rows * 1.5)
                self.assertEqual(terminal.bytes.count(CLEAR), 1)
                print(f"{columns} x {rows}: {len(stream) / pages:.0f} bytes a page, {pages} pages in 2 s")
                terminal.press("q")
                self.assertEqual(terminal.ends(), 0)

    def remove_binding(self, binding):
        with Posed(self.daemon.address) as station:
            station.binding.remove(id=binding)

    def test_a_goal_nudged_here_moves_in_another_client_and_undo_brings_it_back(self):
        with Posed(self.daemon.address) as station:
            station.goal.set(id="a", at="right_hand", position=[0.4, -0.3, 1.2])
            terminal = self.view()
            terminal.shows("◆ 1/", " a ")
            terminal.press("2")  # the front view: right is +Y
            terminal.press("\x1b[C" * 3 + "\x1b[1;2A")
            place = lambda: station.goal.get(id="a")["position"]  # noqa: E731
            terminal.until(lambda: place() == [0.4, -0.27, 1.3], f"is not nudged: {place()}")
            terminal.press("]")
            terminal.until(lambda: station.goal.get(id="a")["weight"] == 13, "has no more weight")
            terminal.shows("weight 13")
            terminal.press("u")
            terminal.until(lambda: station.goal.get(id="a")["weight"] == 10, "has its old weight again")
            terminal.press("u")
            terminal.until(lambda: place() == [0.4, -0.3, 1.2], "the nudges are one step to undo")
            terminal.press("r")
            terminal.until(lambda: place() == [0.4, -0.27, 1.3], "is done again")
            # What others do is seen.
            station.goal.set(id="a", weight=77)
            terminal.shows("weight 77")
            station.goal.grab(id="a")
            terminal.press("[")
            terminal.shows("not done: ")
            station.goal.release(id="a")
            station.goal.remove(id="a")
            terminal.press("q")
            self.assertEqual(terminal.ends(), 0)

    def test_keys_change_what_is_seen(self):
        terminal = self.view()
        terminal.shows("1 Top")
        terminal.press("3" "m")
        terminal.until(lambda: "3 Side" in terminal.text() and "1 Top" not in terminal.text(), "the side is not alone")
        terminal.press("?")
        terminal.shows("nudge the goal", "quit")
        terminal.press("\x1b")  # alone
        terminal.until(lambda: "nudge the goal in" not in terminal.text(), "the help stays")
        terminal.press("\x1b")
        terminal.shows("1 Top")
        terminal.pump(0.3)
        before = terminal.text()
        terminal.press("4hhh")
        terminal.until(lambda: terminal.text() != before, "nothing turns")
        terminal.press("\x03")
        self.assertEqual(terminal.ends(), 0)
        self.restored(terminal)

    def test_another_size_is_drawn_anew(self):
        terminal = self.view()
        terminal.shows("1 Top")
        terminal.resize(132, 40)
        terminal.until(lambda: "Goals" in terminal.text() and terminal.screen.display[37].startswith("╰"), "keeps its old size")
        terminal.resize(30, 5)
        terminal.shows("too small")
        terminal.press("q")
        self.assertEqual(terminal.ends(), 0)

    def test_signals_leave_the_terminal_as_it_was(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with self.subTest(signal=number):
                terminal = self.view()
                terminal.shows("1 Top")
                terminal.process.send_signal(number)
                self.assertEqual(terminal.ends(), 0)
                self.restored(terminal)

    def test_a_crash_leaves_the_terminal_as_it_was(self):
        terminal = self.view()
        terminal.shows("1 Top")
        terminal.process.send_signal(signal.SIGSEGV)
        self.assertEqual(terminal.ends(), -signal.SIGSEGV)
        self.restored(terminal)

    def test_stopped_and_gone_on(self):
        terminal = self.view()
        terminal.shows("1 Top")
        # Its group has no shell to wake it: the kernel does not stop it, and it must come back by itself.
        terminal.press("\x1a")
        terminal.until(lambda: terminal.bytes.count(b"\x1b[?1049l") == 1, "does not let go")
        terminal.until(lambda: terminal.bytes.count(b"\x1b[?1049h") == 2, "does not come back")
        terminal.process.send_signal(signal.SIGSTOP)
        os.waitpid(terminal.process.pid, os.WUNTRACED)
        termios.tcsetattr(terminal.follower, termios.TCSANOW, terminal.before)
        terminal.process.send_signal(signal.SIGCONT)
        terminal.until(lambda: terminal.bytes.count(b"\x1b[?1049h") >= 3, "does not hold the terminal again")
        terminal.shows("1 Top")
        terminal.press("q")  # without a line's end: the terminal is raw again
        self.assertEqual(terminal.ends(), 0)
        self.restored(terminal)

    def test_a_terminal_that_reads_nothing_wakes_to_what_is(self):
        with Posed(self.daemon.address) as station:
            goal = station.goal.list()["goals"][0]["id"]
            binding = station.binding.set(sensor="simulated:1", to={"goal": goal})["id"]
            self.addCleanup(self.remove_binding, binding)
            for answers in (True, False):
                with self.subTest(answers=answers):
                    terminal = self.view(answers=answers)
                    terminal.until(lambda: re.search(r"\d\d Hz", terminal.text()), "follows nothing")
                    terminal.pump(0.5)  # it has found out whether it is answered
                    time.sleep(3.0)  # 180 poses
                    waited = len(terminal.bytes)
                    os.set_blocking(terminal.leader, False)
                    backlog = os.read(terminal.leader, 1 << 20)
                    os.set_blocking(terminal.leader, True)
                    terminal.bytes += backlog
                    terminal.stream.feed(backlog)
                    # What the kernel holds between the two is bounded; with answers it is two pages, and one now and then.
                    self.assertLess(len(terminal.bytes) - waited, 80_000)
                    if answers:
                        self.assertLessEqual(backlog.count(b"\x1b[?2026h"), 4)
                    terminal.press("q")
                    self.assertEqual(terminal.ends(), 0)
                    self.restored(terminal)

    def test_without_utf8_or_colours(self):
        terminal = self.view(environment={"LC_ALL": "C", "NO_COLOR": "1"})
        terminal.shows("1 Top", "weight")
        terminal.until(lambda: sum(terminal.text().count(glyph) for glyph in "#*") > 10, "has no figure")
        self.assertNotIn(b"38;5", terminal.bytes)
        self.assertTrue(all(byte < 0x80 for byte in terminal.bytes))
        terminal.press("q")
        self.assertEqual(terminal.ends(), 0)

    def test_a_terminal_that_goes_away_ends_it(self):
        terminal = self.view()
        terminal.shows("1 Top")
        os.close(terminal.leader)
        self.assertIsNotNone(terminal.process.wait(PATIENCE))
        terminal.leader = os.open("/dev/null", os.O_RDWR)


class WithADaemonOfItsOwn(unittest.TestCase):
    def test_a_lost_connection_is_said_and_comes_back(self):
        daemon = Daemon("--scene.template", "paper/sitting")
        self.addCleanup(daemon.close)
        terminal = Terminal(daemon.address, 100, 30)
        self.addCleanup(terminal.close)
        terminal.shows("1 Top", "weight")
        daemon.stop()
        terminal.shows("NO CONNECTION")
        terminal.press("]")
        terminal.shows("not done: ")
        daemon.start()
        terminal.until(lambda: "NO CONNECTION" not in terminal.text() and solid(terminal.text()) > 30, "does not come back")
        with Posed(daemon.address) as station:
            station.goal.set(id="left_knee", weight=33)
        terminal.press("nnn")
        terminal.until(lambda: "weight 33" in terminal.text() or terminal.press("n"), "does not hear of edits again")
        daemon.stop()
        terminal.shows("NO CONNECTION")
        terminal.press("q")
        self.assertEqual(terminal.ends(), 0)
        daemon.start()


class WithoutATerminal(unittest.TestCase):
    def test_it_refuses_and_says_what_would_do(self):
        daemon = Daemon()
        self.addCleanup(daemon.close)
        run = lambda *words, **more: subprocess.run([BIN / "posectl", "--host", daemon.address, "view", *words], text=True,  # noqa: E731
                                                    capture_output=True, stdin=subprocess.DEVNULL, check=False, **more)
        refused = run()
        self.assertEqual((refused.returncode, refused.stdout), (2, ""))
        self.assertIn("posectl watch", refused.stderr)
        env = {**os.environ, "LC_ALL": "C.UTF-8"}
        picture = run("--once", "--size", "80x24", env=env)
        self.assertEqual((picture.returncode, picture.stderr), (0, ""))
        self.assertNotIn("\x1b", picture.stdout)
        self.assertEqual(len(picture.stdout.splitlines()), 24)
        self.assertGreater(solid(picture.stdout), 30)
        self.assertEqual(run("--size", "80x24").returncode, 2)
        self.assertEqual(run("--once", "--size", "huge").returncode, 2)
        alone = subprocess.run([BIN / "posectl", "--host", nobody(), "view"], capture_output=True, check=False)
        self.assertEqual(alone.returncode, 3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
