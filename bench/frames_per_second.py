#!/usr/bin/env python3
"""Frames a second of a sequence, beside what the GPU's passes alone would allow.

    bench/frames_per_second.py SCENE... [--frames N] [--film] [--json FILE] [--program FILE] [-- OPTION...]

Each scene is rendered once to warm up (disk and pipeline cache), then --frames frames of 1280 x 720 as PNGs (with --film as
one MP4) are rendered and written. The yardstick is the sum of the GPU's passes in the same run; "above" is how much longer
the whole took, from the first frame's preparation to the last file. Options after -- go to `scumble render`.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
from surroundings import parse, surroundings  # noqa: E402


def render(program, scene, output, frames, stats, options):
    command = [program, "render", scene, "-o", str(output), "--frames", f"0..{frames - 1}", "--size", "1280x720", "--quiet",
               "--stats", str(stats), *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"exit code {done.returncode}: {done.stderr.strip()}")
    return json.loads(stats.read_text())


def measure(program, scene, frames, film, options):
    with tempfile.TemporaryDirectory(prefix="scumble bench ") as folder:
        output = Path(folder) / ("film.mp4" if film else "picture.####.png")
        stats = Path(folder) / "stats.json"
        try:
            render(program, scene, output, 2, stats, options)
            report = render(program, scene, output, frames, stats, options)
        except RuntimeError as problem:
            return {"scene": os.path.basename(scene), "problem": str(problem)}
    gpu = sum(frame["gpuMilliseconds"] for frame in report["frames"])
    # The first frame builds the scene's data and the pipelines.
    later = report["frames"][1:]

    def median(key):
        return statistics.median(frame[key] for frame in later)

    return {
        "scene": os.path.basename(scene),
        "frames": frames,
        "film": film,
        "framesPerSecond": 1000 * frames / report["renderMilliseconds"],
        "wallMilliseconds": report["renderMilliseconds"],
        "gpuSumMilliseconds": gpu,
        "above": report["renderMilliseconds"] / gpu - 1,
        "gpuMilliseconds": median("gpuMilliseconds"),
        "cpuMilliseconds": median("cpuMilliseconds"),
        "readbackMilliseconds": median("readbackMilliseconds"),
        "writeMilliseconds": report["writeMilliseconds"] / frames,
        "triangles": report["frames"][0]["triangles"],
        "drawCalls": report["frames"][0]["drawCalls"],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", type=int, default=48, help="default 48")
    parser.add_argument("--film", action="store_true", help="an MP4 instead of PNGs")
    chosen, options = parse(parser)
    if chosen.frames < 2:
        parser.error("--frames must be at least 2")

    report = surroundings(chosen.program, options)
    print(f"{'scene':32} {'fps':>7} {'above':>7} {'GPU ms':>8} {'CPU ms':>8} {'back ms':>8} {'write ms':>8}")
    for scene in chosen.scenes:
        result = measure(chosen.program, scene, chosen.frames, chosen.film, options)
        report["results"].append(result)
        name = result["scene"][:32]
        if "problem" in result:
            print(f"{name:32} {result['problem']}")
            continue
        print(f"{name:32} {result['framesPerSecond']:7.2f} {100 * result['above']:6.1f}% " + " ".join(
            f"{result[key]:8.2f}" for key in ("gpuMilliseconds", "cpuMilliseconds", "readbackMilliseconds",
                                              "writeMilliseconds")))
    if chosen.json:
        Path(chosen.json).write_text(json.dumps(report, indent=2) + "\n")
    return 1 if any("problem" in r for r in report["results"]) else 0


if __name__ == "__main__":
    sys.exit(main())
