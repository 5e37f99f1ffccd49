#!/usr/bin/env python3
"""Frames a second of a sequence, beside what the GPU's passes alone would allow.

    bench/frames_per_second.py SCENE... [--frames N] [--runs N] [--film] [--json FILE] [--program FILE] [-- OPTION...]

Each scene is rendered once to warm up (disk and pipeline cache), then --runs times --frames frames of 1280 x 720 as PNGs
(with --film as one MP4) are rendered and written. The yardstick is the sum of the GPU's passes in the same run; "above" is
how much longer the whole took, from the first frame's preparation to the last file. The table gives medians over the runs,
and the least and the most frames a second. Options after -- go to `scumble render`.
"""
import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
from surroundings import head, parse  # noqa: E402


def render(program, scene, output, frames, stats, options):
    command = [program, "render", scene, "-o", str(output), "--frames", f"0..{frames - 1}", "--size", "1280x720", "--quiet",
               "--stats", str(stats), *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"exit code {done.returncode}: {done.stderr.strip()}")
    return json.loads(stats.read_text())


# Of each run; the report has their medians, and the least and the most of them in "spread".
MEASURED = ["framesPerSecond", "wallMilliseconds", "gpuSumMilliseconds", "above", "gpuMilliseconds", "cpuMilliseconds",
            "readbackMilliseconds", "writeMilliseconds"]


def numbers_of(report, frames):
    """What one run of `scumble render` says of itself."""
    gpu = sum(frame["gpuMilliseconds"] for frame in report["frames"])
    # The first frame builds the scene's data and the pipelines.
    later = report["frames"][1:]

    def median(key):
        return statistics.median(frame[key] for frame in later)

    return {
        "framesPerSecond": 1000 * frames / report["renderMilliseconds"],
        "wallMilliseconds": report["renderMilliseconds"],
        "gpuSumMilliseconds": gpu,
        "above": report["renderMilliseconds"] / gpu - 1,
        "gpuMilliseconds": median("gpuMilliseconds"),
        "cpuMilliseconds": median("cpuMilliseconds"),
        "readbackMilliseconds": median("readbackMilliseconds"),
        "writeMilliseconds": report["writeMilliseconds"] / frames,
    }


def measure(program, scene, frames, runs, film, options):
    measured = []
    with tempfile.TemporaryDirectory(prefix="scumble bench ") as folder:
        stats = Path(folder) / "stats.json"
        try:
            for run in range(runs + 1):
                # In a folder of its own: a run that finds its files there already writes over them.
                place = Path(folder) / str(run)
                place.mkdir()
                output = place / ("film.mp4" if film else "picture.####.png")
                report = render(program, scene, output, frames if run else 2, stats, options)
                if run:
                    measured.append(numbers_of(report, frames))
                shutil.rmtree(place)
        except RuntimeError as problem:
            return {"scene": os.path.basename(scene), "problem": str(problem)}
    every = {key: [run[key] for run in measured] for key in MEASURED}
    return {
        "scene": os.path.basename(scene),
        "frames": frames,
        "runs": runs,
        "film": film,
        **{key: statistics.median(values) for key, values in every.items()},
        "spread": {key: {"least": min(values), "most": max(values)} for key, values in every.items()},
        "triangles": report["frames"][0]["triangles"],
        "drawCalls": report["frames"][0]["drawCalls"],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", type=int, default=48, help="default 48")
    parser.add_argument("--runs", type=int, default=3, help="how often each sequence is rendered (default 3)")
    parser.add_argument("--film", action="store_true", help="an MP4 instead of PNGs")
    chosen, options = parse(parser)
    if chosen.frames < 2:
        parser.error("--frames must be at least 2")
    if chosen.runs < 1:
        parser.error("--runs must be at least 1")

    report = head(chosen.program, options)
    print(f"{'scene':32} {'fps':>7} {'least':>7} {'most':>7} {'above':>7} {'GPU ms':>8} {'CPU ms':>8} {'back ms':>8} {'write ms':>8}")
    for scene in chosen.scenes:
        result = measure(chosen.program, scene, chosen.frames, chosen.runs, chosen.film, options)
        report["results"].append(result)
        name = result["scene"][:32]
        if "problem" in result:
            print(f"{name:32} {result['problem']}")
            continue
        spread = result["spread"]["framesPerSecond"]
        print(f"{name:32} {result['framesPerSecond']:7.2f} {spread['least']:7.2f} {spread['most']:7.2f} {100 * result['above']:6.1f}% " + " ".join(
            f"{result[key]:8.2f}" for key in ("gpuMilliseconds", "cpuMilliseconds", "readbackMilliseconds",
                                              "writeMilliseconds")))
    if chosen.json:
        Path(chosen.json).write_text(json.dumps(report, indent=2) + "\n")
    return 1 if any("problem" in r for r in report["results"]) else 0


if __name__ == "__main__":
    sys.exit(main())
