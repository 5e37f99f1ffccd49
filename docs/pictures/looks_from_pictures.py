#!/usr/bin/env python3
"""Draws looks_from_pictures.png beside this script: on the left a still life as looks that ship paint it, on the right the
demo scene as the looks have it that `scumble look` finds in those pictures. Standard library only.

    docs/pictures/looks_from_pictures.py [BUILD]     BUILD: the folder of the program and the generators; default: build
"""
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "docs/figures"))
from panels import Picture, table  # noqa: E402

LOOKS = ["dusk", "gouache-night", "watercolour-night"]


def main():
    build = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build").resolve()
    panels = []
    with tempfile.TemporaryDirectory() as folder:
        def run(program, *words):
            subprocess.run([build / program, *words], cwd=folder, check=True, stdout=subprocess.DEVNULL)

        def panel(scene, look):
            run("scumble", "render", scene, "--look", look, "-o", "panel.png", "--size", "960x540", "--quiet")
            run("scumble", "look", "panel.png", "-o", "found.json")
            run("scumble", "render", scene, "--look", look, "-o", "small.png", "--size", "480x270", "--quiet")
            return Picture.read(Path(folder) / "small.png")
        run("still_life", "still.glb")
        run("demo_scene", "demo.glb")
        for look in LOOKS:
            panels.append(panel("still.glb", look))
            (Path(folder) / "found.json").rename(Path(folder) / "other.json")
            panels.append(panel("demo.glb", "./other.json"))
    out = ROOT / "docs/pictures/looks_from_pictures.png"
    table(panels, 2).save(out)
    print(out)


if __name__ == "__main__":
    main()
