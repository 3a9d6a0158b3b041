"""client/python/posed.py against a real daemon."""
import json
import socket
import sys
import threading
import time
import unittest

from daemon import TOP, Daemon, nobody

sys.path.insert(0, str(TOP / "client" / "python"))
from posed import Lost, Posed, PosedError, Refused  # noqa: E402

PATIENCE = 60.0  # never waited for but when something is broken


class WithADaemon(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.close()

    def setUp(self):
        self.station = Posed(self.daemon.address, timeout=PATIENCE, user="ana")
        self.addCleanup(self.station.close)


class Calls(WithADaemon):
    def test_a_goal_is_set_and_reached(self):
        edit = self.station.goal.set(at="right_hand", position=[0.4, -0.3, 1.2])
        self.assertEqual(edit["id"], "body.right_hand.position")
        pose = self.station.pose.get(min_revision=edit["revision"], wait_ms=10_000)
        goal = next(goal for goal in pose["goals"] if goal["id"] == edit["id"])
        self.assertEqual(goal["state"], "reached")
        self.assertEqual(self.station.goal.get(id=edit["id"])["position"], [0.4, -0.3, 1.2])

    def test_methods_without_a_family_and_by_name(self):
        answer = self.station.solve(figure={"template": "tempus"}, goals=[{"at": "head", "position": [0, 0, 1.5]}])
        self.assertIn(answer["status"], ("converged", "stalled"))
        self.assertEqual(self.station.call("session.status")["figures"], ["body"])

    def test_a_reply_of_many_megabytes(self):
        problem = {"goals": [{"at": "right_hand", "position": [0.4, -0.3, 1.2]}], "start": "rest"}
        answer = self.station.solve.batch(figure={"template": "tempus"}, problems=[problem] * 2000)
        self.assertEqual(len(answer["results"]), 2000)
        self.assertIn("t_ns", self.station.session.status())

    def test_what_is_refused_says_where_and_what_cures_it(self):
        with self.assertRaises(Refused) as refused:
            self.station.goal.set(at="right_hnd", position=[0, 0, 1])
        self.assertEqual(refused.exception.code, "unknown_segment")
        self.assertEqual(refused.exception.path, "/params/at")
        self.assertIn("right_hand", refused.exception.hint)
        self.assertIn("right_hand", str(refused.exception))

    def test_the_daemon_knows_who_is_there(self):
        sessions = self.station.session.list()["sessions"]
        self.assertIn(("ana", "posed.py"), [(entry.get("user"), entry["client"]["name"]) for entry in sessions])

    def test_numbers_that_json_does_not_have_are_not_sent(self):
        with self.assertRaises(ValueError):
            self.station.goal.set(at="head", position=[0, 0, float("nan")])
        self.assertIn("t_ns", self.station.session.status())


class Streams(WithADaemon):
    def test_frames_come_and_answers_between_them(self):
        self.station.subscribe("tracker")
        seen = []
        while len(seen) < 5:
            seen.append(self.station.next_frame("tracker", PATIENCE))
            self.station.session.ping()
        self.assertTrue(all(frame["device"] == "simulated" for frame in seen))
        self.assertEqual(sorted(frame["t_ns"] for frame in seen), [frame["t_ns"] for frame in seen])
        self.station.unsubscribe("tracker")

    def test_who_does_not_look_wakes_to_what_is(self):
        self.station.subscribe("tracker")
        last = self.station.next_frame("tracker", PATIENCE)["t_ns"]
        counted = Posed(self.daemon.address, timeout=PATIENCE)
        self.addCleanup(counted.close)
        begun = counted.session.status()["frames"]
        while counted.session.status()["frames"] < begun + 240:
            time.sleep(0.01)
        woken = counted.session.ping()["send_t_ns"]
        stale = 0
        while self.station.next_frame("tracker", PATIENCE)["t_ns"] < woken:
            stale += 1
        self.assertLessEqual(stale, 4)  # three under way, and the newest that there was
        self.assertGreater(self.station.lost["tracker"], 100)
        self.assertLess(last, woken)

    def test_nothing_comes_in_time(self):
        self.station.subscribe("scene")
        self.assertIn("document", self.station.next_frame("scene", PATIENCE))
        self.assertIsNone(self.station.next_frame("scene", 0.01))

    def test_frames_end_with_their_loop(self):
        for frame in self.station.frames("tracker"):
            self.assertEqual(frame["device"], "simulated")
            break
        self.assertIn("t_ns", self.station.session.status())


class Connections(unittest.TestCase):
    def test_nobody_there(self):
        with self.assertRaisesRegex(Lost, "nothing listens"):
            Posed(nobody())

    def test_no_address(self):
        for address in ("http://localhost", "tcp://"):
            with self.assertRaises(ValueError):
                Posed(address)

    def test_a_daemon_that_is_started_anew_is_found_again(self):
        daemon = Daemon()
        self.addCleanup(daemon.close)
        with Posed(daemon.address, timeout=PATIENCE) as station:
            boot = station.boot
            frames = station.frames("tracker", patience=PATIENCE)
            next(frames)
            daemon.stop()
            daemon.start()
            self.assertEqual(next(frames)["device"], "simulated")
            self.assertNotEqual(station.boot, boot)

    def test_a_question_is_asked_again_and_an_edit_is_not(self):
        """A daemon that closes each first connection after the hello, without an answer."""
        listener = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(listener.close)
        asked = []

        def serve():
            for answers in (False, True, False, True):
                peer, _ = listener.accept()
                with peer, peer.makefile("rw", encoding="utf-8", newline="\n") as lines:
                    for line in lines:
                        request = json.loads(line)
                        if request["method"] != "session.hello":
                            asked.append(request["method"])
                            if not answers:
                                break
                        print(json.dumps({"jsonrpc": "2.0", "id": request["id"], "result": {"boot": "b"}}), file=lines, flush=True)

        server = threading.Thread(target=serve)
        server.start()
        with Posed(f"tcp://127.0.0.1:{listener.getsockname()[1]}", timeout=PATIENCE) as station:
            station.goal.list()
            station.close()
            with self.assertRaises(Lost):
                station.goal.set(at="head")
            station.goal.list()
        server.join(PATIENCE)
        self.assertEqual(asked, ["goal.list", "goal.list", "goal.set", "goal.list"])

    def test_errors_are_of_one_family(self):
        self.assertTrue(issubclass(Lost, PosedError) and issubclass(Refused, PosedError))
        self.assertTrue(issubclass(Lost, ConnectionError))


if __name__ == "__main__":
    unittest.main()
