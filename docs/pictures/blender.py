#!/usr/bin/env python3
"""Makes docs/pictures/blender.png: the demo scene in Blender's viewport, painted, with the panel of looks.

    docs/pictures/blender.py build

Needs Blender and xvfb. Blender's own importer reads the scene, which Debian's Blender 3.4 cannot without a word that its
numpy has lost.
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
LOAD = """
import numpy, sys
numpy.bool = bool
import bpy
archive, scene, target = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
bpy.ops.preferences.addon_enable(module="scumble_blender")
bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
bpy.ops.import_scene.gltf(filepath=scene)
scene = bpy.context.scene
scene.render.engine, scene.view_settings.view_transform = "SCUMBLE", "Standard"
scene.render.resolution_x, scene.render.resolution_y = 1060, 640
scene.camera = next(each for each in bpy.data.objects if each.type == "CAMERA")
bpy.ops.wm.save_as_mainfile(filepath=target)
"""
SHOW = """
import os, sys
import bpy
bpy.ops.preferences.addon_enable(module="scumble_blender")
bpy.context.preferences.view.show_splash = False
import scumble_blender as addon
waited = 0

def tick():
    global waited
    window = bpy.context.window_manager.windows[0]
    if waited == 0:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                space = area.spaces[0]
                space.shading.type, space.region_3d.view_perspective = "RENDERED", "CAMERA"
                space.region_3d.view_camera_zoom = 34
                space.overlay.show_overlays = space.show_gizmo = False
            elif area.type == "PROPERTIES":
                area.spaces[0].context = "RENDER"
    waited += 1
    if waited > 3 and not any(viewport.is_busy for viewport in addon.engine.VIEWPORTS) or waited > 60:
        with bpy.context.temp_override(window=window, screen=window.screen):
            bpy.ops.screen.screenshot(filepath=sys.argv[-1])
        addon.engine.close_all()
        os._exit(0)
    return 1.0

bpy.app.timers.register(tick, first_interval=1.0, persistent=True)
"""


def main():
    build = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        environment = {**os.environ, "BLENDER_USER_RESOURCES": str(folder / "user"), "SCUMBLE": str(build / "scumble"),
                       "PATH": "/usr/bin:" + os.environ.get("PATH", "")}
        subprocess.run([ROOT / "blender" / "make_zip", folder / "addon.zip"], check=True)
        subprocess.run([build / "demo_scene", folder / "demo.glb"], check=True)
        (folder / "load.py").write_text(LOAD)
        (folder / "show.py").write_text(SHOW)
        blender = ["blender", "--factory-startup", "--python-exit-code", "1"]
        subprocess.run([*blender, "--background", "--python", folder / "load.py", "--", folder / "addon.zip",
                        folder / "demo.glb", folder / "demo.blend"], env=environment, check=True)
        subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1440x900x24", *blender, "--window-geometry", "0", "0", "1440",
                        "900", folder / "demo.blend", "--python", folder / "show.py", "--",
                        ROOT / "docs" / "pictures" / "blender.png"], env=environment, check=True)


if __name__ == "__main__":
    main()
