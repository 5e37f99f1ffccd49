#!/usr/bin/env python3
"""`scumble xr` against a runtime without a headset (runtime.h): what is shown, in which order it is asked for, and what goes wrong.

    tests/xr/xr_test.py SCUMBLE DEMO_SCENE FOLDER [unittest's options]     FOLDER: a build's xr_test

The runtime is as strict as OpenXR allows and keeps what it was shown as pictures. Every call that draws runs under the
validation layers.
"""
import json
import math
import os
import re
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from gltf import Gltf  # noqa: E402
from png import read_png  # noqa: E402

DONE, OUR_FAULT, USAGE, UNUSABLE, NO_GPU = range(5)
SIZE = (96, 64)
CAMERA = ["--eye", "9,2.5,14", "--target", "0,2.5,0"]
UP, ACROSS = 0.4, math.atan(math.tan(0.4) * SIZE[0] / SIZE[1])  # radians, to all sides
ANGLES = [[-ACROSS, ACROSS, UP, -UP]] * 2
UNORM, SRGB, BGRA_SRGB, HALF = 37, 43, 50, 97  # VkFormat
# Headsets' marks are even by angles, however narrow their view is.
RADIAL = [word for block in ("warp", "texture", "ocean") for word in ("--set", f"{block}.metatexture.radial=on")]
AHEAD = [0, 0, 0, 0, 0, 0, 1]
scumble = demo_scene = small_scene = build = None
shared = None  # a folder for what several tests read


def ppm(path):
    data = Path(path).read_bytes()
    kind, size, most, pixels = data.split(b"\n", 3)
    assert (kind, most) == (b"P6", b"255"), path
    width, height = map(int, size.split())
    assert len(pixels) == width * height * 3, path
    return pixels


def exr_floats(path):
    """The numbers of an EXR of one channel of floats, ZIP: blocks of 16 lines, deflated, of differences between bytes of which
    the even ones come first."""
    data = Path(path).read_bytes()
    at = 8
    window = None
    while data[at]:
        name, at = data[at:data.index(0, at)], data.index(0, at) + 1
        kind, at = data[at:data.index(0, at)], data.index(0, at) + 1
        size = struct.unpack_from("<i", data, at)[0]
        at += 4
        if name == b"dataWindow":
            window = struct.unpack_from("<4i", data, at)
        at += size
    height = window[3] - window[1] + 1
    blocks = struct.unpack_from(f"<{(height + 15) // 16}Q", data, at + 1)
    raw = b""
    for block in blocks:
        size = struct.unpack_from("<i", data, block + 4)[0]
        packed = data[block + 8:block + 8 + size]
        lines = min(16, height - len(raw) // (4 * (window[2] + 1)))
        whole = lines * (window[2] - window[0] + 1) * 4
        if size < whole:
            coded = bytearray(zlib.decompress(packed))
            for i in range(1, len(coded)):
                coded[i] = (coded[i - 1] + coded[i] - 128) & 255
            half = (len(coded) + 1) // 2
            packed = bytearray(len(coded))
            packed[0::2], packed[1::2] = coded[:half], coded[half:]
        raw += bytes(packed)
    return struct.unpack(f"<{len(raw) // 4}f", raw)


def alike(a, b, levels=1):
    """The part of the bytes that differ by no more than so many levels."""
    assert len(a) == len(b)
    return sum(abs(x - y) <= levels for x, y in zip(a, b)) / len(a)


def write_small_scene(path):
    """Of the demo's size, with a ball that moves: a process that draws it takes a third of the time."""
    scene = Gltf()
    scene.floor(30, scene.material("Floor", (0.5, 0.6, 0.4, 1)))
    scene.ball(1.8, scene.material("Ball", (0.8, 0.3, 0.1, 1)), rows=12, columns=24, translation=(0, 3, 0))
    scene.lathe([(0, 5), (1.6, 3), (1.6, 0), (0, 0)], scene.material("Post", (0.2, 0.3, 0.6, 1)), columns=16, translation=(-4, 0, 2))
    scene.torus(1.5, 0.5, scene.material("Ring", (0.9, 0.8, 0.3, 1)), rows=8, columns=24, translation=(4, 2, -2))
    times, places = (0, 0.5, 1), ((0, 3, 0), (2.5, 4.5, 0), (0, 3, 0))
    scene.json["animations"] = [{"name": "Swing", "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}],
                                 "samplers": [{"input": scene.accessor(times, "SCALAR"), "output": scene.accessor(places, "VEC3")}]}]
    scene.json["accessors"][-2].update(min=[times[0]], max=[times[-1]])
    path.write_text(scene.text())


class Xr(unittest.TestCase):
    def setUp(self):
        self.scene, self.words = small_scene, []
        self.folder = Path(tempfile.mkdtemp(prefix="scumble xr "))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def environment(self, script):
        """With a runtime that does as the script says; its report is what `report` reads."""
        self.record = self.folder / f"record {len(list(self.folder.iterdir()))}"
        self.record.mkdir()
        file = self.record / "script.json"
        file.write_text(json.dumps({"record": str(self.record), "size": SIZE, "angles": ANGLES, "poses": [AHEAD], **script}))
        return {**os.environ, "XDG_CACHE_HOME": str(shared / "cache"), "XR_RUNTIME_JSON": str(build / "runtime.json"),
                "SCUMBLE_TEST_XR": str(file)}

    def report(self):
        return json.loads((self.record / "report.json").read_text())

    def picture(self, frame, eye="left"):
        return ppm(self.record / f"frame-{frame:04d}-{eye}.ppm")

    def call(self, *words, frames=1, camera=CAMERA, **script):
        return subprocess.run([scumble, "xr", self.scene, *camera, "--samples", "1", "--validate", "--frames", str(frames), *([] if "--ready" in words else ["--ready", "0"]),
                               *([] if "--resolution" in words else ["--resolution", "1"]), *self.words, *words],
                              env=self.environment(script), capture_output=True, text=True, timeout=200)

    def shown(self, *words, frames=1, **script):
        """Runs to the end; the frames that were shown, without a mistake."""
        done = self.call(*words, frames=frames, **script)
        self.assertEqual((done.returncode, done.stdout), (DONE, ""), done.stderr)
        self.assertRegex(done.stderr, r"\Ascumble: Cardboard head on Test runtime 1\.2\.3: twice 96x64[^\n]*\n")
        report = self.report()
        self.assertEqual(report["mistakes"], [])
        self.assertTrue(report["ended"])
        return [frame for frame in report["frames"] if frame["layers"]]

    def bad(self, code, *words, says, **script):
        done = self.call(*words, **script)
        self.assertEqual(done.returncode, code, done.stderr)
        lines = [line for line in done.stderr.splitlines() if not line.startswith("scumble: Cardboard head")]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertRegex(lines[0], r"\Ascumble: error: ")
        self.assertIn(says, lines[0])
        return done

    def rendered(self, *words, camera=CAMERA):
        """What `scumble render` draws for both eyes."""
        out = self.folder / "rendered.png"
        subprocess.run([scumble, "render", self.scene, *camera, "--fov", str(math.degrees(2 * UP)), "--size", f"{SIZE[0]}x{SIZE[1]}",
                        "--samples", "1", "--stereo", "separate", "--ipd", "0.064", "-o", str(out), "--quiet", *RADIAL, *words],
                       check=True, env={**os.environ, "XDG_CACHE_HOME": str(shared / "cache")})
        pixels = []
        for eye in ("left", "right"):
            width, height, channels, rows = read_png(self.folder / f"rendered.{eye}.png")
            self.assertEqual((width, height), SIZE)
            pixels.append(b"".join(row[i:i + 3] for row in rows for i in range(0, len(row), channels)))
        return pixels

    # -- What is shown

    def test_a_headset_shows_what_render_draws(self):
        self.scene = demo_scene
        frames = self.shown(frames=3, refreshRates=[60, 72, 90, 120])
        self.assertEqual([frame["frame"] for frame in frames], [0, 1, 2])
        self.assertEqual(self.report()["refreshRate"], 90)
        self.assertEqual(self.report()["swapchains"], [{"format": SRGB, "layers": 2}] + [{"format": SRGB, "layers": 1}] * 2, "UNORM is what runtimes take for light")
        for eye, wanted in zip(("left", "right"), self.rendered()):
            self.assertGreater(alike(self.picture(0, eye), wanted), 0.999, eye)
        self.assertLess(alike(self.picture(0, "left"), self.picture(0, "right")), 0.999, "one eye is shown twice")
        # Time goes on as frames are seen.
        for eye, wanted in zip(("left", "right"), self.rendered("--time", str(2 / 90))):
            self.assertGreater(alike(self.picture(2, eye), wanted), 0.999, eye)
        self.assertLess(alike(self.picture(0), self.picture(2)), 0.999, "nothing moves")

    def test_marks_are_as_large_aside_as_ahead(self):
        aside, ahead = self.folder / "aside.json", self.folder / "ahead.json"
        aside.write_text('{"warp": {"metatexture": {"radial": "off"}}}')
        ahead.write_text("{}")
        self.shown("--look", str(aside))
        without = self.picture(0)
        self.shown("--look", str(ahead))
        self.assertLess(alike(without, self.picture(0), 0), 1)
        self.assertGreater(alike(self.picture(0), self.rendered("--look", str(ahead))[0]), 0.999)

    def test_khronos_validation_finds_nothing(self):
        if not Path("/usr/share/openxr/1/api_layers/explicit.d/XrApiLayer_core_validation.x86_64-linux-gnu.json").exists():
            self.skipTest("openxr-layer-corevalidation is not installed")
        held = {"point left": [0, 1], "aim left": [self.HAND], "grab right": [0, 1], "aim right": [self.HAND], "walk": [[0, 1]], "turn": [[0, 0], [1, 0]]}
        for script in ({"depth": True, "refreshRates": [72, 90], "events": [{"frame": 3, "event": "stop"}]}, {"synthesis": "fb"},
                       {"depth": True, "insets": {"size": list(SIZE)}}, {"layers": False}):
            with self.subTest(script=script):
                words = self.folder / "words.txt"
                environment = {**self.environment({"hands": held, **script}), "XR_ENABLE_API_LAYERS": "XR_APILAYER_LUNARG_core_validation",
                               "XR_CORE_VALIDATION_EXPORT_TYPE": "text", "XR_CORE_VALIDATION_FILE_NAME": str(words)}
                done = subprocess.run([scumble, "xr", self.scene, *CAMERA, "--samples", "1", "--ready", "0", "--synthesis", "on", "--frames", "6"], env=environment,
                                      capture_output=True, text=True, timeout=100)
                self.assertEqual(done.returncode, DONE, done.stderr)
                self.assertIn("Core Validation", done.stdout + done.stderr, "the layer was not there")
                self.assertEqual(words.read_text() if words.exists() else "", "")

    def test_the_same_script_gives_the_same_bytes(self):
        poses = [[0.01 * i, 0.02 * i, 0, 0, math.sin(0.05 * i), 0, math.cos(0.05 * i)] for i in range(3)]
        self.shown(frames=3, poses=poses)
        first = [self.picture(i, eye) for i in range(3) for eye in ("left", "right")]
        self.shown(frames=3, poses=poses)
        self.assertTrue(first == [self.picture(i, eye) for i in range(3) for eye in ("left", "right")])

    def test_eyes_in_one_place_see_the_same(self):
        self.shown(ipd=0)
        self.assertTrue(self.picture(0, "left") == self.picture(0, "right"))

    def test_runtimes_without_layers_have_two_swapchains(self):
        self.shown()
        wanted = [self.picture(0, eye) for eye in ("left", "right")]
        self.shown(layers=False)
        self.assertEqual([chain["layers"] for chain in self.report()["swapchains"]], [1, 1, 1, 1])
        self.assertTrue(wanted == [self.picture(0, eye) for eye in ("left", "right")])

    def test_runtimes_are_told_how_far_away_it_is(self):
        wanted = [(self.shown(), self.picture(0, eye))[1] for eye in ("left", "right")]
        for layers in (True, False):
            frame = self.shown(depth=True, layers=layers, frames=2)[1]
            self.assertEqual([chain["format"] for chain in self.report()["swapchains"]], [SRGB, 126, SRGB, SRGB] if layers else [SRGB] * 2 + [126] * 2 + [SRGB] * 2)
            self.assertTrue(wanted == [self.picture(0, eye) for eye in ("left", "right")], "the picture is another one")
            for eye, seen in zip(("left", "right"), frame["eyes"]):
                # Reversed: 0 lies endlessly far away, and 1 at the near plane.
                self.assertEqual(seen["depth"]["nearZ"], -1)
                self.assertAlmostEqual(seen["depth"]["farZ"], 0.05, 6)
                raw = (self.record / f"frame-0000-{eye}.ppm.depth").read_bytes()
                depths = struct.unpack(f"<{SIZE[0] * SIZE[1]}f", raw)
                # By what `render` says of the same eye: along the axis, metres.
                self.rendered("--aov", "depth", "--exr", "float,zip")
                metres = exr_floats(self.folder / f"rendered.{eye}.depth.exr")
                self.assertEqual(len(metres), len(depths))
                self.assertGreater(sum(far < 1e5 for far in metres), len(metres) / 4)
                self.assertGreater(sum(far > 1e5 for far in metres), len(metres) / 8)
                fits = sum((depth == 0) if far > 1e5 else abs(0.05 / max(depth, 1e-9) - far) < 0.01 * far for depth, far in zip(depths, metres))
                self.assertGreater(fits / len(depths), 0.97, eye)

    def test_there_are_as_many_pixels_as_there_is_time_for(self):
        # Frames come faster than any device draws them.
        frames = self.shown("--resolution", "auto", frames=26, period=0.001)
        sizes = [tuple(frame["eyes"][0]["size"]) for frame in frames]
        self.assertEqual(sizes[0], SIZE)
        self.assertEqual(sizes, sorted(sizes, reverse=True))
        self.assertEqual(sizes[-1], (SIZE[0] // 2, SIZE[1] // 2))
        for frame in frames:
            self.assertEqual(frame["eyes"][0]["size"], frame["eyes"][1]["size"])
        # There is time for all of them.
        sizes = {tuple(frame["eyes"][0]["size"]) for frame in self.shown("--resolution", "auto", frames=6, period=60)}
        self.assertEqual(sizes, {SIZE})
        # Or somebody says how many: what is seen is the same, as sharp as that.
        frame = self.shown("--resolution", "0.5", depth=True)[0]
        self.assertEqual(frame["eyes"][0]["size"], [SIZE[0] // 2, SIZE[1] // 2])
        self.assertEqual(len(self.picture(0)), SIZE[0] * SIZE[1] * 3 // 4)
        for words in ("0.05", "2", "half"):
            self.bad(USAGE, "--resolution", words, says="auto")

    def test_the_runtime_says_which_format(self):
        self.shown()
        wanted = self.picture(0)
        self.shown(formats=[HALF, BGRA_SRGB, SRGB])
        self.assertEqual(self.report()["swapchains"][0]["format"], BGRA_SRGB)
        self.assertTrue(wanted == self.picture(0))
        self.shown(formats=[UNORM, HALF])
        self.assertEqual(self.report()["swapchains"][0]["format"], HALF)
        self.bad(NO_GPU, formats=[UNORM], says="XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED")

    def test_heads_go_and_turn(self):
        # A step to the right is a camera further right.
        self.shown(poses=[[2, 0, 0, 0, 0, 0, 1]])
        ahead = (-9 / math.hypot(9, 14), -14 / math.hypot(9, 14))
        right = (-ahead[1], ahead[0])
        place = f"{9 + 2 * right[0]},2.5,{14 + 2 * right[1]}"
        target = f"{2 * right[0]},2.5,{2 * right[1]}"
        for eye, wanted in zip(("left", "right"), self.rendered(camera=["--eye", place, "--target", target])):
            self.assertGreater(alike(self.picture(0, eye), wanted, 2), 0.998, eye)
        # In a room of ten metres a metre it takes a tenth of that.
        self.shown("--scale", "10", poses=[[0.2, 0, 0, 0, 0, 0, 1]], ipd=0.0064)
        for eye, wanted in zip(("left", "right"), self.rendered(camera=["--eye", place, "--target", target])):
            self.assertGreater(alike(self.picture(0, eye), wanted, 2), 0.99, eye)

    def test_a_floor_lies_below_the_camera(self):
        self.shown()
        wanted = self.picture(0)
        self.shown("--standing", floor=[0, 1.6, 0])
        self.assertGreater(alike(self.picture(0), wanted), 0.999)
        self.bad(NO_GPU, "--standing", stage=False, says="XR_ERROR_REFERENCE_SPACE_UNSUPPORTED")

    def test_the_newest_poses_are_drawn(self):
        self.shown()
        still = self.picture(0)
        # The runtime refuses layers from elsewhere than where it has last said that the eyes are.
        frames = self.shown(latch=[0.3, 0, 0])
        self.assertAlmostEqual(frames[0]["eyes"][0]["place"][0], 0.3 - 0.032, 5)
        self.assertLess(alike(self.picture(0), still), 0.99, "the picture is from where the head was before")
        self.shown(latchTurn=0.2)
        self.assertLess(alike(self.picture(0), still), 0.99)

    def test_eyes_may_look_out_of_the_middle(self):
        self.shown(angles=[[-0.9, 0.6, 0.5, -0.7], [-0.6, 0.9, 0.5, -0.7]])
        self.assertLess(alike(self.picture(0, "left"), self.picture(0, "right")), 0.9)

    def test_eyes_that_nobody_knows_of_see_nothing(self):
        known, placed, turned = 15, 2, 1
        frames = self.shown(frames=2, flags=[known, 0, placed, turned, known])
        self.assertEqual([frame["frame"] for frame in frames], [0, 4])
        # Nor do eyes of which nonsense is told.
        for script in ({"angles": [[0, 0, 0, 0]] * 2}, {"angles": [[-ACROSS, ACROSS, -UP, UP]] * 2}, {"poses": [[0] * 7]}):
            self.assertEqual(self.shown(frames=9, events=[{"frame": 3, "event": "exit"}], **script), [])

    def test_a_rate_may_be_refused(self):
        self.shown(refreshRates=[72, 90], fail={"xrRequestDisplayRefreshRateFB": -8})
        self.shown(refreshRates=[72, 90], fail={"xrEnumerateDisplayRefreshRatesFB": -8})

    # -- Hands

    def test_sticks_walk_and_turn(self):
        self.shown()
        still = self.picture(0)
        # A second and a half straight on at full speed, from the second frame on: 2.25 m.
        steps = 136
        self.shown(frames=steps, refreshRates=[90], hands={"walk": [[0, 1]]})
        away = math.hypot(9, 14)
        place = [9 - 9 / away * 2.25, 14 - 14 / away * 2.25]
        wanted = self.rendered("--time", str((steps - 1) / 90), camera=["--eye", f"{place[0]},2.5,{place[1]}", "--target", "0,2.5,0"])
        self.assertGreater(alike(self.picture(steps - 1), wanted[0], 2), 0.99)
        # Turned to the right by thirty degrees, once for a push that lasts.
        self.shown(frames=3, hands={"turn": [[0, 0], [0.9, 0]]})
        angle = math.atan2(-9, -14) - math.radians(30)
        target = f"{9 + math.sin(angle)},2.5,{14 + math.cos(angle)}"
        wanted = self.rendered("--time", str(2 / 72), camera=["--eye", "9,2.5,14", "--target", target])
        self.assertGreater(alike(self.picture(2), wanted[0], 2), 0.99)
        self.assertLess(alike(self.picture(2), still, 2), 0.9)
        self.assertIn("/interaction_profiles/oculus/touch_controller", self.report()["profiles"])

    def test_whoever_recentres_is_back_at_the_camera(self):
        self.shown(frames=4)
        wanted = self.picture(3)
        hands = {"walk": [[0, 1], [0, 1], [0, 0]], "turn": [[0, 0], [1, 0]]}
        self.shown(frames=4, hands=hands)
        gone = [self.picture(2), self.picture(3)]
        self.assertFalse(gone[1] == wanted)
        # As soon as the room has its new origin, and not before.
        self.shown(frames=4, hands=hands, events=[{"frame": 1, "event": "recentre"}])
        self.assertTrue(self.picture(2) == gone[0])
        self.assertTrue(self.picture(3) == wanted)
        # The floor is nothing to somebody who sits.
        self.shown(frames=4, hands=hands, events=[{"frame": 1, "event": "redrawFloor"}])
        self.assertTrue(self.picture(3) == gone[1])
        self.shown("--standing", frames=4, floor=[0, 1.6, 0], hands=hands, events=[{"frame": 1, "event": "redrawFloor"}])
        self.assertGreater(alike(self.picture(3), wanted), 0.999)

    def test_it_is_dark_around_while_sticks_move_one(self):
        still = [[0, 0]] * 4
        self.shown(frames=60, hands={"walk": still + [[0, 1]] * 12 + still})
        frames = self.report()["frames"][:60]
        self.assertTrue(all("quads" not in frame for frame in frames[:4]), "dark at rest")
        self.assertEqual([frame["layers"] for frame in frames[5:16]], [2] * 11)
        self.assertTrue(all("quads" not in frame for frame in frames[-2:]), "it stays")
        sizes = [frame["quads"][0]["size"] for frame in frames[5:16]]
        self.assertEqual(sizes, sorted(sizes, reverse=True), "it does not close")
        quad = frames[15]["quads"][0]
        self.assertEqual(quad["light"], 0)
        # As dark as it gets: free in the middle, black from 45 degrees on, by the tangent of where it is.
        alpha = [value / 255 for value in quad["alpha"]]
        at = lambda degrees: alpha[int(math.tan(math.radians(degrees)) * quad["distance"] / (quad["size"] / 2) * len(alpha))]  # noqa: E731
        self.assertEqual(at(0), 0)
        self.assertEqual(at(20), 0)
        self.assertGreater(at(52), 0.9)
        self.assertEqual(alpha, sorted(alpha))
        self.shown("--no-vignette", frames=8, hands={"walk": [[0, 1]]})
        self.assertTrue(all(frame["layers"] == 1 for frame in self.report()["frames"][:8]))

    def test_time_stands_still(self):
        self.shown(frames=4)
        second, third = self.picture(1), self.picture(2)
        # Paused as the third frame is asked for, and going on with the fourth.
        self.shown(frames=5, hands={"pause": [0, 0, 1, 1, 0]})
        self.assertTrue([self.picture(i) == second for i in (1, 2, 3, 4)] == [True] * 4)
        self.shown(frames=5, hands={"pause": [0, 0, 1, 0, 1]})
        self.assertTrue(self.picture(4) == third, "it does not go on from where it stood")
        # Nobody wears it.
        self.shown(frames=6, events=[{"frame": 1, "event": "takeOff"}, {"frame": 3, "event": "putOn"}])
        self.assertTrue(self.picture(2) == self.picture(3))
        self.assertFalse(self.picture(5) == self.picture(3))
        # Whoever takes it off may see nothing from then on, and something only after it is on again.
        self.shown(frames=4, events=[{"frame": 1, "event": "takeOff"}, {"frame": 1, "event": "hide"}, {"frame": 8, "event": "putOn"},
                                     {"frame": 10, "event": "show"}])
        shown = [frame["frame"] for frame in self.report()["frames"] if frame["layers"]]
        self.assertEqual(shown[0], 0)
        self.assertGreater(shown[-2], 9)
        later = [self.picture(frame) for frame in shown]
        self.assertTrue(second in later[:3] and third in later, "what nobody saw has gone on")
        # And where there is no more of it.
        self.shown("--time", "999999.98", frames=9)

    def test_a_button_takes_the_next_look(self):
        done = self.call("--look", "manga", frames=3, hands={"look": [0, 1, 1], "pause": [1]})
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertEqual(done.stderr.splitlines()[1:], ["scumble: look: age-of-sail"])
        self.assertEqual(self.report()["mistakes"], [])
        self.assertGreater(alike(self.picture(0), self.rendered("--look", "manga")[0]), 0.999)
        self.assertGreater(alike(self.picture(2), self.rendered("--look", "age-of-sail")[0]), 0.999)

    RIGHT = (14 / math.hypot(9, 14), 0, -9 / math.hypot(9, 14))  # of the camera, in the world
    HAND = [0.1, -0.1, -0.2, 0, 0, 0, 1]

    def test_a_wrist_changes_colours(self):
        self.scene = demo_scene
        rolled = [0.1, 0.025, -0.2, 0, 0, -math.sin(math.radians(20)), math.cos(math.radians(20))]  # and half as high as doubles it
        hands = {"pause": [1], "point right": [0] + [1] * 7 + [0], "aim right": [self.HAND] * 4 + [rolled]}
        done = self.call(frames=10, hands=hands)
        self.assertEqual(done.returncode, DONE, done.stderr)
        report = self.report()
        self.assertEqual(report["mistakes"], [])
        told = re.findall(r"^colours: (.*)$", done.stdout, re.M)
        self.assertEqual(len(told), 1, done.stdout)
        words = shlex.split(told[0])
        self.assertIn("materials.Sail.lit.hue=40", words)
        self.assertIn("materials.Sail.shadowed.brightness=1.41", words)
        # What it says is what is seen, from then on and after it is let go.
        before, after = self.rendered()[0], self.rendered(*words)[0]
        self.assertGreater(alike(self.picture(3), before), 0.999)
        self.assertGreater(alike(self.picture(9), after, 2), 0.998)
        self.assertLess(alike(before, after, 2), 0.99)
        # Meanwhile there is a ray, from the hand along where it points, with a dot at its end.
        frames = {frame["frame"]: frame for frame in report["frames"]}
        self.assertTrue(all("rays" in frames[i] for i in range(1, 8)))
        self.assertTrue(all("rays" not in frames[i] for i in (0, 8, 9)))
        line, dot = frames[5]["rays"]
        self.assertAlmostEqual(abs(line["along"][2]), 1, 3)
        self.assertAlmostEqual(line["at"][2] - line["size"][0] / 2, dot["at"][2], 3)
        self.assertAlmostEqual(line["at"][2] + line["size"][0] / 2, -0.2, 3)
        self.assertGreater(line["size"][0], 14, "it ends at the sail")
        self.assertLess(line["size"][0], 18)
        for quad in (line, dot):
            to_head = [-x for x in quad["at"]]
            self.assertGreater(sum(a * b for a, b in zip(quad["facing"], to_head)), 0, "it is seen from behind")
        # Who points at the sky changes nothing; nor does one of whose hand nobody knows where it is.
        up = [0, 0, 0, math.sin(0.6), 0, 0, math.cos(0.6)]
        self.shown(frames=8, hands={**hands, "aim right": [up]})
        self.assertTrue(self.picture(7) == self.picture(0))
        self.shown(frames=8, hands={"pause": [1], "point right": [0, 1]})
        self.assertTrue(all("rays" not in frame for frame in self.report()["frames"]))

    def test_hands_place_things(self):
        self.scene, self.words = demo_scene, ["--set", "ocean.mode=off"]  # which takes half of the time
        moved = [1.9, 0.9, -0.2, 0, 0, 0, 1]  # 1.8 m to the right, and 1 m up
        hands = {"pause": [1], "grab left": [0] + [1] * 8 + [0], "aim left": [self.HAND] * 5 + [moved]}
        done = self.call(frames=12, hands=hands)
        self.assertEqual((done.returncode, self.report()["mistakes"]), (DONE, []), done.stderr)
        told = re.search(r"^moved: 'Boat' at (\S+), (\S+), (\S+), turned by", done.stdout, re.M)
        self.assertTrue(told, done.stdout)
        whole = self.picture(11)
        self.assertLess(alike(whole, self.picture(0), 2), 0.97)
        self.assertTrue(self.picture(11) == self.picture(8), "it does not stay where it was let go")
        self.assertGreater(alike(self.picture(4), self.picture(0)), 0.999, "it jumps as it is taken")
        # As far as the hand; and nothing is told of what is where it was.
        self.assertEqual(self.call(frames=12, hands={**hands, "aim left": [self.HAND]}).stdout, "")
        back = [self.HAND] * 5 + [[1, -0.1, -0.2, 0, 0, 0, 1]]
        less = re.search(r"'Boat' at (\S+), (\S+), (\S+),", self.call(frames=12, hands={**hands, "aim left": back}).stdout)
        way = [float(a) - float(b) for a, b in zip(told.groups(), less.groups())]
        for is_so, wanted in zip(way, (0.9 * self.RIGHT[0], 1, 0.9 * self.RIGHT[2])):
            self.assertAlmostEqual(is_so, wanted, delta=0.011)
        # A part of it, by a push of the stick of that hand, which walks nowhere meanwhile. Those that clips move stay.
        later = {**hands, "aim left": [self.HAND] * 7 + [moved]}
        done = self.call(frames=12, hands={**later, "walk": [[0, 0]] * 5 + [[0, -1], [0, 0]]})
        self.assertEqual((done.returncode, self.report()["mistakes"]), (DONE, []), done.stderr)
        self.assertRegex(done.stdout, r"moved: '(Sails|Hull)' at")
        part = self.picture(11)
        self.assertLess(alike(part, self.picture(0), 2), 0.99)
        self.assertLess(alike(part, whole, 2), 0.99)
        # A stick that was pushed before is none of that.
        self.assertIn("moved: 'Boat'", self.call(frames=12, hands={**later, "walk": [[0, -1]]}, scale=1).stdout)
        # What one hand takes the other has no more.
        done = self.call(frames=14, hands={"pause": [1], "grab left": [0] + [1] * 12, "aim left": [self.HAND] * 6 + [moved], "grab right": [0] * 7 + [1] * 4 + [0], "aim right": [[0.1, -0.1, -0.2, 0, 0, 0, 1]] * 7 + [[1.9, 0.9, -0.2, 0, 0, 0, 1]]})
        self.assertEqual(done.stdout.count("moved: 'Boat'"), 1, done.stdout)
        self.assertEqual(self.report()["mistakes"], [])
        # What is held at the end is told; also to who wants quiet.
        self.assertIn("moved: 'Boat'", self.call("--quiet", frames=9, hands={**hands, "grab left": [0, 1]}).stdout)
        # Who sits in it is a part of it, though the mesh, which has joints, hangs elsewhere.
        aside, down = -0.285 / 2, -0.078 / 2
        turn = [math.cos(aside) * math.sin(down), math.sin(aside) * math.cos(down), -math.sin(aside) * math.sin(down), math.cos(aside) * math.cos(down)]
        at_sailor = {"pause": [1], "aim left": [[0, 0, 0, *turn]] * 6 + [[0, 1, 0, *turn]]}
        self.assertRegex(self.call(frames=9, hands={**at_sailor, "point left": [0] + [1] * 7 + [0]}).stdout, r"materials\.(Skin|Coat|Cap|Beard)\.")
        self.assertIn("moved: 'Boat'", self.call(frames=9, hands={**at_sailor, "grab left": [0] + [1] * 7 + [0]}).stdout)
        # A hand of which nobody knows where it is takes nothing; nor does one at the sky take its stick away.
        up = [0, 0, 0, math.sin(0.6), 0, 0, math.cos(0.6)]
        done = self.call(frames=9, hands={"pause": [1], "grab left": [0, 1, 1, 1, 1, 1, 0], "aim left": [None] * 4 + [up], "grab right": [0, 1, 1, 1, 1, 0], "aim right": [up]})
        self.assertEqual((done.returncode, done.stdout), (DONE, ""), done.stderr)
        self.shown(frames=6, hands={"pause": [1]})
        self.assertLess(alike((self.call(frames=30, hands={"pause": [1], "grab left": [1], "aim left": [up], "walk": [[0, 1]]}), self.picture(29))[1], self.picture(0), 2), 0.999)

    def test_hands_are_others_without_the_focus(self):
        self.shown(frames=6)
        wanted = [self.picture(i) for i in range(6)]
        # A push is not seen before the focus is back, and its event has come.
        self.shown(frames=6, hands={"turn": [[1, 0]]}, events=[{"frame": 0, "event": "blur"}, {"frame": 3, "event": "focus"}])
        self.assertEqual([self.picture(i) == wanted[i] for i in range(6)], [True, True, True, True, False, False])

    # -- Frames between, and who looks on

    def test_runtimes_are_told_where_everything_was(self):
        # The head goes and turns while time stands: what was where is known from how far away it is.
        turn = 0.06
        poses = [AHEAD, [0.05, 0.02, -0.1, 0, math.sin(turn / 2), 0, math.cos(turn / 2)]]
        self.shown(frames=4, poses=poses, hands={"pause": [1]})
        pictures = [self.picture(i, eye) for i in range(4) for eye in ("left", "right")]
        for kind, layers in (("ext", True), ("both", True), ("fb", True), ("fb", False)):
            frames = self.shown("--synthesis", "on", frames=4, poses=poses, hands={"pause": [1]}, synthesis=kind, layers=layers)
            self.assertTrue(pictures == [self.picture(i, eye) for i in range(4) for eye in ("left", "right")], "marks lie elsewhere")
            for index, eye in enumerate(("left", "right")):
                # The first one is like none before.
                first = frames[0]["eyes"][index]
                self.assertTrue("motion" not in first if kind != "fb" else first["motion"]["flags"] == 1)
                self.assertEqual(frames[1]["eyes"][index]["motion"]["flags"], 0 if kind == "fb" else 2)
                # Which way y goes.
                up = -1 if kind == "fb" else 1
                self.assertEqual(frames[1]["eyes"][index]["motion"].get("up"), {"ext": 1, "both": -1, "fb": None}[kind])
                self.assertAlmostEqual(frames[1]["eyes"][index]["motion"]["farZ"], 0.05, 6)
                self.assertEqual(frames[1]["eyes"][index]["motion"]["room"], [0, 0, 0, 0, 0, 0, 1])
                width, height = 24, 16
                motion = struct.unpack(f"<{width * height * 4}e", (self.record / f"frame-0001-{eye}.ppm.motion").read_bytes())
                depth = struct.unpack(f"<{width * height}f", (self.record / f"frame-0001-{eye}.ppm.motion-depth").read_bytes())
                self.assertGreater(sum(d == 0 for d in depth), 20)
                self.assertGreater(sum(d > 0 for d in depth), 100)
                across, high = math.tan(ACROSS), math.tan(UP)
                aside = -0.032 if eye == "left" else 0.032
                off = 0
                for i, d in enumerate(depth):
                    x, y = ((i % width + 0.5) / width * 2 - 1), ((i // width + 0.5) / height * 2 - 1)
                    ray = (x * across, -y * high, -1)
                    far = 0.05 / d if d > 0 else 1
                    # In the eye, in the head, in the room, and back to the eye before.
                    place = [c * far for c in ray]
                    if d > 0:
                        place[0] += aside
                    c, s = math.cos(turn), math.sin(turn)
                    place = [c * place[0] + s * place[2], place[1], -s * place[0] + c * place[2]]
                    if d > 0:
                        place = [place[0] + 0.05 - aside, place[1] + 0.02, place[2] - 0.1]
                    before = (place[0] / -place[2] / across, -place[1] / -place[2] / high, 0.05 / -place[2] if d > 0 else 0)
                    wanted = (x - before[0], up * (y - before[1]), d - before[2])
                    off += any(abs(a - b) > 2e-3 for a, b in zip(motion[4 * i:4 * i + 3], wanted))
                self.assertLessEqual(off, 4, eye)
                # And nothing moves where nobody does.
                still = struct.unpack(f"<{width * height * 4}e", (self.record / f"frame-0003-{eye}.ppm.motion").read_bytes())
                self.assertLess(max(abs(value) for i, value in enumerate(still) if i % 4 < 3), 1e-3)
        # Who walks takes the room along; who turns by thirty degrees at once is somewhere else.
        frames = self.shown("--synthesis", "on", frames=5, synthesis="fb", hands={"walk": [[0, 0], [0, 0], [0, 1]], "turn": [[0, 0]] * 4 + [[1, 0]]})
        self.assertAlmostEqual(frames[3]["eyes"][0]["motion"]["room"][2], -1.5 / 72, 4)
        self.assertEqual([frame["eyes"][0]["motion"]["flags"] for frame in frames], [1, 0, 0, 0, 1])
        # One that has no word for that gets none of it then.
        frames = self.shown("--synthesis", "on", frames=2, synthesis="fb", fbVersion=1)
        self.assertEqual(["motion" in frame["eyes"][0] for frame in frames], [False, True])

    def test_frames_are_made_between_where_there_is_no_time(self):
        words = ("--resolution", "auto", "--synthesis", "auto")
        done = self.call(*words, frames=30, period=0.001, synthesis="ext")
        self.assertEqual((done.returncode, self.report()["mistakes"]), (DONE, []), done.stderr)
        self.assertIn("the runtime makes every other frame from here on", done.stderr)
        has = ["motion" in frame["eyes"][0] for frame in self.report()["frames"] if frame["layers"]]
        self.assertEqual((has[0], has[-1]), (False, True))
        self.assertEqual(has, sorted(has))
        for words, script in ((words, {"period": 60, "synthesis": "ext"}), ((), {"synthesis": "fb"})):
            frames = self.shown(*words, frames=8, **script)
            self.assertFalse(any("motion" in frame["eyes"][0] for frame in frames))
        done = self.call("--synthesis", "on")
        self.assertIn("the runtime makes no frames by itself", done.stderr)
        self.assertEqual(done.returncode, DONE)

    def test_insets_are_finer_parts_of_what_eyes_see(self):
        # Of the middle third each way, and a little aside, three times as fine.
        third = lambda angle: math.atan(math.tan(angle) / 3)  # noqa: E731
        insets = {"size": list(SIZE), "angles": [[-third(ACROSS), third(ACROSS), third(UP), -third(UP)]] * 2}
        for look in ("age-of-sail", "storm", "ink", "watercolour"):
            with self.subTest(look=look):
                frames = self.shown("--look", look, frames=2, insets=insets, depth=True, latch=[0.01, 0, 0])
                self.assertEqual([chain["format"] for chain in self.report()["swapchains"]], [SRGB, SRGB, 126, 126, SRGB, SRGB])
                self.assertEqual(len(frames[1]["eyes"]), 4)
                self.assertTrue(all("depth" in eye for eye in frames[1]["eyes"]))
                for eye in ("left", "right"):
                    whole, inset = self.picture(1, eye), self.picture(1, f"inset-{eye}")
                    width, height = SIZE[0] // 3, SIZE[1] // 3 // 1
                    off = total = 0
                    for y in range(height):
                        for x in range(width):
                            for c in range(3):
                                mean = sum(inset[3 * ((3 * y + 1 + dy) * SIZE[0] + 3 * x + dx) + c] for dy in range(3) for dx in range(3)) / 9
                                # A pixel's neighbours: three do not go into 64.
                                near = [whole[3 * ((SIZE[1] // 3 + y + dy) * SIZE[0] + SIZE[0] // 3 + x + dx) + c] for dy in (0, 1) for dx in (-1, 0, 1)]
                                off += not min(near) - 40 <= mean <= max(near) + 40
                                total += 1
                    self.assertLess(off / total, 0.03, (look, eye))
        # Pixels go for both alike, and there is a view for a hand and for who looks on.
        frames = self.shown("--resolution", "0.5", "-o", str(self.folder / "film.mp4"), "--size", "64x48", "--synthesis", "on", frames=5, insets=insets,
                            hands={"point right": [0, 1], "aim right": [self.HAND]}, synthesis="ext")
        self.assertEqual([eye["size"] for eye in frames[4]["eyes"]], [[SIZE[0] // 2, SIZE[1] // 2]] * 4)
        self.assertEqual(len(frames[4]["rays"]), 2)

    def test_others_look_on(self):
        poses = [AHEAD, [0.05, 0, 0, 0, 0, math.sin(0.2), math.cos(0.2)]]
        self.shown(frames=3, poses=poses)
        wanted = [self.picture(i, eye) for i in range(3) for eye in ("left", "right")]
        film = self.folder / "film.mp4"
        self.shown("-o", str(film), "--size", "192x108", "--fps", "72", "--steady", "0", frames=3, poses=poses, refreshRates=[72])
        self.assertTrue(wanted == [self.picture(i, eye) for i in range(3) for eye in ("left", "right")], "eyes see something else")
        raw = subprocess.run(["ffmpeg", "-v", "error", "-i", str(film), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], capture_output=True, check=True).stdout
        self.assertEqual(len(raw), 3 * 192 * 108 * 3)
        # From between the eyes, upright though the head is not.
        out = self.folder / "onlooker.png"
        for index, aside in ((0, 0), (2, 0.05)):
            eye = [9 + aside * self.RIGHT[0], 2.5, 14 + aside * self.RIGHT[2]]
            target = [aside * self.RIGHT[0], 2.5, aside * self.RIGHT[2]]
            subprocess.run([scumble, "render", self.scene, "--eye", ",".join(map(str, eye)), "--target", ",".join(map(str, target)), "--fov", "60",
                            "--size", "192x108", "--samples", "1", "--time", str(index / 72), "-o", str(out), "--quiet"], check=True)
            width, height, channels, rows = read_png(out)
            seen = b"".join(row[i:i + 3] for row in rows for i in range(0, len(row), channels))
            self.assertGreater(alike(raw[index * len(seen):(index + 1) * len(seen)], seen, 24), 0.97, index)
        # At another rate, pictures stand as long as it takes.
        self.shown("-o", str(film), "--size", "64x64", "--fps", "30", frames=73, refreshRates=[72])
        counted = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames,avg_frame_rate", "-of", "csv=p=0", str(film)],
                                 capture_output=True, text=True, check=True).stdout.strip()
        self.assertEqual(counted, "30/1,31")
        for words, says in ((["-o", "film.png"], "no film"), (["-o", str(self.scene)], "ends in none of"), (["--size", "1x1", "-o", "a.mp4"], "--size"),
                            (["--fps", "0", "-o", "a.mp4"], "--fps"), (["--steady", "-1"], "--steady"), (["--ready", "nan"], "--ready")):
            with self.subTest(words=words):
                self.bad(USAGE, *words, says=says)
        self.bad(5, "-o", "/no/such/folder/a.mp4", says="/no/such/folder")
        done = subprocess.run([scumble, "xr", self.scene, "--frames", "0", "--ready", "0", "-o", str(self.folder / "none.mp4")], env=self.environment({}),
                              capture_output=True, text=True, timeout=100)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("no frame was seen", done.stderr)
        done = subprocess.run([scumble, "xr", self.scene, "--frames", "-1"], env=self.environment({}), capture_output=True, text=True, timeout=100)
        self.assertEqual(done.returncode, USAGE, done.stderr)
        # What nobody saw is a second at most.
        self.shown("-o", str(film), "--size", "64x64", "--fps", "10", frames=3, period=20)
        counted = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames", "-of", "csv=p=0", str(film)],
                                 capture_output=True, text=True, check=True).stdout.strip()
        self.assertEqual(counted, "21")

    def test_looks_are_made_ready(self):
        self.scene = demo_scene
        done = self.call("--ready", "600", "--look", "manga", frames=3, hands={"look": [0, 1, 1], "pause": [1]})
        self.assertEqual((done.returncode, self.report()["mistakes"]), (DONE, []), done.stderr)
        self.assertNotIn("are ready", done.stderr)
        self.assertGreater(alike(self.picture(0), self.rendered("--look", "manga")[0]), 0.999)
        self.assertGreater(alike(self.picture(2), self.rendered("--look", "age-of-sail")[0]), 0.999)
        done = self.call("--ready", "0.001")
        self.assertRegex(done.stderr, r"2 of \d+ looks are ready; the others take a moment when they are taken")

    # -- Sessions

    def test_what_nobody_sees_is_not_drawn(self):
        frames = self.shown(frames=4, events=[{"frame": 1, "event": "hide"}, {"frame": 4, "event": "show"}])
        # A state is known once it was asked for: the frame that is under way is still seen.
        self.assertEqual(len(frames), 4)
        empty = [frame["frame"] for frame in self.report()["frames"] if not frame["layers"]]
        self.assertTrue(set(empty) >= {2, 3}, empty)

    def test_sessions_stop_and_begin_again(self):
        frames = self.shown(frames=5, events=[{"frame": 1, "event": "stop"}])
        self.assertEqual(len(frames), 5)
        self.assertEqual(self.report()["calls"].count("xrBeginSession"), 2)
        self.assertEqual(self.report()["calls"].count("xrCreateSession"), 1)

    def test_the_runtime_may_end_it(self):
        frames = self.shown(frames=1000, events=[{"frame": 2, "event": "exit"}])
        self.assertLess(len(frames), 5)

    def test_a_session_that_is_lost_begins_anew(self):
        done = self.call(frames=4, events=[{"frame": 1, "event": "loseSession"}], comesBack=3)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("the headset was lost", done.stderr)
        report = self.report()
        self.assertEqual(report["mistakes"], [])
        self.assertEqual(sum(frame["layers"] for frame in report["frames"]), 4)
        self.assertEqual(report["calls"].count("xrCreateSession"), 2)
        self.assertTrue(report["ended"])

    def test_a_session_that_is_lost_again_and_again_does_not_spin(self):
        for call in ("xrWaitFrame", "xrCreateSession"):
            with self.subTest(call=call):
                process = subprocess.Popen([scumble, "xr", self.scene, "--samples", "1", "--quiet"],
                                           env=self.environment({"fail": {call: -17}}), stderr=subprocess.PIPE, text=True)
                time.sleep(4)
                self.assertIsNone(process.poll())
                process.send_signal(signal.SIGINT)
                self.assertEqual((process.communicate(timeout=60)[1], process.returncode), ("", DONE))
                self.assertLess(self.report()["calls"].count("xrCreateSession"), 500)
                self.assertEqual(self.report()["mistakes"], [])

    def test_a_runtime_that_does_not_answer_is_left(self):
        start = time.monotonic()
        done = self.call(mute=True)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertLess(time.monotonic() - start, 30)
        self.assertEqual(self.report()["mistakes"], [])

    def test_a_keyboard_ends_it(self):
        process = subprocess.Popen([scumble, "xr", self.scene, "--samples", "1", "--validate", "--quiet"], env=self.environment({}),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        until = time.monotonic() + 60
        while not (self.record / "frame-0001-right.ppm").exists() and time.monotonic() < until:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(timeout=60), ("", ""))
        self.assertEqual(process.returncode, DONE)
        report = self.report()
        self.assertEqual(report["mistakes"], [])
        self.assertTrue(report["ended"])
        self.assertEqual(report["calls"].count("xrRequestExitSession"), 1)

    # -- What goes wrong

    def test_what_is_missing_is_told_in_a_line(self):
        self.bad(NO_GPU, headset=False, says="the runtime has no headset")
        self.bad(NO_GPU, vulkan=False, says="does not take Vulkan")
        for words in ([], ["--quiet"]):
            for runtime, preload, says in (("/no/such.json", "", "no OpenXR runtime is there"),
                                           (str(build / "runtime.json"), str(build / "libscumble_no_loader.so"), "is not installed")):
                environment = {**self.environment({}), "XR_RUNTIME_JSON": runtime, "LD_PRELOAD": preload}
                # Also where nothing else could be read.
                done = subprocess.run([scumble, "xr", "no.glb", *words], env=environment, capture_output=True, text=True, timeout=60)
                self.assertEqual((done.returncode, done.stdout), (NO_GPU, ""), done.stderr)
                self.assertRegex(done.stderr, r"\Ascumble: error: [^\n]+\n\Z")
                self.assertIn(says, done.stderr)

    def test_calls_that_fail_end_it(self):
        for call, result, says in (("xrCreateInstance", -1, "XR_ERROR_VALIDATION_FAILURE"),
                                   ("xrCreateInstance", -6, "the runtime cannot start"),
                                   ("xrCreateVulkanInstanceKHR", -2, "start it again"),
                                   ("xrGetVulkanGraphicsDevice2KHR", -2, "xrGetVulkanGraphicsDevice2KHR"),
                                   ("xrCreateVulkanDeviceKHR", -2, "xrCreateVulkanDeviceKHR"),
                                   ("xrCreateSession", -38, "XR_ERROR_GRAPHICS_DEVICE_INVALID"),
                                   ("xrCreateReferenceSpace", -2, "xrCreateReferenceSpace"),
                                   ("xrEnumerateSwapchainImages", -2, "xrEnumerateSwapchainImages"),
                                   ("xrCreateSwapchain", -2, "xrCreateSwapchain"),
                                   ("xrBeginSession", -2, "xrBeginSession"),
                                   ("xrSyncActions", -2, "xrSyncActions"),
                                   ("xrLocateViews", -2, "xrLocateViews"),
                                   ("xrLocateViews", [-2, 2], "xrLocateViews"),
                                   ("xrAcquireSwapchainImage", -2, "xrAcquireSwapchainImage"),
                                   ("xrAcquireSwapchainImage", [-2, 3], "xrAcquireSwapchainImage"),
                                   ("xrReleaseSwapchainImage", [-2, 3], "xrReleaseSwapchainImage"),
                                   ("xrWaitFrame", -13, "the runtime has ended"),
                                   ("xrEndFrame", -2, "xrEndFrame")):
            with self.subTest(call=call, result=result):
                done = self.bad(NO_GPU, fail={call: result}, says=says)
                self.assertIn(f"({call}: ", done.stderr)
                report = self.report()
                self.assertEqual(report["mistakes"], [])
                self.assertEqual(report["calls"].count("xrBeginFrame"), report["calls"].count("xrEndFrame"))

    def test_an_instance_that_is_lost_ends_it(self):
        self.bad(NO_GPU, frames=1000, events=[{"frame": 2, "event": "loseInstance"}], says="the runtime has ended")

    def test_words_that_make_no_sense(self):
        for words in (["--scale", "0"], ["--scale", "nan"], ["--rate", "-1"], ["--samples", "3"], ["--time", "1e9"], ["--eye", "1,2"],
                      ["--fov", "40"], ["--camera", "zzz"], ["--frame", "zzz"], ["--look", "no-such-look"]):
            with self.subTest(words=words):
                done = self.call(*words)
                self.assertEqual(done.returncode, USAGE, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                if (self.record / "report.json").exists():
                    self.assertNotIn("xrCreateSession", self.report()["calls"], "a session was begun for nothing")

    def test_devices_lists_the_headset(self):
        def listed(**script):
            environment = self.environment(script)
            environment["XR_RUNTIME_JSON"] = script.get("runtime", environment["XR_RUNTIME_JSON"])
            done = subprocess.run([scumble, "devices"], env=environment, capture_output=True, text=True, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (DONE, ""))
            return done.stdout.splitlines()[-1]
        self.assertEqual(listed(), "headset: Cardboard head, on Test runtime 1.2.3")
        self.assertIn("headset: none, on Test runtime 1.2.3: the runtime has no headset", listed(headset=False))
        self.assertIn("headset: none: no OpenXR runtime is there", listed(runtime="/no/such.json"))


if __name__ == "__main__":
    scumble, demo_program, build = (Path(word).resolve() for word in sys.argv[1:4])
    with tempfile.TemporaryDirectory(prefix="scumble xr shared ") as folder:
        shared = Path(folder)
        demo_scene = shared / "demo.glb"
        subprocess.run([demo_program, demo_scene], check=True, capture_output=True)
        small_scene = shared / "small.gltf"
        write_small_scene(small_scene)
        unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
