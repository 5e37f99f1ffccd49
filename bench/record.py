#!/usr/bin/env python3
"""Runs a command that writes JSON, and adds the date, the revision and the machine to what it writes.

    bench/record.py FILE.json COMMAND...        COMMAND gets `--json FILE` at its end

For `scumble bench`, `scumble measure` and the benches of one technique; the scripts beside this one do so themselves.
Scenes are named without their folders. The pages' tables are made from such files (tests/docs_numbers_test.py --write).
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
from surroundings import surroundings  # noqa: E402


def named(scene):
    return [os.path.basename(each) for each in ([scene] if isinstance(scene, str) else scene)]


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    place, command = Path(sys.argv[1]), sys.argv[2:]
    head = surroundings()
    with tempfile.TemporaryDirectory(prefix="scumble bench ") as folder:
        written = Path(folder) / "result.json"
        code = subprocess.run([*command, "--json", str(written)]).returncode
        if code:
            return code
        report = json.loads(written.read_text())
    if "scene" in report:
        report["scene"] = named(report["scene"])
    command = [os.path.basename(word) if os.sep in word else word for word in command]
    place.write_text(json.dumps({**head, "command": " ".join(command), **report}, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
