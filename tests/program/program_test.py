#!/usr/bin/env python3
"""The program from outside: what PROGRAM.md promises to users and to scripts, tried with small pictures.

    tests/program/program_test.py SCUMBLE DEMO_SCENE [unittest's options]     both as built, e.g. build/scumble build/demo_scene

Every call that draws runs under the validation layers. Scenes are made here, or by the generator of the demo scene.
"""
import base64
import json
import math
import os
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from array import array
from pathlib import Path
from xml.etree import ElementTree

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from png import read_png as png  # noqa: E402

SMALL = ["--size", "160x90", "--samples", "1", "--validate"]
TINY = ["--size", "32x18", "--samples", "1", "--validate"]
DONE, OUR_FAULT, USAGE, UNUSABLE, NO_GPU, NOT_WRITTEN = range(6)
COMMANDS = ["render", "film", "farm", "view", "xr", "info", "looks", "params", "schema", "devices", "bench", "measure", "paint", "bake", "look", "serve"]
scumble = demo_scene = None
shared = None  # a folder for what several tests read


# -- Scenes

def gltf(color=(0.8, 0.5, 0.2), camera=False, **more):
    """A box on a floor as glTF, all in one file."""
    positions, indices = [], []
    for axis in range(3):
        for side in (-1, 1):
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = [0, 0, 0]
                p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, a, b
                positions.append(p)
            quad = [first, first + 1, first + 2, first, first + 2, first + 3]
            indices += quad if side > 0 else quad[::-1]
    data = b"".join(struct.pack("<3f", *p) for p in positions)
    view = len(data)
    data += struct.pack(f"<{len(indices)}H", *indices)
    scene = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "Box", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "Paint.001", "pbrMetallicRoughness": {"baseColorFactor": [*color, 1]}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": len(positions),
                       "min": [-1, -1, -1], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": len(indices)}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": view},
                        {"buffer": 0, "byteOffset": view, "byteLength": len(data) - view}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    if camera:
        scene["cameras"] = [{"name": "Front", "type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}},
                            {"name": "Side", "type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]
        scene["nodes"] += [{"camera": 0, "translation": [0, 0, 6]},
                           {"camera": 1, "translation": [7, 0, 0], "rotation": [0, 0.70710678, 0, 0.70710678]}]
        scene["scenes"][0]["nodes"] += [1, 2]
    scene.update(more)
    return json.dumps(scene)


# -- Pictures

def exr(path):
    """The header of an EXR: its attributes by name, "channels" as a list of (name, type), type 2 being float."""
    data = Path(path).read_bytes()
    magic, version = struct.unpack("<II", data[:8])
    assert magic == 20000630, f"{path} is no EXR"
    at, attributes = 8, {}

    def text():
        nonlocal at
        end = data.index(b"\0", at)
        at, value = end + 1, data[at:end].decode()
        return value

    while data[at] != 0:
        name, kind = text(), text()
        size = struct.unpack("<I", data[at:at + 4])[0]
        at += 4
        attributes[name] = (kind, data[at:at + size])
        at += size
    channels, value, i = [], attributes["channels"][1], 0
    while value[i] != 0:
        end = value.index(b"\0", i)
        channels.append((value[i:end].decode(), struct.unpack("<I", value[end + 1:end + 5])[0]))
        i = end + 17
    attributes["channels"] = channels
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"][1])
    attributes["size"] = (x1 - x0 + 1, y1 - y0 + 1)
    if "multiView" in attributes:
        value, views, i = attributes["multiView"][1], [], 0
        while i < len(value):
            length = struct.unpack("<I", value[i:i + 4])[0]
            views.append(value[i + 4:i + 4 + length].decode())
            i += 4 + length
        attributes["multiView"] = views
    return attributes


def layers(path):
    """The names of an EXR's layers; the plain channels are the layer ""."""
    return {name.rpartition(".")[0] for name, _ in exr(path)["channels"]}


class Program(unittest.TestCase):
    """Each test has an empty folder of its own, with a scene in it, and the program runs there."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="scumble program "))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.put("box.gltf", gltf())
        self.before = self.files()

    def same(self, a, b, message="the bytes differ"):
        """Equal, without the minutes that unittest takes to describe how two pictures differ."""
        self.assertTrue(a == b, message)

    def different(self, a, b, message="the bytes are the same"):
        self.assertTrue(a != b, message)

    def put(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        self.before = self.before | {name} if hasattr(self, "before") else set()
        return str(path)

    def files(self):
        return {str(p.relative_to(self.folder)) for p in self.folder.rglob("*") if p.is_file()}

    def new_files(self):
        return self.files() - self.before

    def run_program(self, *args, environment=None, largest=None, stdout=subprocess.PIPE):
        """`largest`: a limit on the sizes of files, in bytes."""
        env = {**os.environ, "XDG_CACHE_HOME": str(shared / "cache"), **(environment or {})}
        limits = largest and (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (largest, largest)))
        return subprocess.run([scumble, *args], cwd=self.folder, env=env, stdout=stdout, stderr=subprocess.PIPE, text=True,
                              timeout=120, stdin=subprocess.DEVNULL, preexec_fn=limits)

    def good(self, *args, warnings=False):
        done = self.run_program(*args)
        self.assertEqual(done.returncode, DONE, f"{args}: {done.stderr}")
        if not warnings:
            self.assertEqual(done.stderr, "", args)
        return done.stdout

    def render(self, *args, size=SMALL):
        return self.good("render", *args, *size)

    def bad(self, code, *args, says=(), **how):
        """The call fails with this code and one line in the promised form, and leaves nothing behind."""
        done = self.run_program(*args, **how)
        self.assertEqual(done.returncode, code, f"{args}: {done.stderr}")
        self.assertRegex(done.stderr, r"\Ascumble: error: [^\n]+\n\Z", args)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, done.stderr)
        self.assertEqual(self.new_files(), set(), args)
        return done.stderr


class Commands(Program):
    def test_every_command_has_help_with_an_example(self):
        for command in COMMANDS:
            with self.subTest(command=command):
                text = self.good(command, "--help")
                self.assertRegex(text, rf"Example: scumble {command}")
        text = self.good("--help")
        for command in COMMANDS:
            self.assertIn(command, text)

    def test_help_shows_every_promised_option_of_render(self):
        text = self.good("render", "--help")
        for option in ("-o", "--look", "--set", "--camera", "--orbit", "--eye", "--target", "--roll", "--fov", "--size",
                       "--samples", "--time", "--frames", "--fps", "--stereo", "--ipd", "--aov", "--background", "--device",
                       "--seed", "--stats", "--graph", "--quiet", "--resume", "--missing", "--allow-outside", "--clip", "--quality", "--svg", "--panorama"):
            self.assertRegex(text, rf"(^|[\s,]){option}\b", option)
        for default in ("1280x720", "0.063", "24"):
            self.assertIn(default, text)

    def test_a_window_needs_a_display(self):
        self.bad(NO_GPU, "view", "box.gltf", environment={"DISPLAY": "", "WAYLAND_DISPLAY": ""}, says="`scumble render`")

    def test_version_names_build_and_device(self):
        text = self.good("--version")
        self.assertRegex(text, r"scumble \d+\.\d+")
        self.assertIn("device: ", text)
        # A build has a version also where there is no driver.
        none = self.run_program("--version", environment={"VK_ICD_FILENAMES": "/no.json", "VK_DRIVER_FILES": "/no.json"})
        self.assertEqual((none.returncode, none.stderr), (DONE, ""))
        self.assertEqual(none.stdout.splitlines()[0], text.splitlines()[0])
        self.assertIn("device: none; Vulkan cannot start", none.stdout)

    def test_nothing_to_do_shows_help_and_is_wrong_usage(self):
        done = self.run_program()
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("scumble", done.stdout)

    def test_wrong_usage(self):
        for args in (["paint-me"], ["render"], ["render", "box.gltf", "--no-such-option"], ["info"], ["--nonsense"],
                     ["render", "box.gltf", "--time"], ["render", "box.gltf", "--samples", "many"], ["looks", "too", "many"]):
            with self.subTest(args=args):
                self.bad(USAGE, *args)

    def test_wrong_words_are_named_in_our_own(self):
        for args, says in ((["rendr", "box.gltf", "-o", "x.png"], "there is no command 'rendr'; did you mean 'render'?"),
                           (["box.gltf", "-o", "x.png"], "there is no command 'box.gltf'; did you mean `scumble render box.gltf`?"),
                           (["render", "box.gltf", "--sampels", "1"], "there is no option '--sampels'; did you mean '--samples'?"),
                           (["render", "box.gltf", "--seed", "-1"], "'-1' is no whole number from 0 to 4294967295; give --seed another"),
                           (["render", "box.gltf", "--samples", "many"], "'many' is no whole number; give --samples another"),
                           (["render", "box.gltf", "--fov", "wide"], "'wide' is no number; give --fov another"),
                           (["render", "box.gltf", "--seed", "1", "--seed", "2"], "--seed is given 2 times; give it once"),
                           (["render", "box.gltf", "--time"], "--time needs a value; `scumble render --help`"),
                           (["render", "box.gltf", "--quiet=3"], "--quiet takes no value"),
                           (["render"], "SCENE is missing; write `scumble render SCENE`"),
                           (["looks", "too", "many"], "'too' is one argument too many"),
                           (["render", "box.gltf", "-o", "x.png", "--background", "#12345"], "--background #12345 is no colour; write")):
            with self.subTest(args=args):
                self.assertIn("scumble: error: " + says, self.bad(USAGE, *args))

    def test_the_graph_of_a_frame(self):
        self.good("render", "box.gltf", "-o", "a.png", "--graph", "frame.dot", "--aov", "blur", *TINY)
        text = (self.folder / "frame.dot").read_text()
        self.assertTrue(text.startswith("digraph ") and text.rstrip().endswith("}"), text)
        for part in ('"surface"', '"final-color"', '"readback"', '"blur'):
            self.assertIn(part, text)
        # What nobody has asked for is grey; what was asked for is not.
        line = next(line for line in text.splitlines() if '"facts"' in line)
        self.assertIn("gray", line)
        line = next(line for line in text.splitlines() if '"blur"' in line)
        self.assertNotIn("gray", line)

    def test_empty_values_are_refused(self):
        for option in ("-o", "--stats", "--graph", "--look", "--camera", "--orbit", "--eye", "--clip", "--background", "--device", "--frames",
                       "--stereo", "--exr", "--aov", "--set"):
            with self.subTest(option=option):
                self.bad(USAGE, "render", "box.gltf", option, "", *TINY, says="empty" if option != "-o" else "--output is empty")
        self.bad(USAGE, "measure", "box.gltf", "--plot", "")
        self.bad(USAGE, "info", "box.gltf", "--json=")

    def test_json_prints_and_with_a_name_writes(self):
        for args, prints in ((["info"], True), (["bench", "--runs", "1", *TINY], True),
                             (["measure", "--quiet", "--size", "64x36"], False)):  # measure_test.py has it print
            with self.subTest(args=args):
                if prints:
                    report = json.loads(self.good(*args, "box.gltf", "--json"))
                    self.assertEqual(json.loads(self.good(*args, "--json", "box.gltf")).keys(), report.keys())
                text = self.good(*args, "box.gltf", "--json", "a.JSON")
                self.assertNotIn("{", text)
                self.assertGreater(len(text.splitlines()), 5)
                written = json.loads((self.folder / "a.JSON").read_text())
                if prints:
                    self.assertEqual(written.keys(), report.keys())
                    self.good(*args, "--json", "a.txt", "box.gltf")
                    self.good(*args, "--json=b.gltf", "box.gltf")
                    self.assertEqual(self.new_files(), {"a.JSON", "a.txt", "b.gltf"})
                for name in self.new_files():
                    (self.folder / name).unlink()
                self.bad(NOT_WRITTEN, *args, "box.gltf", "--json", "no/such.json", says="no/such.json: the folder does not exist")
                self.bad(NOT_WRITTEN, *args, "box.gltf", "--json=box.gltf", says="inputs")

    def test_looks_lists_the_default(self):
        self.assertRegex(self.good("looks"), r"(?m)^age-of-sail\s+\S")

    def test_params(self):
        text = self.good("params")
        self.assertIn("threshold", text)
        only = self.good("params", "shadow.")
        self.assertIn("threshold", only)
        self.assertNotIn("elevation", only)
        self.bad(USAGE, "params", "no.such.path")

    def test_schema_is_json(self):
        schema = json.loads(self.good("schema"))
        self.assertIn("shadow", schema["properties"])
        self.assertIn("materials", schema["properties"])

    def test_devices(self):
        self.assertRegex(self.good("devices"), r"(?m)^\* \d+ .*Vulkan 1\.")

    def test_what_devices_get_wrong_is_found_once(self):
        cache = {"XDG_CACHE_HOME": str(self.folder / "found")}
        first = self.run_program("devices", environment=cache).stdout
        kept = {path: path.read_bytes() for path in (self.folder / "found" / "scumble").iterdir()}
        self.assertTrue(any(path.name.startswith("views-") for path in kept), kept)
        self.assertEqual(self.run_program("devices", environment=cache).stdout, first)
        for path in kept:  # what is damaged is found anew
            path.write_bytes(b"damaged")
        self.assertEqual(self.run_program("devices", environment=cache).stdout, first)
        self.assertEqual({path: path.read_bytes() for path in kept}, kept)

    def test_both_eyes_are_drawn_whatever_the_device(self):
        for samples in "1", "4":
            self.good("render", "box.gltf", "-o", "both.png", "--stereo", "side-by-side", "--ipd", "0", "--samples", samples,
                      "--size", "32x18", "--validate")
            width, _, channels, rows = png(self.folder / "both.png")
            half = width // 2 * channels
            self.assertEqual([row[:half] for row in rows], [row[half:] for row in rows], samples)
            self.assertGreater(len({bytes(row[i:i + 3]) for row in rows for i in range(0, half, channels)}), 5)

    def test_bench_reports_passes_and_yardstick(self):
        self.good("bench", "box.gltf", "--runs", "1", "--json", "b.json", *TINY)
        report = json.loads((self.folder / "b.json").read_text())
        self.assertGreater(report["yardstickMilliseconds"], 0)
        self.assertGreater(len(report["passes"]), 5)
        self.assertEqual(report["size"], [32, 18])


class Info(Program):
    def test_text_and_json(self):
        self.put("cameras.gltf", gltf(camera=True, extensionsUsed=["EXT_from_nowhere"]))
        text = self.good("info", "cameras.gltf", warnings=True)
        for word in ("Paint.001", "Front", "EXT_from_nowhere"):
            self.assertIn(word, text)
        report = json.loads(self.good("info", "cameras.gltf", "--json", warnings=True))
        self.assertEqual(report["meshes"], 1)
        self.assertEqual(report["triangles"], 12)
        self.assertEqual(report["cameras"], ["Front", "Side"])
        self.assertIn("Paint.001", report["materials"])
        self.assertIn("EXT_from_nowhere", report["extensionsNotSupported"])
        self.assertEqual(report["bounds"], {"min": [-1, -1, -1], "max": [1, 1, 1]})
        for key in ("lights", "clips", "skins", "images", "extensionsUsed", "warnings"):
            self.assertIn(key, report)

    def test_errors(self):
        self.bad(UNUSABLE, "info", "absent.glb", says="absent.glb")
        self.bad(UNUSABLE, "info", "absent.glb", "--json")


class Rendering(Program):
    def test_png(self):
        self.render("box.gltf", "-o", "a.png")
        width, height, channels, rows = png(self.folder / "a.png")
        self.assertEqual((width, height, channels), (160, 90, 3))
        self.assertGreater(len({row[i:i + 3] for row in rows for i in range(0, len(row), 3)}), 20, "an empty picture")
        self.assertEqual(self.new_files(), {"a.png"})

    def test_default_name_is_the_scenes_in_the_current_folder(self):
        self.put("deep/er/vase.gltf", gltf())
        self.before = self.files()
        self.render("deep/er/vase.gltf")
        self.assertEqual(self.new_files(), {"vase.png"})

    def test_exr_is_linear_float(self):
        self.render("box.gltf", "-o", "a.exr")
        header = exr(self.folder / "a.exr")
        self.assertEqual(header["size"], (160, 90))
        self.assertEqual(header["channels"], [("A", 2), ("B", 2), ("G", 2), ("R", 2)])
        self.assertNotIn("multiView", header)
        if shutil.which("exrheader"):  # a second opinion
            subprocess.run(["exrheader", self.folder / "a.exr"], check=True, capture_output=True)

    def test_same_call_same_bytes_and_every_knob_of_the_call_counts(self):
        self.render("box.gltf", "-o", "a.png")
        self.render("box.gltf", "-o", "b.png")
        first = (self.folder / "a.png").read_bytes()
        self.same(first, (self.folder / "b.png").read_bytes())
        for change in (["--orbit", "120,20"], ["--seed", "7"], ["--set", "shadow.threshold=0.2"], ["--roll", "15"],
                       ["--fov", "60"], ["--eye", "3,1,4"], ["--background", "#204060"], ["--samples", "4"]):
            with self.subTest(change=change):
                self.good("render", "box.gltf", "-o", "c.png", "--size", "160x90", "--validate",
                          *([] if "--samples" in change else ["--samples", "1"]), *change)
                self.different(first, (self.folder / "c.png").read_bytes())

    def test_orbit_with_a_distance(self):
        self.render("box.gltf", "-o", "near.png", "--orbit", "30,15,2", "--background", "transparent")
        self.render("box.gltf", "-o", "far.png", "--orbit", "30,15,9", "--background", "transparent")
        # Opaque pixels.
        covered = [sum(row[3::4].count(255) for row in png(self.folder / name)[3]) for name in ("near.png", "far.png")]
        self.assertGreater(covered[0], 4 * covered[1])

    def test_frame(self):
        self.put("two.gltf", gltf(nodes=[{"name": "Box", "mesh": 0, "children": [1]},
                                         {"name": "Far", "mesh": 0, "translation": [9, 0, 0]}]))
        self.before = self.files()
        self.render("two.gltf", "-o", "all.png")
        self.render("two.gltf", "-o", "far.png", "--frame", "F*")
        self.render("two.gltf", "-o", "both.png", "--frame", "Box")
        far, both, everything = ((self.folder / name).read_bytes() for name in ("far.png", "both.png", "all.png"))
        self.different(far, everything)
        self.same(both, everything)
        self.before = self.files()
        self.bad(USAGE, "render", "two.gltf", "-o", "x.png", "--frame", "Near", *TINY, says="Near")
        self.bad(USAGE, "render", "two.gltf", "-o", "x.png", "--frame", "Far", "--target", "1,2,3", *TINY, says="--target")

    def test_cameras(self):
        self.put("cameras.gltf", gltf(camera=True))
        self.before = self.files()
        for name, camera in (("default", []), ("name", ["--camera", "Front"]), ("number", ["--camera", "0"]),
                             ("side", ["--camera", "Side"]), ("side number", ["--camera", "1"])):
            self.render("cameras.gltf", "-o", name + ".png", *camera)
        pictures = {name: (self.folder / (name + ".png")).read_bytes() for name in ("default", "name", "number", "side", "side number")}
        self.same(pictures["default"], pictures["name"])
        self.same(pictures["default"], pictures["number"])
        self.same(pictures["side"], pictures["side number"])
        self.different(pictures["default"], pictures["side"])

    def test_background(self):
        self.render("box.gltf", "-o", "t.png", "--background", "transparent")
        width, height, channels, rows = png(self.folder / "t.png")
        self.assertEqual(channels, 4)
        self.same(rows[0][3], 0)
        self.assertEqual(rows[height // 2][4 * (width // 2) + 3], 255)
        self.render("box.gltf", "-o", "c.png", "--background", "#204060", "--set", "ground.mode=off")
        width, height, channels, rows = png(self.folder / "c.png")
        for corner in (rows[0][:3], rows[0][-3:], rows[-1][:3], rows[-1][-3:]):
            for value, wanted in zip(corner, (0x20, 0x40, 0x60)):
                self.assertLessEqual(abs(value - wanted), 2, corner.hex())

    def test_several_scenes_in_one_world(self):
        self.put("red.gltf", gltf((0.9, 0.1, 0.1), nodes=[{"mesh": 0, "translation": [3, 0, 0]}]))
        self.before = self.files()
        self.render("box.gltf", "red.gltf", "-o", "both.png", "--stats", "s.json")
        self.render("box.gltf", "-o", "one.png", "--stats", "one.json")
        both, one = (json.loads((self.folder / name).read_text())["frames"][0] for name in ("s.json", "one.json"))
        # Not triangles: what counts as a long one, to be split, follows the size of the whole.
        self.assertGreater(both["drawCalls"], one["drawCalls"])
        self.different((self.folder / "both.png").read_bytes(), (self.folder / "one.png").read_bytes())

    def test_one_of_several_scenes_cannot_be_used(self):
        self.bad(UNUSABLE, "render", "box.gltf", "absent.gltf", "-o", "x.png", *TINY, says="absent.gltf")

    def test_stats(self):
        self.render("box.gltf", "-o", "a.png", "--stats", "s.json")
        stats = json.loads((self.folder / "s.json").read_text())
        self.assertEqual(stats["size"], [160, 90])
        self.assertEqual((stats["samples"], stats["views"]), (1, 1))
        self.assertTrue(stats["device"])
        for key in ("totalMilliseconds", "renderMilliseconds", "writeMilliseconds", "peakResidentBytes"):
            self.assertGreater(stats[key], 0)
        self.assertEqual(set(stats["import"]), {"read", "parse", "geometry", "images"})
        frame, = stats["frames"]
        self.assertGreaterEqual(frame["triangles"], 12)
        for key in ("drawCalls", "deviceBytes", "uploadedBytes"):
            self.assertGreater(frame[key], 0)
        passes = {each["name"] for each in frame["passes"]}
        for name in ("shadow-map", "warp", "surface", "blur", "final-shadow", "color", "final-color"):
            self.assertIn(name, passes)

    def test_quiet_says_nothing(self):
        self.put("odd.gltf", gltf(extensionsUsed=["EXT_from_nowhere"]))
        self.before = self.files()
        loud = self.run_program("render", "odd.gltf", "-o", "a.png", *TINY)
        self.assertEqual(loud.stderr.count("EXT_from_nowhere"), 1, "a warning, once")
        self.assertIn("scumble: warning: ", loud.stderr)
        quiet = self.run_program("render", "odd.gltf", "-o", "b.png", "--quiet", *TINY)
        self.assertEqual((loud.returncode, quiet.returncode, quiet.stderr, quiet.stdout), (0, 0, "", ""))

    def test_demo_scene(self):
        self.good("render", str(shared / "demo.glb"), "-o", "a.png", "--camera", "Sailor", *SMALL)
        self.assertEqual(self.new_files(), {"a.png"})


class Memory(Program):
    """Large scenes, 56 bytes a vertex in their files."""
    SIDE = 127

    def put_scene(self, count):
        """Its size, as COUNT.gltf."""
        side = self.SIDE
        positions, normals, uvs, indices = array("f"), array("f"), array("f"), array("I")
        for y in range(side):
            for x in range(side):
                positions.extend((x / side, 0.05 * math.sin(0.2 * x) * math.cos(0.17 * y), y / side))
                normals.extend((0, 1, 0))
                uvs.extend((x / side, y / side))
        for y in range(side - 1):
            for x in range(side - 1):
                a = y * side + x
                indices.extend((a, a + side, a + 1, a + 1, a + side, a + side + 1))
        parts = [each.tobytes() for each in (positions, normals, uvs, indices)]
        each = sum(map(len, parts))
        views, accessors, meshes, nodes = [], [], [], []
        kinds = [("VEC3", 5126, side**2), ("VEC3", 5126, side**2), ("VEC2", 5126, side**2), ("SCALAR", 5125, len(indices))]
        for m in range(count):
            offset = m * each
            for part, (kind, component, values) in zip(parts, kinds):
                accessors.append({"bufferView": len(views), "componentType": component, "count": values, "type": kind})
                views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
                offset += len(part)
            accessors[4 * m].update(min=[0, -0.05, 0], max=[1, 0.05, 1])
            attributes = {"POSITION": 4 * m, "NORMAL": 4 * m + 1, "TEXCOORD_0": 4 * m + 2}
            meshes.append({"primitives": [{"attributes": attributes, "indices": 4 * m + 3}]})
            nodes.append({"mesh": m, "translation": [m % 8, 0, m // 8]})
        nodes.append({"name": "Away", "camera": 0, "translation": [0, 50, 0], "rotation": [0.7071068, 0, 0, 0.7071068]})
        with open(self.folder / f"{count}.bin", "wb") as file:
            for _ in range(count):
                file.writelines(parts)
        self.put(f"{count}.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": list(range(count + 1))}], "nodes": nodes, "meshes": meshes,
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
            "accessors": accessors, "bufferViews": views, "buffers": [{"uri": f"{count}.bin", "byteLength": count * each}]}))
        return count * each

    def peak(self, *args):
        """Of a call, in bytes."""
        process = subprocess.Popen([scumble, *args], cwd=self.folder, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, DONE)
        return 1024 * usage.ru_maxrss

    def test_a_file_and_its_scene_are_not_in_memory_at_once(self):
        sizes = [self.put_scene(count) for count in (60, 120)]
        # A process that begins another one is counted with it: both are larger than this one.
        peaks = [self.peak("info", name) for name in ("60.gltf", "120.gltf")]
        size, more = (pair[1] - pair[0] for pair in (sizes, peaks))
        self.assertLess(more, 2.2 * size)
        self.assertGreater(more, 1.2 * size, "else this measures something else")

    def test_a_still_scene_is_in_memory_once(self):
        size = self.put_scene(60)
        # Nothing of it is in sight or casts shadows: what a driver keeps of triangles that it draws is its own.
        how = ["-o", "a.png", "--size", "32x18", "--set", "shadowMap.cast=false"]
        more = self.peak("render", "60.gltf", "--camera", "Away", *how) - self.peak("render", "box.gltf", *how)
        self.assertLess(more, 2.5 * size)
        self.assertGreater(more, 1.2 * size, "else this measures something else")


class Looks(Program):
    def test_a_look_beside_the_scene_is_found(self):
        self.render("box.gltf", "-o", "plain.png")
        self.put("box.look.json", '{"description": "Blue", "background": {"mode": "look", "horizon": "#0000FF", "zenith": "#0000FF"}}')
        self.render("box.gltf", "-o", "found.png")
        self.render("box.gltf", "-o", "given.png", "--look", "box.look.json")
        self.render("box.gltf", "-o", "named.png", "--look", "age-of-sail")
        plain, found, given, named = ((self.folder / f"{n}.png").read_bytes() for n in ("plain", "found", "given", "named"))
        self.different(plain, found)
        self.same(found, given)
        self.same(plain, named, "a look that was asked for wins over the file beside the scene")

    def test_set_wins_over_the_look_and_the_later_one_wins(self):
        self.put("a.json", '{"shadow": {"threshold": 0.2}}')
        self.before = self.files()
        self.render("box.gltf", "-o", "a.png", "--look", "a.json", "--set", "shadow.threshold=0.3", "--set", "shadow.threshold=0.6")
        self.render("box.gltf", "-o", "b.png", "--set", "shadow.threshold=0.6")
        self.same((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_set_for_materials(self):
        self.render("box.gltf", "-o", "a.png")
        self.render("box.gltf", "-o", "b.png", "--set", "materials.Paint.001.palette.saturation=0")
        self.render("box.gltf", "-o", "c.png", "--set", "materials.P*.palette.saturation=0")
        self.render("box.gltf", "-o", "d.png", "--quiet", "--set", "materials.Other*.palette.saturation=0")
        a, b, c, d = ((self.folder / f"{n}.png").read_bytes() for n in "abcd")
        self.different(a, b)
        self.same(b, c)
        self.same(a, d)

    def warnings(self, *args, command="render"):
        done = self.run_program(command, "box.gltf", *args, *TINY)
        self.assertEqual(done.returncode, DONE, done.stderr)
        return [line.removeprefix("scumble: warning: ") for line in done.stderr.splitlines() if "warning" in line]

    def test_names_that_the_scene_does_not_have_are_named(self):
        why = ": nothing in the scene has such a name (`scumble info` lists names)"
        look = {"materials": {"Pa*": {"warp": {"amount": 1}}, "Sail*": {"warp": {"amount": 1}}, "Paint.001": {"warp": {"amount": 1}},
                              "Mian": {"warp": {"amount": 1, "inflation": 1}}}, "clips": {"Wlak": {"play": {"weight": 1}}}}
        idle = ["materials.Mian" + why, "clips.Wlak" + why]
        self.put("mine.json", json.dumps(look))
        self.assertEqual(self.warnings("--look", "mine.json"), idle)
        self.assertEqual(self.warnings("--look", "mine.json", "--runs", "1", command="bench"), idle)
        self.assertEqual(self.warnings("--look", "mine.json", "--quiet"), [])
        self.put("box.look.json", json.dumps(look))
        self.assertEqual(self.warnings(), idle)
        for shipped in ("open-sea", "storm"):
            self.assertEqual(self.warnings("--look", shipped), [], "it is for many scenes")
        (self.folder / "box.look.json").unlink()
        for name in ("Nope", "Nope*"):
            self.assertEqual(self.warnings("--set", f"materials.{name}.warp.amount=1"), [f"--set materials.{name}{why}"])
        self.assertEqual(self.warnings("--set", "materials.*.warp.amount=1", "--set", "nodes.B?x.animation.hold=2"), [])

    def test_keys_that_stand_twice_are_named_with_their_lines(self):
        self.put("twice.json", '{"shadow": {\n"threshold": 0.2,\n"threshold": 0.3}}')
        self.assertEqual(self.warnings("--look", "twice.json"),
                         ["twice.json:3 (shadow.threshold): it stands in line 2 already; what stands here counts"])
        self.assertEqual(self.warnings("--look", "twice.json", "--quiet"), [])

    def test_options_that_count_for_nothing_are_named(self):
        for args, told in ((["--ipd", "0.07"], "--ipd does nothing without --stereo"),
                           (["--exr", "half"], "--exr does nothing where no EXR is written"),
                           (["--time", "1", "--frames", "0..0"], "--time does nothing beside --frames: frame n is at n / fps")):
            with self.subTest(args=args):
                self.assertEqual(self.warnings(*args), [told])
                self.assertEqual(self.warnings(*args, "--quiet"), [])
        for args in (["--ipd", "0.07", "--stereo", "separate"], ["--eye", "3,1,4", "--target", "0,0,0"], ["--exr", "half", "--aov", "depth"],
                     ["--exr", "half", "-o", "a.exr"]):
            with self.subTest(args=args):
                self.assertEqual(self.warnings(*args), [])

    def test_colorizers_on_nodes_that_are_not_there_are_named(self):
        def told(node):
            self.put("a.json", json.dumps({"colorizers": {"Glow": {"volume": {"node": node}, "grade": {"gain": 2}}}}))
            done = self.run_program("render", "box.gltf", "-o", "a.png", "--look", "a.json", *TINY)
            self.assertEqual(done.returncode, DONE, done.stderr)
            return [line for line in done.stderr.splitlines() if "warning" in line]

        there = json.loads(self.good("info", "box.gltf", "--json"))["nodeNames"][0]
        self.assertEqual(told(there), [])
        self.assertEqual(told(""), [])
        for node in ("nope", {"keys": [[0, there], [1, "nope"]]}, {"keys": [[0, "nope"], [1, there]]}):
            with self.subTest(node=node):
                self.assertEqual(len(told(node)), 1)
                self.assertIn("colorizers.Glow.volume.node", told(node)[0])

    def test_a_sea_that_is_not_there_is_told_of(self):
        def told(*options):
            done = self.run_program("render", "box.gltf", "-o", "a.png", *options, *TINY)
            self.assertEqual(done.returncode, DONE, done.stderr)
            return [line for line in done.stderr.splitlines() if "warning" in line]

        rings = ("--set", "decorations.Rings.water.kind=ripples")
        self.assertIn("decorations: there is no ocean; --set ocean.mode=on puts one", told(*rings)[0])
        self.assertEqual(told(*rings, "--set", "ocean.mode=on"), [])
        self.assertIn("ocean.paint", told("--set", "ocean.paint.foam=1")[0])
        self.assertEqual(told("--look", "storm"), [])

    def test_set_errors(self):
        for setting, says in (("shadow.treshold=0.4", "did you mean 'shadow.threshold'?"), ("shadow.threshold", "="),
                              ("shadow.threshold=", "shadow.threshold"), ("shadow.threshold=9", "range"), ("shadow.threshold=x", "number"),
                              ("ground.mode=maybe", "auto|on|off"), ("ground.tint=rubbish", "#RRGGBB"), ("=1", ""),
                              ("materials.A.shadow.threshold=0.4", ""), ("materials.A=1", "")):
            with self.subTest(setting=setting):
                self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--set", setting, *TINY, says=says)

    def test_look_errors(self):
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--look", "age-of-sial", *TINY, says="'age-of-sail'")
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--look", "absent.json", *TINY, says="absent.json: ")
        self.put("broken.json", '{\n "shadow": {\n  "threshold": 0.4,,\n }\n}')
        self.put("wrong.json", '{"shadow": {"threshold": "much"}}')
        self.put("typo.json", '{"shadow": {"treshold": 0.4}}')
        self.before = self.files()
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--look", "broken.json", *TINY, says="broken.json:3: ")
        self.put("huge.json", '{"shadow": {\n"threshold": 1e400}}')
        self.put("nul.json", '{\n"lit": {"texture": "x.png\\u0000.png"}}')
        self.put("large.json", " " * (17 << 20))
        self.before = self.files()
        for name, says in (("huge.json", "huge.json:2: a number here is too large"), ("nul.json", "nul.json:2: a text here holds the character NUL"),
                           ("large.json", "a look has 16 MiB at most")):
            self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--look", name, *TINY, says=says)
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--look", "wrong.json", *TINY, says="wrong.json:1 (shadow.threshold): ")
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--look", "typo.json", *TINY, says="shadow.threshold")
        self.put("box.look.json", "{")
        self.before = self.files()
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", *TINY, says="box.look.json:1: ")


class Aovs(Program):
    PASSES = ["warp", "shadow", "blur", "final-shadow", "lit", "shadowed", "color", "final-color"]
    FACTS = ["depth", "position", "normal", "uv", "uv-gradient", "metatexture", "motion", "id"]

    def test_all_go_into_one_exr_as_layers_by_their_names(self):
        self.render("box.gltf", "-o", "a.exr", "--aov", "all")
        found = layers(self.folder / "a.exr")
        for name in ["", *self.PASSES, *self.FACTS]:
            self.assertIn(name, found)
        header = exr(self.folder / "a.exr")
        names = {name for name, _ in header["channels"]}
        for channel in ("final-shadow.R", "depth.R", "normal.B", "uv-gradient.A", "motion.G", "id.R"):
            self.assertIn(channel, names)
        self.assertEqual({kind for _, kind in header["channels"]}, {2}, "all float")
        self.assertNotIn("multiView", header)
        # The shadow map has a size of its own, which layers of one file cannot have.
        self.assertIn("a.shadow-map.exr", self.new_files())
        self.assertNotEqual(exr(self.folder / "a.shadow-map.exr")["size"], (160, 90))

    def test_some_by_name_in_both_spellings(self):
        self.render("box.gltf", "-o", "a.exr", "--aov", "depth,final-shadow", "--aov", "id", "--aov", "depth")
        self.assertEqual(layers(self.folder / "a.exr"), {"", "depth", "final-shadow", "id"})

    def test_beside_a_png(self):
        self.render("box.gltf", "-o", "a.png", "--aov", "depth,shadow-map")
        self.assertEqual(self.new_files(), {"a.png", "a.depth.exr", "a.shadow-map.exr"})
        self.assertEqual(exr(self.folder / "a.depth.exr")["size"], (160, 90))

    def test_asking_for_aovs_changes_no_picture(self):
        self.render("box.gltf", "-o", "a.png")
        self.render("box.gltf", "-o", "b.png", "--aov", "all")
        self.same((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_unknown(self):
        self.bad(USAGE, "render", "box.gltf", "-o", "x.exr", "--aov", "final-shadwo", *TINY, says="'final-shadow'")
        self.bad(USAGE, "render", "box.gltf", "-o", "x.exr", "--aov", "depth,nonsense", *TINY, says="nonsense")


class Stereo(Program):
    def test_layouts_and_sizes(self):
        self.render("box.gltf", "-o", "mono.png")
        self.render("box.gltf", "-o", "side.png", "--stereo", "side-by-side")
        self.render("box.gltf", "-o", "over.png", "--stereo", "over-under")
        self.render("box.gltf", "-o", "two.png", "--stereo", "separate")
        self.assertEqual(self.new_files(), {"mono.png", "side.png", "over.png", "two.left.png", "two.right.png"})
        side, over, left, right = (png(self.folder / n) for n in ("side.png", "over.png", "two.left.png", "two.right.png"))
        self.assertEqual((side[:2], over[:2], left[:2], right[:2]), ((320, 90), (160, 180), (160, 90), (160, 90)))
        # The layouts hold the same two pictures.
        self.same([row[:480] for row in side[3]], left[3])
        self.same([row[480:] for row in side[3]], right[3])
        self.same(over[3], left[3] + right[3])
        self.different(left[3], right[3])

    def test_for_glasses_and_for_who_can_squint(self):
        self.render("box.gltf", "-o", "two.png", "--stereo", "separate", "--aov", "depth")
        self.render("box.gltf", "-o", "red.png", "--stereo", "anaglyph", "--aov", "depth")
        self.render("box.gltf", "-o", "crossed.png", "--stereo", "crossed")
        left, right, red, crossed = (png(self.folder / n) for n in ("two.left.png", "two.right.png", "red.png", "crossed.png"))
        self.assertEqual((red[:2], crossed[:2]), ((160, 90), (320, 90)))
        for mixed, one, other in zip(red[3], left[3], right[3]):
            self.same([mixed[0::3], mixed[1::3], mixed[2::3]], [one[0::3], other[1::3], other[2::3]])
        self.same(crossed[3], [other + one for one, other in zip(left[3], right[3])])
        # What is no colour lies side by side.
        self.assertEqual(struct.unpack("<4i", exr(self.folder / "red.depth.exr")["dataWindow"][1]), (0, 0, 319, 89))

    def test_no_distance_no_difference(self):
        self.render("box.gltf", "-o", "two.png", "--stereo", "separate", "--ipd", "0")
        self.same(png(self.folder / "two.left.png")[3], png(self.folder / "two.right.png")[3])

    def test_exr_carries_views(self):
        self.render("box.gltf", "-o", "a.exr", "--stereo", "side-by-side", "--aov", "depth")
        header = exr(self.folder / "a.exr")
        self.assertEqual(header["multiView"], ["left", "right"])
        names = {name for name, _ in header["channels"]}
        # As OpenEXR's own insertViewName() names them: only plain channels of the default view go without it.
        self.assertEqual(names, {"A", "B", "G", "R", "right.A", "right.B", "right.G", "right.R", "depth.left.R", "depth.right.R"})

    def test_errors(self):
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--stereo", "sideways", *TINY, says="side-by-side")
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--stereo", "separate", "--ipd", "-1", *TINY)
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--stereo", "wiggle", *TINY, says="boat.gif")
        self.bad(USAGE, "render", "box.gltf", "-o", "x.svg", "--stereo", "anaglyph", *TINY, says="drawing")
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--stereo", "anaglyp", *TINY, says="'anaglyph'")


class Drawings(Program):
    SVG = "{http://www.w3.org/2000/svg}"

    def layers(self, name):
        """Of an SVG, its size, and by layer its paths."""
        root = ElementTree.parse(self.folder / name).getroot()
        self.assertEqual(root.tag, self.SVG + "svg")
        groups = {group.get("id"): group.findall(self.SVG + "path") for group in root.findall(self.SVG + "g")}
        return (int(root.get("width")), int(root.get("height"))), groups

    def test_lines_of_the_look_go_into_an_svg(self):
        self.render("box.gltf", "-o", "a.svg", "--look", "technical")
        self.assertEqual(self.new_files(), {"a.svg"})
        size, groups = self.layers("a.svg")
        self.assertEqual(size, (160, 90))
        self.assertIn("silhouettes", groups)
        for paths in groups.values():
            self.assertTrue(paths)
            for path in paths:
                self.assertRegex(path.get("fill"), r"\A#[0-9a-f]{6}\Z")
                self.assertRegex(path.get("d"), r"\AM[-0-9. MLAZ]+Z\Z")
        self.render("box.gltf", "-o", "b.svg", "--look", "technical")
        self.same((self.folder / "a.svg").read_bytes(), (self.folder / "b.svg").read_bytes())

    def test_centerlines_and_hidden_lines(self):
        self.render("box.gltf", "-o", "a.svg", "--look", "technical", "--svg", "centerlines,hidden", "--orbit", "30,30")
        _, groups = self.layers("a.svg")
        self.assertTrue(any(name.endswith("-hidden") for name in groups), groups.keys())
        for name, paths in groups.items():
            for path in paths:
                self.assertEqual(path.get("fill"), "none")
                self.assertEqual(path.get("stroke-dasharray") is not None, name.endswith("-hidden"))

    def test_stereo_sequences_and_aovs_are_those_of_pictures(self):
        ink = ("--look", "ink", "--quiet")
        self.render("box.gltf", "-o", "side.svg", "--stereo", "side-by-side", *ink)
        self.assertEqual(self.layers("side.svg")[0], (320, 90))
        self.render("box.gltf", "-o", "two.svg", "--stereo", "separate", "--aov", "depth", *ink)
        self.render("box.gltf", "-o", "x.#.svg", "--frames", "0..1", *ink)
        self.assertEqual(self.new_files(), {"side.svg", "two.left.svg", "two.right.svg", "two.left.depth.exr",
                                            "two.right.depth.exr", "x.0.svg", "x.1.svg"})
        # What is whole stays, and what is not is drawn again.
        whole = (self.folder / "x.0.svg").read_bytes()
        mine = whole.replace(b"<g ", b"<g  ", 1)
        (self.folder / "x.0.svg").write_bytes(mine)
        (self.folder / "x.1.svg").write_bytes(whole[:-8])
        self.render("box.gltf", "-o", "x.#.svg", "--frames", "0..1", "--resume", *ink)
        self.same((self.folder / "x.0.svg").read_bytes(), mine)
        self.assertTrue((self.folder / "x.1.svg").read_bytes().endswith(b"</svg>\n"))

    def test_errors(self):
        self.bad(USAGE, "render", "box.gltf", "-o", "x.svg", *TINY, says="ink.shown=on")
        self.bad(USAGE, "render", "box.gltf", "-o", "x.svg", "--look", "ink", "--svg", "dashed", *TINY, says="centerlines")
        self.assertIn("--svg does nothing", self.run_program("render", "box.gltf", "-o", "x.png", "--svg", "hidden", *TINY).stderr)


class Sequences(Program):
    def test_frames_alone_are_frames_of_the_sequence(self):
        self.good("render", "box.gltf", "-o", "x.##.png", "--frames", "0..2", "--quiet", *SMALL)
        self.assertEqual(self.new_files(), {"x.00.png", "x.01.png", "x.02.png"})
        self.good("render", "box.gltf", "-o", "alone.####.png", "--frames", "2..2", "--quiet", *SMALL)
        self.same((self.folder / "alone.0002.png").read_bytes(), (self.folder / "x.02.png").read_bytes())
        # Frame n is at n / fps seconds.
        self.good("render", "box.gltf", "-o", "time.png", "--time", str(2 / 24), *SMALL)
        self.same((self.folder / "time.png").read_bytes(), (self.folder / "x.02.png").read_bytes())

    def test_resume_goes_on_where_it_was(self):
        # What is whole and of the right size counts as drawn, whoever drew it.
        self.good("render", "box.gltf", "-o", "x.0.png", "--orbit", "90,0", "--quiet", *TINY)
        mine = (self.folder / "x.0.png").read_bytes()
        self.good("render", "box.gltf", "-o", "x.#.png", "--frames", "0..1", "--resume", "--quiet", *TINY)
        self.same((self.folder / "x.0.png").read_bytes(), mine)
        self.assertEqual(png(self.folder / "x.1.png")[:2], (32, 18))
        self.good("render", "box.gltf", "-o", "x.#.png", "--frames", "0..1", "--quiet", *TINY)
        self.different((self.folder / "x.0.png").read_bytes(), mine)

    # Two files make one frame.
    def test_resume_in_stereo(self):
        args = ["render", "box.gltf", "-o", "x.#.png", "--frames", "0..1", "--stereo", "separate", "--resume", "--quiet", *TINY]
        self.good(*args)
        self.assertEqual(self.new_files(), {"x.0.left.png", "x.0.right.png", "x.1.left.png", "x.1.right.png"})
        shutil.copy(self.folder / "x.0.right.png", self.folder / "x.0.left.png")
        (self.folder / "x.1.right.png").unlink()
        self.good(*args)
        self.same((self.folder / "x.0.left.png").read_bytes(), (self.folder / "x.0.right.png").read_bytes(),
                  "drawn again though it was there")
        self.assertEqual(png(self.folder / "x.1.right.png")[:2], (32, 18))

    def test_errors(self):
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--frames", "0..2", *TINY, says="####")
        for frames in ("2..0", "x", "0", "0..", "0..2x", "0...2"):
            with self.subTest(frames=frames):
                self.bad(USAGE, "render", "box.gltf", "-o", "x.#.png", "--frames", frames, *TINY)
        self.bad(USAGE, "render", "box.gltf", "-o", "x.#.png", "--frames", "0..1", "--fps", "0", *TINY)
        # Found before the frames that could be drawn are.
        self.bad(USAGE, "render", "box.gltf", "-o", "x.#.png", "--frames", "99999..100000", "--fps", "0.1", *TINY, says="million")


class Errors(Program):
    def test_inputs_are_never_outputs(self):
        before = (self.folder / "box.gltf").read_bytes()
        self.bad(NOT_WRITTEN, "render", "box.gltf", "-o", "x.png", "--stats", "box.gltf", *TINY, says="inputs")
        self.bad(NOT_WRITTEN, "bench", "box.gltf", "--runs", "1", "--json=box.gltf", *TINY, says="inputs")
        self.put("box.png", before.decode())  # what a file is decides its content, not its name
        self.before = self.files()
        self.bad(NOT_WRITTEN, "render", "box.png", "-o", "box.png", *TINY, says="inputs")
        self.same((self.folder / "box.gltf").read_bytes(), before)

    def test_a_look_that_is_found_is_an_input(self):
        self.put("box.look.json", "{}")
        for args in (["render", "box.gltf", "-o", "x.png", "--stats", "box.look.json", *TINY],
                     ["bench", "box.gltf", "--json", "./box.look.json"], ["measure", "box.gltf", "--json", "box.look.json"]):
            self.bad(NOT_WRITTEN, *args, says="inputs")
            self.assertEqual((self.folder / "box.look.json").read_text(), "{}")

    def test_what_a_scene_and_a_look_read_is_never_an_output(self):
        self.render("box.gltf", "-o", "made.png", size=TINY)
        mine = (self.folder / "made.png").read_bytes()
        scene = json.loads(gltf())
        data = base64.b64decode(scene["buffers"][0]["uri"].partition(",")[2])
        scene["buffers"][0]["uri"] = "data.bin"
        scene["images"], scene["textures"] = [{"uri": "boat.png"}], [{"source": 0}]
        scene["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
        for name, content in (("boat.gltf", json.dumps(scene)), ("boat.png", mine), ("data.bin", data), ("wood.png", mine),
                              ("a.json", '{"lit": {"texture": "wood.png"}}')):
            self.put(name, content)
        self.before = self.files()
        # The default name is that of the picture on the boat.
        for args in (["render", "boat.gltf"], ["render", "boat.gltf", "-o", "x.png", "--stats", "data.bin"],
                     ["render", "boat.gltf", "-o", "wood.png", "--look", "a.json"], ["info", "boat.gltf", "--json=data.bin"],
                     ["bench", "boat.gltf", "--json=./boat.png"], ["measure", "boat.gltf", "--plot", "boat.png"],
                     ["measure", "boat.gltf", "--look", "a.json", "--plot", "wood.png"]):
            with self.subTest(args=args):
                self.bad(NOT_WRITTEN, *args, *([] if "info" in args else TINY), says="this is one of the inputs")
        self.same((self.folder / "boat.png").read_bytes(), mine)
        self.render("boat.gltf", "-o", "x.png", "--look", "a.json", size=TINY)

    def test_no_two_outputs_have_one_name(self):
        (self.folder / "there").mkdir()
        os.symlink("there", self.folder / "link")
        self.before = self.files()
        here = str(self.folder)
        render = ["render", "box.gltf", "--stats"]
        for args in ([*render, "x.png", "-o", "x.png"], [*render, "./x.png", "-o", "x.png"], [*render, here + "/x.png", "-o", "x.png"],
                     [*render, "box.png"], [*render, "there/../x.png", "-o", "x.png"], [*render, "link/x.png", "-o", "there/x.png"],
                     [*render, "x.depth.exr", "-o", "x.png", "--aov", "depth"], [*render, "x.shadow-map.exr", "-o", "x.exr", "--aov", "all"],
                     [*render, "x.left.png", "-o", "x.png", "--stereo", "separate"],
                     [*render, "x.right.depth.exr", "-o", "x.png", "--stereo", "separate", "--aov", "depth"],
                     [*render, "./x.0002.png", "-o", "x.####.png", "--frames", "0..3"],
                     [*render, "x.1.normal.exr", "-o", "x.#.png", "--frames", "0..1", "--aov", "normal"],
                     [*render, "x.mp4", "-o", "./x.mp4", "--frames", "0..1"],
                     [*render, "x.json", "-o", "x.png", "--graph", "./x.json"],
                     ["measure", "box.gltf", "--plot", "a.png", "--json=./a.png"]):
            with self.subTest(args=args):
                self.bad(USAGE, *args, *TINY, says=["two outputs would go there", "different names"])
        # Near misses.
        self.good("render", "box.gltf", "-o", "x.#.png", "--frames", "0..1", "--quiet", "--stats", "x.2.png", *TINY)
        self.good("render", "box.gltf", "-o", "y.exr", "--aov", "depth", "--stats", "y.depth.exr", *TINY)
        self.assertEqual(self.new_files(), {"x.0.png", "x.1.png", "x.2.png", "y.exr", "y.depth.exr"})

    def test_aov_files_are_outputs_like_the_picture(self):
        (self.folder / "x.depth.exr").mkdir()
        self.put("y.depth.exr", gltf())
        self.before = self.files()
        self.bad(NOT_WRITTEN, "render", "box.gltf", "-o", "x.png", "--aov", "depth", *TINY, says="x.depth.exr: this is a folder")
        self.bad(NOT_WRITTEN, "render", "y.depth.exr", "-o", "y.png", "--aov", "depth", *TINY, says="inputs")

    def test_endings_in_any_case(self):
        self.render("box.gltf", "-o", "A.PNG", "--aov", "depth", size=TINY)
        self.assertEqual(self.new_files(), {"A.PNG", "A.depth.exr"})
        self.assertEqual(png(self.folder / "A.PNG")[:2], (32, 18))
        self.render("box.gltf", "-o", "B.Exr", size=TINY)
        self.assertEqual(exr(self.folder / "B.Exr")["size"], (32, 18))

    def test_only_ordinary_files_are_replaced(self):
        os.mkfifo(self.folder / "pipe")
        self.bad(NOT_WRITTEN, "render", "box.gltf", "-o", "x.png", "--stats", "pipe", *TINY, says="ordinary")
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--look", "./pipe", *TINY, says="ordinary")

    def test_what_is_printed_must_arrive(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([scumble, "info", "box.gltf", "--json"], cwd=self.folder, stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, NOT_WRITTEN)
        self.assertRegex(done.stderr, r"\Ascumble: error: [^\n]+\n\Z")

    def test_a_pattern_of_materials_is_not_empty(self):
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--set", "materials..warp.amount=2", *TINY)
        self.put("empty.json", '{"materials": {"": {"warp": {"amount": 1}}}}')
        self.before = self.files()
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--look", "./empty.json", *TINY)

    def test_wrong_numbers(self):
        for args in (["--size", "160"], ["--size", "0x90"], ["--size", "160x90x2"], ["--size", "99999x2"], ["--size", "-1x5"],
                     ["--samples", "2"], ["--orbit", "30"], ["--orbit", "a,b"], ["--orbit", "0,0,0"], ["--eye", "1,2"],
                     ["--eye", "1,2,nan"], ["--target", "x"], ["--fov", "0"], ["--fov", "180"], ["--time", "nan"],
                     ["--background", "rde"], ["--background", "#12345"], ["--eye", "0,0,0", "--target", "0,0,0"],
                     ["--scene", "-7"], ["--scene", "-1"], ["--orbit", "0,1000"], ["--orbit", "0,91"], ["--orbit", "1e30,0"],
                     ["--orbit", "0,0,1e30"], ["--eye", "1e30,0,0"], ["--roll", "1e30"], ["--ipd", "1e30"], ["--ipd", "-1"],
                     ["--fps", "1e308"], ["--fps", "0.001"], ["--time", "1e7"], ["--seed", "-1"], ["--seed", "5000000000"]):
            with self.subTest(args=args):
                size = [] if "--size" in args else ["--size", "32x18"]
                samples = [] if "--samples" in args else ["--samples", "1"]
                self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--validate", *size, *samples, *args)

    def test_cameras(self):
        self.put("cameras.gltf", gltf(camera=True))
        self.before = self.files()
        self.bad(USAGE, "render", "cameras.gltf", "-o", "x.png", "--camera", "Frnt", *TINY, says="Front")
        self.bad(USAGE, "render", "cameras.gltf", "-o", "x.png", "--camera", "2", *TINY)
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--camera", "Front", *TINY)

    def test_unusable_scenes(self):
        self.put("text.gltf", "hello")
        self.put("old.gltf", '{"asset": {"version": "1.0"}}')
        self.put("empty.glb", "")
        (self.folder / "folder.gltf").mkdir()
        self.before = self.files()
        for name in ("absent.glb", "text.gltf", "old.gltf", "empty.glb", "folder.gltf", ".", "", "no/such/folder.glb"):
            with self.subTest(name=name):
                self.bad(UNUSABLE, "render", name, "-o", "x.png", *TINY, says=name)

    def test_a_name_with_a_line_break_makes_no_second_line(self):
        self.bad(UNUSABLE, "render", "a\nb.glb", "-o", "x.png", *TINY)

    def test_mistakes_in_a_scene_name_their_place(self):
        self.put("far.gltf", gltf(meshes=[{"primitives": [{"attributes": {"POSITION": 99}}]}]))
        self.put("comma.gltf", '{\n "asset": {"version": "2.0"},,\n}')
        self.before = self.files()
        self.bad(UNUSABLE, "render", "far.gltf", "-o", "x.png", *TINY, says=["far.gltf (meshes[0].primitives[0]", "POSITION"])
        self.bad(UNUSABLE, "render", "comma.gltf", "-o", "x.png", *TINY, says="comma.gltf:2")
        self.put("huge.gltf", '{\n "asset": {"version": "2.0"},\n "scene": 1e400\n}')
        self.before = self.files()
        self.bad(UNUSABLE, "render", "huge.gltf", "-o", "x.png", *TINY, says="huge.gltf:3: ")
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--scene", "5", *TINY, says="holds 1 scene, but scene 5 was asked for")

    def test_no_network(self):
        scene = json.loads(gltf())
        scene["buffers"][0]["uri"] = "http://localhost:1/a.bin"
        self.put("remote.gltf", json.dumps(scene))
        self.before = self.files()
        self.assertRegex(self.bad(UNUSABLE, "render", "remote.gltf", "-o", "x.png", *TINY), "network|http")

    def test_paths_outside(self):
        scene = json.loads(gltf())
        uri = scene["buffers"][0]["uri"]
        (self.folder / "a.bin").write_bytes(base64.b64decode(uri.partition(",")[2]))
        scene["buffers"][0]["uri"] = "../a.bin"
        self.put("inside/outside.gltf", json.dumps(scene))
        self.before = self.files()
        self.bad(UNUSABLE, "render", "inside/outside.gltf", "-o", "x.png", *TINY, says="--allow-outside")
        self.render("inside/outside.gltf", "-o", "x.png", "--allow-outside", size=TINY)
        self.assertEqual(self.new_files(), {"x.png"})

    def test_outputs_that_cannot_be_written(self):
        self.put("file", "")
        (self.folder / "folder.png").mkdir()
        self.before = self.files()
        for output in ("no/such/folder/x.png", "file/x.png", "folder.png", "/proc/x.png", "/dev/full/x.png"):
            with self.subTest(output=output):
                self.bad(NOT_WRITTEN, "render", "box.gltf", "-o", output, *TINY, says=output)
        self.bad(USAGE, "render", "box.gltf", "-o", "x.tiff", *TINY, says=".png")
        self.bad(USAGE, "render", "box.gltf", "-o", "x", *TINY)

    @unittest.skipIf(os.geteuid() == 0, "root writes everywhere")
    def test_a_folder_without_permission(self):
        (self.folder / "closed").mkdir(mode=0o555)
        self.bad(NOT_WRITTEN, "render", "box.gltf", "-o", "closed/x.png", *TINY)

    def test_statistics_that_cannot_be_written(self):
        done = self.run_program("render", "box.gltf", "-o", "x.png", "--stats", "no/such/s.json", *TINY)
        self.assertEqual(done.returncode, NOT_WRITTEN)
        self.assertRegex(done.stderr, r"\Ascumble: error: no/such/s.json: [^\n]+\n\Z")

    def test_where_compiled_pipelines_are_kept_never_matters(self):
        self.put("file", "mine")
        self.before = self.files()
        for cache in ("relative", "file", str(self.folder / "file"), "/dev/null", "/proc/no/such"):
            with self.subTest(cache=cache):
                done = self.run_program("render", "box.gltf", "-o", "a.png", *TINY,
                                        environment={"XDG_CACHE_HOME": cache, "HOME": str(self.folder / "file"),
                                                     "MESA_SHADER_CACHE_DISABLE": "true"})  # it has messages of its own
                self.assertEqual((done.returncode, done.stderr), (DONE, ""))
                self.assertEqual(self.new_files(), {"a.png"})

    def test_a_limit_on_the_sizes_of_files(self):
        args = ["render", "box.gltf", *TINY]
        for output in ("a.png", "a.exr"):
            self.good(*args, "-o", output, "--aov", "depth", "--stats", "s.json")
        sizes = {path.name: path.stat().st_size for path in self.folder.iterdir()}
        for name in self.new_files():
            (self.folder / name).unlink()
        # Each is the first that is too large.
        self.assertLess(sizes["a.png"], sizes["s.json"])
        for limit, output, more in ((100, "a.png", []), (100, "a.exr", []), (100, "a.png", ["--aov", "depth"])):
            with self.subTest(output=output, more=more):
                self.bad(NOT_WRITTEN, *args, "-o", output, *more, says="File too large", largest=limit)
        done = self.run_program(*args, "-o", "a.png", "--stats", "s.json", largest=sizes["a.png"])
        self.assertEqual(done.returncode, NOT_WRITTEN, done.stderr)
        self.assertRegex(done.stderr, r"\Ascumble: error: s.json: [^\n]+\n\Z")
        self.assertEqual(self.new_files(), {"a.png"})
        with open(self.folder / "printed", "w") as printed:
            done = self.run_program("info", "box.gltf", "--json", largest=100, stdout=printed)
        self.assertEqual(done.returncode, NOT_WRITTEN)
        self.assertRegex(done.stderr, r"\Ascumble: error: [^\n]+\n\Z")

    def test_an_old_picture_survives_a_failure(self):
        self.put("x.png", "mine")
        self.before = self.files()
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--set", "no.such=1", *TINY)
        self.bad(UNUSABLE, "render", "absent.gltf", "-o", "x.png", *TINY)
        self.assertEqual((self.folder / "x.png").read_text(), "mine")

    def test_devices(self):
        self.bad(NO_GPU, "render", "box.gltf", "-o", "x.png", "--device", "no such device", *TINY)
        self.bad(NO_GPU, "render", "box.gltf", "-o", "x.png", *TINY,
                 environment={"VK_ICD_FILENAMES": "/nonexistent.json", "VK_DRIVER_FILES": "/nonexistent.json"})


def main():
    global scumble, demo_scene, shared
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    scumble, demo_scene = (os.path.abspath(path) for path in sys.argv[1:3])
    with tempfile.TemporaryDirectory(prefix="scumble program shared ") as folder:
        shared = Path(folder)
        subprocess.run([demo_scene, shared / "demo.glb"], check=True, stdout=subprocess.DEVNULL)
        program = unittest.main(argv=[sys.argv[0], *sys.argv[3:]], exit=False)
    sys.exit(not program.result.wasSuccessful())


if __name__ == "__main__":
    main()
