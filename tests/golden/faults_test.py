#!/usr/bin/env python3
"""Whether golden pictures would tell: each fault below must be found by the comparison of golden.py, in every golden picture
that it can be put into. Faults are put into the pictures themselves; what is missing from a scene is drawn without it.

    tests/golden/faults_test.py BUILD
"""
import json
import struct
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(HERE), str(HERE.parent / "support")]
import golden  # noqa: E402
from png import encode_png, read_png  # noqa: E402


class Picture:
    def __init__(self, path):
        self.width, self.height, self.channels, self.rows = read_png(path)

    def write(self, path, rows):
        path.write_bytes(encode_png(self.width, self.height, [bytes(row) for row in rows]))

    def pixel(self, x, y):
        at = min(max(x, 0), self.width - 1) * self.channels
        return self.rows[min(max(y, 0), self.height - 1)][at:at + self.channels]


def magenta_square(centre):
    """3 percent of the picture."""
    def fault(picture):
        side = round((0.03 * picture.width * picture.height) ** 0.5)
        left, top = int(centre[0] * (picture.width - side)), int(centre[1] * (picture.height - side))
        paint = bytes([255, 0, 255, 255][:picture.channels])
        rows = [bytearray(row) for row in picture.rows]
        for row in rows[top:top + side]:
            row[left * picture.channels:(left + side) * picture.channels] = paint * side
        return rows
    return fault


def shifted(dx, dy):
    return lambda p: [b"".join(p.pixel(x - dx, y - dy) for x in range(p.width)) for y in range(p.height)]


def darker(picture):
    """By 5 percent, as the file's values go; alpha stays."""
    scaled = bytes(round(0.95 * v) for v in range(256))
    rows = [bytearray(row.translate(scaled)) for row in map(bytes, picture.rows)]
    if picture.channels == 4:
        for row, old in zip(rows, picture.rows):
            row[3::4] = old[3::4]
    return rows


def blurred(picture):
    """The mean of three by three pixels."""
    c, rows = picture.channels, []
    for y in range(picture.height):
        around = [picture.rows[min(max(y + dy, 0), picture.height - 1)] for dy in (-1, 0, 1)]
        column = [a + b + d for a, b, d in zip(*around)]
        column = column[:c] + column + column[-c:]
        rows.append(bytes(round((column[i] + column[i + c] + column[i + 2 * c]) / 9) for i in range(picture.width * c)))
    return rows


def exchanged_eyes(picture):
    half = picture.width // 2 * picture.channels
    return [row[half:] + row[:half] for row in picture.rows]


FAULTS = {"a magenta square in the middle": magenta_square((0.5, 0.5)),
          "a magenta square in a corner": magenta_square((0.97, 0.95)),
          "one pixel to the right": shifted(1, 0), "one pixel down": shifted(0, 1),
          "5 percent darker": darker, "a blur": blurred}


def without_nodes(path, target, word):
    """A copy of a .glb whose nodes with that word in their names draw nothing; how many there were."""
    data = path.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    document, count = json.loads(data[20:20 + length]), 0
    hidden = {i for i, node in enumerate(document["nodes"]) if word in node.get("name", "")}
    pending = list(hidden)
    while pending:
        for child in document["nodes"][pending.pop()].get("children", []):
            if child not in hidden:
                hidden.add(child)
                pending.append(child)
    for i in hidden:
        count += document["nodes"][i].pop("mesh", None) is not None
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length:]
    target.write_bytes(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)) + struct.pack("<I4s", len(text), b"JSON")
                       + text + rest)
    return count


# What is not there: (golden picture, what is missing, options that leave it out or the word in names of nodes that go).
MISSING = [("gulls", "every gull", None, "Gull"),
           ("storm", "foam", ["--set", "ocean.paint.foam=0"], None),
           ("wake", "the wake", ["--set", "decorations.*.water.amount=0"], None),
           ("hero", "the tear of edges", ["--set", "warp.amount=0"], None),
           ("sphere-and-pole", "the tear of edges", ["--set", "warp.amount=0"], None),
           ("aovs", "the blur's roundness", ["--set", "blur.radius=8"], None),
           ("aovs-stereo", "the view between the eyes", ["--set", "warp.metatexture.cyclopean=false"], None)]


def main():
    build = Path(sys.argv[1]).resolve()
    cases = {name: (scene, options) for name, scene, options in golden.cases()}
    failures = checks = 0

    def expect_found(name, fault, values):
        nonlocal failures, checks
        checks += 1
        if golden.verdict(values) is None:
            failures += 1
            print(f"FAILED  {name}: nobody would notice {fault}: {golden.told(values)}")

    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name, (scene, options) in cases.items():
            if "--aov" in options:
                continue
            picture, wrong = Picture(HERE / f"{name}.png"), folder / "wrong.png"
            faults = {**FAULTS, **({"exchanged eyes": exchanged_eyes} if "side-by-side" in options else {})}
            for fault, put in faults.items():
                picture.write(wrong, put(picture))
                expect_found(name, fault, golden.difference(build, HERE / f"{name}.png", wrong))
        for name, what, options, word in MISSING:
            scene, usual = cases[name]
            file = golden.scene_file(build, folder, scene)
            if word:
                if without_nodes(file, file, word) == 0:
                    sys.exit(f"no node of {scene} has '{word}' in its name")
            drawn = folder / golden.file_name(name, usual)
            golden.draw(build, file, drawn, [*usual, *(options or [])], check=True)
            expect_found(name, f"that {what} is missing", golden.difference(build, HERE / drawn.name, drawn))
    print(f"{checks} faults, {failures} not found")
    if checks < (len(cases) - 2) * len(FAULTS):
        sys.exit("not all faults were tried")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
