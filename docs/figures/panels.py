"""Pictures as rows of RGB, put together into figures; fields read from EXR files and coloured. Standard library only."""
import struct
import sys
import zlib
from itertools import accumulate
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "tests/support"))
from png import encode_png, read_png  # noqa: E402

GAP = 6  # pixels between panels
WHITE = (255, 255, 255)


class Picture:
    """`rows`: a list of bytes, three a pixel."""

    def __init__(self, width, height, rows=None):
        self.width, self.height = width, height
        self.rows = rows or [bytes(WHITE) * width for _ in range(height)]

    @staticmethod
    def read(path):
        width, height, channels, rows = read_png(path)
        if channels == 4:
            rows = [bytes(b for i, b in enumerate(row) if i % 4 < 3) for row in rows]
        return Picture(width, height, rows)

    @staticmethod
    def of(width, height, color):
        """color(x, y): three bytes."""
        return Picture(width, height, [b"".join(bytes(color(x, y)) for x in range(width)) for y in range(height)])

    def at(self, x, y):
        return self.rows[y][3 * x:3 * x + 3]

    def crop(self, x, y, width, height):
        assert x >= 0 and y >= 0 and x + width <= self.width and y + height <= self.height, (x, y, width, height)
        return Picture(width, height, [row[3 * x:3 * (x + width)] for row in self.rows[y:y + height]])

    def enlarged(self, n):
        rows = [b"".join(row[i:i + 3] * n for i in range(0, len(row), 3)) for row in self.rows]
        return Picture(n * self.width, n * self.height, [row for row in rows for _ in range(n)])

    def halved(self):
        """Means of 2 x 2 pixels."""
        rows = []
        for upper, lower in zip(self.rows[0::2], self.rows[1::2]):
            sums = [a + b for a, b in zip(upper, lower)]
            rows.append(bytes((sums[i + c] + sums[i + 3 + c]) // 4 for i in range(0, 6 * (self.width // 2), 6) for c in range(3)))
        return Picture(self.width // 2, self.height // 2, rows)

    def turned(self):
        """A quarter turn with the clock."""
        return Picture.of(self.height, self.width, lambda x, y: self.at(y, self.height - 1 - x))

    def save(self, path):
        Path(path).write_bytes(encode_png(self.width, self.height, self.rows))


def beside(*panels):
    height = max(panel.height for panel in panels)
    columns = [panel.rows + [bytes(WHITE) * panel.width] * (height - panel.height) for panel in panels]
    gap = bytes(WHITE) * GAP
    return Picture(sum(p.width for p in panels) + GAP * (len(panels) - 1), height, [gap.join(row) for row in zip(*columns)])


def above(*panels):
    width, rows = max(panel.width for panel in panels), []
    for panel in panels:
        rows += [bytes(WHITE) * width] * GAP if rows else []
        rows += [row + bytes(WHITE) * (width - panel.width) for row in panel.rows]
    return Picture(width, len(rows), rows)


def table(panels, columns):
    return above(*(beside(*panels[i:i + columns]) for i in range(0, len(panels), columns)))


# -- Fields

class Field:
    """One layer of an EXR file with 32 bit floats and ZIP compression, as the program writes them; `at(x, y)` is a dictionary
    from channel to value."""

    def __init__(self, path):
        data = Path(path).read_bytes()
        assert data[:4] == struct.pack("<I", 20000630), f"{path} is no EXR"
        at, attributes = 8, {}
        while data[at]:
            name_end = data.index(b"\0", at)
            kind_end = data.index(b"\0", name_end + 1)
            size = struct.unpack_from("<I", data, kind_end + 1)[0]
            attributes[data[at:name_end].decode()] = data[kind_end + 5:kind_end + 5 + size]
            at = kind_end + 5 + size
        x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
        self.width, self.height = x1 - x0 + 1, y1 - y0 + 1
        names, i, listed = [], 0, attributes["channels"]
        while listed[i]:
            end = listed.index(b"\0", i)
            assert struct.unpack_from("<I", listed, end + 1)[0] == 2, "not 32 bit floats"
            names.append(listed[i:end].decode())
            i = end + 17
        lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
        self.channels = {name.rpartition(".")[2]: [None] * self.height for name in names}
        blocks = (self.height + lines - 1) // lines
        for offset in struct.unpack_from(f"<{blocks}Q", data, at + 1):
            y, size = struct.unpack_from("<iI", data, offset)
            raw = data[offset + 8:offset + 8 + size]
            count = min(lines, self.height - (y - y0))
            whole = 4 * self.width * len(names) * count
            if size != whole:
                raw = bytes(accumulate(zlib.decompress(raw), lambda a, b: (a + b - 128) & 255))
                mixed = bytearray(whole)
                mixed[0::2], mixed[1::2] = raw[:(whole + 1) // 2], raw[(whole + 1) // 2:]
                raw = mixed
            at_line = 0
            for line in range(y - y0, y - y0 + count):
                for channel in self.channels.values():
                    channel[line] = struct.unpack_from(f"<{self.width}f", raw, at_line)
                    at_line += 4 * self.width

    def picture(self, color):
        """color(r, g, b, a), or as many channels as there are: three bytes."""
        channels = [self.channels[name] for name in "RGBA" if name in self.channels]
        return Picture(self.width, self.height, [b"".join(bytes(color(*values)) for values in zip(*(c[y] for c in channels)))
                                                 for y in range(self.height)])


def mix(a, b, t):
    return tuple(round(x + (y - x) * t) for x, y in zip(a, b))


def histogram(picture, width, height, bins=64, full=0.12):
    """Of the red channel of its pixels; a bar of full height holds the share `full` of them or more."""
    counts = [0] * bins
    for row in picture.rows:
        for value in row[::3]:
            counts[value * bins // 256] += 1
    tops = [height - 1 - round((height - 6) * min(count / (full * picture.width * picture.height), 1)) for count in counts]
    return Picture.of(width, height, lambda x, y: (70, 84, 110) if y > tops[x * bins // width] or y == height - 1 else (240, 240, 240))
