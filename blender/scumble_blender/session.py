# SPDX-License-Identifier: GPL-3.0-or-later
"""A server with what it knows: described, drawn, and started anew after it has died. Knows nothing of Blender."""
import threading

import numpy as np

from .mirror import Behind, LookMirror, SceneMirror
from .server import ScumbleError, Server, ServerGone, SharedMemory

DTYPES = {"float32": np.float32, "float16": np.float16, "srgb8": np.uint8}


class Session:
    """One thread at a time uses it, in a `with`."""

    def __init__(self, program, arguments=()):
        self._lock = threading.RLock()
        self.program, self.arguments = program, tuple(arguments)
        self.server = None
        self._is_closed = False

    def __enter__(self):
        self._lock.acquire()
        return self

    def __exit__(self, *_):
        self._lock.release()

    def start(self):
        """Does nothing where a server runs."""
        if self._is_closed:
            raise ServerGone("the add-on has been turned off")
        if self.server is not None and self.server.is_alive:
            return
        self._end()
        server = Server(self.program, self.arguments)
        self._arrays, self._pictures = SharedMemory("arrays"), SharedMemory("pictures")
        self.scene, self.look = SceneMirror(server, self._arrays), LookMirror(server)
        self.server = server

    def close(self):
        """For good."""
        self._is_closed = True
        with self:
            self._end()

    def _end(self):
        if self.server is not None:
            self.server.close()
            self._arrays.close()
            self._pictures.close()
            self.server = None

    @property
    def is_whole(self):
        """Whether the server has the scene and the look that it was last to be told."""
        return self.scene.is_whole and self.look.is_whole

    def knows(self, kind, key):
        server = self.server
        return server is not None and server.is_alive and self.scene.knows(kind, key)

    def sent(self):
        """What the server that runs has been told: lines, bytes of lines and of arrays, edits of each kind, knobs."""
        return {**self.scene.sent, **self.look.sent, "lines": self.server.messages, "lineBytes": self.server.bytes}

    def count(self):
        """How much of each kind there is, and how many nodes there ever were."""
        return self.server.call("edit", edits=[])

    def remember(self):
        self.server.call("remember")

    def render(self, size, views, time, aovs=(), region=None, formats=None, is_unwanted=lambda: False,
               tell=lambda part: None, **options):
        """A dict of lists, an array of rows by columns by channels for each view, by names; and what was said."""
        pixels = (region[2] * region[3]) if region else size[0] * size[1]
        # Of the channels that one can have there are eight at most.
        room = pixels * len(views) * 16 + sum(pixels * len(views) * 4 * (8 if name == "cryptomatte" else 4)
                                              for name in aovs)
        if self._pictures.reserve(room):
            self.server.call("share", memory="pictures", file=self._pictures.path, bytes=self._pictures.bytes)
        members = {"size": list(size), "views": views, "time": time, "aovs": list(aovs),
                   "into": {"memory": "pictures", "count": self._pictures.bytes}, **options}
        if region:
            members["region"] = list(region)
        if formats:
            members["formats"] = formats
        done = self.server.wait(self.server.ask("render", **members), is_unwanted, tell)
        pictures = {}
        for layer in done["layers"]:
            array = self._pictures.read(layer["offset"], DTYPES[layer["format"]],
                                        (layer["height"], layer["width"], len(layer["channels"])))
            pictures.setdefault(layer["name"], []).append(array)
        return pictures, done


class Sessions:
    """Those that run, by what they are for."""

    def __init__(self):
        self._lock = threading.Lock()
        self._sessions = {}

    def get(self, purpose, program, arguments=()):
        with self._lock:
            session = self._sessions.get(purpose)
            if session is None or (session.program, session.arguments) != (program, tuple(arguments)):
                if session is not None:
                    session.close()
                session = self._sessions[purpose] = Session(program, arguments)
            return session

    def close(self):
        with self._lock:
            for session in self._sessions.values():
                session.close()
            self._sessions.clear()


__all__ = ["Behind", "ScumbleError", "ServerGone", "Session", "Sessions"]
