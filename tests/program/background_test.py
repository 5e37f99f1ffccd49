#!/usr/bin/env python3
"""Pictures and films behind everything, from outside.

    tests/program/background_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
"""
import shutil
import struct
import subprocess
import unittest

import program_test
from program_test import NOT_WRITTEN, TINY, UNUSABLE, USAGE, Program, png
from png import make_png  # noqa: E402

QUIET = [*TINY, "--quiet"]
PLAIN = ["--set", "background.style=0", "--set", "background.simplify=0", "--set", "background.steps=0", "--set", "ground.mode=off"]
AWAY = ["--eye", "0,0,50", "--target", "0,0,100"]  # the scene is behind the viewer


def picture(width=32, height=18, color=lambda x, y: (8 * x % 256, 14 * y % 256, 90)):
    return make_png(width, height, color)


class Background(Program):
    def setUp(self):
        super().setUp()
        self.put("behind.png", picture())
        self.before = self.files()

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def draw(self, out, *args):
        self.good("render", "box.gltf", "-o", out, *args, *QUIET)
        return self.bytes(out)


class Pictures(Background):
    def test_the_picture_is_what_is_seen(self):
        self.draw("seen.png", "--background", "behind.png", *AWAY, *PLAIN)
        self.assertEqual(png(self.folder / "seen.png"), png(self.folder / "behind.png"))
        self.different(self.draw("box.png", "--background", "behind.png", *PLAIN), self.bytes("seen.png"))

    def test_the_ground_shows_its_shadows_only(self):
        with_ground = self.draw("ground.png", "--background", "behind.png", *PLAIN[:4])
        without = self.draw("none.png", "--background", "behind.png", *PLAIN)
        self.different(with_ground, without, "no shadow on the ground")
        no_shadow = self.draw("still.png", "--background", "behind.png", *PLAIN[:4], "--set", "shadowMap.cast=false")
        self.different(with_ground, no_shadow)

    def test_far_larger_than_the_frame(self):
        for width, height in ((320, 180), (97, 31), (31, 97), (64, 64)):
            self.put("large.png", picture(width, height))
            for size in ("1x1", "1x7", "2x2", "7x1", "16x16", "13x3"):
                self.good("render", "box.gltf", "-o", "tiny.png", "--background", "large.png", "--size", size, "--samples", "1", "--quiet")

    def test_a_sequence_does_not_overwrite_it(self):
        self.put("w.0005.png", picture())
        before, self.before = self.bytes("w.0005.png"), self.files()
        self.bad(NOT_WRITTEN, "render", "box.gltf", "-o", "w.####.png", "--background", "w.0005.png", "--frames", "4..6", *QUIET,
                 says=["w.0005.png", "inputs"])
        self.same(self.bytes("w.0005.png"), before)
        self.good("render", "box.gltf", "-o", "w.####.png", "--background", "w.0005.png", "--frames", "6..6", *QUIET)

    def test_too_wide(self):
        self.put("wide.png", picture(16385, 1))
        self.before = self.files()
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "a.png", "--background", "wide.png", *QUIET, says=["wide.png", "16384"])

    def test_style_simplify_and_warp_act(self):
        pictures = [self.draw(f"{i}.png", "--background", "behind.png", *AWAY, *PLAIN, *args)
                    for i, args in enumerate(([], ["--set", "background.style=1"], ["--set", "background.simplify=64"],
                                              ["--set", "background.warp=everywhere", "--set", "warp.amount=64"]))]
        self.assertEqual(len(set(pictures)), 4)

    def test_stereo_both_eyes_see_the_same(self):
        self.good("render", "box.gltf", "-o", "a.png", "--background", "behind.png", *AWAY, *PLAIN, "--stereo", "separate", *QUIET)
        self.same(self.bytes("a.left.png"), self.bytes("a.right.png"))

    def test_photographs_come_upright(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("ffmpeg is not installed")
        # A bright corner at the file's lower left is the upper left one of what is turned by a quarter, clockwise.
        self.put("side.png", picture(72, 128, lambda x, y: (240, 240, 240) if x < 36 and y >= 64 else (20, 20, 20)))
        subprocess.run(["ffmpeg", "-loglevel", "error", "-i", "side.png", "-q:v", "2", "side.jpg"], cwd=self.folder, check=True,
                       stdin=subprocess.DEVNULL)
        jpeg = self.bytes("side.jpg")
        exif = b"Exif\0\0MM\0*" + struct.pack(">IHHHIHHI", 8, 1, 0x0112, 3, 1, 6, 0, 0)
        # Decoders show what there is of a cut one; that is not what was asked for.
        self.put("cut.jpg", jpeg[:len(jpeg) * 2 // 3])
        self.before = self.files()
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--background", "cut.jpg", *TINY, says="cut.jpg")
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--set", "lit.texture=cut.jpg", *TINY, says="cut.jpg")
        self.put("turned.jpg", jpeg[:2] + b"\xFF\xE1" + struct.pack(">H", len(exif) + 2) + exif + jpeg[2:])
        self.draw("turned.png", "--background", "turned.jpg", *AWAY, *PLAIN)
        self.draw("expected.png", "--background", str(self.put("upright.png", picture(
            128, 72, lambda x, y: (240, 240, 240) if x < 64 and y < 36 else (20, 20, 20)))), *AWAY, *PLAIN)
        one, other = png(self.folder / "turned.png"), png(self.folder / "expected.png")
        self.assertEqual(one[:2], other[:2])
        self.assertLess(max(abs(a - b) for a, b in zip(b"".join(one[-1]), b"".join(other[-1]))), 40)

    def test_what_cannot_be_used(self):
        self.put("text.jpg", "no picture")
        self.put("cut.png", picture()[:60])
        self.before = self.files()
        for name in ("text.jpg", "cut.png", "absent.png", "absent.webp"):
            self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--background", name, *TINY, says=name)
        self.bad(USAGE, "render", "box.gltf", "-o", "x.png", "--background", "bluish", *TINY, says="'bluish'")
        self.bad(NOT_WRITTEN, "render", "box.gltf", "-o", "behind.png", "--background", "behind.png", *TINY, says="behind.png")


class Films(Background):
    def setUp(self):
        if not (shutil.which("ffmpeg") and shutil.which("ffprobe")):
            self.skipTest("ffmpeg is not installed")
        super().setUp()
        # Twelve frames that grow lighter, 12 a second.
        for i in range(12):
            self.put(f"f{i:02}.png", picture(64, 36, lambda x, y, i=i: (20 * i, 20 * i, 20 * i)))
        for name, options in (("film.mp4", ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-g", "5"]), ("film.mkv", ["-c:v", "ffv1"])):
            subprocess.run(["ffmpeg", "-loglevel", "error", "-framerate", "12", "-i", "f%02d.png", *options, name],
                           cwd=self.folder, check=True, stdin=subprocess.DEVNULL)
        self.before = self.files()

    def seen(self, out, film, *args):
        return self.draw(out, "--background", film, *AWAY, *PLAIN, *args)

    def test_time_chooses_the_frame(self):
        for film in ("film.mp4", "film.mkv"):
            frames = [self.seen("x.png", film, "--time", str(i / 12)) for i in range(12)]
            self.assertEqual(len(set(frames)), 12, film)
            self.same(self.seen("x.png", film, "--time", str(3.9 / 12)), frames[3])
            self.same(self.seen("x.png", film, "--time", "-1"), frames[0])
            self.same(self.seen("x.png", film, "--time", "99"), frames[11])

    def test_a_split_sequence_has_the_same_bytes(self):
        self.good("render", "box.gltf", "-o", "all.#.png", "--frames", "0..9", "--fps", "24", "--background", "film.mp4", *QUIET)
        for first, last in ((7, 9), (0, 2), (3, 6)):
            self.good("render", "box.gltf", "-o", "part.#.png", "--frames", f"{first}..{last}", "--fps", "24",
                      "--background", "film.mp4", *QUIET)
        for i in range(10):
            self.same(self.bytes(f"all.{i}.png"), self.bytes(f"part.{i}.png"))
        self.different(self.bytes("all.1.png"), self.bytes("all.8.png"))

    def test_a_film_over_a_film(self):
        self.good("render", "box.gltf", "-o", "out.mp4", "--frames", "0..5", "--background", "film.mp4", *QUIET)
        self.assertGreater(len(self.bytes("out.mp4")), 500)

    def test_ffmpeg_is_missing_or_it_is_no_film(self):
        self.put("text.mp4", "no film")
        self.before = self.files()
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--background", "text.mp4", *TINY, says=["text.mp4", "no film"])
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--background", "absent.mp4", *TINY, says="absent.mp4")
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", "--background", "film.mp4", *TINY, says=["ffmpeg", "install"],
                 environment={"PATH": "/nonexistent"})


if __name__ == "__main__":
    program_test.main()
