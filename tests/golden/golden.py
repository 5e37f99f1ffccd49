#!/usr/bin/env python3
"""Golden pictures: draws the cases of cases.txt through the program and compares them with the pictures beside it.

    tests/golden/golden.py check  BUILD [NAME...]    fails where a picture looks different; leaves it in BUILD/golden
    tests/golden/golden.py update BUILD [NAME...]    draws the pictures anew (tests/golden/update does it for build/)

How different is told by FLIP (src/film/compare.h), as a person would see it: in the mean, and in the tile of 16 x 16 pixels
that differs most, so that a small thing in one place is found. Drivers round differently, which moves torn edges a little.
faults_test.py tries what the tolerances must find.

A case whose options name an AOV is an EXR file, small, with numbers that nobody looks at: it fails where too many pixels of
one channel differ.
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
if "SCUMBLE_TEST_DEVICE" in os.environ:  # as in the unit tests
    OPTIONS += ["--device", os.environ["SCUMBLE_TEST_DEVICE"]]
# FLIP in the mean and in the worst tile; of an EXR the share of pixels in any channel, and from when on they differ: on the
# driver that the pictures were drawn with, and on others. There, torn edges move: SwiftShader differs by up to 0.021 and 0.11;
# and vertices lie on a coarser grid, by which alone things move by 1/32 of a pixel. Where a palette limits the colours, what
# lies at a threshold turns into another colour altogether: up to 0.034 and, in single tiles, 0.59.
DRAWN_WITH = "llvmpipe"
TOLERANCES, ELSEWHERE = (0.006, 0.06, 0.01, 0.01), (0.03, 0.2, 0.15, 0.05)
LIMITED, LIMITED_ELSEWHERE = {"four-colours", "palette"}, (0.04, 0.65, 0.15, 0.05)
GENERATORS = {"demo": "demo_scene", "room": "henry_room", "still": "still_life"}
BAKED = {"fins": "strokes"}  # from which scene


def cases():
    """(name, scene, options) of each line."""
    result = []
    for number, line in enumerate((HERE / "cases.txt").read_text().splitlines(), 1):
        line = line.partition("#")[0].strip()
        if not line:
            continue
        parts = [part.strip() for part in line.split("|")]
        if len(parts) != 3 or parts[1] not in {*GENERATORS, *BAKED, *scenes.SCENES}:
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
    elif name in BAKED:
        path = folder / f"{name}.glb"
        subprocess.run([build / "scumble", "bake", scene_file(build, folder, BAKED[name]), "-o", path, "--texture", "1024", "--quiet"], check=True)
    else:
        path = folder / f"{name}.gltf"
        path.write_text(scenes.SCENES[name]())
    return path


def draw(build, scene, picture, options, **more):
    """In the picture's folder; options may name a size of their own."""
    usual = OPTIONS[2:] if "--size" in options else OPTIONS
    return subprocess.run([build / "scumble", "render", scene, "-o", picture, *usual, *options], cwd=picture.parent,
                          capture_output=True, text=True, stdin=subprocess.DEVNULL, **more)


def file_name(name, options):
    return f"{name}.exr" if "--aov" in options else f"{name}.png"


def difference(build, golden, picture, limits=TOLERANCES):
    """FLIP in the mean, in the worst tile, in the worst pixel; of an EXR, the share of pixels that differ and in which channel."""
    done = subprocess.run([build / "compare_pictures", golden, picture, str(limits[3])], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{golden}, {picture}: {done.stderr.strip()}")
    words = done.stdout.split()
    return [float(words[0]), words[1]] if len(words) == 2 else [float(word) for word in words]


def told(values):
    if len(values) == 2:
        return "{:.4f} of the pixels differ in {}".format(*values)
    return "FLIP {:.4f}, worst tile {:.3f}, worst pixel {:.3f}".format(*values)


def tolerances(build):
    found = subprocess.run([build / "scumble", "devices"], capture_output=True, text=True, check=True).stdout.splitlines()
    wanted = os.environ.get("SCUMBLE_TEST_DEVICE")
    used = [line for line in found if (wanted in line.split()[:2] or wanted in line if wanted else line.startswith("*"))]
    return TOLERANCES if used and DRAWN_WITH in used[0] else ELSEWHERE


def verdict(values, limits=TOLERANCES):
    """What is wrong with pictures that differ so much; None where nothing is."""
    mean, tile, pixels, _ = limits
    if len(values) == 2:
        return f"more than {pixels}" if values[0] > pixels else None
    if values[0] > mean:
        return f"mean above {mean}"
    return f"a tile above {tile}" if values[1] > tile else None


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
    (folder / "backdrop-picture.png").write_bytes(scenes.backdrop())  # options may name it
    failures, limits = 0, tolerances(build)

    def failed(text):
        nonlocal failures
        failures += 1
        print(f"FAILED  {text}")

    for name, scene, options in cases():
        if names and name not in names:
            continue
        golden, picture = HERE / file_name(name, options), folder / file_name(name, options)
        picture.unlink(missing_ok=True)
        if not update and not golden.exists():
            failed(f"{name}: {golden} is missing; make it with tests/golden/update {name}, look at it, and commit it")
            continue
        done = draw(build, scene_file(build, folder, scene), picture, options)
        if done.returncode != 0:
            failed(f"{name}: exit code {done.returncode}: {done.stderr.strip()}")
            continue
        if update:
            os.replace(picture, golden)
            print(f"made    {golden} ({golden.stat().st_size // 1024} KB): look at it before you commit it")
            continue
        own_limits = LIMITED_ELSEWHERE if limits is ELSEWHERE and name in LIMITED else limits
        values = difference(build, golden, picture, own_limits)
        if problem := verdict(values, own_limits):
            failed(f"{name}: {told(values)}: {problem}: compare {golden} and {picture}; if the new one is right: "
                   f"tests/golden/update {name}")
        else:
            print(f"passed  {name}: {told(values)}")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
