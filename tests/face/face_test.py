#!/usr/bin/env python3
"""The shared library from outside: tests/face/c_face, and Python's ctypes.

    tests/face/face_test.py LIBRARY C_FACE PROGRAM DEMO_SCENE

Both draw what the program draws, to the byte. The library shows its face, and nothing else of itself.
"""
import ctypes
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LIBRARY, C_FACE, PROGRAM, DEMO_SCENE = (Path(argument).resolve() for argument in sys.argv[1:5])
HEADER = Path(__file__).resolve().parent.parent.parent / "include/scumble/scumble.h"
WIDTH, HEIGHT = 96, 54


class View(ctypes.Structure):
    _fields_ = [("world_to_eye", ctypes.c_float * 16), ("eye_to_clip", ctypes.c_float * 16), ("node", ctypes.c_int32),
                ("width", ctypes.c_uint32), ("height", ctypes.c_uint32), ("rig", ctypes.c_int32), ("is_level", ctypes.c_int32)]


class Viewpoint(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("camera", ctypes.c_char_p), ("has_orbit", ctypes.c_int32), ("azimuth", ctypes.c_float),
                ("elevation", ctypes.c_float), ("distance", ctypes.c_float), ("has_eye", ctypes.c_int32),
                ("eye", ctypes.c_float * 3), ("target", ctypes.c_float * 3), ("vertical_fov", ctypes.c_float)]


class Options(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("width", ctypes.c_uint32), ("height", ctypes.c_uint32), ("samples", ctypes.c_uint32),
                ("seed", ctypes.c_uint32), ("transparent", ctypes.c_int32), ("format", ctypes.c_int),
                ("aovs", ctypes.POINTER(ctypes.c_char_p)), ("aov_count", ctypes.c_size_t), ("progress", ctypes.c_void_p),
                ("progress_user", ctypes.c_void_p)]


class Image(ctypes.Structure):
    _fields_ = [("width", ctypes.c_uint32), ("height", ctypes.c_uint32), ("channels", ctypes.c_uint32),
                ("format", ctypes.c_int), ("data", ctypes.c_void_p), ("bytes", ctypes.c_size_t)]


class FaceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="scumble face ")
        cls.scene = Path(cls.folder.name) / "demo.glb"
        subprocess.run([DEMO_SCENE, cls.scene], check=True, stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def drawn(self, name, *options):
        path = Path(self.folder.name) / name
        subprocess.run([PROGRAM, "render", self.scene, "-o", path, "--size", f"{WIDTH}x{HEIGHT}", "--camera", "Hero", "--quiet",
                        *options], check=True)
        return path

    def test_a_program_in_c(self):
        output = Path(self.folder.name) / "c.png"
        done = subprocess.run([C_FACE, self.scene, output], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        look = Path(self.folder.name) / "plain.json"
        look.write_text('{"shadow": {"threshold": 0.45}}')
        self.drawn("program.png", "--look", look, "--time", "0.5", "--stereo", "separate", "--ipd", "0.4")
        self.assertEqual(output.read_bytes(), (Path(self.folder.name) / "program.left.png").read_bytes())

    def test_ctypes(self):
        face = ctypes.CDLL(str(LIBRARY))
        face.scumble_error.restype = ctypes.c_char_p
        for name in ("scumble_scene_load", "scumble_look_load", "scumble_renderer_create", "scumble_render"):
            getattr(face, name).restype = ctypes.c_void_p
        scene = ctypes.c_void_p(face.scumble_scene_load(str(self.scene).encode(), None, None))
        look = ctypes.c_void_p(face.scumble_look_load(b"storm"))
        renderer = ctypes.c_void_p(face.scumble_renderer_create(None))
        self.assertTrue(scene and look and renderer, face.scumble_error())
        viewpoint, views, count = Viewpoint(size=ctypes.sizeof(Viewpoint), camera=b"Hero"), (View * 2)(), ctypes.c_size_t()
        status = face.scumble_make_views(scene, look, ctypes.byref(viewpoint), ctypes.c_float(WIDTH / HEIGHT), 0, ctypes.c_float(0),
                                         ctypes.c_double(1), views, ctypes.byref(count))
        self.assertEqual((status, count.value), (0, 1), face.scumble_error())
        options = Options(size=ctypes.sizeof(Options))
        face.scumble_options_default(ctypes.byref(options))
        options.width, options.height = WIDTH, HEIGHT
        frame = ctypes.c_void_p(face.scumble_render(renderer, scene, look, ctypes.c_double(1), views, ctypes.c_size_t(1),
                                                    ctypes.byref(options)))
        self.assertTrue(frame, face.scumble_error())
        image = Image()
        self.assertEqual(face.scumble_frame_image(frame, ctypes.c_size_t(0), ctypes.c_size_t(0), ctypes.byref(image)), 0)
        self.assertEqual((image.width, image.height, image.channels, image.bytes), (WIDTH, HEIGHT, 4, WIDTH * HEIGHT * 16))
        # Memory as numpy takes it: contiguous rows, no copy.
        pixels = memoryview((ctypes.c_float * (WIDTH * HEIGHT * 4)).from_address(image.data))
        self.assertTrue(pixels.contiguous)
        rows = pixels.cast("B").cast("f", (HEIGHT, WIDTH, 4))
        self.assertEqual(rows.shape, (HEIGHT, WIDTH, 4))
        alphas = {rows[y, x, 3] for y in range(HEIGHT) for x in range(WIDTH)}
        self.assertEqual(alphas, {1.0})
        lightest = max(rows[y, x, c] for y in range(HEIGHT) for x in range(WIDTH) for c in range(3))
        self.assertTrue(0.1 < lightest < 4, lightest)
        output = str(Path(self.folder.name) / "ctypes.png")
        self.assertEqual(face.scumble_frame_write(frame, ctypes.c_size_t(0), ctypes.c_size_t(0), output.encode()), 0)
        program = self.drawn("storm.png", "--look", "storm", "--time", "1")
        self.assertEqual(Path(output).read_bytes(), program.read_bytes())
        for free, handle in (("frame", frame), ("renderer", renderer), ("look", look), ("scene", scene)):
            getattr(face, f"scumble_{free}_free")(handle)

    def test_the_library_shows_its_face_alone(self):
        table = subprocess.run(["nm", "-D", "--defined-only", LIBRARY], capture_output=True, text=True, check=True).stdout
        names = {line.split()[-1] for line in table.splitlines()}
        declared = set(re.findall(r"SCUMBLE_API[^;(]*?(scumble_\w+)\(", HEADER.read_text()))
        self.assertGreater(len(declared), 20)
        self.assertEqual(declared - names, set())
        self.assertEqual({name for name in names if name.startswith("scumble_")} - declared, set())
        # Nothing of the inner rooms, in C++ either.
        inner = [name for name in names if re.search(r"_ZN?K?\w*7scumble\w*(3gpu|5frame|6passes|8renderer|5scene)\d", name)
                 and "_ZT" not in name]
        self.assertEqual(inner, [])
        soname = subprocess.run(["readelf", "-d", LIBRARY], capture_output=True, text=True, check=True).stdout
        version = re.search(r'VERSION_STRING "(\d+)\.', (HEADER.parent / "version.h").read_text()).group(1)
        self.assertIn(f"libscumble.so.{version}]", soname)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
