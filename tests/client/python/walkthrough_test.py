"""client/python/walkthrough.py goes through the paper's scenes and leaves what it found."""
import subprocess
import sys
import unittest

from daemon import TOP, Daemon, nobody

SCRIPT = str(TOP / "client" / "python" / "walkthrough.py")
sys.path.insert(0, str(TOP / "client" / "python"))
from posed import Posed  # noqa: E402


def walk(*words):
    return subprocess.run([sys.executable, "-B", SCRIPT, *words], capture_output=True, text=True, timeout=240, check=False)


class Walkthrough(unittest.TestCase):
    def test_all_scenes_are_shown_and_the_old_one_comes_back(self):
        daemon = Daemon()
        self.addCleanup(daemon.close)
        with Posed(daemon.address, timeout=60.0) as station:
            station.goal.set(id="mine", at="left_hand", position=[0.3, 0.3, 1.3])
            templates = [name for name in station.scene.list()["templates"] if name.startswith("paper/")]
            walked = walk(daemon.address, "--pause", "0")
            self.assertEqual(walked.returncode, 0, walked.stderr)
            self.assertEqual(len(templates), 8)
            for name in templates:
                self.assertIn(name + "\n", walked.stdout)
            # The paper's figure: 40 against 10 leaves the second goal four times as far.
            self.assertRegex(walked.stdout, r"right_hand +balanced +150\.0 mm")
            self.assertRegex(walked.stdout, r"right_upper_arm +balanced +600\.0 mm")
            self.assertEqual(station.goal.get(id="mine")["position"], [0.3, 0.3, 1.3])

    def test_without_a_daemon_it_says_so(self):
        walked = walk(nobody())
        self.assertEqual(walked.returncode, 1)
        self.assertIn("nothing listens", walked.stderr)


if __name__ == "__main__":
    unittest.main()
