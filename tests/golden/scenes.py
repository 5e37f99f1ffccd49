"""Small scenes for golden pictures, each of one thing that may break: a dictionary from name to glTF text."""
import base64
import json
import math
import struct
import zlib


def png(width, height, pixel):
    """An RGBA PNG; pixel(x, y) gives four bytes."""
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Gltf:
    """Collects meshes into one glTF with its buffer inside."""

    def __init__(self):
        self.data = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "materials": [], "accessors": [], "bufferViews": []}

    def view(self, data):
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, rows, kind, letter="f", component=5126):
        flat = [value for row in rows for value in (row if isinstance(row, (tuple, list)) else (row,))]
        entry = {"bufferView": self.view(struct.pack(f"<{len(flat)}{letter}", *flat)), "componentType": component,
                 "type": kind, "count": len(rows)}
        if kind == "VEC3":
            entry["min"], entry["max"] = ([f(row[i] for row in rows) for i in range(3)] for f in (min, max))
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def material(self, name, color=(1, 1, 1, 1), **more):
        self.json["materials"].append({"name": name, "pbrMetallicRoughness": {"baseColorFactor": color}, **more})
        return len(self.json["materials"]) - 1

    def texture(self, material, file):
        for kind in ("images", "textures"):
            self.json.setdefault(kind, [])
        self.json["images"].append({"bufferView": self.view(file), "mimeType": "image/png"})
        self.json["textures"].append({"source": len(self.json["images"]) - 1})
        self.json["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"] = {
            "index": len(self.json["textures"]) - 1}

    def mesh(self, positions, normals, indices, material, uvs=None, colors=None, translation=(0, 0, 0)):
        attributes = {"POSITION": self.accessor(positions, "VEC3"), "NORMAL": self.accessor(normals, "VEC3")}
        if uvs:
            attributes["TEXCOORD_0"] = self.accessor(uvs, "VEC2")
        if colors:
            attributes["COLOR_0"] = self.accessor(colors, "VEC3")
        primitive = {"attributes": attributes, "indices": self.accessor(indices, "SCALAR", "H", 5123), "material": material}
        self.json["meshes"].append({"primitives": [primitive]})
        self.json["nodes"].append({"mesh": len(self.json["meshes"]) - 1, "translation": translation})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def grid(self, rows, columns, point, material, closed=False, color=None, translation=(0, 0, 0)):
        """point(u, v) gives position and normal, u and v in [0, 1]."""
        coordinates = [(c / columns, r / rows) for r in range(rows + 1) for c in range(columns + 1)]
        points = [point(u, v) for u, v in coordinates]
        indices = []
        for r in range(rows):
            for c in range(columns):
                a, b = r * (columns + 1) + c, (r + 1) * (columns + 1) + c
                indices += [a, b, a + 1, a + 1, b, b + 1]
        self.mesh([p for p, _ in points], [n for _, n in points], indices, material, uvs=coordinates,
                  colors=[color(u, v) for u, v in coordinates] if color else None, translation=translation)

    def quad(self, size, material, translation):
        """Upright, facing +Z, standing on its translation."""
        self.grid(1, 1, lambda u, v: ((size * (u - 0.5), size * (1 - v), 0), (0, 0, 1)), material, translation=translation)

    def floor(self, half, material):
        self.grid(4, 4, lambda u, v: ((half * (2 * u - 1), 0, half * (2 * v - 1)), (0, 1, 0)), material)

    def camera(self, distance, height, fov):
        self.json["cameras"] = [{"name": "View", "type": "perspective", "perspective": {"yfov": fov, "znear": 0.1}}]
        tilt = math.atan2(height - 1, distance) / 2
        self.json["nodes"].append({"camera": 0, "translation": [0, height, distance],
                                   "rotation": [-math.sin(tilt), 0, 0, math.cos(tilt)]})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def text(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        return json.dumps({**self.json, "buffers": [{"byteLength": len(self.data), "uri": uri}]})


def sphere():
    """Round form, ground, and a pole whose shadow falls over both."""
    g = Gltf()
    clay, ground, wood = g.material("Clay", (0.72, 0.35, 0.2, 1)), g.material("Ground", (0.75, 0.68, 0.52, 1)), g.material("Wood", (0.25, 0.2, 0.17, 1))
    g.floor(6, ground)

    def ball(u, v):
        a, e = 2 * math.pi * u, math.pi * v
        n = (math.sin(a) * math.sin(e), math.cos(e), math.cos(a) * math.sin(e))
        return n, n

    g.grid(24, 48, ball, clay, translation=(0.4, 1, 0))

    def pole(u, v):
        a = 2 * math.pi * u
        n = (math.sin(a), 0, math.cos(a))
        return (0.07 * n[0], 3 * (1 - v), 0.07 * n[2]), n

    g.grid(1, 12, pole, wood, translation=(-1.6, 0, 0.9))
    g.camera(9, 3, 0.5)
    return g.text()


def alpha():
    """Opaque, cut out, and see-through, in front of a wall; the last one from behind, too."""
    g = Gltf()
    paper, wall, ground = g.material("Paper", (0.85, 0.8, 0.7, 1)), g.material("Wall", (0.3, 0.42, 0.45, 1)), g.material("Ground", (0.7, 0.65, 0.55, 1))
    cut = g.material("Cut", alphaMode="MASK", alphaCutoff=0.5, doubleSided=True)
    glass = g.material("Glass", (0.8, 0.25, 0.2, 0.45), alphaMode="BLEND", doubleSided=True)
    ring = png(64, 64, lambda x, y: (214, 140, 60, 255 if 12 < math.hypot(x - 31.5, y - 31.5) < 28 else 0))
    g.texture(cut, ring)
    g.floor(6, ground)
    g.quad(7, wall, (0, 0, -2.5))
    g.quad(1.6, paper, (-2.2, 0, 0))
    g.quad(1.6, cut, (0, 0, 0))
    g.quad(1.6, glass, (2.2, 0, 0))
    g.quad(1.6, glass, (1.4, 0, -1))
    g.camera(9, 2.5, 0.5)
    return g.text()


def colours():
    """Vertex colours times a texture, on a rolling sheet."""
    g = Gltf()
    cloth = g.material("Cloth", doubleSided=True)
    g.texture(cloth, png(64, 64, lambda x, y: (235, 225, 205, 255) if (x // 16 + y // 16) % 2 else (150, 120, 110, 255)))

    def sheet(u, v):
        slope = 2.2 * math.cos(2 * math.pi * u)
        length = math.hypot(slope, 1)
        return (5 * u - 2.5, 0.8 + 0.35 * math.sin(2 * math.pi * u), 5 * v - 2.5), (-slope / 5 / length, 1 / length, 0)

    g.grid(24, 48, sheet, cloth, color=lambda u, v: (0.25 + 0.75 * u, 0.35 + 0.5 * v, 1 - 0.8 * u))
    g.camera(8, 4, 0.55)
    return g.text()


SCENES = {"sphere": sphere, "alpha": alpha, "colours": colours}
