"""The viewport, in a Blender with a window: it paints while one works, and outlives its server.

Steps follow each other by a timer, since Blender draws between them; a screenshot tells what one sees.
"""
import os
import signal
import sys
import time
import traceback
from pathlib import Path

import bpy
import numpy as np

PICTURES = Path(sys.argv[sys.argv.index("--") + 1])
LONGEST = 60  # seconds that something may take to show

bpy.ops.preferences.addon_enable(module="scumble_blender")
import scumble_blender as addon  # noqa: E402

bpy.context.preferences.view.show_splash = False


def window():
    return bpy.context.window_manager.windows[0]


def area():
    return next(each for each in window().screen.areas if each.type == "VIEW_3D")


def seen(name):
    """What the viewport shows: rows by columns by 3, 0 to 1, row 0 at the bottom."""
    path = PICTURES / f"{name}.png"
    with bpy.context.temp_override(window=window(), screen=window().screen):
        bpy.ops.screen.screenshot(filepath=str(path))
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    view = area()
    return pixels.reshape(height, width, 4)[view.y:view.y + view.height, view.x:view.x + view.width, :3]


def reds(name):
    """The part of the viewport that is as red as the ball."""
    picture = seen(name)
    return float(((picture[..., 0] > 0.6) & (picture[..., 1] < 0.45) & (picture[..., 2] < 0.4)).mean())


def session():
    return next(iter(addon.engine.VIEWPORTS)).session


def steps():
    """Each yields what must come true, and is gone on with when it has."""
    area().spaces[0].shading.type = "RENDERED"
    area().spaces[0].region_3d.view_perspective = "CAMERA"
    area().spaces[0].overlay.show_overlays = False
    yield lambda: reds("painted") > 0.01
    with session() as held:
        before = held.sent()
    ball = bpy.data.objects["Ball"]
    first = seen("painted")
    ball.location.z += 1
    yield lambda: np.abs(seen("moved") - first).mean() > 0.005
    with session() as held:
        told = held.sent()
    assert told["mesh"] == before["mesh"], "what moves is not sent again"
    bpy.data.materials["Red"].node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0, 0.5, 0, 1)
    yield lambda: reds("green") < 0.002
    with session() as held:
        assert held.sent()["mesh"] == before["mesh"] and held.sent()["material"] == before["material"] + 1, held.sent()
    ball.data.vertices[0].co.z += 1
    ball.data.update()
    time.sleep(0.2)
    yield lambda: session().sent()["mesh"] == before["mesh"] + 1
    bpy.context.scene.scumble.knobs.warp_amount = 5
    yield lambda: session().sent().get("knobs", 0) == before.get("knobs", 0) + 1
    # Without its server Blender goes on, and the next change starts another one.
    old = session().server.pid
    os.kill(old, signal.SIGKILL)
    yield lambda: not session().server.is_alive
    bpy.data.materials["Red"].node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.7, 0.05, 0.05, 1)
    yield lambda: reds("after") > 0.01
    assert session().server.pid != old
    # What is wrong is told until it is mended, also where the view alone changes.
    broken = PICTURES / "broken.json"
    broken.write_text('{"warp": {"amuont": 2}}')
    viewport = next(iter(addon.engine.VIEWPORTS))
    bpy.context.scene.scumble.look_file = str(broken)
    yield lambda: "amuont" in viewport.texture()[1]
    area().spaces[0].region_3d.view_camera_zoom += 5
    time.sleep(0.5)
    yield lambda: "amuont" in viewport.texture()[1] and not viewport.is_busy
    bpy.context.scene.scumble.look_file = ""
    yield lambda: not viewport.texture()[1]
    # In edit mode the mesh that is worked on is shown.
    with bpy.context.temp_override(window=window(), area=area()):
        bpy.context.view_layer.objects.active = ball
        bpy.ops.object.mode_set(mode="EDIT")
    yield lambda: reds("edited") > 0.01
    with bpy.context.temp_override(window=window(), area=area()):
        bpy.ops.object.mode_set(mode="OBJECT")
    area().spaces[0].shading.type = "SOLID"
    yield lambda: True


RUNNING = steps()
state = {"until": None, "condition": None}


def leave(code):
    addon.engine.close_all()
    sys.stdout.flush()
    os._exit(code)


def tick():
    try:
        if state["condition"] is None:
            state["condition"] = next(RUNNING, None)
            state["until"] = time.monotonic() + LONGEST
            if state["condition"] is None:
                print("viewport: it paints while one works")
                leave(0)
        elif state["condition"]():
            state["condition"] = None
        elif time.monotonic() > state["until"]:
            print(f"viewport: line {RUNNING.gi_frame.f_lineno} has not come true in {LONGEST} s")
            leave(1)
    except Exception:
        traceback.print_exc()
        leave(1)
    return 0.5


bpy.app.timers.register(tick, first_interval=1.0, persistent=True)
