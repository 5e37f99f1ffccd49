#!/usr/bin/env python3
"""Paintings and their fins, side by side: what fins cost, and what is lost (paper 003, Table 1).

    bench/paintings.py SUBJECT... [--views 24] [--size 960x720] [--away 1] [--pictures FOLDER] [--json FILE] [--program FILE] [-- OPTION...]

A subject is a painting (.tilt, .apa), or a mesh that is painted first: a file, options of `scumble paint`, and after a colon
those of `scumble bake`, as one word: 'cat.glb --style fur --splats 200000 : --texture 2048'. Strokes themselves and fins are
drawn from --views places all around, evenly, which the bake knows nothing of, at --away times the distance from which it
fills the picture. "ms" is what the paint alone takes, sorted and drawn: the median over views of the median over frames (`scumble bench`).
Frames a second are those of the GPU's passes together. FLIP is what a person would see of the difference, in the mean over the
picture and in its worst tile of 16 x 16 pixels, as medians over views, and at the most. Options after -- go to `scumble render`
and `scumble bench`.
"""
import argparse
import json
import math
import os
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
from surroundings import head, parse  # noqa: E402

FIELD = 34  # degrees
PASSES = {"order", "painting-order", "painting"}
RUNS = {"strokes": 3, "fins": 9}  # of each view


def run(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(map(str, command[:3]))} ...: exit code {done.returncode}: {done.stderr.strip()[-300:]}")
    return done.stdout + done.stderr


def made(program, subject, folder):
    """The painting's file, the fins', and numbers of both."""
    painting, _, bake = subject.partition(":")
    source, *options = shlex.split(painting)
    name, strokes = Path(source).stem, source
    numbers = {"subject": name}
    if Path(source).suffix in (".glb", ".gltf"):
        strokes = folder / f"{name}.glb"
        start = time.perf_counter()
        run([program, "paint", source, "-o", strokes, *options])
        numbers["paintSeconds"] = time.perf_counter() - start
    elif options:
        raise RuntimeError(f"{name} is a painting already; options of the bake stand after a colon")
    fins = folder / f"{name}.fins.glb"
    start = time.perf_counter()
    text = run([program, "bake", strokes, "-o", fins, *shlex.split(bake)])
    numbers["bakeSeconds"] = time.perf_counter() - start
    found = re.search(r"(\d+) fins, (\d+) triangles and a texture of (\d+) x (\d+) for (\d+) splats", text)
    left = re.search(r"(\d+) splats lie too far", text)
    numbers.update(zip(("fins", "triangles", "textureWidth", "textureHeight"), map(int, found.groups())))
    numbers["splatsLeftOut"] = int(left.group(1)) if left else 0
    numbers["splats"] = int(found.group(5)) + numbers["splatsLeftOut"]
    numbers["paintingBytes"], numbers["finsBytes"] = os.path.getsize(strokes), os.path.getsize(fins)
    return strokes, fins, numbers


def places(program, strokes, count, away):
    """Eyes and what they look at: a spiral over a sphere."""
    bounds = json.loads(run([program, "info", strokes, "--json"]))["bounds"]
    middle = [(a + b) / 2 for a, b in zip(bounds["min"], bounds["max"])]
    radius = math.dist(bounds["min"], bounds["max"]) / 2
    distance = away * 0.75 * radius / math.sin(math.radians(FIELD / 2))  # it fills the picture
    for i in range(count):
        y = 1 - (2 * i + 1) / count
        around = i * math.pi * (3 - math.sqrt(5)) + 0.3
        level = math.sqrt(1 - y * y)
        way = (level * math.cos(around), y, level * math.sin(around))
        yield [m + distance * w for m, w in zip(middle, way)], middle


def draw(program, scene, picture, eye, target, runs, size, options):
    # Timed apart from the drawing of the picture, the saving of which would take one of few cores.
    view = [scene, "--size", size, "--fov", FIELD, "--eye", ",".join(map(str, eye)), "--target", ",".join(map(str, target)),
            "--set", "ground.mode=off", *options]
    run([program, "render", "-o", picture, "--quiet", *view])
    timed = picture.with_suffix(".json")
    run([program, "bench", "--runs", runs, "--json", timed, *view])
    report = json.loads(timed.read_text())
    return {"picture": picture, "device": report["device"], "frame": report["frameMilliseconds"],
            "paint": sum(p["milliseconds"] for p in report["passes"] if p["name"] in PASSES)}


def compared(chosen, options, subject, folder):
    program, pictures = chosen.program, Path(chosen.pictures or folder)
    pictures.mkdir(parents=True, exist_ok=True)
    strokes, fins, numbers = made(program, subject, folder)
    drawn, flips = {"strokes": [], "fins": []}, []
    for number, (eye, target) in enumerate(places(program, strokes, chosen.views, chosen.away)):
        for kind, scene in (("strokes", strokes), ("fins", fins)):
            drawn[kind].append(draw(program, scene, pictures / f"{numbers['subject']}-{number:02}-{kind}.png", eye, target, RUNS[kind],
                                    chosen.size, options))
        flips.append([float(word) for word in run([Path(program).parent / "compare_pictures", drawn["strokes"][-1]["picture"],
                                                   drawn["fins"][-1]["picture"], "0"]).split()[:2]])
    for kind, each in drawn.items():
        numbers[f"{kind}Milliseconds"] = statistics.median(view["paint"] for view in each)
        numbers[f"{kind}FramesPerSecond"] = 1000 / statistics.median(view["frame"] for view in each)
    numbers["faster"] = numbers["strokesMilliseconds"] / numbers["finsMilliseconds"]
    for at, kind in enumerate(("flip", "worstTile")):
        values = [flip[at] for flip in flips]
        numbers[kind] = {"median": statistics.median(values), "most": max(values)}
    return {**numbers, "device": drawn["fins"][0]["device"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--views", type=int, default=24)
    parser.add_argument("--size", default="960x720", metavar="WxH")
    parser.add_argument("--away", type=float, default=1)
    parser.add_argument("--pictures", metavar="FOLDER", help="keep the pictures there")
    chosen, options = parse(parser)
    report = {**head(chosen.program, options), "views": chosen.views, "size": chosen.size, "away": chosen.away}
    print(f"{'painting':18} {'splats':>8} {'triangles':>9} {'bake, s':>8} {'strokes, ms':>11} {'fins, ms':>8} {'faster':>6} {'FLIP':>6} {'tile':>6}")
    for subject in chosen.scenes:
        with tempfile.TemporaryDirectory(prefix="scumble paintings ") as folder:
            try:
                result = compared(chosen, options, subject, Path(folder))
            except RuntimeError as problem:
                sys.exit(str(problem))
        report["results"].append(result)
        print(f"{result['subject'][:18]:18} {result['splats']:8} {result['triangles']:9} {result['bakeSeconds']:8.1f} "
              f"{result['strokesMilliseconds']:11.2f} {result['finsMilliseconds']:8.2f} {result['faster']:6.1f} "
              f"{result['flip']['median']:6.3f} {result['worstTile']['median']:6.3f}", flush=True)
    if chosen.json:
        Path(chosen.json).write_text(json.dumps(report, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
