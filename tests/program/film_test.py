#!/usr/bin/env python3
"""Clips, sequences and films from outside.

    tests/program/film_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
"""
import base64
import json
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import unittest
from pathlib import Path

import program_test
from program_test import NOT_WRITTEN, TINY, UNUSABLE, USAGE, Program, exr, gltf, png

QUIET = [*TINY, "--quiet"]


def clip(number, name, translation, seconds=1.0):
    """An animation that moves node 0 from where it is to `translation`, in accessors of its own."""
    data = struct.pack("<2f", 0, seconds) + struct.pack("<6f", 0, 0, 0, *translation)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    buffer, view, accessor = 1 + number, 2 + 2 * number, 2 + 2 * number
    return {
        "buffers": [{"byteLength": len(data), "uri": uri}],
        "bufferViews": [{"buffer": buffer, "byteOffset": 0, "byteLength": 8}, {"buffer": buffer, "byteOffset": 8, "byteLength": 24}],
        "accessors": [{"bufferView": view, "componentType": 5126, "type": "SCALAR", "count": 2, "min": [0], "max": [seconds]},
                      {"bufferView": view + 1, "componentType": 5126, "type": "VEC3", "count": 2}],
        "animations": [{"name": name, "samplers": [{"input": accessor, "output": accessor + 1}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]}


def moving(camera=True):
    """The box with two clips: it rises, or walks aside, both for a second."""
    scene = json.loads(gltf(camera=camera))
    for number, (name, to) in enumerate((("Rise", (0, 1.5, 0)), ("Walk.001", (2, 0, 0)))):
        for key, items in clip(number, name, to).items():
            scene.setdefault(key, []).extend(items)
    return json.dumps(scene)


def probe(path, entries):
    text = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", entries, "-of", "json", str(path)],
                          capture_output=True, text=True, check=True).stdout
    return json.loads(text)


class Bench(Program):
    """Which times are measured: a look that adds the pass `behind` from 0.04 s on tells."""

    LATER = {"final": {"ripple": {"keys": [[0, "depth-aware"], [0.04, "layered"]]}}}

    def bench(self, *args):
        report = json.loads(self.good("bench", "box.gltf", *TINY, *args, "--json"))
        self.assertEqual(report["runs"], int(args[args.index("--runs") + 1]))
        report["isLate"] = "behind" in [each["name"] for each in report["passes"]]
        return report

    def test_a_time_and_moving(self):
        self.put("later.json", json.dumps(self.LATER))
        look = ["--look", "later.json"]
        for time in (0, 0.0399, 0.041, 5):
            still = self.bench(*look, "--runs", "2", *(["--time", str(time)] if time else []))
            self.assertEqual((still["mode"], still["times"], still["isLate"]), ("still", [time], time > 0.04))
        for runs, start, isLate in (("1", 0, False), ("2", 0, True), ("1", 0.041, True), ("3", -0.1, False), ("3", -0.04, True)):
            moving = self.bench(*look, "--runs", runs, "--moving", f"--time={start}")
            self.assertEqual((moving["mode"], moving["isLate"]), ("moving", isLate), (runs, start))
            self.assertEqual(len(moving["times"]), int(runs))
            for number, time in enumerate(moving["times"]):
                self.assertAlmostEqual(time, start + number / 24)

    def test_moving_cameras_go_along(self):
        # From 0.04 s on the eye is on its target, from where nothing is seen.
        self.put("eye.json", json.dumps({"camera": {"mode": "eye", "eye": {
            "keys": [[0, [3, 2, 5]], [0.04, [3, 2, 5.001]], [0.041, [0, 0, 0]]]}}}))
        look = ["bench", "box.gltf", *TINY, "--look", "eye.json", "--runs"]
        self.good(*look, "2")
        self.good(*look, "1", "--moving")
        self.bad(USAGE, *look, "2", "--time", "0.05")
        self.bad(USAGE, *look, "2", "--moving")

    def test_spread_and_text(self):
        report = self.bench("--runs", "3")
        for key in ("frameMilliseconds", "yardstickMilliseconds", "ratio"):
            spread = report["spread"][key]
            self.assertEqual(spread["median"], report[key])
            self.assertTrue(0 < spread["least"] <= spread["median"] <= spread["most"], spread)
        self.assertIn("still: at 1.5 s", self.good("bench", "box.gltf", "--runs", "1", "--time", "1.5", *TINY))
        self.assertIn("moving: from 1.5 s to", self.good("bench", "box.gltf", "--runs", "2", "--time", "1.5", "--moving", *TINY))

    def test_times_out_of_range(self):
        for args in (["--time", "1e6"], ["--time", "nan"], ["--time", "999999.99", "--moving", "--runs", "9"], ["--time=-1e7"]):
            with self.subTest(args=args):
                self.bad(USAGE, "bench", "box.gltf", *TINY, *args, says="--time")


class Film(Program):
    def setUp(self):
        super().setUp()
        self.put("move.gltf", moving())
        self.before = self.files()

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def draw(self, *args, scene="move.gltf"):
        self.good("render", scene, *args, *QUIET)


class Clips(Film):
    def test_the_first_clip_plays_and_others_when_asked_for(self):
        for name, args in (("rest", ["--set", "clips.*.play.weight=0"]), ("first", []), ("rise", ["--clip", "Rise"]),
                           ("zero", ["--clip", "0"]), ("walk", ["--clip", "Walk.001"]), ("one", ["--clip", "1"]),
                           ("set", ["--set", "clips.Walk.001.play.weight=1"])):
            self.draw("-o", name + ".png", "--time", "0.5", *args)
        pictures = {name: self.bytes(name + ".png") for name in ("rest", "first", "rise", "zero", "walk", "one", "set")}
        self.same(pictures["first"], pictures["rise"])
        self.same(pictures["rise"], pictures["zero"])
        self.same(pictures["walk"], pictures["one"])
        self.same(pictures["walk"], pictures["set"])
        self.assertEqual(len({pictures[name] for name in ("rest", "rise", "walk")}), 3)

    def test_time_is_seconds_and_clips_begin_again(self):
        for name, seconds in (("a", "0.25"), ("b", "1.25"), ("c", "-0.75"), ("d", "0.5")):
            self.draw("-o", name + ".png", "--time", seconds)
        self.same(self.bytes("a.png"), self.bytes("b.png"))
        self.same(self.bytes("a.png"), self.bytes("c.png"))
        self.different(self.bytes("a.png"), self.bytes("d.png"))

    def test_a_clip_that_is_not_there(self):
        self.bad(USAGE, "render", "move.gltf", "-o", "x.png", "--clip", "Run", *TINY, says=["'Run'", "Rise, Walk.001"])
        self.bad(USAGE, "render", "move.gltf", "-o", "x.png", "--clip", "2", *TINY, says="'2'")
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--clip", "Rise", *TINY, says="none at all")

    def test_the_end_of_a_name_that_blender_wrote(self):
        self.put("blender.gltf", moving().replace('"Walk.001"', '"Armature|Walk"'))
        self.before = self.files()
        self.draw("-o", "a.png", "--time", "0.5", "--clip", "Walk", scene="blender.gltf")
        self.draw("-o", "b.png", "--time", "0.5", "--clip", "Armature|Walk", scene="blender.gltf")
        self.same(self.bytes("a.png"), self.bytes("b.png"))

    def test_settings_for_names_that_are_not_there_are_warned_of(self):
        done = self.run_program("render", "move.gltf", "-o", "a.png", "--set", "nodes.Bax.animation.hold=3",
                                "--set", "nodes.B*.animation.hold=3", "--set", "clips.Run.play.weight=1", *TINY)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"\Ascumble: warning: --set nodes\.Bax: [^\n]+\nscumble: warning: --set clips\.Run: [^\n]+\n\Z")

    def test_poses_that_a_look_holds_stand_for_two_frames(self):
        self.put("hold.json", '{"nodes": {"Box": {"animation": {"hold": 2}}}}')
        self.before = self.files()
        self.draw("-o", "held.#.png", "--frames", "0..5", "--look", "hold.json")
        self.draw("-o", "free.#.png", "--frames", "0..5")
        for frame in (0, 2, 4):
            self.same(self.bytes(f"held.{frame}.png"), self.bytes(f"held.{frame + 1}.png"))
            self.same(self.bytes(f"held.{frame}.png"), self.bytes(f"free.{frame}.png"))
        # So small a picture does not show every step.
        self.assertGreater(len({self.bytes(f"free.{frame}.png") for frame in range(6)}), 3)

    def test_a_track_in_the_look_moves_a_knob_and_set_wins(self):
        self.put("track.json", '{"shadow": {"threshold": {"keys": [[0, 0.2], [1, 0.8]]}}}')
        self.before = self.files()
        for name, args in (("track", ["--time", "0.5"]), ("half", ["--set", "shadow.threshold=0.5"])):
            self.draw("-o", name + ".png", "--look", "track.json", "--set", "clips.*.play.weight=0", *args)
        self.same(self.bytes("track.png"), self.bytes("half.png"))
        self.put("wrong.json", '{"shadow": {"threshold": {"keys": [[0, 0.2], [1, "much"]]}}}')
        self.before = self.files()
        self.bad(program_test.UNUSABLE, "render", "move.gltf", "-o", "x.png", "--look", "wrong.json", *TINY,
                 says="(shadow.threshold.keys[1][1])")

    def test_motion_is_what_a_frame_moved(self):
        self.draw("-o", "m.exr", "--time", "0.5", "--aov", "motion", "--set", "nodes.Box.animation.hold=0")
        self.draw("-o", "still.exr", "--time", "0.5", "--aov", "motion", "--set", "clips.*.play.weight=0")
        self.different(self.bytes("m.exr"), self.bytes("still.exr"))


class Sequences(Film):
    def test_split_over_processes_and_alone_the_bytes_are_the_same(self):
        self.draw("-o", "all.##.png", "--frames", "0..7")
        self.draw("-o", "part.##.png", "--frames", "4..7")
        self.draw("-o", "part.##.png", "--frames", "0..3")
        self.draw("-o", "alone.png", "--time", str(5 / 24))
        for frame in range(8):
            self.same(self.bytes(f"all.{frame:02}.png"), self.bytes(f"part.{frame:02}.png"))
        self.same(self.bytes("all.05.png"), self.bytes("alone.png"))

    def test_layers_too_and_in_stereo(self):
        for args in ([], ["--stereo", "side-by-side"]):
            self.draw("-o", "all.#.exr", "--frames", "0..3", "--aov", "all", *args)
            self.draw("-o", "part.#.exr", "--frames", "2..3", "--aov", "all", *args)
            self.draw("-o", "part.#.exr", "--frames", "0..1", "--aov", "all", *args)
            for frame in range(4):
                self.same(self.bytes(f"all.{frame}.exr"), self.bytes(f"part.{frame}.exr"))

    def test_resume_draws_what_is_not_whole(self):
        args = ["-o", "x.#.png", "--frames", "0..4", "--aov", "id"]
        self.draw(*args)
        wanted = {name: self.bytes(name) for name in self.new_files()}
        (self.folder / "x.0.png").write_bytes(b"")  # as a farm's lock would be
        (self.folder / "x.1.png").write_bytes(wanted["x.1.png"][:-20])
        (self.folder / "x.2.id.exr").unlink()
        self.good("render", "box.gltf", "-o", "x.3.png", "--size", "20x20", "--samples", "1", "--quiet")
        time.sleep(0.02)
        before = (self.folder / "x.4.png").stat().st_mtime_ns
        self.draw(*args, "--resume")
        for name, content in wanted.items():
            self.same(self.bytes(name), content, name)
        self.assertEqual((self.folder / "x.4.png").stat().st_mtime_ns, before, "a whole frame is left as it is")

    def test_a_film_that_is_ended_keeps_its_frames(self):
        if not (shutil.which("ffmpeg") and shutil.which("ffprobe")):
            self.skipTest("ffmpeg is not installed")
        environment = dict(os.environ, XDG_CACHE_HOME=str(program_test.shared / "cache"))
        for sent, code, name in ((signal.SIGINT, 130, "Ctrl-C"), (signal.SIGTERM, 143, "SIGTERM")):
            film = self.folder / f"{name}.mp4"
            process = subprocess.Popen([program_test.scumble, "render", "move.gltf", "-o", film.name, "--frames", "0..99999",
                                        "--stats", "never.json", *TINY], cwd=self.folder, env=environment, text=True,
                                       stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
            # A line comes every five seconds: frames have been drawn then.
            first = process.stderr.readline()
            self.assertRegex(first, r"scumble: frame \d+, \d+ of 100000")
            process.send_signal(sent)
            said = process.stderr.read()
            self.assertEqual(process.wait(), code, said)
            told = re.search(rf"ended by {name}: {re.escape(film.name)} holds (\d+) of 100000 frames", said)
            self.assertTrue(told, said)
            count = int(probe(film, "stream=nb_read_frames")["streams"][0]["nb_read_frames"])
            self.assertEqual(count, int(told[1]))
            self.assertGreater(count, 0)

    def test_killed_at_any_moment_nothing_is_half_written(self):
        args = ["-o", "x.##.png", "--frames", "0..11", "--aov", "normal", "--size", "640x360", "--samples", "1", "--quiet"]
        self.good("render", "move.gltf", *[word.replace("x.##", "whole.##") for word in args])
        wanted = {name.replace("whole", "x"): self.bytes(name) for name in self.new_files()}
        for name in self.new_files():
            (self.folder / name).unlink()
        environment = dict(os.environ, XDG_CACHE_HOME=str(program_test.shared / "cache"))
        chance, most, kills, patience = random.Random(7), 0, 0, 1.2
        while len(self.new_files()) < len(wanted):
            process = subprocess.Popen([program_test.scumble, "render", "move.gltf", *args, "--resume"], cwd=self.folder,
                                       env=environment, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
            # Kills that come sooner than anything is written would never end: now and then one has more time, and on
            # a machine that is busy ever more.
            try:
                process.wait(chance.uniform(0.02, 0.8) if kills % 5 != 4 else patience)
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                kills += 1
            process.communicate()
            for name in self.new_files():
                self.assertIn(name, wanted, "nothing but whole files is left")
                self.same(self.bytes(name), wanted[name], name)
            self.assertGreaterEqual(len(self.new_files()), most, "nothing is lost")
            if kills % 5 == 4 and len(self.new_files()) == most:
                patience *= 1.5
            most = len(self.new_files())
            self.assertLess(kills, 200)
        self.assertGreater(kills, 2)

    def test_what_the_exr_holds(self):
        self.draw("-o", "a.exr", "--aov", "depth,shadow", "--exr", "half,piz")
        types = dict(exr(self.folder / "a.exr")["channels"])
        self.assertEqual((types["R"], types["shadow.R"], types["depth.R"]), (1, 1, 2))  # 1: half, 2: float
        self.same(exr(self.folder / "a.exr")["compression"][1], b"\x04")  # PIZ
        self.draw("-o", "b.exr")
        self.same(exr(self.folder / "b.exr")["compression"][1], b"\x03")  # ZIP
        self.before = self.files()
        self.bad(USAGE, "render", "move.gltf", "-o", "x.exr", "--exr", "double", *TINY, says="half")

    def test_mattes_by_name(self):
        self.draw("-o", "a.exr", "--aov", "cryptomatte")
        header = exr(self.folder / "a.exr")
        names = {name for name, _ in header["channels"]}
        self.assertLessEqual({"cryptomatte00.R", "cryptomatte01.A"}, names)
        manifest, = (value for key, (kind, value) in ((key, value) for key, value in header.items() if isinstance(value, tuple))
                     if kind == "string" and key.startswith("cryptomatte/") and key.endswith("/manifest"))
        self.assertEqual(set(json.loads(manifest)), {"Box", "Ground"}, "there is no ocean")
        self.draw("-o", "b.png", "--aov", "cryptomatte")
        self.assertIn("cryptomatte00.R", {name for name, _ in exr(self.folder / "b.cryptomatte.exr")["channels"]})

    def test_progress_without_a_terminal_is_plain_lines(self):
        done = self.run_program("render", "move.gltf", "-o", "x.#.png", "--frames", "0..2", *TINY)
        self.assertRegex(done.stderr, r"scumble: frame 2, 3 of 3, 0 s left\n\Z")
        self.assertNotIn("\r", done.stderr)


class Films(Film):
    def setUp(self):
        if not (shutil.which("ffmpeg") and shutil.which("ffprobe")):
            self.skipTest("ffmpeg is not installed")
        super().setUp()

    def test_frames_size_and_rate(self):
        self.draw("-o", "a.mp4", "--frames", "3..12", "--fps", "25")
        stream = probe(self.folder / "a.mp4", "stream=codec_name,width,height,nb_read_frames,r_frame_rate,color_space")["streams"][0]
        self.assertEqual((stream["codec_name"], stream["width"], stream["height"]), ("h264", 32, 18))
        self.assertEqual((stream["nb_read_frames"], stream["r_frame_rate"], stream["color_space"]), ("10", "25/1", "bt709"))
        self.assertEqual(self.new_files(), {"a.mp4"})

    def test_a_film_lasts_as_long_as_its_clip(self):
        self.draw("-o", "a.mp4")
        self.draw("-o", "b.mp4", "--set", "clips.Rise.play.weight=1", "--set", "clips.Rise.play.speed=2")
        for name, frames in (("a.mp4", "24"), ("b.mp4", "12")):
            self.assertEqual(probe(self.folder / name, "stream=nb_read_frames")["streams"][0]["nb_read_frames"], frames)
        self.before = self.files()
        self.bad(USAGE, "render", "box.gltf", "-o", "x.mp4", *TINY, says="--frames A..B")

    def around(self, *args, size="32x16"):
        done = self.run_program("render", "box.gltf", "--samples", "1", "--size", size, "--panorama", *args)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [line for line in done.stderr.splitlines() if "warning" in line]

    def test_players_learn_that_a_film_is_a_panorama(self):
        for kind, size, shape, bounds, layout in (("mono360", "32x16", (32, 16), 0, "2D"), ("ods", "32x16", (32, 32), 0, "top and bottom"),
                                                  ("vr180", "16x16", (32, 16), 16, "side by side")):
            with self.subTest(kind=kind):
                self.assertEqual(self.around(kind, "-o", kind + ".mp4", "--frames", "0..0", size=size), [])
                stream = probe(self.folder / (kind + ".mp4"), "stream=width,height:stream_side_data")["streams"][0]
                self.assertEqual((stream["width"], stream["height"]), shape)
                data = {each["side_data_type"]: each for each in stream["side_data_list"]}
                self.assertEqual(data["Stereo 3D"]["type"], layout)
                sphere = data["Spherical Mapping"]
                self.assertEqual(sphere["projection"], "tiled equirectangular" if bounds else "equirectangular")
                if bounds:
                    # ffprobe counts by the whole picture, both eyes in it, and rounds.
                    for side, wanted in (("left", bounds), ("top", 0), ("right", bounds), ("bottom", 0)):
                        self.assertAlmostEqual(sphere["bound_" + side], wanted, delta=1)
                # The first version, for players that know no other.
                film = (self.folder / (kind + ".mp4")).read_bytes()
                self.assertIn(b"<GSpherical:Spherical>true</GSpherical:Spherical>", film)
                self.assertEqual(b"CroppedAreaLeftPixels" in film, kind == "vr180")
        self.draw("-o", "flat.mp4", "--frames", "0..0")
        self.assertNotIn(b"Spherical", (self.folder / "flat.mp4").read_bytes())

    def test_pictures_of_panoramas(self):
        self.assertEqual(self.around("vr180", "-o", "a.png", size="16x16"), [])
        self.assertEqual(png(self.folder / "a.png")[:2], (32, 16))
        self.around("vr180", "-o", "b.png", "--stereo", "separate", size="16x16")
        self.assertEqual(png(self.folder / "b.right.png")[:2], (16, 16))
        self.around("ods", "-o", "c.exr", "--aov", "depth")
        self.assertLessEqual({"R", "right.R", "depth.left.R", "depth.right.R"}, {name for name, _ in exr(self.folder / "c.exr")["channels"]})
        # Without a size it has one that fits.
        self.before = self.files()
        for kind in ("vr180", "ods", "mono360"):
            self.bad(UNUSABLE, "render", "missing.gltf", "-o", "x.png", "--panorama", kind, says="missing.gltf")
        # What does nothing is told.
        for args, told in ((["--roll", "3"], "--roll does nothing in a panorama"), (["--ipd", "0.07"], "--ipd does nothing for one eye")):
            self.assertIn(told, self.around("mono360", "-o", "d.png", *args)[0])
        self.assertIn("MP4 alone", self.around("mono360", "-o", "d.gif", "--frames", "0..0")[0])
        # And what makes no sense.
        self.before = self.files()
        for args, says in ((["vr90"], "'vr180'"), (["cube"], "mono360"), (["vr180", "--size", "32x16"], "2048x2048"),
                           (["mono360", "--size", "16x16"], "4096x2048"), (["mono360", "--stereo", "separate"], "ods"),
                           (["ods", "--stereo", "crossed"], "side-by-side"), (["ods", "--stereo", "wiggle"], "side-by-side"),
                           (["vr180", "--size", "8x8"], "16 to 16384"), (["vr180", "--strip", "0"], "0.5 to 15"),
                           (["ods", "--fov", "0.5"], "1 to 180"), (["ods", "--ipd", "-1"], "eyes")):
            self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--panorama", *args, says=says)
        self.bad(USAGE, "render", "box.gltf", "-o", "x.svg", "--panorama", "mono360", says="drawing")
        self.bad(USAGE, "render", "box.gltf", "-o", "x.mp4", "--frames", "0..0", "--panorama", "vr180", "--size", "17x17", says="even")

    def test_players_learn_how_the_eyes_lie(self):
        for layout, size, name in (("side-by-side", (64, 18), "side by side"), ("over-under", (32, 36), "top and bottom")):
            self.draw("-o", layout + ".mp4", "--frames", "0..1", "--stereo", layout)
            stream = probe(self.folder / (layout + ".mp4"), "stream=width,height:stream_side_data")["streams"][0]
            self.assertEqual((stream["width"], stream["height"]), size)
            self.assertEqual([data["type"] for data in stream["side_data_list"] if data["side_data_type"] == "Stereo 3D"], [name])
        self.draw("-o", "two.mp4", "--frames", "0..1", "--stereo", "separate")
        self.assertIn("two.left.mp4", self.new_files())
        self.assertIn("two.right.mp4", self.new_files())
        self.assertNotIn("two.mp4", self.new_files())

    def test_eyes_take_turns(self):
        self.draw("-o", "turn.####.png", "--frames", "0..7", "--stereo", "wiggle")
        self.draw("-o", "eye.####.png", "--frames", "0..7", "--stereo", "separate")
        for number in range(8):
            eye = "right" if number // 3 % 2 else "left"
            self.same(self.bytes(f"turn.{number:04}.png"), self.bytes(f"eye.{number:04}.{eye}.png"))
        # What stands still is seen for a while.
        self.good("render", "box.gltf", "-o", "still.gif", "--stereo", "wiggle", *TINY, "--quiet")
        self.assertEqual(probe(self.folder / "still.gif", "stream=nb_read_frames")["streams"][0]["nb_read_frames"], "48")
        self.draw("-o", "red.mp4", "--frames", "0..1", "--stereo", "anaglyph")
        stream = probe(self.folder / "red.mp4", "stream=width,height:stream_side_data")["streams"][0]
        self.assertEqual((stream["width"], stream["height"]), (32, 18))
        self.assertEqual(stream.get("side_data_list", []), [])

    def test_quality_is_constant_quality(self):
        sizes = []
        for quality in ("0", "16", "45"):
            self.good("render", "move.gltf", "-o", "q.mp4", "--frames", "0..5", "--quality", quality, "--size", "320x180",
                      "--samples", "1", "--quiet")
            sizes.append(len(self.bytes("q.mp4")))
        self.assertEqual(sizes, sorted(sizes, reverse=True))
        self.assertGreater(sizes[0], 1.5 * sizes[2])
        self.before = self.files()
        self.bad(USAGE, "render", "move.gltf", "-o", "x.mp4", "--quality", "52", *TINY, says="0")

    def test_the_same_bytes_again(self):
        self.draw("-o", "a.mp4", "--frames", "0..7")
        self.draw("-o", "b.mp4", "--frames", "0..7")
        self.same(self.bytes("a.mp4"), self.bytes("b.mp4"))

    def test_what_cannot_be(self):
        self.bad(USAGE, "render", "move.gltf", "-o", "x.mp4", "--aov", "depth", *TINY, says="film")
        self.bad(USAGE, "render", "move.gltf", "-o", "x.##.mp4", "--frames", "0..1", *TINY, says="film")
        self.bad(USAGE, "render", "move.gltf", "-o", "x.mp4", "--missing", *TINY, says="####")
        self.bad(NOT_WRITTEN, "render", "move.gltf", "-o", "no/x.mp4", *TINY, says="no/x.mp4")

    def test_ffmpeg_is_missing_or_fails(self):
        self.bad(NOT_WRITTEN, "render", "move.gltf", "-o", "x.mp4", *QUIET, says=["ffmpeg", "####"],
                 environment={"PATH": "/nonexistent"})
        fake = Path(self.put("bin/ffmpeg", "#!/bin/sh\necho 'the disk is on fire' >&2\nexit 3\n"))
        fake.chmod(0o755)
        self.before = self.files()
        self.bad(NOT_WRITTEN, "render", "move.gltf", "-o", "x.mp4", *QUIET, says="the disk is on fire",
                 environment={"PATH": f"{fake.parent}:{os.environ['PATH']}"})

    def test_a_killed_film_leaves_nothing(self):
        process = subprocess.Popen([program_test.scumble, "render", "move.gltf", "-o", "x.mp4", "--frames", "0..5000", *QUIET],
                                   cwd=self.folder, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL,
                                   env=dict(os.environ, XDG_CACHE_HOME=str(program_test.shared / "cache")))
        time.sleep(1.5)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGKILL)
        process.wait()
        time.sleep(0.3)
        self.assertEqual(self.new_files(), set())


class ResumedFilms(Film):
    def setUp(self):
        if not (shutil.which("ffmpeg") and shutil.which("ffprobe")):
            self.skipTest("ffmpeg is not installed")
        super().setUp()

    def pictures(self, name):
        """The decoded frames of a film, as bytes of R, G, B."""
        stream = probe(self.folder / name, "stream=width,height")["streams"]
        self.assertEqual(len(stream), 1)
        size = 3 * stream[0]["width"] * stream[0]["height"]
        data = subprocess.run(["ffmpeg", "-v", "error", "-xerror", "-i", str(self.folder / name), "-f", "rawvideo", "-pix_fmt", "rgb24",
                               "-fps_mode", "passthrough", "-"], capture_output=True, check=True).stdout
        return [data[at:at + size] for at in range(0, len(data), size)]

    def times(self, name):
        return sorted(float(packet["pts_time"]) for packet in probe(self.folder / name, "packet=pts_time")["packets"])

    def alike(self, name, wanted):
        """Both films have the same pictures, as far as their encoder keeps them, at the same times."""
        self.assertEqual(self.times(name), self.times(wanted))
        entries = "stream=codec_name,profile,width,height,pix_fmt,avg_frame_rate,time_base,color_range,color_space,color_transfer," \
                  "color_primaries,chroma_location,duration:stream_side_data"
        self.assertEqual(probe(self.folder / name, entries), probe(self.folder / wanted, entries))
        one, other = self.pictures(name), self.pictures(wanted)
        self.assertEqual(len(one), len(other))
        for frame, (a, b) in enumerate(zip(one, other)):
            self.assertLess(sum(abs(x - y) for x, y in zip(a, b)) / len(a), 3, frame)

    def test_drawn_in_parts(self):
        # A part of one frame, one of two, and longer ones; the clip moves enough to tell frames apart.
        for ending, more in (("mp4", ["--fps", "23.976"]), ("webm", ["--fps", "23.976"]), ("mp4", ["--fps", "12.34", "--quality", "0"]),
                             ("mp4", ["--stereo", "side-by-side"]), ("webm", ["--stereo", "over-under"]),
                             ("mp4", ["--turntable", "0.5"])):
            with self.subTest(ending=ending, more=more):
                args = ["-o", "part." + ending, *more, "--resume", "--frames"]
                for last in (0, 2, 7, 11):
                    self.draw(*args, f"0..{last}")
                    self.assertEqual(len(self.times("part." + ending)), last + 1)
                self.draw("-o", "whole." + ending, *more, "--frames", "0..11")
                self.alike("part." + ending, "whole." + ending)
                self.assertEqual(self.new_files(), {"part." + ending, "whole." + ending})
                data = self.bytes("part." + ending)
                if ending == "mp4":
                    self.assertLess(data.find(b"moov"), data.find(b"mdat"), "the index lies in front")
                for name in self.new_files():
                    (self.folder / name).unlink()

    def test_panoramas_stay_what_they_are(self):
        for kind, size in (("mono360", "32x16"), ("vr180", "16x16")):
            args = ["render", "box.gltf", "--samples", "1", "--size", size, "--panorama", kind, "--quiet"]
            for name, last in (("a.mp4", "1"), ("a.mp4", "3"), ("whole.mp4", "3")):
                self.good(*args, "-o", name, "--frames", "0.." + last, "--resume")
            self.alike("a.mp4", "whole.mp4")
            self.assertIn(b"<GSpherical:Spherical>true</GSpherical:Spherical>", self.bytes("a.mp4"))
            self.assertEqual(self.bytes("a.mp4").count(b"st3d"), 1)
            self.before = self.files()
            self.bad(USAGE, *args[:6], "--quiet", "-o", "a.mp4", "--frames", "0..4", "--resume", says="this film cannot be resumed")
            self.before = {}
            for name in ("a.mp4", "whole.mp4"):
                (self.folder / name).unlink()

    def test_a_film_for_each_eye(self):
        args = ["--stereo", "separate", "--resume", "--frames"]
        self.draw("-o", "two.mp4", *args, "0..2")
        # As a kill between the two leaves it.
        (self.folder / "two.right.mp4").unlink()
        self.draw("-o", "two.mp4", *args, "0..5")
        self.draw("-o", "whole.mp4", *args, "0..5")
        for eye in ("left", "right"):
            self.alike(f"two.{eye}.mp4", f"whole.{eye}.mp4")
        self.assertLess(len(self.bytes("whole.left.mp4")), len(self.bytes("two.left.mp4")), "its first frames are the old ones")
        self.same(self.bytes("two.right.mp4"), self.bytes("whole.right.mp4"))

    def test_a_whole_film_is_left_as_it_is(self):
        args = ["render", "move.gltf", "-o", "a.mp4", "--frames", "0..3", "--resume", *TINY]
        self.good(*args, "--quiet")
        before = self.bytes("a.mp4"), (self.folder / "a.mp4").stat().st_mtime_ns
        # A device that does not exist is not looked for.
        done = self.run_program(*args, "--device", "none like this")
        self.assertEqual((done.returncode, done.stderr), (0, "scumble: a.mp4 has all of its 4 frames\n"))
        self.assertEqual((self.bytes("a.mp4"), (self.folder / "a.mp4").stat().st_mtime_ns), before)

    def test_what_does_not_fit_is_refused_and_left_as_it_is(self):
        for name in ("a.mp4", "a.webm"):
            self.draw("-o", name, "--frames", "0..3")
        shutil.copy(self.folder / "a.webm", self.folder / "other.mp4")
        (self.folder / "text.mp4").write_text("no film")
        (self.folder / "empty.webm").write_bytes(b"")
        (self.folder / "cut.mp4").write_bytes(self.bytes("a.mp4")[:-100])
        subprocess.run(["ffmpeg", "-v", "error", "-i", "a.mp4", "-f", "lavfi", "-i", "sine=duration=0.1", "-c:v", "copy", "sound.mp4"],
                       cwd=self.folder, check=True)
        self.before = self.files()
        content = {name: self.bytes(name) for name in self.before if name.endswith((".mp4", ".webm"))}
        for name, args, says in (("a.mp4", ["--size", "34x18"], "it has 32 x 18 pixels, not 34 x 18"),
                                 ("a.webm", ["--size", "34x18"], "it has 32 x 18 pixels, not 34 x 18"),
                                 ("a.mp4", ["--fps", "25"], "it has 24 frames a second, not 25"),
                                 ("a.webm", ["--fps", "23.976"], "it has 24 frames a second, not 23.976"),
                                 ("a.mp4", ["--quality", "20"], "another quality"),
                                 ("a.mp4", ["--frames", "0..2"], "it has 4 frames, and 3 are asked for"),
                                 ("a.mp4", ["--stereo", "side-by-side", "--size", "16x18"], "its layout of eyes is none, not side by side"),
                                 ("a.webm", ["--stereo", "over-under", "--size", "32x9"], "its layout of eyes is none, not top and bottom"),
                                 ("other.mp4", [], "its codec is vp9, not h264"), ("text.mp4", [], "cannot be read"),
                                 ("empty.webm", [], "cannot be read"), ("cut.mp4", [], "cannot be read"),
                                 ("sound.mp4", [], "it holds more than pictures")):
            with self.subTest(name=name, args=args):
                usual = [word for pair in (("--frames", "0..9"), ("--size", "32x18")) if pair[0] not in args for word in pair]
                self.bad(USAGE, "render", "move.gltf", "-o", name, "--samples", "1", "--resume", *usual, *args,
                         says=[f"{name}: this film cannot be resumed: ", says, "or delete it"])
        self.bad(NOT_WRITTEN, "render", "move.gltf", "-o", "a.mp4", "--frames", "0..9", "--resume", *TINY, says="ffprobe",
                 environment={"PATH": "/nonexistent"})
        for name in content:
            self.same(self.bytes(name), content[name], name)

    def test_a_gif_is_refused(self):
        self.bad(USAGE, "render", "move.gltf", "-o", "x.gif", "--frames", "0..3", "--resume", *TINY,
                 says=["a GIF cannot be resumed", "`scumble film`"])

    def test_a_film_that_is_ended_goes_on(self):
        environment = dict(os.environ, XDG_CACHE_HOME=str(program_test.shared / "cache"))
        args = [program_test.scumble, "render", "move.gltf", "-o", "a.mp4", "--frames", "0..99999", "--resume", *TINY]
        counts = [0]
        # Ended, and ended again while it goes on.
        for sent, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130)):
            process = subprocess.Popen(args, cwd=self.folder, env=environment, text=True, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
            # A line comes every five seconds: frames have been drawn then.
            process.stderr.readline()
            process.send_signal(sent)
            said = process.communicate()[1]
            self.assertEqual(process.returncode, code, said)
            self.assertEqual(self.new_files(), {"a.mp4"})
            counts.append(len(self.times("a.mp4")))
            self.assertIn(f"a.mp4 holds {counts[-1]} of 100000 frames", said)
            self.assertGreater(counts[-1], counts[-2])
        # The kill of a call that goes on leaves what was there.
        before = self.bytes("a.mp4")
        process = subprocess.Popen(args, cwd=self.folder, env=environment, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
        process.stderr.readline()
        process.kill()
        process.communicate()
        self.same(self.bytes("a.mp4"), before)
        last = counts[-1] + 3
        self.draw("-o", "a.mp4", "--frames", f"0..{last}", "--resume")
        self.draw("-o", "whole.mp4", "--frames", f"0..{last}")
        self.alike("a.mp4", "whole.mp4")
        self.assertEqual(self.new_files(), {"a.mp4", "whole.mp4"})


if __name__ == "__main__":
    program_test.main()
