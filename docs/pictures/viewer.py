#!/usr/bin/env python3
"""Makes docs/pictures/viewer.png, viewer-passes.png and viewer-handles.png: the demo scene in the window, with the help over
it, with what passes put out and the knobs of a sail, and with what the look places, on a screen of Xvfb's.

    docs/pictures/viewer.py [BUILD]
"""
import contextlib
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent.parent / "tests" / "window"))
import view_test  # noqa: E402

SAIL = (820, 440)
# A glow in flowers, a light that sinks, and a camera that goes by.
PLACED = {
    "light": {"source": "look", "azimuth": -60, "elevation": {"keys": [[0, 50], [6, 8]], "interpolation": "ease"}},
    "colorizers": {"Glow": {"volume": {"center": [-0.1, 1.15, 0], "radius": {"keys": [[0, 0.3], [3, 0.45], [6, 0.3]]}},
                            "grade": {"tint": "#FFB060", "gain": 1.4}}},
    "camera": {"mode": "eye", "eye": {"keys": [[0, [-1.6, 1.9, 2.4]], [3, [0.2, 1.5, 1.9]], [6, [1.7, 1.3, 1.7]]], "interpolation": "ease"},
               "shift": [0, 0, 0]}}
TO_CHOOSE = ((1075, 763), (1100, 113), (1100, 135))


def main():
    build = Path(sys.argv[1] if len(sys.argv) > 1 else HERE.parent.parent / "build").resolve()
    view_test.SIZE, view_test.SAMPLES = (1280, 800), "4"
    with tempfile.TemporaryDirectory() as folder, contextlib.closing(view_test.Screen(1400, 900, folder)) as screen:
        scene = Path(folder) / "demo.glb"
        subprocess.run([build / "demo_scene", scene], check=True, capture_output=True)
        window = view_test.Window(screen, build / "scumble", scene, "--time", "3")
        view_test.until(lambda: view_test.is_painted(window.pixels()), "a picture in the window")
        window.key("h")
        window.resting()
        test = view_test.Test(build, HERE)
        test.keep("viewer", window)
        window.key("h", "p")
        window.click(*SAIL)
        time.sleep(5)
        window.resting()
        test.keep("viewer-passes", window)
        window.key("ctrl+q")
        window.closed()

        scene = Path(folder) / "still life.glb"
        subprocess.run([build / "still_life", scene], check=True, capture_output=True)
        scene.with_suffix(".look.json").write_text(json.dumps(PLACED))
        window = view_test.Window(screen, build / "scumble", scene, "--time", "2.5")
        view_test.until(lambda: view_test.is_painted(window.pixels()), "a picture in the window")
        window.resting()
        # From somewhere beside the look's own camera, with the glow's handles, over its tracks.
        window.drag(1, (-160, 30))
        screen.hand("mousemove", 300, 300)
        for _ in range(5):
            screen.hand("click", 5)
        window.resting()
        window.key("g")
        window.resting()
        for place in TO_CHOOSE:
            window.click(*place)
            window.resting()
        test.keep("viewer-handles", window)
        window.key("ctrl+q")
        window.closed()


if __name__ == "__main__":
    main()
