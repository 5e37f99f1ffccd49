#!/usr/bin/env python3
"""The Python module from outside.

    PYTHONPATH=BUILD/python tests/python/module_test.py PROGRAM DEMO_SCENE [Class.test]

Its pictures and films are what the program makes, to the byte; arrays hold what they say, share the renderer's memory, and are told
from those that make no sense; what takes long lets other threads run, and can be stopped; the stubs are true (mypy, stubtest).
"""
import copy
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np
import scumble

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from gltf import Gltf  # noqa: E402

PROGRAM, DEMO_SCENE = (Path(argument).resolve() for argument in sys.argv[1:3])
HERE = Path(__file__).resolve().parent
MODULE = str(Path(scumble.__file__).parent.parent)
SIZE = (160, 90)
WORDS = ["--size", "160x90", "--device", "cpu", "--quiet"]


def setUpModule():
    global FOLDER, HOLD, SCENE, RENDERER
    HOLD = tempfile.TemporaryDirectory(prefix="scumble python ")
    FOLDER = Path(HOLD.name)
    subprocess.run([DEMO_SCENE, FOLDER / "demo.glb"], check=True, stdout=subprocess.DEVNULL)
    SCENE = scumble.Scene(FOLDER / "demo.glb")
    RENDERER = scumble.Renderer("cpu", validation=True)


def tearDownModule():
    messages = RENDERER.validation_messages
    HOLD.cleanup()
    assert messages == 0, f"{messages} messages of the validation layers"


def program(*words):
    done = subprocess.run([str(word) for word in (PROGRAM, *words)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def srgb(linear):
    linear = np.clip(linear.astype(np.float64), 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def editor_of_a_wall():
    editor = scumble.SceneEditor()
    editor.add_node(mesh=editor.add_mesh(positions=np.array([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]), indices=np.array([[0, 1, 2], [0, 2, 3]])))
    return editor


def ball():
    """A scene that is drawn quickly, in a file that the program reads."""
    file = FOLDER / "ball.gltf"
    if not file.exists():
        gltf = Gltf()
        gltf.ball(1, gltf.material("Ball", (0.6, 0.4, 0.2, 1)), rows=24, columns=48)
        file.write_text(gltf.text())
    return scumble.Scene(file)


def triangle(editor, **more):
    return editor.add_mesh(positions=[[-1, 0, 0], [1, 0, 0], [0, 1.5, 0]], indices=[0, 1, 2], **more)


class Pictures(unittest.TestCase):
    def test_are_the_programs(self):
        for stereo in (False, True):
            for look in ("age-of-sail", "watercolour", *([] if stereo else ["storm", "henry", "manga", "gouache-night"])):
                with self.subTest(look=look, stereo=stereo):
                    frame = RENDERER.render(SCENE, look, 0.5, size=SIZE, samples=1, stereo=stereo, orbit=(30, 10))
                    frame.save(FOLDER / "here.png")
                    program("render", FOLDER / "demo.glb", "-o", FOLDER / "there.png", *WORDS, "--look", look, "--time", "0.5", "--orbit", "30,10",
                            "--samples", "1", *(["--stereo", "side-by-side"] if stereo else []))
                    self.assertEqual((FOLDER / "here.png").read_bytes(), (FOLDER / "there.png").read_bytes())

    def test_layers_are_the_programs(self):
        """Whole EXR files: names, views, types, and numbers."""
        names = ["depth", "final-shadow", "cryptomatte", "motion", "id"]
        for stereo in (False, True):
            with self.subTest(stereo=stereo):
                frame = RENDERER.render(SCENE, "ink", size=SIZE, samples=1, aovs=names, stereo=stereo)
                frame.save(FOLDER / "here.exr")
                program("render", FOLDER / "demo.glb", "-o", FOLDER / "there.exr", *WORDS, "--look", "ink", "--samples", "1",
                        "--aov", ",".join(names), *(["--stereo", "side-by-side"] if stereo else []))
                for view in ("left", "right") if stereo else ("",):
                    np.testing.assert_array_equal(scumble.read_picture(FOLDER / "here.exr", view), scumble.read_picture(FOLDER / "there.exr", view))
                described = [re.sub(r".*?capDate.*|.*/(here|there)\.exr.*", "", self.header(FOLDER / name)) for name in ("here.exr", "there.exr")]
                here, there = ({line.strip() for line in text.splitlines()} for text in described)
                self.assertEqual({line for line in here if "32-bit" in line}, {line for line in there if "32-bit" in line})
                self.assertEqual({line for line in here if "crypto" in line}, {line for line in there if "crypto" in line})

    @staticmethod
    def header(path):
        return subprocess.run(["exrheader", path], capture_output=True, text=True, check=True).stdout

    def test_shapes_dtypes_and_memory(self):
        frame = RENDERER.render(SCENE, size=SIZE, aovs=["depth", "color", "shadow-map"],
                                dtypes={"picture": "uint8", "color": "float16"})
        self.assertEqual(list(frame), ["picture", "depth", "color", "shadow-map"])
        self.assertEqual((frame["picture"].shape, frame["picture"].dtype), ((90, 160, 4), np.uint8))
        self.assertEqual((frame["color"].shape, frame["color"].dtype), ((90, 160, 4), np.float16))
        self.assertEqual((frame["depth"].shape, frame["depth"].dtype), ((90, 160, 1), np.float32))
        self.assertEqual(frame.channels["picture"], ("R", "G", "B", "A"))
        self.assertIn("color", frame.colors)
        self.assertNotIn("depth", frame.colors)
        for name, array in frame.items():
            self.assertFalse(array.flags.owndata, f"{name} is a copy")
            self.assertTrue(array.flags.c_contiguous and array.flags.writeable and array.flags.aligned, name)
        kept = frame["depth"]
        expected = kept.copy()
        del frame
        RENDERER.render(SCENE, "ink", size=SIZE, samples=1)
        np.testing.assert_array_equal(kept, expected)  # it owns what it lies in

        floats = RENDERER.render(SCENE, size=SIZE)["picture"]
        codes = RENDERER.render(SCENE, size=SIZE, dtypes={"picture": "uint8"})["picture"]
        self.assertLess(np.abs(srgb(floats[..., :3]) * 255 - codes[..., :3]).max(), 0.51)

        self.assertEqual(RENDERER.render(SCENE, size=SIZE, dtypes={"picture": np.uint8})["picture"].dtype, np.uint8)
        both = RENDERER.render(SCENE, size=SIZE, samples=1, stereo=True, aovs=["depth", "shadow-map"])
        self.assertEqual(both["picture"].shape, (2, 90, 160, 4))
        self.assertEqual(both["shadow-map"].ndim, 3)
        self.assertEqual(both.image().shape, (90, 320, 4))
        self.assertFalse(np.array_equal(both.eye(0), both.eye(1)))

    def test_depth_is_metres(self):
        """Of a wall that the camera looks at from three metres."""
        frame = RENDERER.render(editor_of_a_wall().scene(), size=(32, 32), samples=1, eye=(0, 0, 3), target=(0, 0, 0), fov=40, aovs=["depth"])
        np.testing.assert_allclose(frame["depth"], 3, atol=1e-3)

    def test_backgrounds(self):
        red = np.zeros((8, 8, 3), np.uint8)
        red[..., 0] = 255
        editor = scumble.SceneEditor()
        editor.add_node(mesh=triangle(editor))
        for background in (red, (red / 255).astype(np.float32), self.file(red)):
            picture = RENDERER.render(editor.scene(), size=SIZE, background=background, eye=(0, 0, 90), target=(0, 0, 0),
                                      dtypes={"picture": "uint8"})["picture"]
            self.assertGreater(int(picture[2, 2, 0]), 200)
            self.assertLess(int(picture[2, 2, 1]), 60)
        clear = RENDERER.render(editor.scene(), size=SIZE, transparent=True)["picture"]
        self.assertEqual(clear[0, 0, 3], 0)

    @staticmethod
    def file(pixels):
        path = FOLDER / "back.png"
        scumble.write_picture(path, pixels)
        return path

    def test_files_of_pictures(self):
        pixels = np.random.default_rng(1).integers(0, 256, (5, 7, 3), np.uint8)
        scumble.write_picture(FOLDER / "a.png", pixels)
        again = scumble.read_picture(str(FOLDER / "a.png"))
        self.assertEqual((again.shape, again.dtype), ((5, 7, 4), np.float32))
        np.testing.assert_array_equal(np.rint(srgb(again[..., :3]) * 255), pixels)
        floats = np.random.default_rng(2).random((5, 7, 3), np.float32)
        scumble.write_picture(FOLDER / "a.exr", floats)
        np.testing.assert_array_equal(scumble.read_picture(FOLDER / "a.exr")[..., :3], floats)
        scumble.write_picture(FOLDER / "grey.webp", np.full((4, 4), 128, np.uint8), quality=100)
        np.testing.assert_array_equal(np.rint(srgb(scumble.read_picture(FOLDER / "grey.webp")[..., :3]) * 255), 128)
        scumble.write_picture(FOLDER / "flipped.png", pixels[::-1, ::2])  # with gaps between its rows
        np.testing.assert_array_equal(np.rint(srgb(scumble.read_picture(FOLDER / "flipped.png")[..., :3]) * 255), pixels[::-1, ::2])

    def test_notebooks_see_a_picture(self):
        frame = RENDERER.render(SCENE, size=SIZE, samples=1)
        png = frame._repr_png_()
        frame.save(FOLDER / "note.png")
        self.assertEqual(png, (FOLDER / "note.png").read_bytes())
        self.assertIn("picture: 90x160x4 float32", repr(frame))

    def test_drawings(self):
        frame = RENDERER.render(SCENE, "ink", size=SIZE, drawing=True)
        drawing = frame.drawings[0]
        self.assertEqual(drawing.size, SIZE)
        strokes = drawing.strokes
        self.assertGreater(len(strokes), 50)
        self.assertTrue(all(stroke["points"].shape[1] == 3 and stroke["points"].shape[0] >= 2 for stroke in strokes))
        self.assertIn("silhouettes", {stroke["layer"] for stroke in strokes})
        self.assertTrue(drawing.svg(centerlines=True).startswith("<?xml"))

    def test_panorama(self):
        """The program's."""
        for kind, size in (("mono360", "128x64"), ("vr180", "64x64")):
            frame = RENDERER.panorama(ball(), kind=kind, height=64, samples=1, strip=15, eye=(0, 0, 3), target=(0, 0, 0))
            self.assertEqual(frame.image().shape, (64, 128, 4))
            frame.save(FOLDER / "here.png")
            program("render", FOLDER / "ball.gltf", "-o", FOLDER / "there.png", "--panorama", kind, "--size", size, "--samples", "1", "--strip", "15",
                    "--eye", "0,0,3", "--target", "0,0,0", "--device", "cpu", "--quiet")
            self.assertEqual((FOLDER / "here.png").read_bytes(), (FOLDER / "there.png").read_bytes(), kind)

    def test_the_same_call_gives_the_same_bytes(self):
        first, second = (RENDERER.render(SCENE, "storm", 1.25, size=SIZE, samples=1, aovs=["warp"]) for _ in range(2))
        for name in first:
            self.assertEqual(first[name].tobytes(), second[name].tobytes())


class Looks(unittest.TestCase):
    def test_knobs(self):
        look = scumble.Look("ink")
        look["shadow.threshold"] = 0.25
        self.assertEqual(look["shadow.threshold"], 0.25)
        del look["shadow.threshold"]
        self.assertEqual(look["shadow.threshold"], scumble.Look("ink")["shadow.threshold"])
        look["shadow.threshold"] = np.float32(0.5)
        look["warp.boilDrawings"] = np.int64(3)
        look["ink.shown"] = np.bool_(True)
        look["camera.shift"] = np.array([1, 2, 3])
        look["background.zenith"] = "#FF0000"
        self.assertEqual(look["warp.boilDrawings"], 3)
        self.assertEqual(look["camera.shift"], (1, 2, 3))
        np.testing.assert_allclose(look["background.zenith"], (1, 0, 0), atol=1e-6)
        self.assertTrue("shadow.threshold" in look and "shadow.treshold" not in look and 3 not in look)
        look["shadow.threshold"] = np.array([0.5])
        (FOLDER / "mine.json").write_text('{"shadow": {"threshold": 0.5}}')
        RENDERER.render(SCENE, FOLDER / "mine.json", size=SIZE, samples=1)
        other = copy.deepcopy(look)
        other["shadow.threshold"] = 0.75
        self.assertEqual(look["shadow.threshold"], 0.5)

    def test_tracks(self):
        look = scumble.Look()
        look.set_track("shadow.threshold", [(0, 0.2), (2.0, 0.6)], interpolation="linear")
        self.assertAlmostEqual(look.get("shadow.threshold", 1.0), 0.4)
        self.assertEqual(look.animated, ["shadow.threshold"])
        self.assertEqual(look.last_key_time, 2)

    def test_what_there_is(self):
        self.assertEqual(set(scumble.looks()), {line.split()[0] for line in program("looks").splitlines()})
        self.assertEqual(len(scumble.knobs("shadow.")), len(re.findall(r"^  \w+ ", program("params", "shadow."), re.M)))
        self.assertEqual(json.loads(scumble.look_schema()), json.loads(program("schema")))
        look = scumble.Look.from_json('{"description": "Mine.", "shadow": {"threshold": 0.3}}')
        self.assertEqual((look["shadow.threshold"], look.description), (0.3, "Mine."))
        look["materials.Sial.warp.amount"] = 2
        self.assertIn("materials.Sial", look.check(SCENE)[0])
        self.assertEqual(scumble.devices("cpu")[0]["would_be_used"], True)
        self.assertEqual(RENDERER.device, next(device["name"] for device in scumble.devices("cpu") if device["would_be_used"]))


class Scenes(unittest.TestCase):
    def test_summary_and_bytes(self):
        told = json.loads(program("info", FOLDER / "demo.glb", "--json"))
        self.assertEqual(SCENE.summary()["triangles"], told["triangles"])
        again = scumble.Scene.from_bytes((FOLDER / "demo.glb").read_bytes(), name="again")
        first, second = (RENDERER.render(scene, size=SIZE, samples=1)["picture"] for scene in (SCENE, again))
        np.testing.assert_array_equal(first, second)

    def test_editor(self):
        editor = scumble.SceneEditor()
        texture = editor.add_texture(np.full((4, 4, 3), (255, 0, 0), np.uint8), "red")
        material = editor.add_material(name="Paint", base_color=(1, 1, 1), base_color_texture={"texture": texture, "nearest": True}, double_sided=True)
        mesh = triangle(editor, material=material, uv=np.zeros((3, 2)))
        node = editor.add_node(name="Sail", mesh=mesh)
        self.assertEqual((editor.find_node("Sail"), editor.find_material("Paint"), editor.find_node("Nobody")), (node, material, None))
        front = {"eye": (0, 0.5, 4), "target": (0, 0.5, 0), "size": (64, 64), "samples": 1}

        def middle(look=scumble.Look()):
            return RENDERER.render(editor.scene(), look, **front)["picture"][32, 32, :3]

        def is_red(colour):
            return colour[0] > 3 * colour[1]

        self.assertTrue(is_red(middle()))
        matrix = np.eye(4)
        matrix[0, 3] = 50
        editor.set_transform(node, matrix)
        np.testing.assert_array_equal(editor.transform_of(node), matrix)
        self.assertFalse(is_red(middle()))
        editor.set_transform(node, np.eye(4))
        editor.set_texture(texture, np.full((4, 4, 4), (0, 255, 0, 255), np.uint8))
        colour = middle()
        self.assertGreater(colour[1], 2 * colour[0])
        editor.set_material(material, base_color=(1, 0.01, 1, 1), base_color_texture=None, emissive=(1, 0, 0))
        self.assertTrue(is_red(middle()))
        editor.set_visible(node, False)
        self.assertFalse(is_red(middle()))
        editor.set_visible(node, True)
        editor.set_instances(node, [matrix, np.eye(4)])
        self.assertTrue(is_red(middle()))
        colours = np.array([[0, 0, 1.0]] * 3)
        editor.set_material(material, base_color=(1, 1, 1), emissive=(0, 0, 0))
        editor.set_mesh(mesh, parts=[{"positions": [[-1, 0, 0], [1, 0, 0], [0, 1.5, 0]], "colors": colours, "material": material}])
        colour = middle()
        self.assertGreater(colour[2], 2 * colour[0])
        before = matrix.copy()
        before[:3, 3] = 0, 0.5, 2
        lamp = editor.add_node(name="Lamp", transform=before)
        editor.set_light(lamp, "point", color=(1, 0.5, 0), intensity=500)
        self.assertEqual(len(editor.scene().summary()["lights"]), 1)
        behind = scumble.Look()
        behind["light.source"], behind["light.azimuth"], behind["light.elevation"] = "look", 180, 20
        lit = middle(behind)
        editor.set_light(lamp, None)
        self.assertGreater(lit.sum(), 1.2 * middle(behind).sum())
        editor.set_name(lamp, "Nobody")
        self.assertEqual((editor.find_node("Lamp"), editor.find_node("Nobody")), (None, lamp))
        dry = RENDERER.render(editor.scene(), **front)["picture"]
        editor.set_extras(lamp, {"scumble_ocean": True})
        self.assertFalse(np.array_equal(dry, RENDERER.render(editor.scene(), **front)["picture"]))
        editor.set_extras(lamp, {})
        np.testing.assert_array_equal(dry, RENDERER.render(editor.scene(), **front)["picture"])
        editor.set_material(material, outline={"unit": "picture-heights", "width": 0.05, "color": (0, 1, 0), "lighting_mix": 0})
        with self.assertRaisesRegex(scumble.UsageError, "outline"):
            editor.set_material(material, outline={"width": -1})

    def test_only_what_differs_is_sent(self):
        editor = scumble.SceneEditor(SCENE)
        node = next(i for i in range(editor.node_count) if editor.mesh_of(i) >= 0 and editor.parent_of(i) < 0)
        RENDERER.render(editor.scene(), size=SIZE, samples=1)
        moved = editor.transform_of(node).copy()
        moved[1, 3] += 0.05
        editor.set_transform(node, moved)
        stats = RENDERER.render(editor.scene(), size=SIZE, samples=1).stats
        self.assertEqual((stats["written_primitives"], stats["written_textures"]), (0, 0))

    def test_places(self):
        world = scumble.Scene.place([{"scene": SCENE, "name": "boat"}, {"scene": SCENE, "name": "tender", "at": (4, 0, 0), "scale": 0.3}])
        self.assertGreater(world.summary()["nodes"], 2 * SCENE.summary()["nodes"])
        self.assertIn("tender", world.summary()["node_names"])
        self.assertGreater(scumble.Scene.combine([SCENE, SCENE]).summary()["nodes"], SCENE.summary()["nodes"])


class Views(unittest.TestCase):
    def test_matrices_are_as_mathematics_writes_them(self):
        view, = scumble.make_views(SCENE, eye=(1, 2, 8), target=(1, 2, 0))
        np.testing.assert_allclose(view.world_to_eye @ (1, 2, 8, 1), (0, 0, 0, 1), atol=1e-5)
        np.testing.assert_allclose(view.world_to_eye @ (1, 2, 0, 1), (0, 0, -8, 1), atol=1e-5)
        # Double precision, a planet's radius away.
        far, place = view.world_to_eye.copy(), np.array((1e6, 2e5, -6e6))
        far[:3, 3] -= far[:3, :3] @ place
        seen = scumble.View(far, view.eye_to_clip).world_to_eye
        np.testing.assert_allclose(seen @ (*(place + (1, 2, 0)), 1), (0, 0, -8, 1), atol=1e-5)
        own = scumble.View(view.world_to_eye, view.eye_to_clip, node=view.node)
        spoken = RENDERER.render(SCENE, size=SIZE, samples=1, eye=(1, 2, 8), target=(1, 2, 0))
        np.testing.assert_array_equal(spoken["picture"], RENDERER.render(SCENE, size=SIZE, samples=1, views=[own])["picture"])
        left, right = scumble.make_views(SCENE, stereo=True, ipd=0.1)
        np.testing.assert_allclose(np.linalg.inv(right.world_to_eye)[:3, 3] - np.linalg.inv(left.world_to_eye)[:3, 3] @ np.eye(3),
                                   np.linalg.inv(left.world_to_eye)[:3, 0] * 0.1, atol=1e-4)
        clip = scumble.perspective(np.pi / 2, 1, 0.5) @ (0, 0.5, -0.5, 1)
        np.testing.assert_allclose(clip / clip[3], (0, -1, 1, 1), atol=1e-5)
        self.assertEqual(scumble.nodes_to_world(SCENE).shape, (SCENE.summary()["nodes"], 4, 4))


class Films(unittest.TestCase):
    def test_is_the_programs(self):
        for stereo in (False, True):
            with self.subTest(stereo=stereo):
                RENDERER.film(FOLDER / "here.mp4", SCENE, "ink", seconds=0.25, fps=24, size=(96, 54), samples=1, stereo=stereo)
                program("render", FOLDER / "demo.glb", "-o", FOLDER / "there.mp4", "--size", "96x54", "--device", "cpu", "--quiet", "--look", "ink", "--samples",
                        "1", "--frames", "0..5", *(["--stereo", "side-by-side"] if stereo else []))
                self.assertEqual((FOLDER / "here.mp4").read_bytes(), (FOLDER / "there.mp4").read_bytes())

    def test_frames_are_those_drawn_alone(self):
        times = [0, 0.5, 1.0, 1.5, 2.0]
        frames = list(RENDERER.frames(SCENE, "age-of-sail", times, size=SIZE, samples=1, aovs=["motion"]))
        self.assertEqual(len(frames), 5)
        for i in (0, 3):
            alone = RENDERER.render(SCENE, "age-of-sail", times[i], size=SIZE, samples=1, aovs=["motion"], previous_time=times[i - 1] if i else None)
            for name in alone:
                np.testing.assert_array_equal(frames[i][name], alone[name])

    def test_a_closed_iterator_leaves_the_renderer_free(self):
        frames = RENDERER.frames(SCENE, "ink", (i / 24 for i in range(1000)), size=SIZE, samples=1)
        next(frames)
        with self.assertRaisesRegex(scumble.UsageError, "close that iterator"):
            RENDERER.render(SCENE, size=SIZE)
        frames.close()
        RENDERER.render(SCENE, size=SIZE, samples=1)

    def test_two_iterators_do_not_take_each_others_frames(self):
        first, second = (RENDERER.frames(SCENE, look, [0, 1, 2], size=SIZE, samples=1) for look in ("age-of-sail", "ink"))
        next(first)
        for call in (lambda: next(second), lambda: RENDERER.film(FOLDER / "x.mp4", SCENE, seconds=1, size=SIZE), lambda: RENDERER.prepare(SCENE)):
            with self.assertRaisesRegex(scumble.UsageError, "close that iterator"):
                call()
        self.assertFalse((FOLDER / "x.mp4").exists())
        self.assertEqual(len(list(first)), 2)
        with self.assertRaises(TypeError):
            RENDERER.frames(SCENE, "ink", [0], lens=1)  # at once, not with the first frame

    def test_a_look_that_changes_changes_later_calls(self):
        look = scumble.Look()
        frames = RENDERER.frames(SCENE, look, [0, 0, 0], size=SIZE, samples=1)
        first = next(frames)["picture"].copy()
        look["palette.saturation"] = 3
        for frame in frames:
            np.testing.assert_array_equal(frame["picture"], first)

    def test_two_views_are_two_eyes(self):
        RENDERER.film(FOLDER / "a.mp4", SCENE, seconds=0.1, size=(96, 54), samples=1, stereo=True)
        RENDERER.film(FOLDER / "b.mp4", SCENE, seconds=0.1, size=(96, 54), samples=1, views=scumble.make_views(SCENE, stereo=True, aspect=96 / 54))
        self.assertEqual(*((FOLDER / name).read_bytes().count(b"st3d") for name in ("a.mp4", "b.mp4")))
        self.assertIn(b"st3d", (FOLDER / "b.mp4").read_bytes())

    def test_by_hand_and_read_back(self):
        grey = [np.full((32, 48, 3), 40 * i, np.uint8) for i in range(1, 5)]
        with scumble.FilmWriter(FOLDER / "own.mp4", fps=4, quality=0) as film:
            for picture in grey:
                film.add(picture)
        reader = scumble.FilmReader(FOLDER / "own.mp4")
        self.assertAlmostEqual(reader.last_time, 0.75)
        for i, picture in enumerate(grey):
            self.assertLess(np.abs(srgb(reader.at(i / 4)) * 255 - picture).max(), 2.6)
        with self.assertRaises(ZeroDivisionError), scumble.FilmWriter(FOLDER / "broken.mp4") as film:
            film.add(grey[0])
            1 / 0
        self.assertEqual([path.name for path in FOLDER.iterdir() if "broken" in path.name], [])


class Numbers(unittest.TestCase):
    def test_coherence_is_the_programs(self):
        measured = RENDERER.measure(ball(), size=(96, 54))
        program("measure", FOLDER / "ball.gltf", "--size", "96x54", "--device", "cpu", "--json", FOLDER / "told.json")
        told = json.loads((FOLDER / "told.json").read_text())
        self.assertEqual(set(measured["modes"]), {"metatexture", "object", "screen", "fractal"})
        for mode, own in measured["modes"].items():
            self.assertEqual(own["temporal"], told["modes"][mode]["temporal"])
            self.assertEqual(own["zoom"], told["modes"][mode]["zoom"])
            self.assertEqual((own["stereo"]["warp"], own["marks"]), (told["modes"][mode]["stereo"]["warp"], told["modes"][mode]["marks"]))
        self.assertGreater(len(measured["targets"]), 3)

    def test_steps_are_the_programs(self):
        steps = RENDERER.measure_steps(SCENE, holds=(1, 3), size=(96, 54))
        program("measure", FOLDER / "demo.glb", "--size", "96x54", "--samples", "1", "--steps", "1,3", "--device", "cpu", "--json",
                FOLDER / "steps.json")
        told = json.loads((FOLDER / "steps.json").read_text())["steps"]
        self.assertEqual([step["hold"] for step in steps], [1, 3])
        for step, own in zip(steps, told):
            self.assertAlmostEqual(step["jump"], own["jump"], 4)
        self.assertGreater(steps[1]["jump"], 1.5 * steps[0]["jump"])
        with self.assertRaises(scumble.UsageError):
            RENDERER.measure_steps(SCENE, holds=(0,), size=(96, 54))

    def test_steadiness(self):
        page = np.ones((64, 64, 3), np.float32)
        drawings = []
        for i in range(4):
            drawing = page.copy()
            drawing[20 + 20 * (i % 2)] = 0
            drawings.append(drawing)
        self.assertGreater(scumble.steadiness(drawings)["flickers"], 1)
        self.assertEqual(scumble.steadiness([drawings[0]] * 4)["flickers"], 0)


class Mistakes(unittest.TestCase):
    def test_words(self):
        editor = scumble.SceneEditor()
        triangle_at = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        look = scumble.Look()
        for call, kind, text in (
                (lambda: scumble.Scene("nowhere.glb"), scumble.UnusableFile, "nowhere.glb: there is no such file"),
                (lambda: scumble.Scene.from_bytes(b"nothing"), scumble.UnusableFile, "scene: "),
                (lambda: scumble.Scene(FOLDER / "demo.glb", scene=7), scumble.Error, "scene"),
                (lambda: scumble.Look("inkk"), scumble.UsageError, "ink"),
                (lambda: look.set("shadow.treshold", 1), scumble.UsageError, "did you mean 'shadow.threshold'"),
                (lambda: look.set("shadow.threshold", 90), scumble.UsageError, "out of range"),
                (lambda: look.set("shadow.threshold", None), scumble.UsageError, "cannot be None"),
                (lambda: look.set("shadow.threshold", [1, 2]), scumble.UsageError, "shape"),
                (lambda: look.set_track("shadow.threshold", [(0, 1), (0, 1)]), scumble.UsageError, ""),
                (lambda: look.set_track("shadow.threshold", [0]), scumble.UsageError, "pair"),
                (lambda: RENDERER.render(SCENE, size=(0, 90)), scumble.UsageError, "size|width"),
                (lambda: RENDERER.render(SCENE, size=(-5, 90)), (TypeError, scumble.UsageError), ""),
                (lambda: RENDERER.render(SCENE, samples=3), scumble.UsageError, "samples"),
                (lambda: RENDERER.render(SCENE, aovs=["dept"]), scumble.UsageError, "dept"),
                (lambda: RENDERER.render(SCENE, aovs=["depth"], dtypes={"depth": "uint8"}), scumble.UsageError, "depth"),
                (lambda: RENDERER.render(SCENE, dtypes={"picture": "int7"}), scumble.UsageError, "float16"),
                (lambda: RENDERER.render(SCENE, camera="Nobody"), scumble.UsageError, "Nobody"),
                (lambda: RENDERER.render(SCENE, orbit=(1,)), scumble.UsageError, "azimuth"),
                (lambda: RENDERER.render(SCENE, eye=(1, 2), target=(0, 0, 0)), scumble.UsageError, "three numbers"),
                (lambda: RENDERER.render(SCENE, lens=3), TypeError, "lens"),
                (lambda: RENDERER.render(SCENE, size=(96.0, 54.0)), scumble.UsageError, "size cannot be"),
                (lambda: RENDERER.render(SCENE, size="96x54"), scumble.UsageError, "width, height"),
                (lambda: RENDERER.render(SCENE, samples=1.5), scumble.UsageError, "samples cannot be 1.5; give a whole number"),
                (lambda: RENDERER.render(SCENE, aovs="depth"), scumble.UsageError, "list of names"),
                (lambda: RENDERER.render(SCENE, aovs=["id"], dtypes={"id": np.float16}), scumble.UsageError, "float16"),
                (lambda: RENDERER.render(SCENE, fov="40"), scumble.UsageError, "fov cannot be '40'"),
                (lambda: RENDERER.render(SCENE, frame=3), scumble.UsageError, "frame cannot be 3"),
                (lambda: RENDERER.render(SCENE, look=None), TypeError, "look"),
                (lambda: RENDERER.film(FOLDER / "a.mp4", SCENE, seconds=0), scumble.UsageError, "above 0"),
                (lambda: RENDERER.film(FOLDER / "a.mp4", SCENE, seconds=1, fps=0), scumble.UsageError, "fps"),
                (lambda: RENDERER.film(FOLDER / "a.mp4", SCENE, seconds=1, aovs=["depth"]), TypeError, "aovs"),
                (lambda: scumble.perspective(40, 1.5), scumble.UsageError, "radians"),
                (lambda: scumble.Scene(os.fsdecode(b"/nowhere/\xff.glb")), scumble.UnusableFile, "no such file"),
                (lambda: scumble.write_picture(FOLDER / "a.png", np.zeros((2, 2, 3)), quality=5), scumble.UsageError, "quality"),
                (lambda: editor.name_of(999), scumble.UsageError, "no node 999"),
                (lambda: editor.transform_of(-1), scumble.UsageError, "no node"),
                (lambda: editor.add_material(base_color="#fff"), scumble.UsageError, "linear numbers"),
                (lambda: editor.add_mesh(positions=np.ma.masked_array(triangle_at, False)), scumble.UsageError, "mask"),
                (lambda: RENDERER.render(SCENE, views=[], size=SIZE), scumble.UsageError, "view"),
                (lambda: RENDERER.render(SCENE, views=scumble.make_views(SCENE), orbit=(0, 0)), scumble.UsageError, "orbit"),
                (lambda: RENDERER.render(SCENE, background=np.zeros((4, 4, 2))), scumble.UsageError, "4, 2"),
                (lambda: RENDERER.render(SCENE, background="nowhere.png"), scumble.UnusableFile, "nowhere.png"),
                (lambda: RENDERER.render("demo.glb"), TypeError, ""),
                (lambda: scumble.View(np.eye(3), np.eye(4)), scumble.UsageError, "4 by 4"),
                (lambda: editor.add_mesh(positions=[[0, 0]]), scumble.UsageError, "rows of 3"),
                (lambda: editor.add_mesh(positions=triangle_at, indices=[0, 1, -1]), scumble.UsageError, "from 0"),
                (lambda: editor.add_mesh(positions=triangle_at, indices=[0, 1, 7]), scumble.UsageError, ""),
                (lambda: editor.add_mesh(positions=triangle_at, indices=[0.0, 1.0, 2.0]), scumble.UsageError, "whole numbers"),
                (lambda: editor.add_mesh(positions=[["a", "b", "c"]]), scumble.UsageError, "no numbers"),
                (lambda: editor.add_mesh(positions=triangle_at, colors=[[2.0, 0, 0]] * 3), scumble.UsageError, "0 to 1"),
                (lambda: editor.add_mesh(positions=triangle_at, colours=[]), scumble.UsageError, "colors"),
                (lambda: editor.add_mesh(positions=[[np.nan, 0, 0]] * 3), scumble.UsageError, ""),
                (lambda: editor.add_mesh(), scumble.UsageError, ""),
                (lambda: editor.add_material(alpha="half"), scumble.UsageError, "mask"),
                (lambda: editor.add_material(color=(1, 1, 1)), scumble.UsageError, "base_color"),
                (lambda: editor.add_node(mesh=99), scumble.UsageError, ""),
                (lambda: editor.set_transform(99, np.eye(4)), scumble.UsageError, ""),
                (lambda: editor.set_light(99, "sun"), scumble.UsageError, "spot"),
                (lambda: scumble.write_picture(FOLDER / "a.tiff", np.zeros((2, 2, 3))), scumble.UsageError, ".webp"),
                (lambda: scumble.write_picture(FOLDER / "no" / "a.png", np.zeros((2, 2, 3))), scumble.OutputNotWritten, ""),
                (lambda: scumble.write_picture(FOLDER / "a.png", np.zeros((2, 2, 3), np.int64)), scumble.UsageError, "uint8"),
                (lambda: scumble.read_picture(FOLDER / "demo.glb"), scumble.UnusableFile, ""),
                (lambda: scumble.FilmWriter(FOLDER / "a.avi"), scumble.UsageError, ".mp4"),
                (lambda: scumble.FilmReader(FOLDER / "demo.glb"), scumble.UnusableFile, ""),
                (lambda: scumble.Renderer("no such device"), scumble.Error, "no such device"),
                (lambda: RENDERER.film(FOLDER / "a.mp4", editor_of_a_wall().scene(), seconds=None, size=SIZE), scumble.UsageError, "seconds"),
                (lambda: scumble.Scene.place([{"scene": SCENE, "where": 1}]), scumble.UsageError, "at"),
        ):
            with self.subTest(text=text), self.assertRaisesRegex(kind, text):
                call()

    def test_errors_tell(self):
        (FOLDER / "look.json").write_text('{\n "shadow": {"treshold": 1}}')
        with self.assertRaises(scumble.UnusableFile) as caught:
            scumble.Look(FOLDER / "look.json")
        error = caught.exception
        self.assertEqual((error.file, error.line, error.json_path), (str(FOLDER / "look.json"), 2, "shadow.treshold"))
        self.assertTrue(error.problem and error.advice)
        self.assertIsInstance(error, scumble.Error)
        with self.assertRaises(ValueError):
            scumble.Look().set("nothing", 1)


class Long(unittest.TestCase):
    def test_progress(self):
        parts = []
        renderer = scumble.Renderer("cpu")
        renderer.render(SCENE, size=SIZE, progress=parts.append)
        self.assertEqual(parts, sorted(parts))
        self.assertTrue(parts and 0 <= parts[0] and parts[-1] <= 1)
        with self.assertRaises(scumble.Cancelled):
            scumble.Renderer("cpu").render(SCENE, size=SIZE, progress=lambda part: False)
        with self.assertRaises(scumble.Cancelled):
            RENDERER.film(FOLDER / "stopped.mp4", SCENE, seconds=5, size=SIZE, samples=1, progress=lambda part: np.bool_(False))
        scumble.Renderer("cpu").render(SCENE, size=SIZE, progress=lambda part: 0)  # no truth value: it goes on
        with self.assertRaises(ZeroDivisionError):
            scumble.Renderer("cpu").render(SCENE, size=SIZE, progress=lambda part: 1 / 0)
        with self.assertRaises(scumble.Cancelled):
            RENDERER.film(FOLDER / "stopped.mp4", SCENE, seconds=5, size=SIZE, samples=1, progress=lambda part: part < 0.1)
        self.assertFalse((FOLDER / "stopped.mp4").exists())
        RENDERER.render(SCENE, size=SIZE, samples=1)

    def test_others_run_meanwhile(self):
        """The GIL is free: another thread counts on while a frame is drawn."""
        counted, stop = [0], threading.Event()

        def count():
            while not stop.is_set():
                counted[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        begin = time.monotonic()
        RENDERER.render(SCENE, "watercolour", size=(960, 540))
        took, seen = time.monotonic() - begin, counted[0]
        stop.set()
        thread.join()
        self.assertGreater(seen, 20 * took)

    def test_one_thread_at_a_time(self):
        caught = []

        def draw():
            try:
                for _ in range(20):
                    RENDERER.render(SCENE, size=(480, 270), samples=1)
            except scumble.UsageError as error:
                caught.append(str(error))

        threads = [threading.Thread(target=draw) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(caught)
        RENDERER.render(SCENE, size=SIZE, samples=1)

    def test_ctrl_c(self):
        """Within the frame that is drawn, and the renderer goes on."""
        code = f"""
import os, signal, sys, threading, time
import scumble
scene = scumble.Scene({str(FOLDER / "demo.glb")!r})
renderer = scumble.Renderer("cpu")
times = []
def strike():
    times.append(time.monotonic())
    os.kill(os.getpid(), signal.SIGINT)
for what in (lambda: renderer.measure(scene, size=(192, 108)),
             lambda: renderer.film({str(FOLDER / "struck.mp4")!r}, scene, seconds=100, size=(192, 108), samples=1)):
    timer = threading.Timer(0.4, strike)
    timer.start()
    try:
        what()
        print("ended")
    except KeyboardInterrupt:
        print("stopped", time.monotonic() - times[-1])
    timer.join()
print(renderer.render(scene, size=(96, 54), samples=1)["picture"].shape)
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=os.environ)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines[:2]], ["stopped", "stopped"])
        for line in lines[:2]:
            self.assertLess(float(line.split()[1]), 5)
        self.assertEqual(lines[-1], "(54, 96, 4)")
        self.assertFalse((FOLDER / "struck.mp4").exists())

    def test_what_one_thread_at_a_time_uses(self):
        """Others are told, and nothing breaks."""
        with scumble.FilmWriter(FOLDER / "threads.mp4") as film:
            film.add(np.zeros((32, 32, 3), np.uint8))
        reader = scumble.FilmReader(FOLDER / "threads.mp4")
        film = scumble.FilmWriter(FOLDER / "many.mp4")
        ended = threading.Event()

        def insist(call):
            for _ in range(40):
                try:
                    call()
                except scumble.UsageError as error:
                    assert "another call" in str(error), error

        threads = [threading.Thread(target=insist, args=[call]) for call in (lambda: film.add(np.zeros((32, 32, 3), np.uint8)), lambda: reader.at(0)) * 3]
        for thread in threads:
            thread.start()
        drawing = threading.Thread(target=lambda: ([RENDERER.render(SCENE, ("ink", "manga")[i % 2], size=(96, 54), samples=1) for i in range(12)], ended.set()))
        drawing.start()
        while not ended.is_set():
            insist(RENDERER.graph)
        for thread in (*threads, drawing):
            thread.join()
        film.finish()

    def test_ends_while_daemons_draw(self):
        code = f"""
import threading, time
import scumble
scene = scumble.Scene({str(FOLDER / "demo.glb")!r})
renderer = scumble.Renderer("cpu")
def draw():
    while True:
        renderer.render(scene, size=(96, 54), samples=1)
def load():
    while True:
        scumble.Scene({str(FOLDER / "demo.glb")!r})
for work in (draw, load):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.7)
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=os.environ, timeout=60)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_forks(self):
        """A renderer stays with the process that made it."""
        code = f"""
import os, sys
import scumble
renderer = scumble.Renderer("cpu")
renderer.render(scumble.Scene({str(FOLDER / "demo.glb")!r}), size=(96, 54), samples=1)
if os.fork() == 0:
    try:
        renderer.graph()
    except scumble.UsageError as error:
        print("forked" if "forked" in str(error) else error)
    sys.exit(0)
print("child", os.wait()[1])
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=os.environ, timeout=60)
        self.assertEqual((done.returncode, sorted(done.stdout.split("\n"))), (0, ["", "child 0", "forked"]), done.stderr)

    def test_memory_stays(self):
        def used():
            return int(re.search(r"VmRSS:\s+(\d+)", Path("/proc/self/status").read_text())[1])

        def draw(count):
            for i in range(count):
                RENDERER.render(SCENE, "age-of-sail", i / 24, size=(240, 135), samples=1, aovs=["depth"])

        draw(5)
        before = used()
        draw(40)
        self.assertLess(used() - before, 12_000)  # kilobytes; forty frames hold 26,000


class Types(unittest.TestCase):
    def mypy(self, *words):
        return subprocess.run([sys.executable, "-m", *words], capture_output=True, text=True, check=False, cwd=FOLDER,
                              env={**os.environ, "MYPY_CACHE_DIR": str(FOLDER / "mypy"), "PYTHONPATH": MODULE, "MYPYPATH": MODULE})

    def setUp(self):
        if subprocess.run([sys.executable, "-c", "import mypy"], capture_output=True, check=False).returncode:
            self.skipTest("there is no mypy")

    def test_what_is_right_passes(self):
        done = self.mypy("mypy", "--strict", str(HERE / "typed_use.py"))
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_what_is_wrong_does_not(self):
        wrong = FOLDER / "wrong.py"
        wrong.write_text("import scumble\nscumble.Renderer().render(3)\nscumble.Look().set(1, 2)\nscumble.SceneEditor().add_mesh(colours=[1])\n"
                         "scumble.Renderer().render(scumble.Scene('a'), lens=3)\n")
        done = self.mypy("mypy", "--strict", str(wrong))
        self.assertEqual({int(line.split(":")[1]) for line in done.stdout.splitlines() if ": error:" in line}, {2, 3, 4, 5}, done.stdout)

    def test_stubs_are_true(self):
        # Classes of pybind11 have a metaclass of its own.
        allowed = FOLDER / "allowed"
        allowed.write_text("".join(rf"scumble\._scumble\.{name}(\.__init__)?" "\n" for name, thing in vars(scumble._scumble).items() if isinstance(thing, type)))
        done = self.mypy("mypy.stubtest", "scumble._scumble", "--allowlist", str(allowed))
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_everything_is_described(self):
        for name in scumble.__all__:
            thing = getattr(scumble, name)
            if callable(thing):
                self.assertTrue(thing.__doc__ and len(thing.__doc__) > 20, name)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
