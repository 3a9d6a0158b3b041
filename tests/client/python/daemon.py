"""A daemon for the tests: a free port, data in a folder of its own."""
import os
import re
import socket
import subprocess
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]
BIN = Path(os.environ.get("POSED_BIN", TOP / "build" / "dev" / "bin"))


class Daemon:
    def __init__(self, *options):
        self.folder = tempfile.TemporaryDirectory(prefix="posed-python-")
        self.options = options
        self.port = 0
        self.start()

    def start(self):
        """Again at the same port, if it has run before."""
        self.process = subprocess.Popen(
            [BIN / "posed", "--listen", f"127.0.0.1:{self.port}", "--data", self.folder.name, "--tracker", "simulated",
             "--log", "error", *self.options], stdout=subprocess.PIPE, text=True)
        found = re.search(r":(\d+)/", self.process.stdout.readline())
        if not found:
            raise RuntimeError("posed did not start")
        self.port = int(found.group(1))
        self.address = f"tcp://127.0.0.1:{self.port}"

    def stop(self):
        self.process.terminate()
        self.process.wait(60)
        self.process.stdout.close()

    def close(self):
        self.stop()
        self.folder.cleanup()


def nobody():
    """An address where nothing listens."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return f"tcp://127.0.0.1:{free.getsockname()[1]}"
