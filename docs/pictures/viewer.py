#!/usr/bin/env python3
"""Makes docs/pictures/viewer.png and viewer-passes.png: the demo scene in the window, with the help over it, and with what
passes put out and the knobs of a sail, on a screen of Xvfb's.

    docs/pictures/viewer.py [BUILD]
"""
import contextlib
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


if __name__ == "__main__":
    main()
