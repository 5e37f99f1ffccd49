#!/usr/bin/env python3
"""Paintings in space: files of other programs, strokes for meshes, and mistakes that people make with both.

    tests/program/painting_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
"""
import io
import json
import struct
import unittest
import zipfile

import program_test
from program_test import NOT_WRITTEN, TINY, UNUSABLE, USAGE, Program, gltf, png

OIL = "c515dad7-4393-4681-81ad-162ef052241b"


def sketch(strokes=1, cut=None, nan=False):
    """data.sketch of Tilt Brush: strokes of three points, in decimetres, a second each."""
    data = struct.pack("<IiiIi", 0xC576A5CD, 5, 0, 0, strokes)
    for s in range(strokes):
        data += struct.pack("<i4ffIIi", 0, 0.9, 0.2, 0.1, 1, 3, 0, 3, 3)
        for i in range(3):
            x = float("nan") if nan else 5.0 * i
            data += struct.pack("<7ffI", x, 4.0 * s, 0, 0, 0, 0, 1, 1, 1000 * (3 * s + i))
    return data[:cut]


def opened(data):
    """What a .glb says, and a function that gives an accessor's numbers, element by element."""
    size = struct.unpack("<I", data[12:16])[0]
    root, binary = json.loads(data[20:20 + size]), data[28 + size:]

    def numbers(accessor):
        a = root["accessors"][accessor]
        view = root["bufferViews"][a["bufferView"]]
        letter, each = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}[a["componentType"]]
        components = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[a["type"]]
        stride = view.get("byteStride", each * components)
        start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        return [struct.unpack_from(f"<{components}{letter}", binary, start + i * stride) for i in range(a["count"])]

    return root, numbers


class Case(Program):
    def tilt(self, data=None, metadata=None, name="bird.tilt"):
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w") as file:
            file.writestr("metadata.json", metadata or json.dumps({"BrushIndex": [OIL]}))
            file.writestr("data.sketch", sketch() if data is None else data)
        self.put(name, struct.pack("<4sHHQ", b"tilT", 16, 1, 0) + packed.getvalue())

    def reds(self, name):
        _, _, channels, rows = png(self.folder / name)
        return sum(row[i] > 1.6 * max(row[i + 1:i + 3]) for row in rows for i in range(0, len(row), channels))


class Files(Case):
    def test_a_tilt_is_a_scene(self):
        self.tilt(data=sketch(2))
        about = json.loads(self.good("info", "bird.tilt", "--json"))
        self.assertEqual((about["strokes"], about["points"], about["brushes"]), (2, 6, ["OilPaint"]))
        self.assertEqual(about["meshes"], 1)
        for i in range(3):
            self.assertAlmostEqual(about["bounds"]["max"][i], (1.15, 0.55, 0.15)[i], 4)
        self.good("render", "bird.tilt", "-o", "bird.png", *TINY)
        self.assertGreater(self.reds("bird.png"), 20)
        self.good("render", "bird.tilt", "-o", "two.png", "--stereo", "side-by-side", *TINY)
        self.good("render", "box.gltf", "bird.tilt", "--place", "bird:at=0,2,0", "-o", "both.png", *TINY)

    def test_as_a_folder(self):
        self.put("bird.tilt/metadata.json", json.dumps({"BrushIndex": [OIL]}))
        self.put("bird.tilt/data.sketch", sketch())
        self.good("render", "bird.tilt", "-o", "bird.png", *TINY)
        (self.folder / "bird.tilt/metadata.json").unlink()
        (self.folder / "bird.png").unlink()
        self.bad(UNUSABLE, "render", "bird.tilt", "-o", "x.png", *TINY, says="metadata.json")

    def test_what_cannot_be_used(self):
        for data, says in ((sketch(cut=90), "data.sketch, byte"), (b"", "ends too early"), (sketch(0), "nothing to draw"),
                           (sketch(nan=True), "nothing to draw")):
            self.tilt(data=data)
            self.bad(UNUSABLE, "render", "bird.tilt", "-o", "x.png", *TINY, says=says)
        self.tilt(metadata="{}")
        self.bad(UNUSABLE, "info", "bird.tilt", says="BrushIndex")
        self.put("bird.tilt", b"tilT")
        self.bad(UNUSABLE, "info", "bird.tilt")

    def test_it_paints_itself(self):
        self.tilt(data=sketch(3))
        counts = []
        for time in ("0.5", "2", "9"):
            self.good("render", "bird.tilt", "-o", "x.png", "--time", time, "--set", "painting.plays=on", *TINY)
            counts.append(self.reds("x.png"))
        self.assertLess(counts[0], counts[1])
        self.assertLess(counts[1], counts[2])


class Paint(Case):
    def test_strokes_for_a_mesh(self):
        said = self.good("paint", "box.gltf", "-o", "painted.glb", "--splats", "2000", "--style", "fur", warnings=True)
        self.assertIn("strokes", said)
        about = json.loads(self.good("info", "painted.glb", "--json"))
        self.assertGreater(about["strokes"], 10)
        self.assertEqual(about["triangles"], 12)
        self.good("render", "painted.glb", "-o", "x.png", *TINY)
        self.good("render", "painted.glb", "-o", "y.png", "--set", "painting.shown=off", *TINY)
        self.different(*((self.folder / name).read_bytes() for name in ("x.png", "y.png")))

    def test_the_same_call_gives_the_same_bytes(self):
        for name in ("a.glb", "b.glb"):
            self.good("paint", "box.gltf", "-o", name, "--splats", "1000", "--quiet")
        self.same(*((self.folder / name).read_bytes() for name in ("a.glb", "b.glb")))
        self.good("paint", "box.gltf", "-o", "b.glb", "--splats", "1000", "--seed", "1", "--quiet")
        self.different(*((self.folder / name).read_bytes() for name in ("a.glb", "b.glb")))

    def test_the_default_name(self):
        self.good("paint", "box.gltf", "--splats", "100", warnings=True)
        self.assertTrue((self.folder / "box.painted.glb").exists())

    def test_mistakes(self):
        self.tilt()
        for args, code, says in (
                (["box.gltf", "--style", "furr"], USAGE, "did you mean 'fur'?"), (["box.gltf", "--splats", "0"], USAGE, "splats"),
                (["box.gltf", "--stroke", "0"], USAGE, "paints nothing"), (["box.gltf", "--height", "-1"], USAGE, "below 0"),
                (["box.gltf", "--flow", "wind"], USAGE, "curvature or direction"), (["box.gltf", "--direction", "1,2"], USAGE, "0,-1,0"),
                (["box.gltf", "-o", "x.png"], USAGE, "painted.glb"), (["box.gltf", "-o", "x.gltf"], USAGE, "painted.glb"),
                (["box.gltf", "--nodes", "Cat"], USAGE, "Cat"), (["bird.tilt"], UNUSABLE, "surface"), (["none.glb"], UNUSABLE, "none.glb"),
                ([], USAGE, "SCENE")):
            self.bad(code, "paint", *args, says=says)
        self.put("x.glb", gltf())
        self.bad(NOT_WRITTEN, "paint", "x.glb", "-o", "x.glb", says="one of the inputs")


class Fins(Case):
    def paint(self):
        self.good("paint", "box.gltf", "-o", "painted.glb", "--splats", "2000", "--quiet")
        self.put("painted.glb", (self.folder / "painted.glb").read_bytes())

    def test_a_painting_is_baked(self):
        self.paint()
        out = self.good("bake", "painted.glb", "-o", "fins.glb", "--texture", "512", warnings=True)
        self.assertIn("fins", out)
        about = json.loads(self.good("info", "fins.glb", "--json"))
        self.assertEqual(about["strokes"], 0)
        self.good("render", "fins.glb", "-o", "fins.png", *TINY)
        self.good("render", "fins.glb", "-o", "two.png", "--stereo", "side-by-side", *TINY)
        first = (self.folder / "fins.glb").read_bytes()
        self.good("bake", "painted.glb", "-o", "again.glb", "--texture", "512", "--quiet")
        self.assertEqual((self.folder / "again.glb").read_bytes(), first)
        self.assertFalse(list(self.folder.glob("*.part")))
        # What other programs look for.
        root, numbers = opened(first)
        layers = [m for m in root["materials"] if "scumble_paint" in m.get("extras", {})]
        self.assertTrue(any("fadeStart" in m["extras"]["scumble_paint"] for m in layers))
        for m in layers:
            self.assertEqual(m["alphaMode"], "BLEND")
            self.assertIn("KHR_materials_unlit", m["extensions"])
        self.assertTrue(all(p.get("mode", 4) == 4 for m in root["meshes"] for p in m["primitives"]))
        for mesh in root["meshes"]:
            told = mesh.get("extras", {}).get("scumble_orders")
            if not told:
                continue
            self.assertEqual(len(told["orders"]), 14)
            first_vertex, triangles = 0, []
            for number in told["primitives"]:
                primitive = mesh["primitives"][number]
                self.assertIn("scumble_paint", root["materials"][primitive["material"]]["extras"])
                indices = [first_vertex + i[0] for i in numbers(primitive["indices"])]
                triangles += [tuple(indices[i:i + 3]) for i in range(0, len(indices), 3)]
                first_vertex += root["accessors"][primitive["attributes"]["POSITION"]]["count"]
            for order in told["orders"]:
                self.assertAlmostEqual(sum(x * x for x in order["toViewer"]), 1, 5)
                named = [number for number, accessor in enumerate(root["accessors"]) if accessor.get("name") == order["indices"]]
                self.assertEqual(len(named), 1, order["indices"])
                indices = [i[0] for i in numbers(named[0])]
                self.assertEqual(sorted(tuple(indices[i:i + 3]) for i in range(0, len(indices), 3)), sorted(triangles))
        self.assertTrue(any("scumble_orders" in m.get("extras", {}) for m in root["meshes"]))
        # Tools that write glTF anew count accessors as they like, and leave extras as they are.
        for owner in [*root["meshes"], *root["materials"], *root["nodes"]]:
            for order in owner.get("extras", {}).get("scumble_orders", {}).get("orders", []):
                self.assertIsInstance(order["indices"], str)
        self.good("bake", "painted.glb", "-o", "none.glb", "--texture", "512", "--orders", "0", "--quiet")
        self.assertNotIn(b"scumble_orders", (self.folder / "none.glb").read_bytes())

    def test_a_painting_as_points(self):
        self.paint()
        self.tilt()
        self.bad(UNUSABLE, "bake", "box.gltf", "--points", "-o", "none.glb", says="scumble paint")
        self.bad(NOT_WRITTEN, "bake", "painted.glb", "--points", "-o", "absent/points.glb")
        for painting, meshes in (("painted.glb", 1), ("bird.tilt", 0)):
            out = self.good("bake", painting, "--points", "-o", "points.glb", warnings=True)
            root, numbers = opened((self.folder / "points.glb").read_bytes())
            self.assertEqual(len(root["meshes"]), meshes + 1)
            self.assertNotIn("animations", root)
            (primitive,) = root["meshes"][-1]["primitives"]
            self.assertEqual((primitive["mode"], primitive["extensions"]["KHR_gaussian_splatting"]["kernel"]), (0, "ellipse"))
            self.assertIn("KHR_gaussian_splatting", root["extensionsUsed"])
            of = {name.split(":")[-1]: numbers(accessor) for name, accessor in primitive["attributes"].items()}
            self.assertEqual(len({len(values) for values in of.values()}), 1)
            self.assertIn(f"{len(of['POSITION'])} points", out)
            for turn, scale, opacity, color, harmonic in zip(of["ROTATION"], of["SCALE"], of["OPACITY"], of["COLOR_0"],
                                                              of["SH_DEGREE_0_COEF_0"]):
                self.assertAlmostEqual(sum(x * x for x in turn), 1, 4)
                self.assertTrue(all(s > 0 for s in scale) and scale[2] < scale[0] == scale[1], scale)  # flat
                self.assertTrue(0 <= opacity[0] <= 1 and opacity[0] == color[3])
                for linear, h in zip(color, harmonic):
                    srgb = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
                    self.assertAlmostEqual(0.28209479 * h + 0.5, srgb, 4)
        # The sketch is a line along x, 0.15 m to either side, and so are its splats.
        self.assertAlmostEqual(max(s[0] for s in of["SCALE"]), 0.5 * 0.15, 4)
        for (_, y, z), (qx, qy, qz, qw) in zip(of["POSITION"], of["ROTATION"]):
            self.assertTrue(abs(y) < 1e-4 and abs(z) < 1e-4, (y, z))
            self.assertAlmostEqual(abs(1 - 2 * (qy * qy + qz * qz)), 1, 4)
        # It is drawn, about as the strokes are.
        for name in ("bird.tilt", "points.glb"):
            self.good("render", name, "-o", f"{name}.png", *TINY)
        strokes, points = (self.reds(f"{name}.png") for name in ("bird.tilt", "points.glb"))
        self.assertGreater(strokes, 20)
        self.assertLess(abs(points - strokes), 0.25 * strokes, (points, strokes))
        self.assertEqual(json.loads(self.good("info", "points.glb", "--json"))["points"], len(of["POSITION"]))

    def test_parts_have_their_own_numbers(self):
        self.paint()
        self.good("bake", "painted.glb", "-o", "a.glb", "--texture", "512", "--part", "*:offset=0.4;start=0.8;end=0.3;layers=3", "--quiet")
        self.good("bake", "painted.glb", "-o", "b.glb", "--texture", "512", "--quiet")
        self.assertNotEqual((self.folder / "a.glb").read_bytes(), (self.folder / "b.glb").read_bytes())
        for name in ("a.glb", "b.glb"):
            (self.folder / name).unlink()
        for part in ("offset=1", "*:offset", "*:height=1", "*:layers=1.5", "*:offset=-1"):
            self.bad(USAGE, "bake", "painted.glb", "-o", "c.glb", "--part", part)
        self.bad(USAGE, "bake", "painted.glb", "-o", "c.glb", "--part", "Nobody:offset=1", says="Nobody")

    def test_strokes_in_the_air_get_a_hull_or_a_proxy(self):
        self.tilt(data=sketch(2))
        self.good("bake", "bird.tilt", "-o", "hull.glb", "--texture", "512", "--hull-cells", "16", "--quiet")
        self.good("render", "hull.glb", "-o", "hull.png", *TINY)
        self.assertGreater(self.reds("hull.png"), 20)
        self.good("bake", "bird.tilt", "--proxy", "box.gltf", "-o", "boxed.glb", "--texture", "512", "--quiet")
        about = json.loads(self.good("info", "boxed.glb", "--json"))
        self.assertEqual(about["meshes"], 1)
        self.good("render", "boxed.glb", "-o", "boxed.png", *TINY)

    def test_mistakes(self):
        self.bad(UNUSABLE, "bake", "box.gltf", "-o", "fins.glb", says="scumble paint")
        self.bad(UNUSABLE, "bake", "absent.glb", "-o", "fins.glb")
        self.paint()
        self.bad(USAGE, "bake", "painted.glb", "-o", "fins.glb", "--hull-cells", "5", says="hull")
        self.bad(UNUSABLE, "bake", "painted.glb", "-o", "fins.glb", "--proxy", "absent.glb")
        self.put("proxy.glb", (self.folder / "painted.glb").read_bytes())
        self.bad(NOT_WRITTEN, "bake", "painted.glb", "-o", "proxy.glb", "--proxy", "proxy.glb", says="one of the inputs")
        self.put("all.json", json.dumps({"scenes": [{"file": "painted.glb"}]}))
        self.bad(USAGE, "bake", "all.json", "-o", "fins.glb", says="world")
        self.bad(USAGE, "bake", "painted.glb", "-o", "fins.png", says="fins.glb")
        self.bad(NOT_WRITTEN, "bake", "painted.glb", "-o", "painted.glb", says="one of the inputs")
        self.bad(USAGE, "bake", "painted.glb", "-o", "fins.glb", "--texture", "10")
        self.bad(NOT_WRITTEN, "bake", "painted.glb", "-o", "absent/fins.glb")


if __name__ == "__main__":
    program_test.main()
