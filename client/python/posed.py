"""A client of posed in one file, of the standard library alone. Copy it beside your script.

    from posed import Posed

    with Posed() as station:                                   # or Posed("tcp://studio:19870", token="...")
        edit = station.goal.set(at="right_hand", position=[0.5, -0.3, 1.2])
        pose = station.pose.get(min_revision=edit["revision"], wait_ms=1000)
        for frame in station.frames("pose", max_rate_hz=60):   # the newest, whatever is in between
            print(frame["t_ns"], frame["figures"][0]["goals"])

Every method of proto/PROTOCOL.md is there by its name: station.scene.new(template="paper/sitting") is scene.new. What the
daemon refuses raises Refused, with its code, path and hint. A connection that is lost is made anew by the next call, and
by frames(), which subscribes again; a call whose reply was lost raises Lost, unless it only asked: then it is sent again.

Units are metres, radians and seconds; Z is up. One thread at a time.
"""
from __future__ import annotations

import json
import socket
import ssl
import time
from collections import deque
from contextlib import suppress
from typing import Any, Dict, Iterator, Optional
from urllib.parse import urlsplit

__all__ = ["Posed", "PosedError", "Refused", "Lost"]

JsonObject = Dict[str, Any]

DEFAULT_PORT = 19870
CREDIT = 3  # frames under way at most: who stalls wakes to what is, not to what was
KEPT = 1024  # frames that nobody has asked for yet
# They change nothing, so that asking twice does no harm.
ASKING = {"get", "list", "ping", "status", "hello", "solve", "batch", "subscribe", "unsubscribe", "history"}


class PosedError(Exception):
    """Anything that went wrong between here and the daemon."""


class Lost(PosedError, ConnectionError):
    """There is no daemon, it went away, or it did not answer in time."""


class Refused(PosedError):
    """The daemon said no. `code` as in "unknown_segment"; `path` is where in the request; `hint` is the cure."""

    def __init__(self, error: JsonObject) -> None:
        data = error.get("data") or {}
        self.code: str = data.get("code", str(error.get("code", "")))
        self.path: str = data.get("path", "")
        self.hint: str = data.get("hint", "")
        text = str(error.get("message", ""))
        super().__init__(text + (f" (at {self.path})" if self.path else "") + (f"; {self.hint}" if self.hint else ""))


class _Family:
    """station.goal: its attributes are the methods goal.*"""

    def __init__(self, station: "Posed", name: str) -> None:
        self._station, self._name = station, name

    def __getattr__(self, method: str) -> Any:
        if method.startswith("_"):
            raise AttributeError(method)
        return lambda **params: self._station.call(f"{self._name}.{method}", **params)

    def __call__(self, **params: Any) -> Any:  # a method without a family: station.solve(...)
        return self._station.call(self._name, **params)


class Posed:
    """A connection to a daemon at tcp://HOST:PORT, or tls://HOST:PORT. `timeout` is that of each call, in seconds."""

    def __init__(self, address: str = "tcp://127.0.0.1", *, token: Optional[str] = None, user: str = "",
                 timeout: float = 5.0, tls: Optional[ssl.SSLContext] = None) -> None:
        parts = urlsplit(address if "://" in address else f"tcp://{address}")
        if parts.scheme not in ("tcp", "tls") or not parts.hostname:
            raise ValueError(f"{address} is no address; as in tcp://127.0.0.1:{DEFAULT_PORT}")
        self.host: str = parts.hostname
        self.port: int = parts.port or DEFAULT_PORT
        self.timeout = timeout
        self.boot = ""  # another one: the daemon was started anew
        self.lost: Dict[str, int] = {}  # frames of each stream that were left out since we read too slowly
        self._token, self._user = token, user
        self._tls = tls or (ssl.create_default_context() if parts.scheme == "tls" else None)
        self._socket: Optional[socket.socket] = None
        self._buffer, self._searched = bytearray(), 0  # so far without a line's end
        self._next_id = 1
        self._subscriptions: Dict[str, JsonObject] = {}
        self._frames: Dict[str, "deque[JsonObject]"] = {}
        self._connect()

    # ---- calls ----

    def call(self, method: str, **params: Any) -> Any:
        """The result of any method of the protocol. None means null: for X.set, back to the default."""
        for attempt in (1, 2):
            self._connect()
            try:
                return self._exchange(method, params)
            except Lost:
                self.close()
                if attempt == 2 or method.rsplit(".", 1)[-1] not in ASKING:
                    raise
        raise AssertionError("unreachable")

    def __getattr__(self, family: str) -> _Family:
        if family.startswith("_"):
            raise AttributeError(family)
        return _Family(self, family)

    # ---- streams ----

    def subscribe(self, stream: str, **options: Any) -> None:
        """Asks for a stream; next_frame() and frames() read it. Options as in stream.subscribe."""
        wish = {"stream": stream, **options}
        if stream != "scene":  # which is never thinned
            wish.setdefault("credit", CREDIT)
        self.call("stream.subscribe", **wish)
        self._frames.pop(stream, None)  # what came before the reply is the old subscription's
        self._subscriptions[stream] = wish

    def unsubscribe(self, stream: str) -> None:
        self._subscriptions.pop(stream, None)
        self.call("stream.unsubscribe", stream=stream)
        self._frames.pop(stream, None)

    def next_frame(self, stream: str, timeout: Optional[float] = None) -> Optional[JsonObject]:
        """The next frame's data, or None when the time (in seconds; None: no end) is over."""
        until = None if timeout is None else time.monotonic() + timeout
        while True:
            kept = self._frames.get(stream)
            if kept:
                frame = kept.popleft()
                if self._subscriptions.get(stream, {}).get("credit"):
                    self._send({"method": "stream.ack", "params": {"stream": stream, "seq": frame["seq"]}})
                return frame["data"]
            try:
                self._keep(self._receive(until))
            except TimeoutError:
                return None

    def frames(self, stream: str, patience: float = 30.0, **options: Any) -> Iterator[JsonObject]:
        """Every frame that comes, without end. A lost connection is made anew; Lost when that fails for `patience` s."""
        self.subscribe(stream, **options)
        try:
            while stream in self._subscriptions:
                try:
                    frame = self.next_frame(stream, 3600.0)
                except Lost:
                    self._reconnect(patience)
                    continue
                if frame is not None:
                    yield frame
        finally:
            self._subscriptions.pop(stream, None)
            if self._socket:
                with suppress(Lost):
                    self.unsubscribe(stream)

    # ---- the connection ----

    def close(self) -> None:
        if self._socket:
            self._socket.close()
        self._socket, self._searched = None, 0
        self._buffer.clear()
        self._frames.clear()

    def __enter__(self) -> "Posed":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def _connect(self) -> None:
        if self._socket:
            return
        where = f"{self.host}:{self.port}"
        try:
            plain = socket.create_connection((self.host, self.port), timeout=self.timeout)
            plain.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._socket = self._tls.wrap_socket(plain, server_hostname=self.host) if self._tls else plain
        except ConnectionRefusedError as error:
            raise Lost(f"nothing listens at {where}; start the daemon with ./deploy/run") from error
        except (OSError, ssl.SSLError) as error:
            raise Lost(f"cannot connect to {where}: {error}") from error
        try:
            hello: JsonObject = {"client": {"name": "posed.py", "version": "1"}, "user": self._user}
            if self._token is not None:
                hello["token"] = self._token
            self.boot = self._exchange("session.hello", hello)["boot"]
            for wish in self._subscriptions.values():
                self._exchange("stream.subscribe", wish)
        except PosedError:
            self.close()
            raise

    def _reconnect(self, patience: float) -> None:
        until, pause = time.monotonic() + patience, 0.05
        while True:
            self.close()
            try:
                return self._connect()
            except Lost:
                if time.monotonic() + pause > until:
                    raise
                time.sleep(pause)
                pause = min(2.0 * pause, 2.0)

    def _exchange(self, method: str, params: JsonObject) -> Any:
        number, self._next_id = self._next_id, self._next_id + 1
        self._send({"id": number, "method": method, "params": params})
        until = time.monotonic() + self.timeout
        while True:
            try:
                message = self._receive(until)
            except TimeoutError as error:
                raise Lost(f"{self.host}:{self.port} did not answer {method} within {self.timeout} s") from error
            if "method" in message:
                self._keep(message)
            elif message.get("id") in (number, None):
                # An error without an id is said of the whole connection, before it is closed.
                if "error" in message:
                    raise Refused(message["error"])
                return message["result"]

    def _send(self, message: JsonObject) -> None:
        line = json.dumps({"jsonrpc": "2.0", **message}, allow_nan=False, separators=(",", ":")).encode() + b"\n"
        if not self._socket:
            raise Lost("the connection is closed")
        try:
            self._socket.settimeout(self.timeout)
            self._socket.sendall(line)
        except OSError as error:
            raise Lost(f"the connection is lost: {error}") from error

    def _receive(self, until: Optional[float]) -> JsonObject:
        """The next message. TimeoutError when the time is over."""
        while (end := self._buffer.find(b"\n", self._searched)) < 0:
            self._searched = len(self._buffer)
            if not self._socket:
                raise Lost("the connection is closed")
            left = None if until is None else until - time.monotonic()
            if left is not None and left <= 0:
                raise TimeoutError
            try:
                self._socket.settimeout(left)
                got = self._socket.recv(1 << 16)
            except socket.timeout as error:
                raise TimeoutError from error
            except OSError as error:
                raise Lost(f"the connection is lost: {error}") from error
            if not got:
                raise Lost("the daemon has closed the connection")
            self._buffer += got
        line = self._buffer[:end]
        del self._buffer[: end + 1]
        self._searched = 0
        return json.loads(line)

    def _keep(self, message: JsonObject) -> None:
        params = message.get("params", {})
        stream = params.get("stream", "")
        if message.get("method") == "stream.frame":
            self._frames.setdefault(stream, deque(maxlen=KEPT)).append(params)
        elif message.get("method") == "stream.lost":
            self.lost[stream] = self.lost.get(stream, 0) + params["dropped"]
        elif "error" in message:
            raise Refused(message["error"])
