#!/usr/bin/env python3
"""MetaTexture and Edge Breakup from outside: pictures that a look names, and knobs that change with time.

    tests/program/patterns_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
"""
import json
import struct
import unittest
import zlib

import program_test
from program_test import UNUSABLE, USAGE, Program
from png import make_png as png  # program_test knows where



def stripes(size=32):
    return png(size, size, lambda x, y: (200 if x // 4 % 2 else 60, 200 if y // 8 % 2 else 60, 40 + 6 * (x % 32), 255))


def claims(width, height):
    """A PNG that claims to be larger than it is."""
    data = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    chunk = struct.pack(">I", 13) + b"IHDR" + data + struct.pack(">I", zlib.crc32(b"IHDR" + data))
    return b"\x89PNG\r\n\x1a\n" + chunk


class Pattern(Program):
    def bytes(self, name):
        return (self.folder / name).read_bytes()


class Pictures(Pattern):
    def look(self, knobs, name="look.json"):
        self.put(name, json.dumps(knobs))
        return ["--look", "./" + name]

    def test_each_use_takes_a_picture_from_beside_the_look(self):
        self.put("fields/stripes.png", stripes())
        self.render("box.gltf", "-o", "plain.png")
        for use in ("warp", "breakup", "texture"):
            knobs = {use: {"metatexture": {"example": "fields/stripes.png"}}, "shadow": {"dither": 1}}
            if use == "texture":
                knobs["texture"]["amount"] = 1
            self.render("box.gltf", "-o", use + ".png", *self.look(knobs, "shadow.json"))
            base = {"shadow": {"dither": 1}, "texture": {"amount": 1 if use == "texture" else 0}}
            self.render("box.gltf", "-o", "base.png", *self.look(base, "base.json"))
            self.different(self.bytes(use + ".png"), self.bytes("base.png"))

    def test_a_looks_file_reads_nothing_outside_of_its_folder(self):
        self.put("stripes.png", stripes())
        self.put("looks/inside.png", stripes())
        for path in ("../stripes.png", str(self.folder / "stripes.png"), "sub/../../stripes.png"):
            with self.subTest(path=path):
                look = self.look({"warp": {"metatexture": {"example": path}}}, "looks/look.json")
                self.bad(UNUSABLE, "render", "box.gltf", *look, says=("looks/look.json", "warp.metatexture.example", "outside"))
        self.render("box.gltf", "-o", "a.png", *self.look({"warp": {"metatexture": {"example": "inside.png"}}}, "looks/look.json"))
        # By hand any path is the user's own.
        self.render("box.gltf", "-o", "b.png", "--set", "warp.metatexture.example=looks/../stripes.png")
        self.same(self.bytes("a.png"), self.bytes("b.png"))

    def test_pictures_that_cannot_be_used(self):
        self.put("text.png", b"no picture at all")
        self.put("cut.png", stripes()[:80])
        self.put("huge.png", claims(5000, 5000))
        self.put("absurd.png", claims(2000000, 2000000))
        for name in ("absent.png", "text.png", "cut.png", "huge.png", "absurd.png", "."):
            with self.subTest(name=name):
                self.bad(UNUSABLE, "render", "box.gltf", "--set", "texture.metatexture.example=" + name, says=name)
                look = self.look({"texture": {"metatexture": {"example": name}}})
                self.bad(UNUSABLE, "render", "box.gltf", *look, says=("look.json", "texture.metatexture.example"))

    def test_a_slip_in_a_name_is_no_file(self):
        self.bad(USAGE, "render", "box.gltf", "--set", "warp.metatexture.example=tron", says="torn|strokes|paper|sea|foam|nested")
        self.bad(USAGE, "render", "box.gltf", "--set", "warp.metatexture.example=")
        self.bad(UNUSABLE, "render", "box.gltf", *self.look({"warp": {"metatexture": {"example": 1}}}), says="example")

    def test_pictures_of_any_shape(self):
        for name, width, height in (("dot.png", 1, 1), ("wide.png", 64, 4), ("odd.png", 7, 13)):
            self.put(name, png(width, height, lambda x, y: (37 * x % 256, 91 * y % 256, 128, 255)))
            for contrast in ("auto", "histogram"):
                self.render("box.gltf", "-o", "x.png", "--set", f"warp.metatexture.example={name}", "--set",
                            f"warp.metatexture.contrast={contrast}", "--set", "texture.amount=1", "--set",
                            f"texture.metatexture.example={name}")


class Time(Pattern):
    def test_line_boil_is_on_twos(self):
        for second in ("0", "0.05", "0.0834", "0.12"):
            self.render("box.gltf", "-o", second + ".png", "--time", second, "--set", "warp.boil=1", "--set", "warp.amount=20")
        self.same(self.bytes("0.png"), self.bytes("0.05.png"))
        self.different(self.bytes("0.png"), self.bytes("0.0834.png"))
        self.same(self.bytes("0.0834.png"), self.bytes("0.12.png"))
        self.render("box.gltf", "-o", "f.####.png", "--frames", "0..3", "--quiet", "--set", "warp.boil=1", "--set", "warp.amount=20")
        self.same(self.bytes("f.0000.png"), self.bytes("0.png"))
        self.same(self.bytes("f.0001.png"), self.bytes("0.png"))
        self.same(self.bytes("f.0002.png"), self.bytes("0.0834.png"))


class Ripple(Pattern):
    def test_all_three_in_stereo_too(self):
        pictures = []
        for ripple in ("paper", "depth-aware", "layered"):
            for stereo in ([], ["--stereo", "side-by-side", "--ipd", "0.2"]):
                name = ripple + str(len(stereo)) + ".png"
                self.render("box.gltf", "-o", name, "--set", "final.ripple=" + ripple, "--set", "warp.amount=40", *stereo)
                pictures.append(self.bytes(name))
        self.assertEqual(len(set(pictures)), len(pictures))


if __name__ == "__main__":
    program_test.main()
