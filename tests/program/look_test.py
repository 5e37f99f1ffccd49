#!/usr/bin/env python3
"""Looks from pictures: there and back, and mistakes that people make.

    tests/program/look_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
    tests/program/look_test.py SCUMBLE --table SCENE...                    the table of docs/study.md, in some minutes
"""
import json
import math
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import program_test
from program_test import NOT_WRITTEN, UNUSABLE, USAGE, Program
from png import make_png  # program_test knows where it lies

SIZE = ["--size", "960x540"]


def lab(color):
    """OKLab of #RRGGBB."""
    r, g, b = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
               for c in (int(color[i:i + 2], 16) / 255 for i in (1, 3, 5)))
    l, m, s = (x ** (1 / 3) for x in (0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b,
                                      0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b,
                                      0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b))
    return (0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s, 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s)


def apart(a, b):
    """How far the colours of two studies are from each other's, by their shares: the greater of both ways; OKLab."""
    def one_way(here, there):
        return sum(color["share"] * min(math.dist(lab(color["color"]), lab(other["color"])) for other in there) for color in here)
    return max(one_way(a["palette"], b["palette"]), one_way(b["palette"], a["palette"]))


def picture(path, width=96, height=96):
    """A PNG of two colours, and a corner of a third."""
    def pixel(x, y):
        return (200, 60, 40) if x < 20 and y < 20 else (240, 230, 200) if x < width // 2 else (40, 60, 110)
    path.write_bytes(make_png(width, height, pixel))


class RoundTrip(Program):
    def painted(self, look, name):
        self.good("render", str(program_test.shared / "demo.glb"), "--look", look, "-o", name, "--quiet", *SIZE)
        return json.loads(self.good("look", name, "-o", name + ".look.json", "--json"))

    def test_what_looks_have_painted_gives_them_back(self):
        plain = self.painted("age-of-sail", "plain.png")
        self.assertFalse(plain["lines"]["isDrawn"])
        for look, lines, paper in (("four-colours", False, False), ("watercolour", True, True)):
            first = self.painted(look, f"{look}.png")
            again = self.painted(f"./{look}.png.look.json", f"{look}-again.png")
            self.assertLess(apart(first, again), 0.03, look)
            self.assertLess(apart(first, again), 0.4 * apart(first, plain), look)
            for study in (first, again):
                self.assertEqual((study["lines"]["isDrawn"], study["isOnPaper"]), (lines, paper), look)
            for value in ("darkest", "lightest", "median"):
                self.assertAlmostEqual(first["value"][value], again["value"][value], delta=0.12, msg=f"{look} {value}")
        # Of a print in four colours, these are the four.
        own = json.loads((Path(__file__).parents[2] / "looks/four-colours.json").read_text())["limit"]
        found = json.loads(self.good("look", "four-colours.png", "-o", "f.json", "--json"))["palette"]
        for color in found:
            self.assertLess(min(math.dist(lab(color["color"]), lab(own[f"color{k}"])) for k in range(1, 5)), 0.02)


class Command(Program):
    def setUp(self):
        super().setUp()
        picture(self.folder / "two.png")
        self.before = self.files()

    def test_it_says_what_it_found(self):
        text = self.good("look", "two.png")
        self.assertRegex(text, r"\Atwo\.found\.json: 3 colours, values from 0\.\d+ to 0\.\d+")
        self.assertEqual(self.new_files(), {"two.found.json"})
        # The look is a look, with comments; a scene takes it for its own only where somebody names it so.
        written = (self.folder / "two.found.json").read_text()
        self.assertIn("// ", written)
        self.good("render", "box.gltf", "--look", "./two.found.json", "-o", "a.png", "--size", "64x48")
        shutil.copy(self.folder / "two.found.json", self.folder / "box.look.json")
        self.good("render", "box.gltf", "-o", "b.png", "--size", "64x48", "--quiet")
        self.same((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        self.assertEqual(self.good("look", "two.png", "-o", "again.json", "--quiet"), "")
        self.same((self.folder / "again.json").read_text(), written)
        study = json.loads(self.good("look", "two.png", "--json"))
        self.assertEqual(len(study["palette"]), 3)
        self.assertEqual(json.loads(self.good("look", "--json", "two.png")), study)
        self.good("look", "two.png", "--json", "study.txt")
        self.assertEqual(json.loads((self.folder / "study.txt").read_text()), study)

    def test_all_kinds_of_pictures(self):
        for name in ("a.png", "a.jpg", "a.webp", "a.exr"):
            self.good("render", "box.gltf", "-o", name, "--size", "128x96", "--quiet")
            self.good("look", name, "-o", name + ".json")

    def test_pictures_are_never_reports(self):
        picture(self.folder / "other.png")
        self.before = self.files()
        before = (self.folder / "other.png").read_bytes()
        self.bad(USAGE, "look", "--json", "other.png", "two.png")
        self.same((self.folder / "other.png").read_bytes(), before)

    def test_narrow_pictures(self):
        picture(self.folder / "tall.png", 100, 800)
        self.good("look", "tall.png", "-o", "tall.json")
        picture(self.folder / "thread.png", 64, 9000)
        self.before = self.files()
        self.bad(UNUSABLE, "look", "thread.png", says="64 x 9000")

    def test_mistakes(self):
        self.bad(USAGE, "look", says="PICTURE")
        self.bad(UNUSABLE, "look", "none.png", says="none.png")
        self.bad(UNUSABLE, "look", "box.gltf", says="box.gltf")
        self.bad(USAGE, "look", "two.png", "-o", "two.png", says=".json")
        self.bad(USAGE, "look", "two.png", "-o", "a.json", "--json=a.json", says="a.json")
        self.bad(NOT_WRITTEN, "look", "two.png", "-o", "no/such/folder/a.json")
        picture(self.folder / "small.png", 40, 30)
        self.before = self.files()
        self.bad(UNUSABLE, "look", "small.png", says=["small.png", "40 x 30"])


def table(scumble, scenes):
    """For each look, scene by scene: how far what the found look paints is from what the look has painted, and how far the default
    look's picture is; and whether lines and paper were told."""
    folder = Path(tempfile.mkdtemp())

    def study(look, scene, name):
        subprocess.run([scumble, "render", scene, "--look", look, "-o", folder / f"{name}.png", "--quiet", *SIZE], check=True)
        return json.loads(subprocess.run([scumble, "look", folder / f"{name}.png", "-o", folder / f"{name}.json", "--json"],
                                         check=True, capture_output=True, text=True).stdout)
    looks = [line.split()[0] for line in subprocess.run([scumble, "looks"], check=True, capture_output=True, text=True).stdout.splitlines()]
    print("| look | palette | default look's | darkest | lightest | lines | paper |\n|---|---|---|---|---|---|---|")
    plain = {scene: study("age-of-sail", scene, "plain") for scene in scenes}
    for look in looks:
        rows = []
        for scene in scenes:
            first = study(look, scene, "first")
            again = study(str(folder / "first.json"), scene, "again")
            rows.append((apart(first, again), apart(first, plain[scene]),
                         *(abs(first["value"][k] - again["value"][k]) for k in ("darkest", "lightest")),
                         first["lines"]["isDrawn"] == again["lines"]["isDrawn"], first["isOnPaper"] == again["isOnPaper"]))
        *numbers, lines, paper = zip(*rows)
        cells = [", ".join(f"{value:.3f}" for value in of_scenes) for of_scenes in numbers]
        cells += [", ".join("yes" if value else "**no**" for value in of_scenes) for of_scenes in (lines, paper)]
        print(f"| `{look}` | {' | '.join(cells)} |", flush=True)
    shutil.rmtree(folder)


if __name__ == "__main__":
    if "--table" in sys.argv:
        table(sys.argv[1], sys.argv[3:])
    else:
        program_test.main()
