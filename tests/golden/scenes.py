"""Small scenes for golden pictures, each of one thing that may break: a dictionary from name to glTF text."""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from gltf import Gltf  # noqa: E402
from png import make_png  # noqa: E402


def sphere():
    """Round form, ground, and a pole whose shadow falls over both."""
    g = Gltf()
    clay, ground, wood = g.material("Clay", (0.72, 0.35, 0.2, 1)), g.material("Ground", (0.75, 0.68, 0.52, 1)), g.material("Wood", (0.25, 0.2, 0.17, 1))
    g.floor(6, ground)

    g.ball(1, clay, 24, 48, translation=(0.4, 1, 0))

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
    ring = make_png(64, 64, lambda x, y: (214, 140, 60, 255 if 12 < math.hypot(x - 31.5, y - 31.5) < 28 else 0))
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
    g.texture(cloth, make_png(64, 64, lambda x, y: (235, 225, 205, 255) if (x // 16 + y // 16) % 2 else (150, 120, 110, 255)))

    def sheet(u, v):
        slope = 2.2 * math.cos(2 * math.pi * u)
        length = math.hypot(slope, 1)
        return (5 * u - 2.5, 0.8 + 0.35 * math.sin(2 * math.pi * u), 5 * v - 2.5), (-slope / 5 / length, 1 / length, 0)

    g.grid(24, 48, sheet, cloth, color=lambda u, v: (0.25 + 0.75 * u, 0.35 + 0.5 * v, 1 - 0.8 * u))
    g.camera(8, 4, 0.55)
    return g.text()


def lamps():
    """A dim room: a point light, a spot, something that glows, and colours of a palette to be limited to."""
    g = Gltf()
    wall, ground = g.material("Wall", (0.5, 0.42, 0.4, 1)), g.material("Ground", (0.45, 0.35, 0.25, 1))
    clay, bulb = g.material("Clay", (0.7, 0.3, 0.2, 1)), g.material("Bulb", (1, 0.8, 0.4, 1), emissiveFactor=[1, 0.8, 0.4])
    g.floor(6, ground)
    g.quad(8, wall, (0, 0, -2.5))
    g.torus(0.8, 0.3, clay, translation=(-1.2, 1.1, 0))
    g.lathe([(0, 2), (0.5, 1.7), (0.3, 1), (0.8, 0.3), (0.6, 0)], clay, translation=(1.4, 0, 0.2))
    g.ball(0.15, bulb, 12, 24, translation=(0.1, 1.6, 0.8))
    g.json["extensionsUsed"] = ["KHR_lights_punctual"]
    g.json["extensions"] = {"KHR_lights_punctual": {"lights": [
        {"type": "point", "intensity": 30, "color": [1, 0.8, 0.5]},
        {"type": "spot", "intensity": 60, "color": [0.5, 0.7, 1], "spot": {"outerConeAngle": 0.4}}]}}
    for light, place in ((0, (0.1, 1.6, 0.8)), (1, (2.5, 1.5, 5))):
        g.json["nodes"].append({"translation": place, "extensions": {"KHR_lights_punctual": {"light": light}}})
        g.json["scenes"][0]["nodes"].append(len(g.json["nodes"]) - 1)
    g.camera(9, 2.5, 0.5)
    return g.text()


def strokes():
    """Strokes in space of every brush: on a ball that carries them, and in the air before it and behind it."""
    g = Gltf()
    g.floor(6, g.material("Ground", (0.7, 0.65, 0.55, 1)))
    g.ball(1, g.material("Clay", (0.5, 0.22, 0.12, 1)), 24, 48, translation=(0, 1.2, 0))

    def around(i, height, turn, radius, width, color, brush):
        """A part of a helix on the ball's mesh."""
        rows = []
        for k in range(25):
            a, y = turn + 0.09 * k, height + 0.012 * k
            side = math.sqrt(max(radius * radius - y * y, 0.01))
            rows.append((side * math.sin(a), y, side * math.cos(a)))
        g.stroke(rows, width, color, brush, 0.1 * i)

    for i in range(22):
        shade = 0.35 + 0.03 * i
        around(i, -0.8 + 0.07 * i, 2.4 * i, 1.03 + 0.004 * i, 0.13, (0.9 * shade, 0.5 * shade, 0.25 * shade, 1), "bristles")
    for i in range(6):
        around(30 + i, 0.1 * i, 1.05 * i, 1.1, 0.05, (0.95, 0.85, 0.6, 0.9), "plain")
    g.json["meshes"].append({"primitives": []})
    g.json["nodes"].append({"mesh": len(g.json["meshes"]) - 1})
    g.json["scenes"][0]["nodes"].append(len(g.json["nodes"]) - 1)
    for i, (brush, color) in enumerate((("wash", (0.2, 0.3, 0.6, 0.8)), ("spatter", (0.1, 0.35, 0.2, 1)), ("light", (1, 0.8, 0.3, 1)))):
        z = (1.6, 0.4, -1.5)[i]
        g.stroke([(-2.4 + 0.2 * k, 1.2 + 0.5 * i + 0.4 * math.sin(0.5 * k + i), z + 0.02 * k) for k in range(25)], 0.22, color, brush, 5 + i)
    g.camera(8, 2.2, 0.5)
    return g.text()


def wake():
    """An artist's wake: two strips with teeth that lie on the waves behind a buoy, and a ring around it."""
    g = Gltf()
    buoy, foam = g.material("Buoy", (0.8, 0.2, 0.1, 1)), g.material("Wake", (0.95, 0.95, 0.9, 1), doubleSided=True)
    g.ball(0.9, buoy, rows=16, columns=32, translation=(0, 0.3, 0))
    up = (0, 1, 0)

    def ring(u, v):
        a, r = 2 * math.pi * u, 1.0 + (0.5 + 0.15 * math.sin(10 * math.pi * u)) * v
        return (r * math.cos(a), 0.02, r * math.sin(a)), up

    g.grid(2, 80, ring, foam)
    for side in (-1, 1):
        def strip(u, v, side=side):
            width = (1 - u) * (0.9 + 0.35 * math.sin(30 * u))
            return (1 + 9 * u, 0.02, side * (0.9 + 2.6 * u + width * (v - 0.5))), up

        g.grid(4, 60, strip, foam)
    g.camera(9, 4.5, 0.7)
    return g.text()


SCENES = {"sphere": sphere, "alpha": alpha, "colours": colours, "lamps": lamps, "strokes": strokes, "artists-wake": wake}


def backdrop():
    """A picture for behind everything: a sky, hills with a hard edge, a field with fine rows."""
    def pixel(x, y):
        if y < 24 + 10 * math.sin(x / 17):
            return (150 + y // 2, 180 + y // 3, 215)
        return (96, 120, 70) if (x + 3 * y) % 8 < 5 else (140, 150, 80)

    return make_png(160, 90, pixel)
