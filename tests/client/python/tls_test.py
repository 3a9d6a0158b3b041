"""client/python/posed.py through TLS, with a token."""
import hashlib
import shutil
import ssl
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from daemon import BIN, TOP, Daemon

sys.path.insert(0, str(TOP / "client" / "python"))
from posed import Lost, Posed, Refused  # noqa: E402

PATIENCE = 60.0


@unittest.skipUnless(shutil.which("openssl"), "SKIPPED: there is no openssl to make a certificate with")
class Tls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="posed-tls-")
        cls.certificate, key, tokens = (str(Path(cls.folder.name, name)) for name in ("cert.pem", "key.pem", "tokens"))
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2",
                        "-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost", "-keyout", key, "-out",
                        cls.certificate], check=True, capture_output=True)
        Path(tokens).write_text(f"viewer ana sha256:{hashlib.sha256(b'let me look').hexdigest()}\n", encoding="utf-8")
        cls.daemon = Daemon("--tls.certificate", cls.certificate, "--tls.key", key, "--auth.tokens", tokens)
        cls.address = cls.daemon.address.replace("tcp://127.0.0.1", "tls://localhost")

    @classmethod
    def tearDownClass(cls):
        cls.daemon.close()
        cls.folder.cleanup()

    def test_a_viewer_looks_and_may_not_edit(self):
        trusted = ssl.create_default_context(cafile=self.certificate)
        with Posed(self.address, token="let me look", tls=trusted, timeout=PATIENCE) as station:
            frames = station.frames("tracker")
            for _ in range(50):
                self.assertEqual(next(frames)["device"], "simulated")
            self.assertIn("ana", [entry.get("user") for entry in station.session.list()["sessions"]])
            with self.assertRaises(Refused) as refused:
                station.goal.set(at="head", position=[0, 0, 1.6])
            self.assertEqual(refused.exception.code, "forbidden")

    def test_without_the_token_nothing_is_told(self):
        trusted = ssl.create_default_context(cafile=self.certificate)
        for token in (None, "let me look!"):
            with self.assertRaises(Refused) as refused:
                Posed(self.address, token=token, tls=trusted, timeout=PATIENCE)
            self.assertEqual(refused.exception.code, "unauthorized")

    def test_posectl_goes_the_same_way(self):
        def posectl(*words):
            return subprocess.run([BIN / "posectl", "--host", self.address, *words], capture_output=True, text=True,
                                  timeout=PATIENCE, check=False)

        trusted = ("--authority", self.certificate)
        status = posectl(*trusted, "--token", "let me look", "status")
        self.assertEqual(status.returncode, 0, status.stderr)
        self.assertIn("up ", status.stdout)
        watched = posectl(*trusted, "--token", "let me look", "watch", "tracker", "--csv", "--count", "20")
        self.assertEqual(watched.returncode, 0, watched.stderr)
        self.assertGreater(watched.stdout.count("simulated:1"), 15)
        self.assertEqual(posectl(*trusted, "--token", "let me look", "goal", "clear").returncode, 1)
        self.assertEqual(posectl(*trusted, "status").returncode, 1)
        self.assertEqual(posectl("--token", "let me look", "status").returncode, 3)

    def test_a_certificate_of_nobody_is_not_trusted(self):
        with self.assertRaisesRegex(Lost, "certificate"):
            Posed(self.address, token="let me look", timeout=PATIENCE)


if __name__ == "__main__":
    unittest.main()
