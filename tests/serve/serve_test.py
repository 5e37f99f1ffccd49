#!/usr/bin/env python3
"""`scumble serve`, by a client of its own.

    serve_test.py PROGRAM [TEST...]
"""
import hashlib
import json
import mmap
import os
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1)
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
SQUARE = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
FRONT = {"eye": [0, 0, 5], "target": [0, 0, 0]}


class Memory:
    def __init__(self, name, size):
        folder = "/dev/shm" if os.path.isdir("/dev/shm") else None
        self.file = tempfile.NamedTemporaryFile(prefix="scumble-test-", dir=folder)
        self.file.truncate(size)
        self.name, self.size, self.used = name, size, 0
        self.map = mmap.mmap(self.file.fileno(), size)

    def put(self, kind, values, columns):
        """Numbers, as a reference to them."""
        values = [x for row in values for x in (row if columns > 1 else (row,))]
        data = struct.pack(f"<{len(values)}{kind}", *values)
        self.map[self.used:self.used + len(data)] = data
        reference = {"memory": self.name, "offset": self.used, "count": len(values) // columns}
        self.used += -(-len(data) // 16) * 16
        return reference


class Pixels(bytes):
    def __repr__(self):
        return f"<pixels {hashlib.sha1(self).hexdigest()[:8]}>"


class Client:
    def __init__(self, *arguments):
        self.process = subprocess.Popen([PROGRAM, "serve", "--validate", *arguments], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE)
        self.greeting = json.loads(self.process.stdout.readline())
        self.last = 0

    def write(self, line):
        self.process.stdin.write(line if isinstance(line, bytes) else line.encode())
        self.process.stdin.flush()

    def send(self, do, **members):
        self.last += 1
        self.write(json.dumps({"id": self.last, "do": do, **members}) + "\n")
        return self.last

    def read(self):
        line = self.process.stdout.readline()
        return json.loads(line) if line else None

    def answer(self, number):
        while True:
            message = self.read()
            if message is None:
                raise AssertionError("the server has gone")
            if message["id"] == number and "progress" not in message:
                return message

    def ask(self, do, **members):
        reply = self.answer(self.send(do, **members))
        if "error" in reply:
            raise AssertionError(reply["error"]["message"])
        return reply["done"]

    def refused(self, do, **members):
        reply = self.answer(self.send(do, **members))
        if "error" not in reply:
            raise AssertionError(f"{do} was done: {reply}")
        return reply["error"]

    def close(self):
        self.process.stdin.close()
        code = self.process.wait(60)
        self.process.stdout.close()
        return code


class Case(unittest.TestCase):
    """One process serves all tests of a class; each begins with nothing in its scene."""

    @classmethod
    def setUpClass(cls):
        cls.client = Client()
        cls.out = Memory("out", 32 << 20)
        cls.client.ask("share", memory="out", file=cls.out.file.name, bytes=cls.out.size)

    @classmethod
    def tearDownClass(cls):
        assert cls.client.close() == 0

    def setUp(self):
        self.client.ask("clear")
        self.client.ask("look")
        self.data = Memory("data", 1 << 20)
        self.client.ask("share", memory="data", file=self.data.file.name, bytes=self.data.size)

    def square(self, z=0.0):
        return {"positions": self.data.put("f", [(x, y, z) for x, y, _ in SQUARE], 3),
                "indices": self.data.put("I", [0, 1, 2, 0, 2, 3], 1), "material": "red"}

    def red_square(self):
        return [{"set": "material", "key": "red", "name": "Red", "baseColor": [0.8, 0.1, 0.1, 1]},
                {"set": "mesh", "key": "square", "parts": [self.square()]},
                {"set": "node", "key": "one", "mesh": "square"}]

    def frame(self, **members):
        """Pictures by name and view: the layer, and its bytes."""
        done = self.client.ask("render", **{"size": [96, 64], "samples": 1, "viewpoint": FRONT,
                                            "into": {"memory": "out", "count": self.out.size}, **members})
        sizes = {"float32": 4, "float16": 2, "srgb8": 1}
        pictures = {}
        for layer in done["layers"]:
            size = layer["width"] * layer["height"] * len(layer["channels"]) * sizes[layer["format"]]
            pictures[layer["name"], layer["view"]] = (layer, self.out.map[layer["offset"]:layer["offset"] + size])
        return pictures, done

    def picture(self, **members):
        return Pixels(self.frame(**members)[0]["picture", 0][1])


class Served(Case):
    def test_greets(self):
        self.assertEqual(self.client.greeting["protocol"], 1)
        names = [aov["name"] for aov in self.client.greeting["aovs"]]
        self.assertIn("warp", names)
        self.assertTrue(self.client.greeting["device"])

    def test_paints_what_it_is_told(self):
        empty = self.picture()
        self.assertEqual(self.client.ask("edit", edits=self.red_square()),
                         {"materials": 1, "meshes": 1, "nodes": 1, "textures": 0, "nodesEver": 1})
        now, done = self.frame(formats={"picture": "srgb8"})
        layer, codes = now["picture", 0]
        self.assertEqual((layer["width"], layer["height"], layer["channels"], layer["format"]),
                         (96, 64, ["R", "G", "B", "A"], "srgb8"))
        red, green, blue, _ = codes[4 * (32 * 96 + 48):][:4]
        self.assertGreater(red, 2 * max(green, blue))
        self.assertNotEqual(empty, self.picture())
        self.assertEqual(done["warnings"], [])
        self.assertGreater(done["stats"]["triangles"], 0)

    def test_formats_hold_the_same_colors(self):
        self.client.ask("edit", edits=self.red_square())
        floats = struct.unpack(f"<{96 * 64 * 4}f", self.picture())
        codes = self.picture(formats={"picture": "srgb8"})
        halves = struct.unpack(f"<{96 * 64 * 4}e", self.picture(formats={"picture": "float16"}))
        for at in range(0, len(floats), 401):
            self.assertAlmostEqual(halves[at], floats[at], 3)
            if at % 4 < 3:
                linear = max(floats[at], 0)
                curve = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
                self.assertLessEqual(abs(codes[at] - 255 * min(curve, 1)), 0.51)

    def test_a_region_is_a_part(self):
        self.client.ask("edit", edits=self.red_square())
        whole = self.picture()
        part = self.frame(region=[10, 20, 50, 30], aovs=["depth", "shadow-map"])[0]
        layer, pixels = part["picture", 0]
        self.assertEqual((layer["width"], layer["height"]), (50, 30))
        rows = [whole[16 * (96 * y + 10):16 * (96 * y + 60)] for y in range(20, 50)]
        self.assertEqual(pixels, b"".join(rows))
        self.assertEqual(part["depth", 0][0]["width"], 50)
        self.assertEqual(part["shadow-map", 0][0]["width"], 2048)

    def test_both_eyes(self):
        self.client.ask("edit", edits=self.red_square())
        now, _ = self.frame(viewpoint={**FRONT, "stereo": True, "ipd": 0.5}, aovs=["depth"])
        self.assertEqual(set(now), {("picture", 0), ("picture", 1), ("depth", 0), ("depth", 1)})
        self.assertNotEqual(now["picture", 0][1], now["picture", 1][1])

    def test_views_by_matrices(self):
        self.client.ask("edit", edits=self.red_square())
        tangent = 0.30573068  # of half of 34 degrees, the program's own angle
        clip = [1 / tangent * 64 / 96, 0, 0, 0, 0, -1 / tangent, 0, 0, 0, 0, 0, -1, 0, 0, 0.01, 0]
        away = list(IDENTITY)
        away[14] = -5
        mine = self.frame(viewpoint=None, views=[{"worldToEye": away, "eyeToClip": clip}], aovs=["depth"])[0]
        self.assertAlmostEqual(struct.unpack_from("<f", mine["depth", 0][1], 4 * (32 * 96 + 48))[0], 5, 3)

    def test_steps_lead_to_the_same_bytes(self):
        self.client.ask("edit", edits=self.red_square())
        self.picture()
        moved = list(IDENTITY)
        moved[12] = 0.5
        self.client.ask("edit", edits=[{"set": "node", "key": "one", "transform": moved},
                                       {"set": "material", "key": "red", "name": "Red", "baseColor": [0, 0.5, 0, 1]},
                                       {"set": "mesh", "key": "square", "parts": [self.square(0.5)]}])
        by_steps = self.picture()
        self.client.ask("clear")
        self.client.ask("edit", edits=[{"set": "material", "key": "red", "name": "Red", "baseColor": [0, 0.5, 0, 1]},
                                       {"set": "mesh", "key": "square", "parts": [self.square(0.5)]},
                                       {"set": "node", "key": "one", "mesh": "square", "transform": moved}])
        self.assertEqual(by_steps, self.picture())

    def test_only_what_changed_goes_to_the_device(self):
        self.client.ask("edit", edits=self.red_square())
        self.picture()
        moved = list(IDENTITY)
        moved[12] = 0.1
        self.client.ask("edit", edits=[{"set": "node", "key": "one", "transform": moved}])
        stats = self.frame()[1]["stats"]
        self.assertEqual((stats["writtenTextures"], stats["pipelines"]), (0, 0))

    def test_textures_instances_lights_and_visibility(self):
        rgba = self.data.put("B", [0, 255, 0, 255] * 4, 1)
        del rgba["count"]
        self.client.ask("edit", edits=self.red_square() + [
            {"set": "texture", "key": "green", "width": 2, "height": 2, "rgba": rgba},
            {"set": "material", "key": "red", "name": "Red", "baseColorTexture": {"texture": "green"}}])
        green = self.picture(formats={"picture": "srgb8"})
        r, g, b, _ = green[4 * (32 * 96 + 48):][:4]
        self.assertGreater(g, 2 * max(r, b))
        left, right = list(IDENTITY), list(IDENTITY)
        left[12], right[12] = -1, 1
        places = self.data.put("f", left + right, 1)
        self.client.ask("edit", edits=[{"set": "node", "key": "one",
                                        "instances": {**places, "count": 2}}])
        two = self.picture()
        self.client.ask("edit", edits=[{"set": "node", "key": "one", "visible": False}])
        none = self.picture()
        self.client.ask("edit", edits=[{"set": "node", "key": "one", "visible": True},
                                       {"set": "node", "key": "lamp", "light": {"kind": "directional"},
                                        "transform": [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1]}])
        lit = self.picture()
        self.assertEqual(len({two, none, lit}), 3)
        self.client.ask("edit", edits=[{"set": "node", "key": "lamp", "light": {"kind": "none"}}])
        self.assertEqual(self.picture(), two)

    def test_what_is_removed_is_gone_and_its_place_used_again(self):
        empty = self.picture()
        for _ in range(3):
            counts = self.client.ask("edit", edits=self.red_square())
            self.picture()
            self.client.ask("edit", edits=[{"remove": "node", "key": "one"}, {"remove": "mesh", "key": "square"},
                                           {"remove": "material", "key": "red"}])
            self.assertEqual(self.picture(), empty)
        self.assertEqual(counts["nodesEver"], 1)

    def test_what_is_used_stays(self):
        self.client.ask("edit", edits=self.red_square() + [{"set": "node", "key": "two", "parent": "one"}])
        for edit in ({"remove": "mesh", "key": "square"}, {"remove": "material", "key": "red"},
                     {"remove": "node", "key": "one"}):
            error = self.client.refused("edit", edits=[edit])
            self.assertEqual((error["kind"], error["where"]), ("usage", "edits[0]"))
            self.assertIn("belongs to", error["problem"])

    def test_names_are_those_of_looks(self):
        self.client.ask("edit", edits=self.red_square())
        plain = self.picture()
        self.client.ask("set", knobs={"nodes.Door.palette.litTint": "#0000FF", "nodes.Door.palette.litTintAmount": 2})
        self.assertEqual(self.picture(), plain)
        self.client.ask("edit", edits=[{"set": "node", "key": "one", "name": "Door"}])
        self.assertNotEqual(self.picture(), plain)

    def test_looks_and_knobs(self):
        self.client.ask("edit", edits=self.red_square())
        plain = self.picture()
        self.assertTrue(self.client.ask("look", look="ink")["description"])
        ink = self.picture()
        self.assertNotEqual(plain, ink)
        self.client.ask("look", look={"extends": "ink"})
        self.assertEqual(self.picture(), ink)
        self.client.ask("look")
        self.client.ask("set", knobs={"warp.amount": 6, "palette.litTint": "#336699",
                                      "shadow.threshold": {"keys": [[0, 0.2], [1, 0.8]]}})
        self.assertNotEqual(self.picture(), plain)
        self.client.ask("set", knobs={"warp.amount": None, "palette.litTint": None, "shadow.threshold": None})
        self.assertEqual(self.picture(), plain)
        # All of them or none.
        error = self.client.refused("set", knobs={"warp.amount": 6, "warp.amuont": 6})
        self.assertEqual(error["where"], "knobs.warp.amuont")
        self.assertEqual(self.picture(), plain)
        self.assertEqual(self.client.refused("look", look="no-such")["kind"], "usage")
        self.assertEqual(self.client.refused("look", look="/no/such.json")["kind"], "unusable-file")
        self.assertIn("warp.amuont", self.client.refused("look", look={"warp": {"amuont": 1}})["message"])
        self.assertEqual(self.picture(), plain)

    def test_motion(self):
        self.client.ask("edit", edits=self.red_square())
        self.client.ask("remember")
        moved = list(IDENTITY)
        moved[12] = 0.25
        self.client.ask("edit", edits=[{"set": "node", "key": "one", "transform": moved}])
        now, _ = self.frame(aovs=["motion"], previous={"time": 0, "remembered": True})
        x, y = struct.unpack_from("<2f", now["motion", 0][1], 8 * (32 * 96 + 48))
        # 0.25 m, 5 m away: the picture is 64 pixels for 2 tan 17 degrees.
        self.assertAlmostEqual(x, 0.25 / 5 * 32 / 0.30573068, 1)
        self.assertAlmostEqual(y, 0, 3)

    def test_extras_and_outlines(self):
        self.client.ask("edit", edits=self.red_square())
        plain = self.picture()
        self.client.ask("edit", edits=[{"set": "node", "key": "sea", "extras": {"scumble_ocean": True}}])
        self.assertNotEqual(self.picture(), plain)
        self.client.ask("edit", edits=[{"remove": "node", "key": "sea"}])
        self.assertEqual(self.picture(), plain)
        self.client.ask("set", knobs={"ink.shown": True})
        corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        faces = [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3]
        self.client.ask("edit", edits=[{"set": "mesh", "key": "square", "parts": [
            {"positions": self.data.put("f", corners, 3), "indices": self.data.put("I", faces, 1), "material": "red"}]}])
        plain = self.picture()
        self.client.ask("edit", edits=[{"set": "material", "key": "red", "name": "Red", "baseColor": [0.8, 0.1, 0.1, 1],
                                        "outline": {"width": 0.2, "color": [0, 1, 0]}}])
        self.assertNotEqual(self.picture(), plain)

    def test_does_not_grow(self):
        def resident():
            return int(Path(f"/proc/{self.client.process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        for turn in range(120):
            self.data.used = 0
            edits = self.red_square()
            edits[1]["parts"] = [self.square(turn / 100)]
            self.client.ask("edit", edits=edits + [{"set": "node", "key": f"n{turn}", "mesh": "square"}])
            if turn % 10 == 0:
                self.picture()
            self.client.ask("edit", edits=[{"remove": "node", "key": f"n{turn}"}])
            if turn == 30:
                before = resident()
        self.assertLess(resident() - before, 8 << 20)


class Refused(Case):
    """What cannot be done is said, with its place, and nothing changes."""

    def test_requests(self):
        self.client.ask("edit", edits=self.red_square())
        before = self.picture()
        into = {"memory": "out", "count": self.out.size}
        for do, members, where in [
                ("rendr", {}, "do"),
                ("render", {}, "views"),
                ("render", {"viewpoint": FRONT}, "into"),
                ("render", {"viewpoint": FRONT, "views": [1], "into": into}, "views"),
                ("render", {"views": [1], "into": into}, "views[0]"),
                ("render", {"views": [{"worldToEye": [1], "eyeToClip": IDENTITY}], "into": into}, "views[0].worldToEye"),
                ("render", {"views": [{"worldToEye": IDENTITY, "eyeToClip": IDENTITY}], "into": into}, None),
                ("render", {"viewpoint": FRONT, "into": into, "size": [0, 5]}, "size"),
                ("render", {"viewpoint": FRONT, "into": into, "size": [1e9, 5]}, "size"),
                ("render", {"viewpoint": FRONT, "into": into, "samples": 3}, None),
                ("render", {"viewpoint": FRONT, "into": into, "time": "now"}, "time"),
                ("render", {"viewpoint": FRONT, "into": into, "time": 1e300}, None),
                ("render", {"viewpoint": FRONT, "into": into, "aovs": ["wrap"]}, None),
                ("render", {"viewpoint": FRONT, "into": into, "aovs": "warp"}, "aovs"),
                ("render", {"viewpoint": FRONT, "into": into, "formats": {"picture": "bytes"}}, "formats.picture"),
                ("render", {"viewpoint": FRONT, "into": into, "formats": {"depth": "srgb8"}, "aovs": ["depth"]}, None),
                ("render", {"viewpoint": FRONT, "into": into, "formats": {"picture": None}}, "formats.picture"),
                ("render", {"viewpoint": FRONT, "into": into, "formats": {"pic\0ture": "srgb8"}}, None),
                ("render", {"viewpoint": FRONT, "into": into, "region": [90, 0, 10, 10], "size": [96, 64]}, "region"),
                ("render", {"viewpoint": FRONT, "into": into, "region": [0, 0, 0, 10]}, "region"),
                ("render", {"viewpoint": FRONT, "into": {"memory": "out", "count": 100}, "size": [96, 64]}, "into.count"),
                ("render", {"viewpoint": FRONT, "into": {"memory": "nowhere", "count": 100}}, "into"),
                ("render", {"viewpoint": FRONT, "into": {"memory": "out", "count": 1 << 40}}, "into"),
                ("render", {"viewpoint": FRONT, "into": {"memory": "out", "offset": 1 << 52, "count": 4}}, "into.offset"),
                ("render", {"viewpoint": {"eye": [0, 0, 0], "target": [0, 0, 0]}, "into": into}, "viewpoint"),
                ("render", {"viewpoint": FRONT, "into": into, "previous": {"remembered": True}}, "previous.remembered"),
                ("render", {"viewpoint": FRONT, "into": into, "colour": 1}, "colour"),
                ("edit", {"edits": 5}, "edits"),
                ("edit", {"edits": [5]}, "edits[0]"),
                ("edit", {"edits": [{"set": "node"}]}, "edits[0].key"),
                ("edit", {"edits": [{"set": "nod", "key": "a"}]}, "edits[0].set"),
                ("edit", {"edits": [{"set": "node", "key": ""}]}, "edits[0].key"),
                ("edit", {"edits": [{"set": "node", "key": "a", "mesh": "none"}]}, "edits[0].mesh"),
                ("edit", {"edits": [{"set": "node", "key": "a", "parent": "a"}]}, "edits[0].parent"),
                ("edit", {"edits": [{"set": "node", "key": "one", "extras": [1]}]}, "edits[0].extras"),
                ("edit", {"edits": [{"set": "node", "key": "one", "light": {"kind": "sun"}}]}, "edits[0].light.kind"),
                ("edit", {"edits": [{"set": "node", "key": "one", "transform": [2] * 16}]}, "edits[0].transform"),
                ("edit", {"edits": [{"set": "node", "key": "one", "transform": [1e39] * 16}]}, "edits[0].transform"),
                ("edit", {"edits": [{"set": "material", "key": "red", "baseColor": [2, 0, 0, 1]}]}, "edits[0]"),
                ("edit", {"edits": [{"set": "material", "key": "a", "baseColorTexture": {"texture": "x"}}]},
                 "edits[0].baseColorTexture.texture"),
                ("edit", {"edits": [{"set": "material", "key": "a", "outline": {"width": -1}}]}, "edits[0]"),
                ("edit", {"edits": [{"set": "mesh", "key": "a", "parts": []}]}, "edits[0].parts"),
                ("edit", {"edits": [{"set": "mesh", "key": "a", "parts": [{}]}]}, "edits[0].parts[0].positions"),
                ("edit", {"edits": [{"set": "mesh", "key": "a", "parts": [{"positions": {"memory": "data", "count": 1 << 40}}]}]},
                 "edits[0].parts[0].positions"),
                ("edit", {"edits": [{"set": "mesh", "key": "a", "parts": [{"positions": {"memory": "data", "count": -1}}]}]},
                 "edits[0].parts[0].positions.count"),
                ("edit", {"edits": [{"set": "mesh", "key": "a", "parts": [
                    {"positions": self.data.put("f", SQUARE, 3), "indices": self.data.put("I", [0, 1, 9], 1)}]}]},
                 "edits[0].parts"),
                ("edit", {"edits": [{"set": "texture", "key": "a", "width": 16384, "height": 16384,
                                     "rgba": {"memory": "data"}}]}, "edits[0].rgba"),
                ("edit", {"edits": [{"set": "texture", "key": "a", "width": 0, "height": 1, "rgba": {"memory": "data"}}]},
                 "edits[0].width"),
                ("edit", {"edits": [{"remove": "node", "key": "nobody"}]}, "edits[0]"),
                ("share", {"memory": "x", "file": "/no/such/file", "bytes": 5}, "file"),
                ("share", {"memory": "x", "file": "/dev/zero", "bytes": 5}, "file"),
                ("share", {"memory": "x", "file": "/tmp", "bytes": 5}, "file"),
                ("share", {"memory": "x", "file": self.data.file.name, "bytes": 1 << 40}, "file"),
                ("set", {"knobs": [1]}, "knobs"),
                ("set", {"knobs": {"warp.amount": "much"}}, "knobs.warp.amount"),
                ("set", {"knobs": {"warp.amount": [1, 2]}}, "knobs.warp.amount"),
                ("set", {"knobs": {"warp.amount": 1e300}}, "knobs.warp.amount"),
                ("look", {"look": 5}, None),
                ("look", {"look": [1]}, None)]:
            with self.subTest(do=do, members=members):
                error = self.client.refused(do, **members)
                self.assertIn(error["kind"], ("usage", "unusable-file"))
                self.assertNotIn("\n", error["message"])
                if where:
                    self.assertEqual(error.get("where"), where)
        self.assertEqual(self.picture(), before)

    def test_a_pipe_is_no_memory(self):
        with tempfile.TemporaryDirectory() as folder:
            pipe = os.path.join(folder, "pipe")
            os.mkfifo(pipe)
            self.assertEqual(self.client.refused("share", memory="x", file=pipe, bytes=1)["kind"], "unusable-file")

    def test_memory_that_is_cut_off(self):
        edits = self.red_square()
        os.truncate(self.data.file.fileno(), 0)
        self.assertIn("ends before", self.client.refused("edit", edits=edits)["problem"])

    def test_lines(self):
        for line in (b"\n", b"{\n", b"[]\n", b"5\n", b'{"id": 1}\n', b'{"do": "clear"}\n', b'{"id": "a", "do": "clear"}\n',
                     b'{"id": -1, "do": "clear"}\n', b'{"id": 1.5, "do": "clear"}\n', b'{"id": 1e300, "do": "clear"}\n',
                     b"[" * 100000 + b"\n", b"\xff\xfe\n", b'{"id": 5, "do": "\xff"}\n', b'{"id": NaN, "do": "clear"}\n'):
            self.client.write(line)
            if line == b"\n":
                continue
            with self.subTest(line=line[:40]):
                self.assertIn("error", self.client.read())
        self.client.write(b'{"id": 1, "do": "' + b"x" * (65 << 20) + b'"}\n')
        self.assertIn("64 MiB", self.client.read()["error"]["problem"])
        self.client.ask("clear")


class Interrupted(Case):
    def test_cancelled(self):
        self.client.ask("edit", edits=self.red_square())
        into = {"memory": "out", "count": self.out.size}
        first = self.client.send("render", size=[640, 360], viewpoint=FRONT, into=into)
        second = self.client.send("render", size=[640, 360], viewpoint=FRONT, into=into)
        cancel = self.client.send("cancel", of=second)
        replies = {}
        while len(replies) < 3:
            message = self.client.read()
            if "progress" not in message:
                replies[message["id"]] = message
        self.assertIn("done", replies[first])
        self.assertIn("done", replies[cancel])
        self.assertEqual(replies[second]["error"]["kind"], "cancelled")
        self.client.ask("cancel", of=second)  # that is over already
        self.picture()

    def test_cancelled_at_work(self):
        self.client.ask("edit", edits=self.red_square())
        into = {"memory": "out", "count": self.out.size}
        # Pipelines that no other test has made.
        self.client.ask("look", look="watercolour")
        number = self.client.send("render", size=[200, 100], viewpoint=FRONT, into=into)
        message = self.client.read()
        if "progress" in message:
            self.client.send("cancel", of=number)
            reply = self.client.answer(number)
        else:
            reply = message
        self.assertTrue("done" in reply or reply["error"]["kind"] == "cancelled")
        self.client.ask("look")
        self.picture()

    def test_a_number_that_is_in_use(self):
        self.client.ask("edit", edits=self.red_square())
        number = self.client.send("render", size=[640, 360], viewpoint=FRONT,
                                  into={"memory": "out", "count": self.out.size})
        self.client.write(json.dumps({"id": number, "do": "clear"}) + "\n")
        message = self.client.read()
        while "progress" in message:
            message = self.client.read()
        self.assertIn("not yet answered", message["error"]["problem"])
        self.client.answer(number)

    def test_the_end_of_the_input(self):
        client = Client()
        client.send("clear")
        client.process.stdin.close()
        self.assertIn("done", client.answer(1))
        self.assertEqual(client.process.wait(60), 0)
        client.process.stdout.close()

    def test_nobody_listens(self):
        client = Client()
        client.process.stdout.close()
        client.send("clear")
        self.assertEqual(client.process.wait(60), 5)
        client.process.stdin.close()

    def test_killed(self):
        client = Client()
        threading.Timer(0.3, lambda: os.kill(client.process.pid, signal.SIGTERM)).start()
        begin = time.monotonic()
        self.assertIsNone(client.read())
        self.assertLess(time.monotonic() - begin, 30)
        client.process.wait(60)
        client.process.stdin.close()
        client.process.stdout.close()


if __name__ == "__main__":
    unittest.main()
