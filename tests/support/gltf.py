"""glTF scenes made by scripts: of tests, and of docs/figures."""
import base64
import json
import math
import struct


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

    def stroke(self, positions, radius, color, brush, time=0):
        """On the last mesh: a stroke in space of one colour, thin at its ends."""
        n = len(positions)
        ends = [radius * min(1, 0.2 + 4 * min(k, n - 1 - k) / n) for k in range(n)]
        attributes = {"POSITION": self.accessor(positions, "VEC3"), "COLOR_0": self.accessor([color] * n, "VEC4"),
                      "_RADIUS": self.accessor(ends, "SCALAR"), "_TIME": self.accessor([time + 0.01 * k for k in range(n)], "SCALAR")}
        self.json["meshes"][-1]["primitives"].append({"attributes": attributes, "mode": 3, "extras": {"scumble_brush": brush}})

    def grid(self, rows, columns, point, material, color=None, translation=(0, 0, 0), repeat=(1, 1)):
        """point(u, v) gives position and normal, u and v in [0, 1]; repeat: units of texture coordinates along u and v."""
        coordinates = [(c / columns, r / rows) for r in range(rows + 1) for c in range(columns + 1)]
        points = [point(u, v) for u, v in coordinates]
        indices = []
        for r in range(rows):
            for c in range(columns):
                a, b = r * (columns + 1) + c, (r + 1) * (columns + 1) + c
                indices += [a, b, a + 1, a + 1, b, b + 1]
        self.mesh([p for p, _ in points], [n for _, n in points], indices, material,
                  uvs=[(u * repeat[0], v * repeat[1]) for u, v in coordinates],
                  colors=[color(u, v) for u, v in coordinates] if color else None, translation=translation)

    def ball(self, radius, material, rows=32, columns=64, **more):
        def point(u, v):
            a, e = 2 * math.pi * u, math.pi * v
            n = (math.sin(a) * math.sin(e), math.cos(e), math.cos(a) * math.sin(e))
            return tuple(radius * x for x in n), n

        self.grid(rows, columns, point, material, **more)

    def torus(self, ring, tube, material, rows=32, columns=96, **more):
        """Upright, around the axis z."""
        def point(u, v):
            a, e = 2 * math.pi * u, -2 * math.pi * v
            n = (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))
            r = ring + tube * math.cos(e)
            return (r * math.cos(a), r * math.sin(a), tube * math.sin(e)), n

        self.grid(rows, columns, point, material, **more)

    def lathe(self, profile, material, columns=48, **more):
        """Turned around the axis y; profile: (radius, height) from the top down."""
        def point(u, v):
            at = min(int(v * (len(profile) - 1)), len(profile) - 2)
            (r0, y0), (r1, y1) = profile[at], profile[at + 1]
            t, a = v * (len(profile) - 1) - at, 2 * math.pi * u
            length = math.hypot(r1 - r0, y1 - y0)
            n = ((y0 - y1) / length, (r1 - r0) / length)
            r = r0 + t * (r1 - r0)
            return (r * math.sin(a), y0 + t * (y1 - y0), r * math.cos(a)), (n[0] * math.sin(a), n[1], n[0] * math.cos(a))

        self.grid(len(profile) - 1, columns, point, material, **more)

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
