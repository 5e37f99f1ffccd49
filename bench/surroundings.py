"""What benches of the whole program share: their arguments, and what stands at the head of every result."""
import datetime
import os
import platform
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def first_line(path, start):
    try:
        for line in Path(path).read_text().splitlines():
            if line.startswith(start):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return None


def output_of(command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return None


def machine():
    return {
        "system": platform.platform(),
        "processor": first_line("/proc/cpuinfo", "model name") or platform.processor(),
        "processors": len(os.sched_getaffinity(0)),
        "memory": first_line("/proc/meminfo", "MemTotal"),
        "loadBefore": os.getloadavg()[0],
    }


def surroundings():
    """When, of what and where something was measured."""
    return {
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "revision": output_of(["git", "describe", "--always", "--dirty", "--abbrev=12"]),
        "machine": machine(),
    }


def head(program, options):
    return {**surroundings(), "program": output_of([program, "--version"]), "options": options, "results": []}


def parse(parser):
    """The arguments, with those that all benches have; and the options after --, for `scumble render`."""
    parser.add_argument("scenes", nargs="+", metavar="SCENE")
    parser.add_argument("--json", metavar="FILE", help="also write the results there")
    parser.add_argument("--program", default=str(ROOT / "build" / "scumble"), help="default: build/scumble")
    arguments, options = sys.argv[1:], []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, options = arguments[:at], arguments[at + 1 :]
    chosen = parser.parse_args(arguments)
    if not os.access(chosen.program, os.X_OK):
        parser.error(f"{chosen.program} is not there; build it first (./demo)")
    return chosen, options
