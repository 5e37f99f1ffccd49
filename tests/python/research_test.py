#!/usr/bin/env python3
"""docs/research.md runs as it stands, a quarter as large, and shows what it says.

    PYTHONPATH=BUILD/python tests/python/research_test.py
    --keep FOLDER [--scale N]    leaves the figures there, N times as large (1: as the page says)
"""
import argparse
import os
import re
import tempfile
from pathlib import Path

import scumble

PAGE = Path(__file__).resolve().parents[2] / "docs/research.md"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--scale", type=float, default=0.25)
    arguments = parser.parse_args()
    blocks = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.M | re.S)
    assert len(blocks) > 12, len(blocks)
    for block in blocks[1:]:
        count = sum(1 for line in block.splitlines() if line.strip())
        assert count <= 20, f"{count} lines: {block[:200]}"
    with tempfile.TemporaryDirectory(prefix="scumble research ") as folder:
        os.chdir(arguments.keep or folder)
        ran = {"__name__": "research"}
        for number, block in enumerate(blocks):
            exec(compile(block, f"{PAGE.name}, block {number}", "exec"), ran)  # the page is ours
            if number == 0:
                ran["scale"] = arguments.scale
        for name in re.findall(r'sheet\("(\w+\.png)"', "".join(blocks)):
            picture = scumble.read_picture(name)[..., :3]
            dark = float((picture.mean(-1) < 0.3).mean())
            assert 0.01 < dark < 0.8, f"{100 * dark:.1f} percent of {name} is dark"

    deviation = ran["deviation"]
    assert deviation["off", 1] < 0.75 * deviation["off", 0.01], deviation
    for mode in ("gaussian", "histogram"):
        assert 0.8 < deviation[mode, 1] / deviation["off", 0.01] < 1.25, deviation
    assert ran["changes"][::2] == [0.0] * 4 and min(ran["changes"][1::2]) > 0, ran["changes"]
    assert ran["apart"]["metatexture"] < 0.6 * ran["apart"]["screen"], ran["apart"]
    reach = ran["reach"]
    assert reach[0, 16] > 0.8 * reach[0, 2] and reach[0.1, 16] < 0.5 * reach[0.1, 2], reach
    assert ran["error"]["metatexture"] < ran["error"]["screen"] and ran["drift"]["metatexture"] < ran["drift"]["object"], (ran["error"], ran["drift"])
    print(f"research: {len(blocks) - 1} figures of the page are drawn")


if __name__ == "__main__":
    main()
