#!/usr/bin/env python3
"""Cameras that move, scenes at their places, looks that extend looks, and the formats of pictures and films.

    tests/program/camera_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
"""
import json
import shutil
import subprocess
import unittest

import program_test
from program_test import TINY, UNUSABLE, USAGE, Program, gltf, layers, png

QUIET = [*TINY, "--quiet"]


def probe(path, entries):
    text = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", entries, "-of", "json", str(path)],
                          capture_output=True, text=True, check=True).stdout
    return json.loads(text)


class Case(Program):
    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def draw(self, *args, scene=("box.gltf",)):
        self.good("render", *scene, *args, *QUIET)


class Turntable(Case):
    @unittest.skipUnless(shutil.which("ffmpeg"), "films need ffmpeg")
    def test_a_film_of_exactly_one_turn(self):
        for args, frames, seconds in ((["--turntable", "0.5"], 12, 0.5), (["--turntable=0.4", "--fps", "10"], 4, 0.4),
                                      (["--turntable", "0.33", "--fps", "6"], 2, 1 / 3), (["--turntable", "--fps", "0.5"], 4, 8)):
            self.draw("-o", "x.mp4", *args)
            found = probe(self.folder / "x.mp4", "stream=nb_read_frames,duration")["streams"][0]
            self.assertEqual(int(found["nb_read_frames"]), frames, args)
            self.assertAlmostEqual(float(found["duration"]), seconds, 3, args)

    def test_pictures_of_the_whole_turn_and_parts_of_it(self):
        self.draw("-o", "t.####.png", "--turntable", "1", "--fps", "4")
        self.assertEqual(self.new_files(), {f"t.{i:04}.png" for i in range(4)})
        self.assertEqual(len({self.bytes(f"t.{i:04}.png") for i in range(4)}), 4)
        # The frame after the last is the first, and a part is a part of the whole.
        self.draw("-o", "p.####.png", "--turntable", "1", "--fps", "4", "--frames", "3..4")
        self.same(self.bytes("p.0003.png"), self.bytes("t.0003.png"))
        self.same(self.bytes("p.0004.png"), self.bytes("t.0000.png"))
        self.draw("-o", "one.png", "--turntable", "1", "--fps", "4", "--time", "0.25")
        self.same(self.bytes("one.png"), self.bytes("t.0001.png"))
        # It begins where the orbit says, and grows in azimuth.
        self.draw("-o", "o.####.png", "--turntable", "1", "--fps", "4", "--orbit", "10,20,4")
        for number, azimuth in enumerate((10, 100, 190, 280)):
            self.draw("-o", "s.png", "--orbit", f"{azimuth},20,4", "--time", str(number / 4))
            self.same(self.bytes("s.png"), self.bytes(f"o.{number:04}.png"), f"{azimuth} degrees")
        # What is there is left out.
        (self.folder / "t.0002.png").unlink()
        before = (self.folder / "t.0001.png").stat().st_mtime_ns
        self.draw("-o", "t.####.png", "--turntable", "1", "--fps", "4", "--resume")
        self.assertTrue((self.folder / "t.0002.png").exists())
        self.assertEqual((self.folder / "t.0001.png").stat().st_mtime_ns, before)

    def test_in_stereo(self):
        self.draw("-o", "t.####.png", "--turntable", "1", "--fps", "2", "--stereo", "side-by-side", "--ipd", "0.4")
        self.draw("-o", "m.####.png", "--turntable", "1", "--fps", "2", "--stereo", "separate", "--ipd", "0.4")
        self.assertEqual(png(self.folder / "t.0001.png")[0], 64)
        self.different(self.bytes("m.0001.left.png"), self.bytes("m.0001.right.png"))

    def test_motion_knows_the_moving_camera(self):
        def motion(*args):
            self.draw("-o", "m.exr", "--aov", "motion", "--fps", "8", "--background", "transparent", *args)
            return self.bytes("m.exr")
        still, turning = motion("--time", "1", "--orbit", "32,14,4"), motion("--time", "1", "--turntable", "4", "--orbit", "302,14,4")
        self.assertIn("motion", layers(self.folder / "m.exr"))
        self.different(still, turning)

    def test_what_makes_no_sense(self):
        for args, says in ((["--camera", "0"], "--camera and --turntable"), (["--eye", "1,2,3"], "--turntable and --eye"),
                           (["--target", "1,2,3"], "--turntable and --target")):
            self.bad(USAGE, "render", "box.gltf", "-o", "x.mp4", "--turntable", "2", *args, *TINY, says=says)
        for seconds in ("0", "-2", "nan", "inf", "box.gltf", "1,2", "1e99"):
            self.bad(USAGE, "render", "box.gltf", "-o", "x.mp4", f"--turntable={seconds}", *TINY, says="--turntable")
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--turntable", "2", *TINY, says="x.png")
        self.bad(USAGE, "render", "--turntable", "box.gltf", "-o", "x.mp4", *TINY, says="box.gltf")
        for args in (["--camera", "0", "--orbit", "1,2"], ["--orbit", "1,2", "--eye", "1,2,3"], ["--camera", "0", "--target", "1,2,3"]):
            self.bad(USAGE, "render", "box.gltf", "-o", "x.png", *args, *TINY, says="both say where the camera stands")


class LookCamera(Case):
    def test_a_look_brings_a_camera_that_moves(self):
        self.put("fly.json", '{"camera": {"azimuth": {"keys": [[0, 0], [1, 90]]}, "elevation": 10, "distance": 4}}')
        self.draw("-o", "l.####.png", "--frames", "0..2", "--fps", "2", "--look", "fly.json")
        for number, azimuth in enumerate((0, 45, 90)):
            self.draw("-o", "s.png", "--orbit", f"{azimuth},10,4", "--time", str(number / 2))
            self.same(self.bytes("s.png"), self.bytes(f"l.{number:04}.png"), f"{azimuth} degrees")
        # The command line wins.
        self.draw("-o", "a.png", "--look", "fly.json", "--orbit", "200,5,3")
        self.draw("-o", "b.png", "--orbit", "200,5,3")
        self.same(self.bytes("a.png"), self.bytes("b.png"))

    def test_a_look_wins_over_the_scenes_camera(self):
        self.put("cameras.gltf", gltf(camera=True))
        scene = ["cameras.gltf"]
        self.draw("-o", "own.png", scene=scene)
        self.draw("-o", "look.png", "--set", "camera.azimuth=90", scene=scene)
        self.draw("-o", "back.png", "--set", "camera.azimuth=90", "--set", "camera.mode=scene", scene=scene)
        self.draw("-o", "named.png", "--set", "camera.azimuth=90", "--camera", "Front", scene=scene)
        self.different(self.bytes("own.png"), self.bytes("look.png"))
        self.same(self.bytes("own.png"), self.bytes("back.png"))
        self.same(self.bytes("own.png"), self.bytes("named.png"))

    def test_a_target_that_is_not_there_is_told_of(self):
        done = self.run_program("render", "box.gltf", "-o", "x.png", "--set", "camera.target=Bx", *TINY)
        self.assertEqual(done.returncode, 0)
        self.assertIn("camera.target: the scene has no node of that name", done.stderr)


class Placing(Case):
    def test_scenes_stand_and_ride(self):
        self.put("post.gltf", gltf(color=(0.1, 0.2, 0.9)))
        both = ["box.gltf", "post.gltf"]
        view = ["--orbit", "20,20,4"]
        self.draw("-o", "plain.png", *view, scene=both)
        self.draw("-o", "same.png", *view, "--place", "post:at=0,0,0", scene=both)
        self.same(self.bytes("plain.png"), self.bytes("same.png"))
        self.draw("-o", "on.png", *view, "--place", "post:at=0,2,0;scale=0.5;turn=45;on=box/Box", scene=both)
        self.draw("-o", "two.png", *view, "--place", "2:at=0,2,0;turn=0,45,0;scale=0.5", scene=both)
        self.different(self.bytes("plain.png"), self.bytes("on.png"))
        self.same(self.bytes("two.png"), self.bytes("on.png"))
        self.put("world.json", json.dumps({"scenes": [{"file": "box.gltf"},
                                                      {"file": "post.gltf", "at": [0, 2, 0], "turn": 45, "scale": 0.5, "on": "box/Box"}]}))
        self.draw("-o", "world.png", *view, scene=["world.json"])
        self.same(self.bytes("world.png"), self.bytes("on.png"))
        self.assertIn("post", self.good("info", "world.json"))

    def test_what_cannot_be_placed(self):
        self.put("post.gltf", gltf())
        both = ["box.gltf", "post.gltf"]
        for place, says in (("post:on=Bxo", "did you mean"), ("pots:at=1,2,3", "box, post"), ("3:at=1,2,3", "no scene is called '3'"), ("post", "says nothing"),
                            ("post:", "says nothing"), ("post:at=1,2", "three numbers"), ("post:at=1,nan,2", "three numbers"),
                            ("post:scale=0", "a scale of 0"), ("post:scale=-1", "out of range"), ("post:scale=inf", "one number"),
                            ("post:turn=1,2", "one number or three"), ("post:size=2", "at, turn, scale and on"), ("post:on=", "a node"),
                            ("post:on=post", "itself")):
            self.bad(USAGE, "render", *both, "-o", "x.png", "--place", place, *TINY, says=says)
        self.bad(USAGE, "render", *both, "-o", "x.png", "--place", "1:on=post", "--place", "2:on=box", *TINY, says="in a circle")
        self.bad(USAGE, "render", *both, "-o", "x.png", "--place", "1:at=0,0,1", "--place", "box:at=0,0,2", *TINY, says="already")
        self.put("world.json", '{"scenes": [{"file": "box.gltf", "scale": 0}]}')
        self.bad(UNUSABLE, "render", "world.json", "-o", "x.png", *TINY, says=["world.json (scenes[0].scale)", "a scale of 0"])
        self.put("world.json", '{"scenes": [{"file": "../box.gltf"}]}')
        self.bad(UNUSABLE, "render", "world.json", "-o", "x.png", *TINY, says="leads out of")


class Looks(Case):
    def test_looks_extend_looks(self):
        self.put("base.json", '{"shadow": {"threshold": 0.2} /* deep */, "palette": {"shadowTint": "navy"}}')
        self.put("own.json", '{"extends": "base.json", "warp": {"amount": 0}} // calm')
        self.draw("-o", "a.png", "--look", "own.json")
        self.draw("-o", "b.png", "--set", "shadow.threshold=0.2", "--set", "palette.shadowTint=#000080", "--set", "warp.amount=0")
        self.same(self.bytes("a.png"), self.bytes("b.png"))
        self.put("base.json", '{"extends": "own.json"}')
        self.before = self.files()
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--look", "own.json", *TINY,
                 says=["base.json:1 (extends)", "own.json -> base.json -> own.json"])

    def test_colours_as_words(self):
        for one, other in (("navy", "#000080"), ("#abc", "#AABBCC")):
            self.draw("-o", "a.png", "--background", one)
            self.draw("-o", "b.png", "--background", other)
            self.same(self.bytes("a.png"), self.bytes("b.png"))
        self.before = self.files()
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--set", "ground.tint=stealblue", *TINY,
                 says="did you mean 'steelblue'?")


class Formats(Case):
    def test_jpeg_and_webp(self):
        for ending, start in (("jpg", b"\xff\xd8\xff"), ("jpeg", b"\xff\xd8\xff"), ("webp", b"RIFF")):
            with self.subTest(ending=ending):
                self.draw("-o", "x." + ending)
                self.assertTrue(self.bytes("x." + ending).startswith(start))
                self.draw("-o", "small." + ending, "--quality", "10")
                self.assertLess(len(self.bytes("small." + ending)), len(self.bytes("x." + ending)))
                self.draw("-o", "both." + ending, "--stereo", "separate", "--aov", "depth")
                for name in ("both.left." + ending, "both.right." + ending, "both.left.depth.exr"):
                    self.assertTrue((self.folder / name).exists(), name)
                # Cut files are drawn again, whole ones are left.
                self.draw("-o", "s.####." + ending, "--frames", "0..1")
                whole = self.bytes("s.0000." + ending)
                (self.folder / ("s.0000." + ending)).write_bytes(whole[:-5])
                kept = (self.folder / ("s.0001." + ending)).stat().st_mtime_ns
                self.draw("-o", "s.####." + ending, "--frames", "0..1", "--resume")
                self.same(self.bytes("s.0000." + ending), whole)
                self.assertEqual((self.folder / ("s.0001." + ending)).stat().st_mtime_ns, kept)

    @unittest.skipUnless(shutil.which("ffmpeg"), "films need ffmpeg")
    def test_webm_and_gif(self):
        for ending, codec in (("webm", "vp9"), ("gif", "gif")):
            self.draw("-o", "x." + ending, "--frames", "0..5", "--fps", "10", "--stereo", "over-under")
            found = probe(self.folder / ("x." + ending), "stream=codec_name,nb_read_frames,width,height")["streams"][0]
            self.assertEqual((found["codec_name"], int(found["nb_read_frames"]), found["width"], found["height"]),
                             (codec, 6, 32, 36))
        self.before = self.files()
        self.bad(USAGE, "render", "box.gltf", "-o", "y.gif", "--frames", "0..5", "--fps", "60", *TINY, says="50")
        self.bad(USAGE, "render", "box.gltf", "-o", "y.gif", "--frames", "0..5", "--resume", *TINY, says="resumed")

    def test_quality_is_of_the_format(self):
        for name, quality in (("x.png", "5"), ("x.exr", "5"), ("x.jpg", "0"), ("x.jpg", "101"), ("x.webp", "-1"),
                              ("x.mp4", "52"), ("x.webm", "64"), ("x.gif", "1")):
            self.bad(USAGE, "render", "box.gltf", "-o", name, "--frames", "0..0", f"--quality={quality}", *TINY, says="--quality")


if __name__ == "__main__":
    program_test.main()
