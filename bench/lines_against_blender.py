#!/usr/bin/env python3
"""How steady lines are along an orbit: ours, the plain method, and Blender's Freestyle and Line Art.

    bench/lines_against_blender.py SCENE... [--json FILE] [--program FILE] [--size 640x480] [-- OPTION...]

Needs Blender 3.4 (apt-get install blender python3-numpy xvfb libgl1-mesa-dri). All draw the same: outlines, ends, and creases
of more than 40 degrees, black, 2 pixels wide, from the cameras that `scumble measure --lines ink --json` names. What counts is
found in everybody's pictures by the same command (docs/measure.md). Scenes should stand still. Line Art draws by OpenGL, in a
window system without a screen.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
from surroundings import ROOT, head, parse  # noqa: E402

METHODS = ["freestyle", "lineart"]
WIDTH = 2  # pixels
CREASE = 40  # degrees


def settings(height):
    width = WIDTH * 1080 / height
    for knob in ("least", "greatest"):
        yield f"ink.{knob}={width}"
    yield from ("ink.shown=on", "ink.outer=1", "ink.placement=centred", f"ink.creaseAngle={CREASE}", "ink.materials.shown=off",
                "ink.colors.shown=off", "ink.silhouettes.width=1", "ink.boundaries.width=1", "ink.creases.width=1")


def run(command, **more):
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode:
        sys.exit(f"{' '.join(command[:3])} ...: exit code {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def measure(chosen, options, scene, folder):
    width, height = map(int, chosen.size.split("x"))
    ours = [chosen.program, "measure", scene, "--look", "ink", "--lines", "ink", "--json", "--quiet", "--size", chosen.size]
    ours += [word for setting in settings(height) for word in ("--set", setting)] + options
    plain = json.loads(run([*ours, "--set", "ink.fade=0", "--set", "ink.fadeAngle=0"]))
    views = plain["views"]
    # Blender's interpreter must be the system's, whose packages it is built for.
    system = {**os.environ, "PATH": "/usr/bin:/bin"}
    for method in METHODS:
        task = {"scene": str(Path(scene).resolve()), "method": method, "size": [width, height], "width": WIDTH,
                "crease": CREASE, "views": views, "output": str(folder / method)}
        screen = ["xvfb-run", "-a"] if method == "lineart" else []
        run([*screen, "blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python",
             str(ROOT / "bench" / "draw_lines_in_blender.py"), "--", json.dumps(task)], env=system)
        ours += ["--drawing", f"{method}={folder / method}.####.png"]
    return {"scene": os.path.basename(scene), "lines": {"plain": plain["lines"]["ink"], **json.loads(run(ours))["lines"]}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0],
                                     epilog="example: bench/lines_against_blender.py Suzanne.gltf --json lines.json")
    parser.add_argument("--size", default="640x480", metavar="WxH")
    chosen, options = parse(parser)
    report = {**head(chosen.program, options), "blender": run(["blender", "--version"]).splitlines()[0], "size": chosen.size}
    for scene in chosen.scenes:
        with tempfile.TemporaryDirectory(prefix="scumble lines ") as folder:
            result = measure(chosen, options, scene, Path(folder))
        report["results"].append(result)
        print(result["scene"])
        for method, lines in result["lines"].items():
            print(f"  {method:12} {lines['drawn']:8.0f} pixels drawn on, {lines['changes']:.3f} change a degree, {lines['flickers']:.5f} flicker")
    if chosen.json:
        Path(chosen.json).write_text(json.dumps(report, indent=2) + "\n")


if __name__ == "__main__":
    main()
