#!/usr/bin/env python3
"""`scumble measure` from outside, with tiny pictures: what is printed, not what is measured.

    tests/program/measure_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
"""
import json
import math
import re
import sys
import unittest

import program_test
from program_test import NOT_WRITTEN, UNUSABLE, USAGE, Program, png

SMALL = ["--size", "64x36", "--quiet"]
MODES = ["metatexture", "object", "screen", "fractal"]


class Measure(Program):
    def test_json_and_chart(self):
        text = self.good("measure", "box.gltf", *SMALL, "--validate", "--json", "--plot", "chart.png")
        report = json.loads(text)
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
                         ["frequency", "contrast", "warp error", "stereo"])
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

    def test_the_table_names_everything(self):
        text = self.good("measure", "box.gltf", *SMALL, "--ipd", "0.2")
        self.assertIn("eyes 0.2 m apart", text)
        for mode in MODES:
            self.assertIn(mode, text)
        for row in ("dolly", "orbit", "roll", "moving object", "frequency", "contrast", "flatness", "stereo", "final-color"):
            self.assertIn(row, text)
        self.assertEqual(len(re.findall(r"(?m)^  (?:kept|missed) ", text)), 4)
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
