"""Draws a scene's lines in Blender 3.4, for lines_against_blender.py, which says what: black lines on white, for each view."""
import json
import math
import sys

import numpy

# The packaged importer is older than the packaged NumPy, which has dropped these names.
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object

import bpy  # noqa: E402
from mathutils import Matrix  # noqa: E402

SAMPLES = 16


def white_material():
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    links.new(nodes.new("ShaderNodeEmission").outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return material


def whiten(scene):
    white = white_material()
    for thing in list(scene.objects):
        if thing.type == "MESH":
            thing.data.materials.clear()
            thing.data.materials.append(white)
        elif thing.type in ("CAMERA", "LIGHT"):
            bpy.data.objects.remove(thing)
    scene.world = bpy.data.worlds.new("white")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (1, 1, 1, 1)
    scene.view_settings.view_transform = "Standard"


def use_freestyle(scene, task):
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.device = SAMPLES, False, "CPU"
    scene.render.use_freestyle = True
    layer = scene.view_layers[0]
    layer.use_freestyle = True
    freestyle = layer.freestyle_settings
    freestyle.crease_angle = math.radians(180 - task["crease"])
    lines = freestyle.linesets[0] if freestyle.linesets else freestyle.linesets.new("lines")
    lines.select_silhouette = lines.select_border = lines.select_crease = True
    lines.linestyle = lines.linestyle or bpy.data.linestyles.new("lines")
    lines.linestyle.thickness, lines.linestyle.color = task["width"], (0, 0, 0)


def use_line_art(scene, task):
    scene.render.engine = "BLENDER_EEVEE"
    scene.eevee.taa_render_samples = SAMPLES
    pencil = bpy.data.grease_pencils.new("lines")
    pencil.stroke_thickness_space = "SCREENSPACE"
    layer = pencil.layers.new("lines")
    layer.frames.new(0)
    black = bpy.data.materials.new("black")
    bpy.data.materials.create_gpencil_data(black)
    black.grease_pencil.color = (0, 0, 0, 1)
    pencil.materials.append(black)
    lines = bpy.data.objects.new("lines", pencil)
    lines.show_in_front = True
    scene.collection.objects.link(lines)
    art = lines.grease_pencil_modifiers.new("lines", "GP_LINEART")
    art.source_type, art.target_layer, art.target_material = "SCENE", "lines", black
    art.thickness, art.crease_threshold = task["width"], math.radians(180 - task["crease"])
    art.use_contour = art.use_crease = True
    # The importer welds what it can; what it leaves open is no end that anybody means.
    art.use_loose = art.use_material = art.use_intersection = False


def main():
    task = json.loads(sys.argv[sys.argv.index("--") + 1])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.import_scene.gltf(filepath=task["scene"], merge_vertices=True)
    whiten(scene)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.data.sensor_fit = "VERTICAL"
    camera.data.clip_start, camera.data.clip_end = 0.01, 10000
    scene.render.resolution_x, scene.render.resolution_y = task["size"]
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format, scene.render.image_settings.color_mode = "PNG", "RGB"
    {"freestyle": use_freestyle, "lineart": use_line_art}[task["method"]](scene, task)
    z_up = Matrix.Rotation(math.radians(90), 4, "X")
    for number, view in enumerate(task["views"]):
        columns = view["eyeToWorld"]
        camera.matrix_world = z_up @ Matrix([columns[i::4] for i in range(4)])
        camera.data.angle = 2 * math.atan(1 / abs(view["eyeToClip"][5]))
        scene.render.filepath = f"{task['output']}.{number:04}.png"
        bpy.ops.render.render(write_still=True)


main()
