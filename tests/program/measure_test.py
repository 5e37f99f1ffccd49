#!/usr/bin/env python3
"""`scumble measure` from outside, with tiny pictures: what is printed, and that the modes can be told by it.

    tests/program/measure_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
"""
import json
import math
import re
import sys
import unittest

import program_test
from film_test import clip
from program_test import NOT_WRITTEN, UNUSABLE, USAGE, Program, gltf, png

SMALL = ["--size", "64x36", "--quiet"]
MODES = ["metatexture", "object", "screen", "fractal"]


class Measure(Program):
    def test_json_and_chart(self):
        # Near by, and with marks that are large enough for so small a picture.
        near = ["--orbit", "25,15,2", "--set", "warp.metatexture.size=500", "--set", "breakup.metatexture.size=500"]
        text = self.good("measure", "box.gltf", *SMALL, *near, "--validate", "--json", "--plot", "chart.png")
        report = json.loads(text)
        self.check_modes(report["modes"])
        self.assertEqual(list(report["modes"]), sorted(MODES))
        for mode in report["modes"].values():
            for motion in ("dolly", "orbit", "roll", "object", "mean"):
                for field in ("vectors", "marks"):
                    self.assertGreaterEqual(mode["temporal"][motion][field], 0)
                    self.assertLess(mode["temporal"][motion][field], 1.5)
            zooms = [point["zoom"] for point in mode["zoom"]]
            self.assertEqual(len(zooms), 13)
            self.assertEqual((zooms[0], zooms[6], zooms[-1]), (1 / 8, 1, 8))
            for before, after in zip(zooms, zooms[1:]):
                self.assertAlmostEqual(after / before, math.sqrt(2))
            for field in ("vectors", "marks"):
                self.assertTrue(0 <= mode["flatness"][field] <= 1)
                self.assertGreater(mode["stereo"]["warp"][field], 0)
                self.assertGreaterEqual(mode["frequencyDrift"][field], 0)
            for aov in ("final-shadow", "color", "final-color"):
                self.assertTrue(0 <= mode["stereo"][aov] < 1)
        self.assertEqual([target["name"] for target in report["targets"]],
                         ["frequency", "contrast", "warp error", "stereo", "warp error, best rival",
                          "stereo, best rival"])
        for target in report["targets"]:
            self.assertEqual(target["kept"], target["value"] <= target["limit"])
        self.assertEqual(report["size"], [64, 36])
        self.assertGreater(report["ipd"], 0)

        self.assertEqual(self.new_files(), {"chart.png"})
        width, height, _, rows = png(self.folder / "chart.png")
        self.assertGreater(width, 1000)
        self.assertGreater(height, 700)
        colors = {row[i:i + 3] for row in rows for i in range(0, len(row), 3)}
        for color in (0x1D6478, 0xD0974A, 0xB4605A, 0x8E9B6B):  # one of each mode
            self.assertIn(color.to_bytes(3, "big"), colors)

    def test_lines(self):
        """Of an AOV, beside pictures that the program has drawn itself: the same lines are as steady."""
        look = ["--look", "ink", "--size", "96x72", "--quiet", "--orbit", "25,15", "--set", "warp.amount=0"]
        report = json.loads(self.good("measure", "box.gltf", *look, "--samples", "1", "--lines", "ink", "--validate", "--json"))
        ink = report["lines"]["ink"]
        self.assertGreater(ink["drawn"], 50)
        self.assertGreater(ink["changes"], 0.05)
        self.assertLess(ink["flickers"], 0.02)
        self.assertEqual(len(report["views"]), 41)
        eyes = [view["eyeToWorld"][12:15] for view in report["views"]]
        across = [math.atan2(eye[0], eye[2]) for eye in eyes]  # the box stands around the origin
        for before, after in zip(across, across[1:]):
            self.assertAlmostEqual(abs(math.degrees(after - before)), 0.125, places=3)
        # Black on white, but for surfaces: a drawing of nothing but lines.
        blank = ["--set", "lit.overlay=#FFFFFF", "--set", "lit.overlayAmount=1", "--set", "shadowed.overlay=#FFFFFF", "--set",
                 "shadowed.overlayAmount=1", "--set", "ground.mode=off", "--background", "#FFFFFF", "--samples", "1"]
        for number, view in enumerate(report["views"]):
            m = view["eyeToWorld"]
            eye, target = m[12:15], [m[12 + i] - m[8 + i] for i in range(3)]
            self.good("render", "box.gltf", *look[:5], *look[7:], *blank, "--eye", ",".join(map(str, eye)), "--target",
                      ",".join(map(str, target)), "-o", f"drawn.{number:04}.png")
        text = self.good("measure", "box.gltf", *look, "--lines", "ink", "--drawing", "drawn=drawn.####.png")
        rows = {row.split()[0]: [float(n) for n in row.split()[1:]] for row in text.splitlines() if row.startswith("  ")}
        self.assertEqual(set(rows), {"ink", "drawn"})
        self.assertAlmostEqual(rows["drawn"][1] / rows["ink"][1], 1, delta=0.3)
        self.assertLess(rows["drawn"][2], 0.02)

    def test_lines_that_cannot_be_measured(self):
        for words, what in ((["--lines", "nope"], "nope"), (["--lines", "depth"], "depth"), (["--lines", "ink"], "no lines"),
                            (["--lines", "ink", "--plot", "a.png"], "--plot"), (["--drawing", "a=a.####.png"], "--lines"),
                            (["--lines", "ink", "--drawing", "a"], "####")):
            self.assertIn(what, self.bad(USAGE, "measure", "box.gltf", *SMALL, *words))
        self.bad(UNUSABLE, "measure", "box.gltf", "--look", "ink", *SMALL, "--lines", "ink", "--drawing", "a=a.####.png")

    def test_steps(self):
        """Poses that stand twice as long jump about twice as far, and half as often."""
        scene = json.loads(gltf(camera=True))
        for key, items in clip(0, "Rise", (0, 2, 0), seconds=4).items():
            scene.setdefault(key, []).extend(items)
        (self.folder / "moving.gltf").write_text(json.dumps(scene))
        report = json.loads(self.good("measure", "moving.gltf", *SMALL, "--samples", "1", "--steps", "1,2,4", "--validate", "--json"))
        steps = report["steps"]
        self.assertEqual([step["hold"] for step in steps], [1, 2, 4])
        for before, after in zip(steps, steps[1:]):
            self.assertAlmostEqual(after["jump"] / before["jump"], 2, delta=0.5)
            self.assertAlmostEqual(after["stands"] / before["stands"], 2)
        text = self.good("measure", "moving.gltf", *SMALL, "--steps", "3")
        self.assertAlmostEqual(float(text.split()[-6]), 8, places=1)

    def test_steps_that_cannot_be_measured(self):
        for words, what in ((["--steps", "1"], "moves"), (["--steps", "0"], "0 frames"), (["--steps", "25"], "25 frames"),
                            (["--steps", "1", "--lines", "ink"], "--lines"), (["--steps", "1", "--plot", "a.png"], "--plot")):
            self.assertIn(what, self.bad(USAGE, "measure", "box.gltf", *SMALL, *words))

    def check_modes(self, modes):
        """Each mode fails where docs/measure.md says it does, and the others do not."""
        for name, mode in modes.items():
            with self.subTest(mode=name):
                stereo, drift = mode["stereo"]["warp"]["vectors"], mode["frequencyDrift"]["vectors"]
                carried, contrast = mode["temporal"]["object"]["vectors"], mode["contrastError"]["vectors"]
                # What lies on the screen is unrelated in the other eye, and stays behind when the object moves.
                self.assertEqual(stereo > 0.8, name == "screen", stereo)
                self.assertEqual(carried > 0.6, name == "screen", carried)
                self.assertTrue(stereo > 0.8 or stereo < 0.5, stereo)
                # Ordinary mapping grows with the picture; what is below two pixels a cycle cannot be seen.
                self.assertEqual(drift > 1.5, name == "object", drift)
                self.assertTrue(drift > 1.5 or drift < 0.7, drift)
                # Ordinary mapping loses the example's contrast.
                self.assertEqual(contrast > 0.4, name == "object", contrast)
                self.assertTrue(contrast > 0.4 or contrast < 0.3, contrast)
        flatness = {name: mode["flatness"]["vectors"] for name, mode in modes.items()}
        self.assertEqual(min(flatness, key=flatness.get), "screen")
        # Octaves that are summed show the largest of them.
        self.assertGreater(flatness["fractal"], flatness["metatexture"])

    def test_the_table_names_everything(self):
        text = self.good("measure", "box.gltf", *SMALL, "--ipd", "0.2")
        self.assertIn("eyes 0.2 m apart", text)
        for mode in MODES:
            self.assertIn(mode, text)
        for row in ("dolly", "orbit", "roll", "moving object", "frequency", "contrast", "flatness", "stereo", "final-color"):
            self.assertIn(row, text)
        self.assertEqual(len(re.findall(r"(?m)^  (?:kept|missed) ", text)), 6)
        self.assertEqual(self.new_files(), set())

    def test_wrong_usage(self):
        for args in (["--plot", "chart.jpg"], ["--size", "8x8"], ["--ipd", "0"], ["--ipd", "nan"], ["--stereo", "separate"],
                     ["--size", "64by36"], ["--orbit", "1"], ["--set", "no.such=1"], ["--eye", "0,0,100", "--target", "0,0,200"]):
            with self.subTest(args=args):
                self.bad(USAGE, "measure", "box.gltf", *SMALL, *args)
        self.bad(USAGE, "measure")
        self.bad(UNUSABLE, "measure", "absent.gltf", *SMALL, says="absent.gltf")
        self.bad(NOT_WRITTEN, "measure", "box.gltf", *SMALL, "--plot", "no/such/chart.png", says="no/such/chart.png")
        self.bad(NOT_WRITTEN, "measure", "box.gltf", *SMALL, "--plot", "box.gltf.png/x.png")


if __name__ == "__main__":
    program_test.main()
