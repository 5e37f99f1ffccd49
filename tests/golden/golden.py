#!/usr/bin/env python3
"""Golden pictures: draws the cases of cases.txt through the program and compares them with the pictures beside it.

    tests/golden/golden.py check  BUILD [NAME...]    fails where a picture looks different; leaves it in BUILD/golden
    tests/golden/golden.py update BUILD [NAME...]    draws the pictures anew (tests/golden/update does it for build/)

How different is told by FLIP (src/film/compare.h), as a person would see it. Drivers round differently, which moves the
torn edges a little: measured in the mean that is well below the tolerance, while a moved shadow or another colour is not.
"""
import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE))
import scenes  # noqa: E402

OPTIONS = ["--size", "320x180", "--samples", "4", "--validate", "--quiet"]
TOLERANCE = 0.05  # mean FLIP
GENERATORS = {"demo": "demo_scene", "room": "henry_room"}


def cases():
    """(name, scene, options) of each line."""
    result = []
    for number, line in enumerate((HERE / "cases.txt").read_text().splitlines(), 1):
        line = line.partition("#")[0].strip()
        if not line:
            continue
        parts = [part.strip() for part in line.split("|")]
        if len(parts) != 3 or parts[1] not in {*GENERATORS, *scenes.SCENES}:
            sys.exit(f"{HERE / 'cases.txt'}:{number}: write it like: name | scene | options")
        result.append((parts[0], parts[1], shlex.split(parts[2])))
    return result


def scene_file(build, folder, name):
    if name in GENERATORS:
        path = folder / f"{name}.glb"
        look = HERE.parent.parent / "examples" / GENERATORS[name] / f"{name}.look.json"
        if look.exists():
            shutil.copy(look, folder / look.name)
        subprocess.run([build / GENERATORS[name], path], check=True, stdout=subprocess.DEVNULL)
    else:
        path = folder / f"{name}.gltf"
        path.write_text(scenes.SCENES[name]())
    return path


def difference(build, golden, picture):
    done = subprocess.run([build / "compare_pictures", golden, picture], capture_output=True, text=True)
    if done.returncode != 0:
        return None, done.stderr.strip()
    return [float(word) for word in done.stdout.split()], None


def main():
    if len(sys.argv) < 3 or sys.argv[1] not in ("check", "update"):
        sys.exit(__doc__)
    update, build, names = sys.argv[1] == "update", Path(sys.argv[2]).resolve(), sys.argv[3:]
    known = [name for name, _, _ in cases()]
    for name in names:
        if name not in known:
            sys.exit(f"there is no case '{name}'; there are: {', '.join(known)}")
    folder = build / "golden"
    folder.mkdir(exist_ok=True)
    for scene in folder.glob("*.gl*"):
        scene.unlink()
    failures = 0

    def failed(text):
        nonlocal failures
        failures += 1
        print(f"FAILED  {text}")

    for name, scene, options in cases():
        if names and name not in names:
            continue
        golden, picture = HERE / f"{name}.png", folder / f"{name}.png"
        picture.unlink(missing_ok=True)
        if not update and not golden.exists():
            failed(f"{name}: {golden} is missing; make it with tests/golden/update {name}, look at it, and commit it")
            continue
        done = subprocess.run([build / "scumble", "render", scene_file(build, folder, scene), "-o", picture, *OPTIONS, *options],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            failed(f"{name}: exit code {done.returncode}: {done.stderr.strip()}")
            continue
        if update:
            os.replace(picture, golden)
            print(f"made    {golden} ({golden.stat().st_size // 1024} KB): look at it before you commit it")
            continue
        values, problem = difference(build, golden, picture)
        if problem:
            failed(f"{name}: {problem}")
        elif values[0] > TOLERANCE:
            failed(f"{name}: mean FLIP {values[0]:.4f} is above {TOLERANCE} (most {values[1]:.3f}): compare {golden} and "
                   f"{picture}; if the new one is right: tests/golden/update {name}")
        else:
            print(f"passed  {name}: mean FLIP {values[0]:.4f}, most {values[1]:.3f}")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
