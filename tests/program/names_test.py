#!/usr/bin/env python3
"""What captures see: names of what a frame is made of, and labels around its steps, by a layer of our own.

    tests/program/names_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
"""
import collections
import json
import subprocess
from pathlib import Path

import program_test
from program_test import TINY, Program

LAYER = "VK_LAYER_TEST_write_names"
BUFFER, IMAGE, PIPELINE = 9, 10, 19  # VkObjectType
KINDS = {BUFFER: "buffer", IMAGE: "image", PIPELINE: "pipeline"}


class Names(Program):
    def written(self, *args):
        """The layer's lines, by words, of a call of the program."""
        layers = self.folder / "layers"
        if not layers.exists():
            layers.mkdir()
            subprocess.run(["g++", "-std=c++20", "-shared", "-fPIC", "-Wl,-Bsymbolic", Path(__file__).with_name("write_names.cpp"),
                            "-o", layers / "write_names.so"], check=True)
            (layers / "write_names.json").write_text(json.dumps({"file_format_version": "1.1.0", "layer": {
                "name": LAYER, "type": "INSTANCE", "library_path": "./write_names.so", "api_version": "1.3.0",
                "implementation_version": "1", "description": "writes names"}}))
        lines = self.folder / "lines"
        done = self.run_program(*args, environment={"VK_ADD_LAYER_PATH": str(layers), "VK_INSTANCE_LAYERS": LAYER,
                                                    "WRITE_NAMES": str(lines)})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return [line.split(" ", 3) for line in lines.read_text().splitlines()]

    def checked(self, *args):
        """Names by kind, labels of steps and of submissions; after everything has been seen to have one."""
        unnamed, names = {}, collections.defaultdict(list)
        labels, submissions, depth, queue = [], [], 0, None
        for words in self.written(*args):
            what, rest = words[0], words[1:]
            if what == "made":
                unnamed[(int(rest[0]), rest[1])] = True
            elif what == "named":
                self.assertTrue(rest[2])
                if unnamed.pop((int(rest[0]), rest[1]), False):
                    names[int(rest[0])].append(rest[2])
            elif what == "begin":
                labels.append(" ".join(rest))
                depth += 1
            elif what == "end":
                depth -= 1
                self.assertGreaterEqual(depth, 0)
            elif what == "queue":
                queue = " ".join(rest)
            elif what == "queue-end":
                queue = None
            elif what == "submit":
                self.assertTrue(queue, "a submission without a label")
                submissions.append(queue)
        self.assertEqual((depth, queue), (0, None))
        self.assertEqual({}, unnamed, "made, and without a name")
        for kind, word in KINDS.items():
            self.assertGreater(len(names[kind]), 3, word)
        return names, labels, submissions

    def test_everything_has_a_name(self):
        self.put("paint.gltf", program_test.gltf())
        for args in ([], ["--look", "ink"], ["--look", "watercolour"], ["--look", "manga"], ["--stereo", "side-by-side"],
                     ["--aov", "depth", "--aov", "cryptomatte"]):
            with self.subTest(args=args):
                output = "a.exr" if "--aov" in args else "a.png"
                names, labels, submissions = self.checked("render", "paint.gltf", "-o", output, *args, "--stats", "s.json", *TINY)
                stats = json.loads((self.folder / "s.json").read_text())
                passes = {each["name"] for frame in stats["frames"] for each in frame["passes"]}
                self.assertLessEqual(passes, set(labels), "steps as the statistics call them")
                self.assertIn("scumble: frame", submissions)
                self.assertIn("scumble: upload", submissions)
                # Pipelines as their shaders are called, and not all alike.
                self.assertNotIn("shader", names[PIPELINE])
                self.assertTrue(any(name.startswith("surface") for name in names[PIPELINE]), names[PIPELINE])
                self.assertIn("depth", " ".join(names[IMAGE]))
                self.assertFalse([name for name in names[IMAGE] + names[BUFFER] if name.startswith("/")], "this machine's paths")

    def test_names_change_nothing(self):
        self.put("paint.gltf", program_test.gltf())
        self.checked("render", "paint.gltf", "-o", "a.png", *TINY)
        self.good("render", "paint.gltf", "-o", "b.png", *TINY)
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())


if __name__ == "__main__":
    program_test.main()
