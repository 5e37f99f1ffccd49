"""PNG files of 8 bits, written and read with nothing but the standard library."""
import struct
import zlib
from pathlib import Path


def encode_png(width, height, rows):
    """The bytes of a PNG; rows are bytes, RGB or RGBA. Each row is stored as it is or as differences to its left or
    upper neighbours, whichever has the smaller sum."""
    channels = len(rows[0]) // width
    packed, before = [], bytes(width * channels)
    for row in rows:
        left = bytes(channels) + row[:-channels]
        choices = [row, bytes((a - b) & 255 for a, b in zip(row, left)), bytes((a - b) & 255 for a, b in zip(row, before))]
        kind = min(range(3), key=lambda i: sum(min(byte, 256 - byte) for byte in choices[i]))
        packed.append(bytes([kind]) + choices[kind])
        before = row

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(b"".join(packed), 9)) + chunk(b"IEND", b""))


def make_png(width, height, pixel):
    """A PNG whose pixel(x, y) gives three or four bytes."""
    return encode_png(width, height, [b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height)])


def read_png(path):
    """Width, height, channels and rows of an 8 bit PNG."""
    data = Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG"
    width, height, depth, color = struct.unpack(">IIBB", data[16:26])
    assert depth == 8 and color in (2, 6), (depth, color)
    channels = {2: 3, 6: 4}[color]
    packed, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, rows, before = zlib.decompress(packed), [], bytearray(width * channels)
    stride = width * channels + 1
    for y in range(height):
        kind, row = raw[y * stride], bytearray(raw[y * stride + 1:(y + 1) * stride])
        for i in range(len(row) if kind else 0):
            a = row[i - channels] if i >= channels else 0
            b = before[i]
            c = before[i - channels] if i >= channels else 0
            if kind == 1:
                row[i] = (row[i] + a) & 255
            elif kind == 2:
                row[i] = (row[i] + b) & 255
            elif kind == 3:
                row[i] = (row[i] + (a + b) // 2) & 255
            elif kind == 4:
                p = a + b - c
                pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
                row[i] = (row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
        rows.append(bytes(row))
        before = row
    return width, height, channels, rows
