# SPDX-License-Identifier: GPL-3.0-or-later
"""A running `scumble serve`: requests, answers, and the memory that both share. Knows nothing of Blender.

The protocol is docs/serve.md of scumble.
"""
import json
import mmap
import os
import subprocess
import tempfile
import threading
import time

import numpy as np

PROTOCOL = 1
PATIENCE = 10  # seconds for what was cancelled to end
GREETING = 60  # seconds for the first word


class ScumbleError(Exception):
    """What scumble says is wrong, in its words."""

    def __init__(self, message, kind="usage"):
        super().__init__(message)
        self.kind = kind


class ServerGone(ScumbleError):
    """The process has ended, or was never there."""

    def __init__(self, message):
        super().__init__(message, "gone")


class SharedMemory:
    """Memory that grows as needed, and is gone with this process: a file without a name, which the server opens by
    way of this process where the system has one (Linux), and otherwise by its name."""

    def __init__(self, name):
        self.name = name
        folder = "/dev/shm" if os.path.isdir("/dev/shm") and os.access("/dev/shm", os.W_OK) else None
        self._file = tempfile.TemporaryFile(dir=folder)
        self.path = f"/proc/{os.getpid()}/fd/{self._file.fileno()}"
        if not os.path.exists(self.path):
            self._file.close()
            self._file = tempfile.NamedTemporaryFile(prefix="scumble-", dir=folder)
            self.path = self._file.name
        self.bytes = 0
        self._map = None

    def reserve(self, count):
        """Whether it had to grow to hold so many bytes."""
        if count <= self.bytes:
            return False
        self.bytes = max(count, 2 * self.bytes, 1 << 20)
        os.truncate(self._file.fileno(), self.bytes)
        self._map = mmap.mmap(self._file.fileno(), self.bytes)
        return True

    def write(self, offset, array):
        self._map[offset:offset + array.nbytes] = memoryview(array).cast("B") if array.nbytes else b""

    def read(self, offset, dtype, shape):
        return np.frombuffer(self._map, dtype, int(np.prod(shape)), offset).reshape(shape).copy()

    def close(self):
        self._map = None
        self._file.close()


class Request:
    """One that is under way."""

    def __init__(self, number):
        self.number = number
        self.progress = 0.0
        self.reply = None
        self.changed = threading.Event()

    @property
    def is_done(self):
        return self.reply is not None

    def result(self):
        if "error" in self.reply:
            error = self.reply["error"]
            if error["kind"] == "gone":
                raise ServerGone(error["message"])
            raise ScumbleError(error["message"], error["kind"])
        return self.reply["done"]


class Server:
    """One process. Any thread may ask; answers are read by a thread of its own, which calls nobody."""

    def __init__(self, program, arguments=()):
        try:
            self._process = subprocess.Popen([program, "serve", *arguments], stdin=subprocess.PIPE,
                                             stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        except OSError as error:
            raise ServerGone(f"'{program}' cannot be run ({error.strerror}); set where scumble is in the "
                             "add-on's preferences") from None
        self.messages = self.bytes = 0  # sent so far, as lines
        self._lock = threading.Lock()
        self._open = {}
        self._last = 0
        self._said = []
        self._is_gone = False
        self._greeted = threading.Event()
        self.greeting = None
        self._errors = threading.Thread(target=self._listen_to_errors, daemon=True)
        self._errors.start()
        threading.Thread(target=self._listen, daemon=True).start()
        if not self._greeted.wait(GREETING):
            self.kill()
            raise ServerGone(f"scumble has not said a word in {GREETING} s")
        if not isinstance(self.greeting, dict):
            self.kill()
            self._errors.join(5)
            raise ServerGone("scumble did not start: " + (self.words() or "it said nothing"))
        if self.greeting.get("protocol") != PROTOCOL:
            self.kill()
            raise ServerGone(f"scumble {self.greeting.get('scumble')} speaks another protocol than this "
                             "add-on; install the two of one version")

    @property
    def pid(self):
        return self._process.pid

    @property
    def is_alive(self):
        return not self._is_gone and self._process.poll() is None

    def words(self):
        """The last lines that it has written to stderr."""
        return " ".join(self._said[-4:])

    def _listen_to_errors(self):
        for line in self._process.stderr:
            self._said.append(line.decode("utf-8", "replace").strip())
            del self._said[:-20]

    def _listen(self):
        for line in self._process.stdout:
            try:
                message = json.loads(line)
            except ValueError:
                break
            if not self._greeted.is_set():
                self.greeting = message
                self._greeted.set()
                continue
            number = message.get("id")
            with self._lock:
                if number is None:
                    # Of a line that was no request: whose it was cannot be told, and nobody else will.
                    requests, self._open = list(self._open.values()), {}
                elif "progress" in message:
                    requests = []
                    if number in self._open:
                        self._open[number].progress = message["progress"]
                else:
                    requests = [self._open.pop(number)] if number in self._open else []
                for request in requests:
                    request.reply = message
            for request in requests:
                request.changed.set()
        with self._lock:
            self._is_gone = True
        self._greeted.set()
        self.kill()
        code = self._process.wait()
        self._errors.join(5)
        self._lose(f"scumble has ended ({'signal' if code < 0 else 'exit code'} {abs(code)})"
                   + (f": {self.words()}" if self.words() else ""))

    def kill(self):
        """Does nothing to one that has ended by itself."""
        try:
            self._process.wait(0.2)
        except subprocess.TimeoutExpired:
            self._process.kill()

    def _lose(self, message):
        with self._lock:
            self._is_gone = True
            lost, self._open = self._open, {}
        for request in lost.values():
            request.reply = {"error": {"kind": "gone", "message": message}}
            request.changed.set()

    def ask(self, do, **members):
        """Sends a request, and returns at once."""
        with self._lock:
            if self._is_gone:
                raise ServerGone("scumble has ended" + (f": {self.words()}" if self.words() else ""))
            self._last += 1
            request = Request(self._last)
            try:
                line = json.dumps({"id": request.number, "do": do, **members}, allow_nan=False).encode() + b"\n"
            except ValueError as error:
                raise ScumbleError(f"something cannot be sent: {error}") from None
            self._open[request.number] = request
            self.messages += 1
            self.bytes += len(line)
            try:
                self._process.stdin.write(line)
                self._process.stdin.flush()
            except (OSError, ValueError):
                pass  # its end is told by the thread that listens
        return request

    def wait(self, request, is_unwanted=lambda: False, tell=lambda part: None):
        """Its result. `is_unwanted` is asked, and `tell` told the part that is done, ten times a second. A server
        that goes on for long with what is unwanted is ended."""
        cancelled_at = None
        while not request.is_done:
            request.changed.wait(0.1)
            request.changed.clear()
            tell(request.progress)
            if cancelled_at is None and not request.is_done and is_unwanted():
                cancelled_at = time.monotonic()
                self.ask("cancel", of=request.number)
            elif cancelled_at is not None and time.monotonic() - cancelled_at > PATIENCE:
                self._process.kill()
        return request.result()

    def call(self, do, **members):
        return self.wait(self.ask(do, **members))

    def close(self):
        try:
            self._process.stdin.close()
        except OSError:
            pass
        try:
            self._process.wait(2)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
