"""What people write, for mypy --strict to look at; never run."""
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import scumble


def sheet(folder: Path) -> NDArray[np.uint8]:
    renderer = scumble.Renderer(cache=folder)
    look = scumble.Look("ink")
    look["shadow.threshold"] = 0.4
    look.set_track("shadow.threshold", [(0, 0.2), (2.0, 0.6)], interpolation="ease")
    scene = scumble.Scene(folder / "boat.glb", progress=lambda part: part < 0.5)
    frame = renderer.render(scene, look, 0.5, size=(320, 180), aovs=["depth"], dtypes={"picture": "uint8"}, orbit=(30, 15))
    depth = frame["depth"][..., 0]
    print(float(depth.max()), frame.stats["gpu_ms"], frame.drawings[0].strokes[0]["points"].shape)
    frame.save(folder / "boat.exr")
    for each in renderer.frames(scene, "ink", np.arange(24) / 24, size=(320, 180), stereo=True):
        scumble.write_picture(folder / "frame.png", each.image())
    renderer.film(folder / "boat.mp4", scene, seconds=2, turntable=2)
    try:
        scumble.Look("nobody")
    except scumble.UsageError as error:
        print(error.problem, error.advice)
    return np.asarray(frame["picture"], np.uint8)


def build() -> scumble.Scene:
    editor = scumble.SceneEditor()
    paint = editor.add_material(name="Paint", base_color=(0.8, 0.2, 0.1), double_sided=True)
    mesh = editor.add_mesh(positions=np.zeros((3, 3)), indices=[0, 1, 2], material=paint)
    node = editor.add_node(name="Sail", mesh=mesh, transform=np.eye(4))
    editor.set_transform(node, np.eye(4))
    return editor.scene()


def views(scene: scumble.Scene) -> list[scumble.View]:
    return [scumble.View(np.eye(4), scumble.perspective(0.6, 16 / 9)), *scumble.make_views(scene, stereo=True)]
