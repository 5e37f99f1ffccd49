#!/usr/bin/env python3
"""Draws the contact sheet of the looks that ship, looks.png beside this script. Standard library only.

    docs/pictures/looks.py [BUILD]     BUILD: the folder of the program and the generators; default: build
    --out FILE      another picture
    --size WxH      size of each panel; default: 480x270

In the order of `scumble looks`, row by row: the demo scene, but for `henry`, which was made for Henry's room. Looks that
change with time are shown on the way.
"""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "docs/figures"))
from panels import Picture, table  # noqa: E402

MADE_FOR = {"henry": "henry_room"}
AT = {"gathering-storm": 35}  # seconds
COLUMNS = 2


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", type=Path, default=ROOT / "build")
    parser.add_argument("--out", type=Path, default=ROOT / "docs/pictures/looks.png")
    parser.add_argument("--size", default="480x270")
    arguments = parser.parse_args()

    def run(*command):
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
        return done.stdout

    build = arguments.build.resolve()
    looks = [line.split()[0] for line in run(build / "scumble", "looks").splitlines()]
    panels = []
    with tempfile.TemporaryDirectory() as folder:
        for look in looks:
            generator = MADE_FOR.get(look, "demo_scene")
            scene, picture = Path(folder) / f"{generator}.glb", Path(folder) / "panel.png"
            if not scene.exists():
                run(build / generator, scene)
            run(build / "scumble", "render", scene, "--look", look, "--time", AT.get(look, 0), "-o", picture,
                "--size", arguments.size, "--quiet")
            panels.append(Picture.read(picture))
    table(panels, COLUMNS).save(arguments.out)
    print(f"{arguments.out}: {', '.join(looks)}")


if __name__ == "__main__":
    main()
