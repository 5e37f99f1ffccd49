#!/usr/bin/env python3
"""docs/figures/make.py still works: one figure, very small; and page, folder and script agree on which figures there are.
docs/pictures/looks.py too, and README.md tells of all looks that ship, in its order.

    tests/figures_test.py PROGRAM
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/support"))
sys.path.insert(0, str(ROOT / "docs/figures"))
from panels import GAP  # noqa: E402
from png import read_png  # noqa: E402

LOOKS_APART = 8  # of 255


def make(*arguments):
    return subprocess.run([sys.executable, ROOT / "docs/figures/make.py", *arguments], capture_output=True, text=True, check=True).stdout


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    listed = make("--list").split()
    shown = re.findall(r"\]\(figures/([\w-]+)\.png\)", (ROOT / "docs/figures.md").read_text(encoding="utf-8"))
    there = [path.stem for path in (ROOT / "docs/figures").glob("*.png")]
    assert sorted(listed) == sorted(shown) == sorted(there), f"script {sorted(listed)}, page {sorted(shown)}, folder {sorted(there)}"
    with tempfile.TemporaryDirectory() as folder:
        make(sys.argv[1], "breakup", "--small", "--out", folder)
        width, height, _, rows = read_png(Path(folder) / "breakup.png")
    assert width > 250 and height == 100, (width, height)
    assert len({row[i:i + 3] for row in rows for i in range(0, len(row), 3)}) > 50, "hardly anything in the picture"
    build = Path(sys.argv[1]).resolve().parent
    looks = [line.split(None, 1) for line in subprocess.run([sys.argv[1], "looks"], capture_output=True, text=True, check=True).stdout.splitlines()]
    told = re.findall(r"^\| `([\w-]+)` \| (.*) \|$", (ROOT / "README.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert [tuple(look) for look in looks] == told, f"`scumble looks` says {looks}, README.md {told}"
    with tempfile.TemporaryDirectory() as folder:
        sheet = Path(folder) / "looks.png"
        subprocess.run([sys.executable, ROOT / "docs/pictures/looks.py", build, "--out", sheet, "--size", "64x36"], capture_output=True, check=True)
        width, height, channels, rows = read_png(sheet)
    columns, down = 2, (len(looks) + 1) // 2
    assert (width - 64 * columns, height - 36 * down) == (GAP * (columns - 1), GAP * (down - 1)), (width, height)
    # At first sight: the mean difference of two panels, of 255. Those that show another scene differ anyway.
    panels = [b"".join(rows[(36 + GAP) * (i // columns) + y][channels * (64 + GAP) * (i % columns):][:channels * 64] for y in range(36))
              for i in range(len(looks))]
    for i, one in enumerate(panels):
        for j, other in enumerate(panels[:i]):
            apart = sum(abs(a - b) for a, b in zip(one, other)) / len(one)
            assert apart > LOOKS_APART, f"{looks[i][0]} and {looks[j][0]} look alike: {apart:.1f} of 255 apart"
    print(f"looks: {len(looks)}, and their sheet can be drawn")
    print(f"figures: {len(listed)}, and breakup can be drawn")


if __name__ == "__main__":
    main()
