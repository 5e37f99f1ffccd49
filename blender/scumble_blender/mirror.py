# SPDX-License-Identifier: GPL-3.0-or-later
"""What a server knows of a scene and a look, and what it must be told when they change. Knows nothing of Blender."""
import hashlib
from collections import Counter

import numpy as np


class Description:
    """A scene as it should be.

    textures: key to a dict with width, height, rgba (bytes, row 0 at the top).
    materials: key to what a material's edit says.
    meshes: key to a list of parts: dicts of arrays by their names in the protocol, and material.
    nodes: key to a dict with name, parent, transform, mesh, light, extras, and instances (n by 4 by 4, each
    transposed, so column-major), parents first.
    None in place of a texture or a mesh: it is as it was.
    """

    def __init__(self):
        self.textures, self.materials, self.meshes, self.nodes = {}, {}, {}, {}

    def keep_from(self, older):
        """What is as it was in one that has not been sent is as that says."""
        for mine, theirs in ((self.textures, older.textures), (self.meshes, older.meshes)):
            for key, value in mine.items():
                if value is None and theirs.get(key) is not None:
                    mine[key] = theirs[key]


class Behind(Exception):
    """A description leaves out what its reader took for known: it is to be read anew, all of it."""


def digest(value):
    """Of dicts, lists, numbers, texts and arrays, by what is in them."""
    hashed = hashlib.blake2b(digest_size=16)

    def add(item):
        if isinstance(item, np.ndarray):
            hashed.update(f"{item.dtype}{item.shape}".encode())
            hashed.update(np.ascontiguousarray(item))
        elif isinstance(item, dict):
            for key, inner in item.items():
                hashed.update(repr(key).encode())
                add(inner)
        elif isinstance(item, (list, tuple)):
            hashed.update(b"[")
            for inner in item:
                add(inner)
            hashed.update(b"]")
        else:
            hashed.update(repr(item).encode() + b",")

    add(value)
    return hashed.digest()


class Arena:
    """Arrays one after another in shared memory, until it is emptied."""

    def __init__(self, memory):
        self.memory = memory
        self.arrays, self.used = [], 0

    def put(self, array):
        array = np.ascontiguousarray(array)
        reference = {"memory": self.memory.name, "offset": self.used}
        self.arrays.append((self.used, array))
        self.used += -(-array.nbytes // 16) * 16
        return reference

    def write(self, server):
        if self.memory.reserve(self.used):
            server.call("share", memory=self.memory.name, file=self.memory.path, bytes=self.memory.bytes)
        for offset, array in self.arrays:
            self.memory.write(offset, array)


class SceneMirror:
    """One server's scene. `sent` counts what it has been told in all: edits of each kind, and bytes of arrays."""

    MOST = 2000  # edits at once: lines have limits
    KINDS = ("textures", "materials", "meshes", "nodes")
    WORDS = {"textures": "texture", "materials": "material", "meshes": "mesh", "nodes": "node"}

    def __init__(self, server, memory):
        self.server, self.memory = server, memory
        self.known = {kind: {} for kind in self.KINDS}  # digests by keys
        self.identity = {}  # of nodes: what cannot be changed
        self.is_whole = False  # whether the server has all that it was last to be told
        self.sent = Counter()

    def knows(self, kind, key):
        return key in self.known[kind]

    def sync(self, description):
        """Tells what is new, what is other than before, and what is gone."""
        self.is_whole = False
        arena, edits = Arena(self.memory), []
        fresh = {kind: {} for kind in self.KINDS}
        for kind in self.KINDS:
            for key, value in getattr(description, kind).items():
                if value is None:
                    if key not in self.known[kind]:
                        raise Behind(f"{key} is not known any more")
                    fresh[kind][key] = self.known[kind][key]
                else:
                    fresh[kind][key] = digest(value)

        def changed(kind, key):
            return self.known[kind].get(key) != fresh[kind][key]

        for key, texture in description.textures.items():
            if changed("textures", key):
                edits.append({"set": "texture", "key": key, "width": texture["width"],
                              "height": texture["height"], "rgba": arena.put(texture["rgba"])})
        for key, material in description.materials.items():
            if changed("materials", key):
                edits.append({"set": "material", "key": key, **material})
        for key, parts in description.meshes.items():
            if changed("meshes", key):
                edits.append({"set": "mesh", "key": key, "parts": [self._part(part, arena) for part in parts]})
        identity = {}
        for key, node in description.nodes.items():
            identity[key] = (node["parent"], identity.get(node["parent"]))
        gone = [key for key in self.known["nodes"] if identity.get(key) != self.identity.get(key)]
        # Children first: they were told after their parents.
        edits += [{"remove": "node", "key": key} for key in reversed(gone)]
        for key, node in description.nodes.items():
            if key in gone or changed("nodes", key):
                edits.append({"set": "node", "key": key, **self._node(node, arena)})
        for kind in ("meshes", "materials", "textures"):
            edits += [{"remove": self.WORDS[kind], "key": key} for key in self.known[kind]
                      if key not in fresh[kind]]
        # What has been told in part is not known any more.
        try:
            if edits:
                arena.write(self.server)
            for begin in range(0, len(edits), self.MOST):
                self.server.call("edit", edits=edits[begin:begin + self.MOST])
        except Exception:
            # What has been told in part is not known any more, neither here nor there.
            self.known, self.identity = {kind: {} for kind in self.KINDS}, {}
            if self.server.is_alive:
                self.server.call("clear")
            raise
        self.known, self.identity, self.is_whole = fresh, identity, True
        for edit in edits:
            self.sent["removals" if "remove" in edit else edit["set"]] += 1
        self.sent["bytes"] += sum(array.nbytes for _, array in arena.arrays)

    @staticmethod
    def _part(part, arena):
        described = {"material": part["material"]}
        for name, array in part.items():
            if name != "material":
                rows = array.size if name == "indices" else len(array)
                described[name] = {**arena.put(array), "count": rows}
        return described

    @staticmethod
    def _node(node, arena):
        described = dict(node)
        instances = described.pop("instances", None)
        if instances is not None:
            described["instances"] = {**arena.put(instances), "count": len(instances)}
        return described


class LookMirror:
    """One server's look: a base, by name or file, and knobs by paths."""

    def __init__(self, server):
        self.server = server
        self.base, self.knobs = None, {}
        self.is_whole = False  # as of scenes
        self.sent = Counter()

    def sync(self, base, knobs):
        """`base`: anything that differs when the look's file does; its first entry is the name or path."""
        self.is_whole = False
        # What a look declares stays declared until it is set anew.
        is_undeclared = any(path.startswith(("colorizers.", "decorations.")) and path not in knobs
                            for path in self.knobs)
        if base != self.base or is_undeclared:
            self.base, self.knobs = None, {}
            self.server.call("look", **({"look": base[0]} if base[0] else {}))
            self.base = base
            self.sent["looks"] += 1
        changed = {path: value for path, value in knobs.items() if self.knobs.get(path) != value}
        changed.update({path: None for path in self.knobs if path not in knobs})
        if changed:
            self.server.call("set", knobs=changed)
            self.sent["knobs"] += len(changed)
        self.knobs, self.is_whole = dict(knobs), True
