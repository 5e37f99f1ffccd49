#!/usr/bin/env python3
"""From the start of the process to the finished PNG: what a person waits for a still picture.

    bench/start_to_picture.py SCENE... [--runs N] [--json FILE] [--program FILE] [-- OPTION...]

Each scene is rendered once to warm up (disk and pipeline cache), then N times; the table gives the median, the fastest
and the slowest run, and the largest peak of resident memory. Options after -- go to `scumble render`. With --stats of the program, its
own times of each step are kept in the JSON (those of the median run).
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
from surroundings import head, parse  # noqa: E402

PNG_END = b"\x00\x00\x00\x00IEND\xaeB`\x82"


def run_once(command):
    """Wall seconds, peak resident bytes, and what went wrong if anything did."""
    with tempfile.TemporaryFile() as messages:
        begin = time.perf_counter()
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=messages, stderr=messages)
        # wait4 tells the peak of this one child; resource.getrusage would tell that of the largest so far.
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.perf_counter() - begin
        process.returncode = os.waitstatus_to_exitcode(status)
        messages.seek(0)
        text = messages.read().decode(errors="replace").strip()
    problem = f"exit code {process.returncode}: {text}" if process.returncode else None
    return seconds, usage.ru_maxrss * 1024, problem


def is_whole_png(path):
    try:
        return path.read_bytes()[-12:] == PNG_END
    except OSError:
        return False


def measure(program, scene, runs, options):
    with tempfile.TemporaryDirectory(prefix="scumble bench ") as folder:
        picture, stats = Path(folder) / "picture.png", Path(folder) / "stats.json"
        command = [program, "render", scene, "-o", str(picture), "--size", "1280x720", "--quiet", "--stats", str(stats)]
        command += options
        samples = []
        for run in range(runs + 1):
            picture.unlink(missing_ok=True)
            seconds, peak, problem = run_once(command)
            if problem is None and not is_whole_png(picture):
                problem = "it wrote no whole PNG"
            if problem:
                return {"scene": scene, "problem": problem}
            if run > 0:
                steps = json.loads(stats.read_text()) if stats.exists() else None
                samples.append((seconds, peak, steps))
    seconds = [s[0] for s in samples]
    middle = sorted(samples, key=lambda s: s[0])[len(samples) // 2]
    return {
        "scene": scene,
        "bytes": os.path.getsize(scene),
        "medianSeconds": statistics.median(seconds),
        "fastestSeconds": min(seconds),
        "slowestSeconds": max(seconds),
        "peakResidentBytes": max(s[1] for s in samples),
        "seconds": seconds,
        "stats": middle[2],
    }


def main():
    parser = argparse.ArgumentParser(
        description=__doc__.splitlines()[0],
        epilog="example: bench/start_to_picture.py Duck.glb --runs 9 --json duck.json -- --device cpu",
    )
    parser.add_argument("--runs", type=int, default=7, help="measured runs of each scene (default 7)")
    chosen, options = parse(parser)
    if chosen.runs < 1:
        parser.error("--runs must be at least 1")

    report = head(chosen.program, options)
    print(f"{'scene':40} {'median s':>9} {'fastest':>9} {'slowest':>9} {'peak MiB':>9}")
    for scene in chosen.scenes:
        result = measure(chosen.program, scene, chosen.runs, options)
        report["results"].append(result)
        name = os.path.basename(scene)[:40]
        if "problem" in result:
            print(f"{name:40} {result['problem']}")
            continue
        times = [result[k] for k in ("medianSeconds", "fastestSeconds", "slowestSeconds")]
        print(f"{name:40} " + " ".join(f"{t:9.3f}" for t in times) + f" {result['peakResidentBytes'] / 2**20:9.0f}")
    if chosen.json:
        Path(chosen.json).write_text(json.dumps(report, indent=2) + "\n")
    return 1 if any("problem" in r for r in report["results"]) else 0


if __name__ == "__main__":
    sys.exit(main())
