"""The add-on, inside of Blender without a window.

    blender --background --factory-startup --python-exit-code 1 --python addon_test.py -- PROGRAM ZIP [TEST...]
"""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import bpy
import mathutils
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import scenes  # noqa: E402

PROGRAM, ZIP = sys.argv[sys.argv.index("--") + 1:][:2]
FOLDER = tempfile.TemporaryDirectory(prefix="scumble-blender-")


def render(scene=None, **settings):
    """What F12 gives: the passes that the engine has filled, by name and eye, row 0 at the top."""
    filled = {}
    fill = addon.engine._fill

    def record(passes, name, picture, eye):
        filled[name, eye] = picture.copy()
        fill(passes, name, picture, eye)

    addon.engine._fill = record
    try:
        bpy.ops.render.render(**settings)
    finally:
        addon.engine._fill = fill
    return filled


def picture(**settings):
    return render(**settings)["Combined", ""]


def saved(path):
    """A picture's file as Blender reads it: linear, row 0 at the top."""
    image = bpy.data.images.load(str(path))
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    result = pixels.reshape(image.size[1], image.size[0], 4)[::-1].copy()
    bpy.data.images.remove(image)
    return result


def exported(name, **settings):
    path = Path(FOLDER.name) / (name + ".glb")
    bpy.ops.export_scene.gltf(filepath=str(path), export_format="GLB", export_lights=True, export_cameras=True,
                              export_extras=True, export_apply=True, export_animations=False, **settings)
    return path


def of_program(scene_file, *arguments, camera="Camera", size="320x180"):
    """What `scumble render` paints of a file."""
    out = Path(FOLDER.name) / "program.exr"
    done = subprocess.run([PROGRAM, "render", str(scene_file), "-o", str(out), "--camera", camera, "--size", size,
                           "--samples", "1", "--quiet", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return saved(out)


def apart(a, b):
    """How far two pictures are from each other, a pixel on the average, and the part that is another colour."""
    difference = np.abs(a[..., :3] - b[..., :3]).max(axis=-1)
    return float(difference.mean()), float((difference > 0.05).mean())


def sent(since=None):
    now = addon.engine.session_for("final").sent()
    return now if since is None else {key: now[key] - since.get(key, 0) for key in now if now[key] != since.get(key, 0)}


class Changes(unittest.TestCase):
    """What is sent again."""

    def setUp(self):
        scenes.still_life()
        picture()
        self.before = sent()

    def change(self):
        first = picture()
        return first, sent(self.before)

    def test_nothing(self):
        _, told = self.change()
        self.assertEqual(set(told), {"lines", "lineBytes"})
        self.assertEqual(told["lines"], 1)

    def test_a_vertex(self):
        ball = bpy.data.meshes["Ball"]
        ball.vertices[5].co.z += 0.3
        ball.update()
        _, told = self.change()
        self.assertEqual({key: told.get(key) for key in ("mesh", "node", "material", "texture", "knobs")},
                         {"mesh": 1, "node": None, "material": None, "texture": None, "knobs": None})

    def test_a_color(self):
        bpy.data.materials["Red"].node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0, 1, 0, 1)
        now, told = self.change()
        self.assertEqual({key: told.get(key) for key in ("mesh", "node", "material", "texture", "knobs", "bytes")},
                         {"mesh": None, "node": None, "material": 1, "texture": None, "knobs": None, "bytes": None})

    def test_a_knob(self):
        bpy.context.scene.scumble.knobs.warp_amount = 6
        _, told = self.change()
        self.assertEqual({key: told.get(key) for key in ("mesh", "node", "material", "texture", "knobs", "lines")},
                         {"mesh": None, "node": None, "material": None, "texture": None, "knobs": 1, "lines": 2})


class Pictures(unittest.TestCase):
    def assertNear(self, a, b, difference=0.004, others=0.01):
        found = apart(a, b)
        self.assertLess(found[0], difference)
        self.assertLess(found[1], others)

    def test_a_still_life_is_that_of_its_file(self):
        scenes.still_life()
        self.assertNear(picture(), of_program(exported("still")))

    def test_the_same_frame_has_the_same_bytes(self):
        scenes.still_life()
        first = picture()
        addon.engine.SESSIONS.close()
        np.testing.assert_array_equal(first, picture())

    def test_cameras(self):
        scene = scenes.still_life()
        lens = scene.camera.data
        for change in ({"shift_x": 0.2, "shift_y": -0.1}, {"sensor_fit": "VERTICAL", "lens": 35},
                       {"sensor_fit": "AUTO", "type": "ORTHO", "ortho_scale": 7}):
            with self.subTest(change):
                for name, value in change.items():
                    setattr(lens, name, value)
                if "shift_x" in change:
                    # glTF has no shifts: the picture is that of a larger one.
                    shifted = picture()
                    lens.shift_x = lens.shift_y = 0
                    straight = picture()
                    self.assertGreater(apart(shifted, straight)[1], 0.05)
                    # 0.2 of the width to the right, 0.1 of it down: what is at the middle moves the other way.
                    moved = np.roll(straight, (-int(0.1 * 320), -int(0.2 * 320)), (0, 1))
                    inner = (slice(40, 130), slice(70, 240))
                    self.assertLess(apart(shifted[inner], moved[inner])[1], 0.15)
                else:
                    self.assertNear(picture(), of_program(exported("camera")), others=0.02)

    def test_vertex_colors(self):
        scenes.start()
        paint = scenes.material("Painted", (1, 1, 1))
        tree = paint.node_tree
        node = tree.nodes.new("ShaderNodeVertexColor")
        node.layer_name = "Color"
        tree.links.new(node.outputs["Color"], tree.nodes["Principled BSDF"].inputs["Base Color"])
        ball = scenes.add("ico_sphere", "Ball", (0, 0, 1), paint, radius=1.5, subdivisions=3)
        colors = ball.data.color_attributes.new("Color", "FLOAT_COLOR", "POINT")
        for vertex, color in zip(ball.data.vertices, colors.data):
            color.color = (0.8, 0.1, 0.1, 1) if vertex.co.x > 0 else (0.1, 0.2, 0.8, 1)
        now = picture()
        self.assertNear(now, of_program(exported("colors")))
        reds = (now[..., 0] > 2 * now[..., 2]).mean()
        self.assertGreater(reds, 0.02)

    def test_a_second_uv_map(self):
        scenes.start()
        paint = scenes.material("Checked", (1, 1, 1), scenes.checker())
        box = scenes.add("cube", "Box", (0, 0, 1), paint)
        other = box.data.uv_layers.new(name="Other")
        for corner in other.data:
            corner.uv = (0.05, 0.05)
        first = picture()
        tree = paint.node_tree
        node = tree.nodes.new("ShaderNodeUVMap")
        image = next(each for each in tree.nodes if each.type == "TEX_IMAGE")
        tree.links.new(node.outputs["UV"], image.inputs["Vector"])
        node.uv_map = "UVMap"
        np.testing.assert_array_equal(first, picture())
        node.uv_map = "Other"
        second = picture()
        self.assertGreater(apart(first, second)[1], 0.02)
        other.active_render = True  # which is then the first
        np.testing.assert_allclose(second[60, 155], picture()[60, 155], atol=0.2)

    def test_shape_keys_and_armatures(self):
        scene = scenes.start()
        blob = scenes.add("uv_sphere", "Blob", (0, 0, 1), scenes.material("Green", (0.1, 0.5, 0.1)), radius=1)
        blob.shape_key_add(name="Basis")
        tall = blob.shape_key_add(name="Tall")
        for point in tall.data:
            point.co.z *= 2
        bones = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
        scene.collection.objects.link(bones)
        bpy.context.view_layer.objects.active = bones
        bpy.ops.object.mode_set(mode="EDIT")
        bone = bones.data.edit_bones.new("Bone")
        bone.head, bone.tail = (0, 0, 0), (0, 0, 2)
        bpy.ops.object.mode_set(mode="OBJECT")
        group = blob.vertex_groups.new(name="Bone")
        group.add(range(len(blob.data.vertices)), 1, "ADD")
        blob.modifiers.new("Rig", "ARMATURE").object = bones
        rest = picture()
        since = sent()
        tall.value = 1
        grown = picture()
        self.assertGreater(apart(rest, grown)[1], 0.03)
        bones.pose.bones["Bone"].location = (1.5, 0, 0)
        moved = picture()
        self.assertGreater(apart(grown, moved)[1], 0.03)
        told = sent(since)
        self.assertEqual((told["mesh"], told.get("node")), (2, None))
        # As one whose vertices are there for good.
        evaluated = blob.evaluated_get(bpy.context.evaluated_depsgraph_get())
        still = bpy.data.objects.new("Still", bpy.data.meshes.new_from_object(evaluated))
        still.matrix_world = blob.matrix_world
        scene.collection.objects.link(still)
        blob.hide_render = True
        self.assertNear(moved, picture(), 0.002, 0.005)

    def test_instances(self):
        scene = scenes.start()
        post = scenes.add("cube", "Post", (0, 0, 0.5), scenes.material("Posts", (0.6, 0.5, 0.2)), size=1)
        props = scenes.collection_of(post)
        for number in range(5):
            scenes.place_collection(props, f"Place{number}", (number - 2, -number / 2, 0), 1 - number / 10)
        now = picture()
        self.assertEqual(addon.engine.session_for("final").scene.known["meshes"].keys(), {"mesh/Post"})
        # What geometry nodes place.
        dots = scenes.add("plane", "Dots", (0, 0, 2), None, size=4)
        group = bpy.data.node_groups.new("Cones", "GeometryNodeTree")
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
        nodes = [group.nodes.new(kind) for kind in ("NodeGroupInput", "GeometryNodeMeshCone",
                                                    "GeometryNodeInstanceOnPoints", "NodeGroupOutput")]
        group.links.new(nodes[0].outputs[0], nodes[2].inputs["Points"])
        group.links.new(nodes[1].outputs[0], nodes[2].inputs["Instance"])
        group.links.new(nodes[2].outputs[0], nodes[3].inputs[0])
        dots.modifiers.new("Cones", "NODES").node_group = group
        coned = picture()
        self.assertGreater(apart(now, coned)[1], 0.02)
        self.assertEqual(addon.engine.session_for("final").scene.known["meshes"].keys(),
                         {"mesh/Post", "object/Dots/made/0"})
        bpy.data.objects.remove(dots)
        np.testing.assert_array_equal(now, picture())
        since = sent()
        # As so many objects.
        for empty in [each for each in scene.objects if each.type == "EMPTY"]:
            copy = bpy.data.objects.new("Copy", post.data)
            copy.matrix_world = empty.matrix_world @ post.matrix_world
            scene.collection.objects.link(copy)
            bpy.data.objects.remove(empty)
        self.assertNear(now, picture(), 0.002, 0.005)
        self.assertNotIn("mesh", sent(since))

    def test_custom_properties(self):
        scenes.still_life()
        plain = picture()
        bpy.data.objects["Table"]["scumble_ocean"] = True
        sea = picture()
        self.assertGreater(apart(plain, sea)[1], 0.2)
        self.assertNear(sea, of_program(exported("sea"), "--time", str(1 / 24)), 0.01, 0.03)

    def test_what_is_hidden_or_gone_is_not_there(self):
        scene = scenes.still_life()
        bpy.data.objects["Ape"].hide_render = True
        hidden = picture()
        bpy.data.objects.remove(bpy.data.objects["Ape"])
        np.testing.assert_array_equal(hidden, picture())
        count = addon.engine.session_for("final").count()
        self.assertEqual(count["nodes"], len(scene.objects))

    def test_names_and_parents_change(self):
        scenes.still_life()
        before = picture()
        bpy.data.objects["Ball"].name = "Sphere"
        bpy.context.view_layer.update()
        np.testing.assert_array_equal(before, picture())
        ring = bpy.data.objects["Ring"]
        world = ring.matrix_world.copy()
        ring.parent = None
        ring.matrix_world = world
        self.assertNear(before, picture(), 0.001, 0.002)


class Frames(unittest.TestCase):
    def test_passes_are_those_of_the_program(self):
        scene = scenes.still_life()
        for aov in ("warp", "depth", "final_shadow", "normal", "cryptomatte"):
            setattr(bpy.context.view_layer.scumble, "pass_" + aov, True)
        passes = render()
        self.assertEqual({name for name, _ in passes}, {"Combined", "warp", "Depth", "final-shadow", "Normal",
                                                        "CryptoObject00", "CryptoObject01"})
        scene_file = exported("passes")
        out = Path(FOLDER.name) / "aovs.exr"
        subprocess.run([PROGRAM, "render", str(scene_file), "-o", str(out), "--camera", "Camera", "--size", "320x180",
                        "--samples", "1", "--quiet", "--aov", "warp,depth,final-shadow,normal"], check=True)

        def layer(name, letters):
            one = Path(FOLDER.name) / "one.exr"
            channels = ",".join(f"{'RGB'[i]}={name}.{letter}" for i, letter in enumerate(letters))
            subprocess.run(["oiiotool", str(out), "--ch", channels, "-o", str(one)], check=True)
            return saved(one)

        self.assertLess(apart(passes["warp", ""], layer("warp", "RGB"))[1], 0.02)
        self.assertLess(apart(passes["final-shadow", ""], layer("final-shadow", "RGB"))[1], 0.02)
        ours, theirs = passes["Depth", ""][..., 0], layer("depth", "RRR")[..., 0]
        here = ours < 1e9
        np.testing.assert_array_equal(here, np.isfinite(theirs) & (theirs < 1e9))
        self.assertLess(np.median(np.abs(ours[here] - theirs[here])), 1e-3)
        # Blender's space: the table looks up along z.
        self.assertGreater(passes["Normal", ""][175, 160, 2], 0.99)

    def test_cryptomatte_is_read_by_blender(self):
        scene = scenes.still_life()
        bpy.context.view_layer.scumble.pass_cryptomatte = True
        scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
        scene.render.filepath = str(Path(FOLDER.name) / "mattes.exr")
        scene.use_nodes = True
        tree = scene.node_tree
        tree.nodes.clear()
        matte = tree.nodes.new("CompositorNodeCryptomatteV2")
        matte.matte_id = "Ball"
        out = tree.nodes.new("CompositorNodeOutputFile")
        out.base_path = FOLDER.name
        out.format.file_format, out.format.color_depth = "OPEN_EXR", "32"
        out.file_slots[0].path = "matte"
        tree.links.new(matte.outputs["Matte"], out.inputs[0])
        composite = tree.nodes.new("CompositorNodeComposite")
        layers = tree.nodes.new("CompositorNodeRLayers")
        tree.links.new(layers.outputs["Image"], composite.inputs["Image"])
        passes = render(write_still=True)
        found = saved(Path(FOLDER.name) / "matte0001.exr")[..., 0]
        ball = (found > 0.5).mean()
        self.assertGreater(ball, 0.01)
        self.assertLess(ball, 0.3)
        header = subprocess.run(["exrheader", scene.render.filepath], capture_output=True, text=True, check=True).stdout
        self.assertIn("CryptoObject", header)
        self.assertIn('\"Ball\"'.replace("\\", ""), header)

    def test_a_region_is_a_part_of_the_picture(self):
        scene = scenes.still_life()
        whole = picture()
        scene.render.use_border = True
        scene.render.border_min_x, scene.render.border_max_x = 0.25, 0.75
        scene.render.border_min_y, scene.render.border_max_y = 0.1, 0.6
        for crop in (False, True):
            scene.render.use_crop_to_border = crop
            np.testing.assert_array_equal(picture(), whole[72:162, 80:240])
        scene.render.use_crop_to_border = False
        scene.render.image_settings.file_format = "OPEN_EXR"
        scene.render.image_settings.color_depth = "32"
        scene.render.filepath = str(Path(FOLDER.name) / "region.exr")
        bpy.ops.render.render(write_still=True)
        file = saved(scene.render.filepath)
        np.testing.assert_allclose(file[72:162, 80:240, :3], whole[72:162, 80:240, :3], atol=1e-6)
        self.assertEqual(np.abs(file[:72, :, :3]).max(), 0)

    def test_both_eyes(self):
        scene = scenes.still_life()
        scene.render.use_multiview = True
        stereo = scene.camera.data.stereo
        stereo.interocular_distance, stereo.convergence_distance, stereo.pivot = 0.3, 9, "CENTER"
        scene.render.views_format = "STEREO_3D"
        views = []
        camera_view = addon.blender.camera_view
        addon.blender.camera_view = lambda *given: views.append(camera_view(*given)) or views[-1]
        try:
            passes = render()
        finally:
            addon.blender.camera_view = camera_view
        self.assertGreater(apart(passes["Combined", "left"], passes["Combined", "right"])[1], 0.02)
        # What is as far as the eyes converge is at the same place for both; what is nearer is further right for
        # the left one.
        world = addon.space.matrix_of_looking(scene.camera.matrix_world)
        for distance, disparity in ((9, 0), (4.5, 1)):
            point = world @ [0.5, 0.2, -distance, 1]
            seen = []
            for view in views:
                clip = (np.reshape(view["eyeToClip"], (4, 4)).T @ np.reshape(view["worldToEye"], (4, 4)).T @ point)
                seen.append(clip[0] / clip[3])
            width = 2 * 18 / scene.camera.data.lens  # of what is seen, a metre away
            self.assertAlmostEqual(seen[0] - seen[1], disparity * 0.3 * (1 / 4.5 - 1 / 9) / width * 2, 5)
        # With parallel axes each eye is what a camera there sees; where marks lie is found for both together.
        stereo.convergence_mode = "PARALLEL"
        passes = render()
        scene.render.use_multiview = False
        camera, home = scene.camera, scene.camera.matrix_world.copy()
        for eye, side in (("left", -1), ("right", 1)):
            camera.matrix_world = home @ mathutils.Matrix.Translation((side * 0.15, 0, 0))
            bpy.context.view_layer.update()
            self.assertLess(apart(passes["Combined", eye], picture())[0], 0.01)

    def test_motion(self):
        scene = scenes.start()
        bpy.context.view_layer.scumble.pass_motion = True
        box = scenes.add("cube", "Box", (0, 0, 1), scenes.material("Red", (0.7, 0.1, 0.1)))
        right = scene.camera.matrix_world.to_3x3().col[0]
        for frame in (1, 11):
            box.location = right * (frame - 1) * 0.1
            box.location.z += 1
            box.keyframe_insert("location", frame=frame)
        for curve in box.animation_data.action.fcurves:
            for key in curve.keyframe_points:
                key.interpolation = "LINEAR"
        scene.frame_set(5)
        vector = render()["Vector", ""]
        self.assertEqual(scene.frame_current, 5)
        moved = vector[np.abs(vector[..., 0]) > 0.5]
        self.assertGreater(len(moved), 200)
        # To the right, so it was further left.
        self.assertLess(np.median(moved[:, 0]), -1)
        self.assertLess(np.abs(np.median(moved[:, 1])), 0.3)
        # What was not there a frame ago has not moved.
        late = scenes.add("cube", "Late", (-3, 0, 1), size=1)
        late.hide_render = True
        late.keyframe_insert("hide_render", frame=4)
        late.hide_render = False
        late.keyframe_insert("hide_render", frame=5)
        addon.engine.SESSIONS.close()
        again = render()["Vector", ""]
        self.assertGreater((np.abs(again[..., 0]) > 0.5).sum(), 200)

    def test_an_animation_sends_what_moves(self):
        scene = scenes.still_life()
        box = bpy.data.objects["Box"]
        for frame, z in ((1, 1), (4, 2)):
            box.location.z = z
            box.keyframe_insert("location", frame=frame)
        scene.frame_start, scene.frame_end = 1, 4
        scene.render.filepath = str(Path(FOLDER.name) / "shot.####.png")
        picture()
        since = sent()
        bpy.ops.render.render(animation=True)
        told = sent(since)
        self.assertEqual((told.get("mesh"), told["node"]), (None, 3))
        frames = sorted(Path(FOLDER.name).glob("shot.*.png"))
        self.assertEqual(len(frames), 4)
        self.assertGreater(apart(saved(frames[0]), saved(frames[3]))[1], 0.01)

    def test_layers(self):
        scene = scenes.still_life()
        other = scene.view_layers.new("Other")
        scene.collection.children.link(bpy.data.collections.new("Extra"))
        extra = scene.collection.children["Extra"]
        ape = bpy.data.objects["Ape"]
        scene.collection.objects.unlink(ape)
        extra.objects.link(ape)
        other.layer_collection.children["Extra"].exclude = True
        pictures = []
        fill = addon.engine._fill
        addon.engine._fill = lambda passes, name, what, eye: (pictures.append(what.copy()), fill(passes, name, what, eye))
        try:
            bpy.ops.render.render()
        finally:
            addon.engine._fill = fill
        self.assertEqual(len(pictures), 2)
        self.assertGreater(apart(*pictures)[1], 0.02)

    def test_transparent(self):
        scene = scenes.still_life()
        bpy.data.objects.remove(bpy.data.objects["Table"])
        scene.render.film_transparent = True
        now = picture()
        self.assertEqual(now[0, 0].tolist(), [0, 0, 0, 0])
        self.assertEqual(now[90, 160, 3], 1)


class Looks(unittest.TestCase):
    def test_knobs_are_those_of_the_schema(self):
        paths = {knob.path for knob in addon.settings.KNOBS["scene"]}
        listed = subprocess.run([PROGRAM, "params"], capture_output=True, text=True, check=True).stdout
        self.assertIn("warp.amount", paths)
        self.assertGreater(len(paths), 300)
        self.assertEqual(len(paths), len({knob.name for knob in addon.settings.KNOBS["scene"]}))
        self.assertTrue(listed)
        scene = scenes.start()
        # Each can be set, and is what the look is told.
        for knob in addon.settings.KNOBS["scene"]:
            group = scene.scumble.knobs
            self.assertEqual(group.bl_rna.properties[knob.name].description, knob.meaning)
            setattr(group, knob.name, getattr(group, knob.name))
        everything = {path: value for path, value in
                      addon.settings.values_of(scene.scumble.knobs, "scene").items()}
        self.assertEqual(set(everything), paths)
        scenes.add("cube", "Box", (0, 0, 1))
        picture()  # the server takes all of them

    def test_a_look_by_name_and_by_file(self):
        scene = scenes.still_life()
        plain = picture()
        scene.scumble.look = "ink"
        scene_file = exported("look")
        ink = picture()
        self.assertGreater(apart(plain, ink)[1], 0.1)
        difference, others = apart(ink, of_program(scene_file, "--look", "ink"))
        self.assertLess(others, 0.02)
        own = Path(FOLDER.name) / "own.json"
        own.write_text('{"extends": "ink"}')
        scene.scumble.look_file = str(own)
        np.testing.assert_array_equal(ink, picture())
        own.write_text('{"extends": "ink", "ink": {"shown": false}}')
        self.assertGreater(apart(ink, picture())[1], 0.02)

    def test_keys_and_drivers(self):
        scene = scenes.still_life()
        knobs = scene.scumble.knobs
        knobs.shadow_threshold = 0.2
        knobs.keyframe_insert("shadow_threshold", frame=1)
        knobs.shadow_threshold = 0.8
        knobs.keyframe_insert("shadow_threshold", frame=11)
        values = []
        for frame in (1, 6, 11):
            scene.frame_set(frame)
            picture()
            values.append(addon.engine.session_for("final").look.knobs["shadow.threshold"])
        np.testing.assert_allclose(values, [0.2, 0.5, 0.8], atol=1e-6)
        driver = knobs.driver_add("warp_amount").driver
        driver.expression = "frame / 4"
        scene.frame_set(8)
        picture()
        self.assertAlmostEqual(addon.engine.session_for("final").look.knobs["warp.amount"], 2)

    def test_taken_back(self):
        scene = scenes.still_life()
        plain = picture()
        scene.scumble.knobs.warp_amount = 8
        self.assertGreater(apart(plain, picture())[1], 0.01)
        scene.scumble.knobs.property_unset("warp_amount")
        np.testing.assert_array_equal(plain, picture())

    def test_overrides(self):
        scenes.still_life()
        ball = bpy.data.objects["Ball"]
        plain = picture()
        bpy.data.materials["Red"].scumble.knobs.palette_litTint = (0, 0, 1)
        bpy.data.materials["Red"].scumble.knobs.palette_litTintAmount = 2
        by_material = picture()
        changed = np.abs(by_material - plain)[..., :3].max(axis=-1) > 0.05
        self.assertGreater(changed.mean(), 0.005)
        self.assertLess(changed.mean(), 0.2)
        bpy.data.materials["Red"].scumble.knobs.property_unset("palette_litTint")
        bpy.data.materials["Red"].scumble.knobs.property_unset("palette_litTintAmount")
        ball.scumble.knobs.palette_litTint = (0, 0, 1)
        ball.scumble.knobs.palette_litTintAmount = 2
        by_object = picture()
        self.assertGreater(apart(plain, by_object)[1], 0.005)

    def test_colorizers_are_empties(self):
        scene = scenes.still_life()
        plain = picture()
        bpy.ops.scumble.add_colorizer()
        glow = bpy.context.object
        self.assertTrue(glow.scumble.is_colorizer)
        glow.location, glow.scale = (0.4, -1.2, 1), (1.5, 1.5, 1.5)
        glow.scumble.colorizer.grade_tint = (0, 1, 0)
        green = picture()
        changed = np.abs(green - plain)[..., :3].max(axis=-1) > 0.05
        self.assertGreater(changed.mean(), 0.01)
        self.assertLess(changed.mean(), 0.5)
        knobs = addon.engine.session_for("final").look.knobs
        self.assertEqual(knobs["colorizers.Colorizer.volume.shape"], "sphere")
        np.testing.assert_allclose(knobs["colorizers.Colorizer.volume.center"], [0.4, 1, 1.2], atol=1e-5)
        self.assertAlmostEqual(knobs["colorizers.Colorizer.volume.radius"], 1.5, 5)
        glow.empty_display_type, glow.rotation_euler = "CUBE", (0.3, 0.2, 0.1)
        glow.scale = (1, 2, 3)
        picture()
        knobs = addon.engine.session_for("final").look.knobs
        self.assertEqual(knobs["colorizers.Colorizer.volume.shape"], "box")
        np.testing.assert_allclose(knobs["colorizers.Colorizer.volume.size"], [1, 3, 2], atol=1e-5)
        bpy.data.objects.remove(glow)
        np.testing.assert_array_equal(plain, picture())

    def test_an_ocean(self):
        scene = scenes.still_life()
        bpy.data.objects.remove(bpy.data.objects["Table"])
        dry = picture()
        bpy.ops.scumble.add_ocean()
        sea = bpy.context.object
        calm = picture()
        self.assertGreater(apart(dry, calm)[1], 0.2)
        sea.scumble.ocean.ocean_wind = 20
        self.assertGreater(apart(calm, picture())[1], 0.02)
        sea.location.z = -1
        self.assertGreater(apart(calm, picture())[1], 0.02)
        # It moves with time, by Blender's frames.
        sea.scumble.ocean.property_unset("ocean_wind")
        sea.location.z = 0
        scene.frame_set(30)
        self.assertGreater(apart(calm, picture())[1], 0.01)

    def test_outlines_of_mtoon(self):
        """As the VRM add-on keeps them, of which this is the part that is read."""
        properties = bpy.props

        class Pbr(bpy.types.PropertyGroup):
            base_color_factor: properties.FloatVectorProperty(size=4, default=(1, 1, 1, 1))

        class Extension(bpy.types.PropertyGroup):
            outline_width_mode: properties.StringProperty(default="none")
            outline_width_factor: properties.FloatProperty()
            outline_color_factor: properties.FloatVectorProperty(size=3)
            outline_lighting_mix_factor: properties.FloatProperty()

        class Extensions(bpy.types.PropertyGroup):
            vrmc_materials_mtoon: properties.PointerProperty(type=Extension)

        class MToon(bpy.types.PropertyGroup):
            enabled: properties.BoolProperty()
            pbr_metallic_roughness: properties.PointerProperty(type=Pbr)
            extensions: properties.PointerProperty(type=Extensions)

        class Vrm(bpy.types.PropertyGroup):
            mtoon1: properties.PointerProperty(type=MToon)

        classes = [Pbr, Extension, Extensions, MToon, Vrm]
        for each in classes:
            bpy.utils.register_class(each)
        bpy.types.Material.vrm_addon_extension = properties.PointerProperty(type=Vrm)
        try:
            scene = scenes.still_life()
            scene.scumble.knobs.ink_shown = True
            mtoon = bpy.data.materials["Red"].vrm_addon_extension.mtoon1
            mtoon.enabled = True
            mtoon.pbr_metallic_roughness.base_color_factor = (0.7, 0.1, 0.1, 1)
            plain = picture()
            outline = mtoon.extensions.vrmc_materials_mtoon
            outline.outline_width_mode, outline.outline_width_factor = "worldCoordinates", 0.1
            outline.outline_color_factor = (0, 1, 0)
            lined = picture()
            green = ((lined[..., 1] > 2 * lined[..., 0]) & (lined[..., 1] > 2 * lined[..., 2])).mean()
            self.assertGreater(apart(plain, lined)[1], 0.005)
            self.assertGreater(green, 0.003)
        finally:
            del bpy.types.Material.vrm_addon_extension
            for each in reversed(classes):
                bpy.utils.unregister_class(each)


class Troubles(unittest.TestCase):
    """What goes wrong is told, and Blender goes on."""

    def refused(self):
        with self.assertRaises(RuntimeError) as told:
            bpy.ops.render.render()
        return str(told.exception)

    def test_a_server_that_has_died(self):
        scenes.still_life()
        before = picture()
        server = addon.engine.session_for("final").server
        os.kill(server.pid, signal.SIGKILL)
        while server.is_alive:
            time.sleep(0.1)
        np.testing.assert_array_equal(before, picture())  # another one has been started, and told all

    def test_a_server_that_dies_at_work(self):
        scenes.still_life()
        before = picture()
        session = addon.engine.session_for("final")
        ask = session.server.ask

        def ask_and_die(do, **members):
            request = ask(do, **members)
            if do == "render":
                os.kill(session.server.pid, signal.SIGKILL)
            return request

        session.server.ask = ask_and_die
        bpy.context.scene.scumble.samples = "4"
        self.assertIn("scumble has ended (signal 9)", self.refused())
        bpy.context.scene.scumble.samples = "1"
        np.testing.assert_array_equal(before, picture())

    def test_a_program_that_is_not_there(self):
        scenes.still_life()
        preferences = bpy.context.preferences.addons["scumble_blender"].preferences
        preferences.program = "/nowhere/scumble"
        try:
            self.assertIn("/nowhere/scumble", self.refused())
            preferences.program = "/bin/false"
            self.assertIn("did not start", self.refused())
        finally:
            preferences.program = PROGRAM
        picture()

    def test_no_camera(self):
        scenes.still_life().camera = None
        self.assertIn("camera", self.refused())

    def test_a_look_that_is_wrong(self):
        scene = scenes.still_life()
        broken = Path(FOLDER.name) / "broken.json"
        broken.write_text('{"warp": {"amuont": 2}}')
        scene.scumble.look_file = str(broken)
        self.assertIn("amount", self.refused())
        broken.write_text('{"warp": {"amount": 2}}')
        picture()

    def test_cancelled(self):
        scenes.still_life()
        before = picture()
        since = sent()
        engine = addon.engine.ScumbleEngine
        is_unwanted = engine.is_unwanted
        try:
            # Before anything is asked for, and at work, where it may be too late.
            for patience in (0, 1):
                asked = []
                engine.is_unwanted = lambda self: len(asked) >= patience or asked.append(1) is not None
                bpy.context.scene.scumble.knobs.ink_shown = True
                self.assertLessEqual(len(render()), patience)
        finally:
            engine.is_unwanted = is_unwanted
        self.assertNotIn("mesh", sent(since))
        bpy.context.scene.scumble.knobs.property_unset("ink_shown")
        np.testing.assert_array_equal(before, picture())

    def test_what_is_not_taken_over_is_told(self):
        scene = scenes.start()
        paint = scenes.material("Noisy", (1, 1, 1))
        noise = paint.node_tree.nodes.new("ShaderNodeTexNoise")
        paint.node_tree.links.new(noise.outputs["Color"], paint.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
        scenes.add("cube", "Box", (0, 0, 1), paint)
        told = []
        warn = addon.engine.ScumbleEngine.warn
        addon.engine.ScumbleEngine.warn = lambda self, notes: told.extend(notes)
        try:
            picture()
        finally:
            addon.engine.ScumbleEngine.warn = warn
        self.assertEqual(told, ["material 'Noisy': 'Noise Texture' is not taken over as a colour"])

    def test_numbers_that_are_none(self):
        nan, inf = float("nan"), float("inf")
        scenes.still_life()
        before = picture()
        told = []
        warn = addon.engine.ScumbleEngine.warn
        addon.engine.ScumbleEngine.warn = lambda self, notes: told.extend(notes)
        try:
            bpy.data.materials["Blue"].node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (nan, 0.2, 0.6, 1)
            bpy.data.lights["Lamp"].energy = inf
            bpy.data.objects["Box"]["scumble_float"] = inf
            bpy.data.objects["Table"].location.x = nan
            bpy.data.meshes["Ball"].vertices[3].co.x = nan
            now = picture()
        finally:
            addon.engine.ScumbleEngine.warn = warn
        self.assertTrue(np.isfinite(now).all())
        self.assertEqual(sorted(told), ["'Ball' has vertices that lie nowhere, and is left out",
                                        "'Table' lies nowhere, and is left out"])

    def test_after_a_refusal_all_is_told_anew(self):
        scenes.still_life()
        with_ape = picture()
        bpy.data.objects["Ape"].hide_render = True
        without = picture()
        bpy.data.objects["Ape"].hide_render = False
        picture()
        session = addon.engine.session_for("final")
        call = session.server.call

        def refuse(do, **members):
            if do == "edit":
                raise addon.session.ScumbleError("refused")
            return call(do, **members)

        session.server.call = refuse
        bpy.data.objects["Ape"].hide_render = True
        self.assertIn("refused", self.refused())
        session.server.call = call
        np.testing.assert_array_equal(picture(), without)
        bpy.data.objects["Ape"].hide_render = False
        np.testing.assert_array_equal(picture(), with_ape)

    def test_nodes_in_a_circle_and_past_reroutes(self):
        scenes.still_life()
        before = picture()
        tree = bpy.data.materials["Boxes"].node_tree
        surface = tree.nodes["Principled BSDF"]
        for target, source in ((surface.inputs["Base Color"], None), (tree.nodes["Material Output"].inputs["Surface"], surface)):
            link = target.links[0]
            reroute = tree.nodes.new("NodeReroute")
            tree.links.new(link.from_socket, reroute.inputs[0])
            tree.links.new(reroute.outputs[0], target)
        np.testing.assert_array_equal(before, picture())
        mix = tree.nodes.new("ShaderNodeMixRGB")
        mix.blend_type = "MULTIPLY"
        tree.links.new(mix.outputs[0], mix.inputs[1])
        tree.links.new(mix.outputs[0], surface.inputs["Base Color"])
        picture()

    def test_a_camera_that_is_scaled_to_nothing(self):
        scene = scenes.still_life()
        scene.camera.scale = (0, 0, 0)
        self.assertIn("camera", self.refused())

    def test_sizes_are_those_of_blender(self):
        scene = scenes.still_life()
        scene.render.resolution_x = scene.render.resolution_y = 100
        scene.render.image_settings.file_format = "PNG"
        scene.render.filepath = str(Path(FOLDER.name) / "size.png")
        for percent in (29, 57, 58, 69):
            scene.render.resolution_percentage = percent
            bpy.ops.render.render(write_still=True)
            file = saved(scene.render.filepath)
            self.assertEqual(file.shape[:2], (percent, percent))
            self.assertGreater(file[-1, :, :3].min(), 0)
            self.assertGreater(file[:, -1, :3].min(), 0)
        scene.render.resolution_percentage = 100
        scene.render.resolution_x, scene.render.resolution_y = 320, 180
        scene.render.use_border = scene.render.use_crop_to_border = True
        scene.render.border_min_x, scene.render.border_max_x = 0.1, 0.7
        scene.render.border_min_y, scene.render.border_max_y = 0.1, 0.9
        bpy.ops.render.render(write_still=True)
        file = saved(scene.render.filepath)
        self.assertGreater(file[-1, :, :3].min(), 0)
        self.assertGreater(file[:, -1, :3].min(), 0)

    def test_names_that_are_patterns(self):
        scenes.still_life()
        plain = picture()
        bpy.data.materials["Gold"].name = "Go?d"
        knobs = bpy.data.materials["Go?d"].scumble.knobs
        knobs.warp_amount = 8
        told = []
        warn = addon.engine.ScumbleEngine.warn
        addon.engine.ScumbleEngine.warn = lambda self, notes: told.extend(notes)
        try:
            np.testing.assert_array_equal(plain, picture())
        finally:
            addon.engine.ScumbleEngine.warn = warn
        self.assertIn("'Go?d'", told[0])

    def test_a_server_that_does_not_answer(self):
        scenes.still_life()
        before = picture()
        session = addon.engine.session_for("final")
        addon.server.PATIENCE = 1
        engine = addon.engine.ScumbleEngine
        asked = []
        is_unwanted = engine.is_unwanted
        engine.is_unwanted = lambda self: len(asked) > 3 or asked.append(1) is not None
        os.kill(session.server.pid, signal.SIGSTOP)
        try:
            self.assertIn("scumble has ended", self.refused())
        finally:
            engine.is_unwanted = is_unwanted
            addon.server.PATIENCE = 10
        np.testing.assert_array_equal(before, picture())
        lines = Path(FOLDER.name) / "yes.sh"
        lines.write_text("#!/bin/sh\nif [ \"$1\" = serve ]; then exec yes; fi\n")
        lines.chmod(0o755)
        preferences = bpy.context.preferences.addons["scumble_blender"].preferences
        preferences.program = str(lines)
        try:
            self.assertIn("did not start", self.refused())
        finally:
            preferences.program = PROGRAM

    def test_turned_off_and_on(self):
        scenes.still_life()
        before = picture()
        pid = addon.engine.session_for("final").server.pid
        bpy.ops.preferences.addon_disable(module="scumble_blender")
        self.assertFalse(Path(f"/proc/{pid}/cmdline").exists() and Path(f"/proc/{pid}/cmdline").read_bytes())
        bpy.ops.preferences.addon_enable(module="scumble_blender")
        bpy.context.preferences.addons["scumble_blender"].preferences.program = PROGRAM
        scenes.still_life()
        self.assertLess(apart(before, picture())[0], 1e-4)

    def test_bpy_is_called_in_few_files(self):
        folder = Path(addon.__file__).parent
        callers = {path.name for path in folder.glob("*.py") if "import bpy" in path.read_text()}
        self.assertEqual(callers, {"__init__.py", "blender.py", "engine.py", "interface.py", "settings.py"})


def main():
    global addon
    bpy.ops.preferences.addon_install(filepath=ZIP, overwrite=True)
    bpy.ops.preferences.addon_enable(module="scumble_blender")
    import scumble_blender as addon
    bpy.context.preferences.addons["scumble_blender"].preferences.program = PROGRAM
    names = sys.argv[sys.argv.index("--") + 3:]
    loader = unittest.TestLoader()
    module = sys.modules[__name__]
    tests = loader.loadTestsFromNames(names, module) if names else loader.loadTestsFromModule(module)
    result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout).run(tests)
    addon.engine.SESSIONS.close()
    FOLDER.cleanup()
    if not result.wasSuccessful():
        raise SystemExit(1)


if __name__ == "__main__":
    main()
