"""Scenes made by script, for tests inside of Blender."""
import math

import bpy
import numpy as np


def start(width=320, height=180):
    """An empty scene with a camera and a sun, painted by scumble."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "SCUMBLE"
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.view_settings.view_transform = "Standard"
    scene.scumble.samples = "1"
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location, camera.rotation_euler = (7, -6, 4.5), (math.radians(66), 0, math.radians(49))
    scene.collection.objects.link(camera)
    scene.camera = camera
    add_lamp("Sun", "SUN", (0, 0, 5), (math.radians(40), 0, math.radians(20)))
    return scene


def add_lamp(name, kind, location, rotation=(0, 0, 0), energy=1.0):
    lamp = bpy.data.objects.new(name, bpy.data.lights.new(name, kind))
    lamp.data.energy = energy
    lamp.location, lamp.rotation_euler = location, rotation
    bpy.context.scene.collection.objects.link(lamp)
    return lamp


def material(name, color, image=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    surface = made.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = (*color, 1)
    if image is not None:
        node = made.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        made.node_tree.links.new(node.outputs["Color"], surface.inputs["Base Color"])
    return made


def checker(name="Checker", side=64):
    image = bpy.data.images.new(name, side, side)
    rows, columns = np.mgrid[0:side, 0:side] // (side // 8)
    pixels = np.ones((side, side, 4), np.float32)
    pixels[..., 0] = np.where((rows + columns) % 2, 0.8, 0.2)
    pixels[..., 1] = rows / 8
    image.pixels.foreach_set(pixels.reshape(-1))
    image.pack()
    return image


def add(kind, name, location, paint=None, **options):
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(location=location, **options)
    added = bpy.context.object
    added.name = added.data.name = name
    if paint is not None:
        added.data.materials.append(paint)
    return added


def still_life():
    """Materials, a texture, a modifier, smooth and flat faces, parents, instances, a lamp."""
    scene = start()
    add("plane", "Table", (0, 0, 0), material("Wood", (0.5, 0.3, 0.15)), size=12)
    add("cube", "Box", (-1.6, 0.6, 1), material("Boxes", (1, 1, 1), checker()), size=1.6)
    ball = add("uv_sphere", "Ball", (0.4, -1.2, 1), material("Red", (0.7, 0.08, 0.05)), radius=1)
    bpy.ops.object.shade_smooth()
    ring = add("torus", "Ring", (0, 0, 1.3), material("Gold", (0.8, 0.5, 0.1)))
    ring.parent = ball
    ring.matrix_parent_inverse.identity()
    ring.scale = (1, 1, 1.5)
    ape = add("monkey", "Ape", (2.2, 1.6, 1.2), material("Blue", (0.1, 0.2, 0.6)))
    ape.modifiers.new("Smooth", "SUBSURF").levels = 1
    ape.modifiers["Smooth"].render_levels = 1
    ape.rotation_euler[2] = math.radians(50)
    add_lamp("Lamp", "POINT", (2, -3, 3), energy=200)
    return scene


def collection_of(*objects):
    """Instances of what is in a collection that is not itself shown."""
    made = bpy.data.collections.new("Props")
    for each in objects:
        for holder in each.users_collection:
            holder.objects.unlink(each)
        made.objects.link(each)
    return made


def place_collection(collection, name, location, scale=1.0):
    empty = bpy.data.objects.new(name, None)
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    empty.location, empty.scale = location, (scale,) * 3
    bpy.context.scene.collection.objects.link(empty)
    return empty
