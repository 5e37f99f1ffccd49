#!/usr/bin/env python3
"""How far a watercolour's paper goes along with the subject, for each of `watercolor.paperMotion` and several ways of the
camera: pixels a picture, at 540 lines.

    bench/paper_motion.py SCENE... [--program FILE] [--json FILE] [-- OPTION...]

Needs numpy (apt-get install python3-numpy) and ffmpeg. The paper alone is painted, its relief strong, and what of its shift
between two pictures is found by phase correlation; the subject's shift is that of the middle of its silhouette.
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
from surroundings import head, parse  # noqa: E402

WIDTH, HEIGHT, PICTURES = 960, 540, 5
DISTANCE = 6.0  # metres


def rotated(x, z, degrees):
    a = math.radians(degrees)
    return x * math.cos(a) + z * math.sin(a), z * math.cos(a) - x * math.sin(a)


# Eye and target of picture i.
def turn(i):
    x, z = rotated(0, -DISTANCE, 0.5 * i)
    return (0, 0, DISTANCE), (x, 0, DISTANCE + z)


def sideways(i):
    return (0.05 * i, 0, DISTANCE), (0.05 * i, 0, 0)


def orbit(i):
    x, z = rotated(0, DISTANCE, i)
    return (x, 0, z), (0, 0, 0)


def nearer(i):
    return (0, 0, DISTANCE * 0.99**i), (0, 0, 0)


WAYS = {"turns by 0.5 degrees": turn, "goes 5 cm to the side": sideways, "orbits by 1 degree": orbit, "comes 1 % nearer": nearer}
MOTIONS = ["screen", "turn", "subject"]
PAPER = ["--look", "watercolour", "--set", "watercolor.strength=0", "--set", "watercolor.relief=2", "--set", "watercolor.margin=0",
         "--set", "watercolor.bare=1", "--set", "watercolor.bareFrom=0", "--set", "ink.shown=off"]


SUBJECT = ["--look", "age-of-sail", "--background", "transparent", "--set", "ground.mode=off", "--set", "warp.amount=0"]


def picture(program, scene, view, path, *options):
    eye, target = (",".join(f"{v:.6f}" for v in place) for place in view)
    subprocess.run([program, "render", scene, "-o", path, "--size", f"{WIDTH}x{HEIGHT}", "--eye=" + eye, "--target=" + target,
                    "--quiet", *options], check=True)
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgba", "-"], check=True,
                         capture_output=True).stdout
    return np.frombuffer(raw, np.uint8).reshape(HEIGHT, WIDTH, 4).astype(float)


def shift(first, second):
    """Of the second picture, pixels, to a tenth or so."""
    window = np.outer(np.hanning(HEIGHT), np.hanning(WIDTH))
    a, b = (np.fft.rfft2((p - p.mean()) * window) for p in (first, second))
    cross = b * a.conj()
    surface = np.fft.irfft2(cross / np.maximum(abs(cross), 1e-9) * np.exp(-0.5 * ((np.fft.fftfreq(HEIGHT)[:, None] / 0.1)**2 +
                                                                                  (np.fft.rfftfreq(WIDTH) / 0.1)**2)), (HEIGHT, WIDTH))
    y, x = np.unravel_index(surface.argmax(), surface.shape)

    def fine(before, here, after):
        return 0.5 * (before - after) / (before - 2 * here + after)

    dy = fine(surface[y - 1, x], surface[y, x], surface[(y + 1) % HEIGHT, x])
    dx = fine(surface[y, x - 1], surface[y, x], surface[y, (x + 1) % WIDTH])
    return np.array([(x + dx + WIDTH / 2) % WIDTH - WIDTH / 2, (y + dy + HEIGHT / 2) % HEIGHT - HEIGHT / 2])


def middle(image):
    alpha = image[..., 3]
    return np.array([(alpha * np.arange(WIDTH)).sum(), (alpha * np.arange(HEIGHT)[:, None]).sum()]) / alpha.sum()


def measured(program, scene, options):
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "picture.png")
        for way, view in WAYS.items():
            subject = [middle(picture(program, scene, view(i), path, *SUBJECT, *options))
                       for i in range(PICTURES)]
            moved = np.mean(np.diff(subject, axis=0), axis=0)
            results[way] = {"moves": float(np.hypot(*moved))}
            for motion in MOTIONS:
                papers = [picture(program, scene, view(i), path, *PAPER, "--set", f"watercolor.paperMotion={motion}", *options)
                          for i in range(PICTURES)]
                slips = [np.hypot(*(shift(a[..., 1], b[..., 1]) - moved)) for a, b in zip(papers, papers[1:])]
                results[way][motion] = float(np.mean(slips))
    print(f"{'the camera':24}{'subject moves':>15}" + "".join(f"{'slip: ' + motion:>15}" for motion in MOTIONS))
    for way, row in results.items():
        print(f"{way:24}{row['moves']:15.2f}" + "".join(f"{row[motion]:15.2f}" for motion in MOTIONS))
    return results


def main():
    chosen, options = parse(argparse.ArgumentParser(description=__doc__.split("\n")[0]))
    report = head(chosen.program, options)
    for scene in chosen.scenes:
        report["results"].append({"scene": Path(scene).name, "size": [WIDTH, HEIGHT], "ways": measured(chosen.program, scene, options)})
    if chosen.json:
        Path(chosen.json).write_text(json.dumps(report, indent=2) + "\n")


if __name__ == "__main__":
    main()
