#!/usr/bin/env python3
"""Draws the figures of docs/figures.md with the program. Standard library only.

    docs/figures/make.py [PROGRAM] [FIGURE...]     PROGRAM: default build/scumble; FIGURE: all, if none is named
    docs/figures/make.py --list                    the figures' names
    --out FOLDER    where the PNGs go; default: beside this script
    --small         a quarter of the size, for trying

Every figure is a function below, and makes its own scene. docs/figures.md says what is to be seen.
"""
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE))
from panels import WHITE, Field, Picture, above, beside, histogram, mix, table  # noqa: E402  (tests/support is in the path now)
from gltf import Gltf  # noqa: E402
from png import encode_png, make_png  # noqa: E402

INK, PAPER = (52, 62, 84), (233, 226, 211)
FIGURES = {}

# Nothing but the material's own colours.
PLAIN = {"ground.mode": "off", "palette.litTintAmount": 0, "palette.darkest": 0, "palette.lightest": 1, "final.bloom": 0,
         "background.air": 0, "final.lostEdges": 0, "background.skyTones": 0}
CALM = {**PLAIN, "warp.amount": 0, "warp.inflation": 0}


def figure(function):
    FIGURES[function.__name__.replace("_", "-")] = function
    return function


class Studio:
    """Calls the program in a folder of its own."""

    def __init__(self, program, folder, shrink):
        self.program, self.folder, self.shrink = program, Path(folder), shrink

    def put(self, name, content):
        path = self.folder / name
        path.write_bytes(content) if isinstance(content, bytes) else path.write_text(content)
        return str(path)

    def render(self, scene, width, height, knobs, *options, background="#FFFFFF", samples=4):
        """The picture; scene: glTF text. Options as of `scumble render`."""
        sets = [f"--set={path}={str(value).lower() if isinstance(value, bool) else value}" for path, value in knobs.items()]
        command = [self.program, "render", self.put("scene.gltf", scene), "-o", self.folder / "panel.png", "--quiet",
                   "--size", f"{max(width // self.shrink, 16)}x{max(height // self.shrink, 16)}", "--samples", samples,
                   "--background", background, *options, *sets]
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
        name = "panel.left.png" if "separate" in options else "panel.png"
        return Picture.read(self.folder / name)

    def aov(self, name, scene, width, height, knobs, *options, color, **more):
        """A pass's output, coloured."""
        self.render(scene, width, height, knobs, *options, "--aov", name, **more)
        return Field(self.folder / f"panel.{name}.exr").picture(color)

    def size(self, n):
        return n // self.shrink


# -- Parts of scenes

def unlit(gltf, name, color=(0.5, 0.5, 0.5, 1), **more):
    gltf.json["extensionsUsed"] = ["KHR_materials_unlit"]
    return gltf.material(name, color, extensions={"KHR_materials_unlit": {}}, doubleSided=True, **more)


def painted(example, **meta):
    """Knobs that paint an example texture over materials; the same ones for the AOV `metatexture`, which shows the warp's."""
    knobs = {"texture.amount": 1, "texture.blend": "replace", "texture.metatexture.example": example,
             "warp.metatexture.example": example}
    for key, value in meta.items():
        knobs[f"texture.metatexture.{key}"] = knobs[f"warp.metatexture.{key}"] = value
    return {**CALM, **knobs}


def dabs():
    """An example texture: round dabs of three sizes on paper, 256 x 256, the dark share about a half."""
    chance, circles = random.Random(3), []
    for radius, count in ((20, 14), (12, 22), (7, 40)):
        for _ in range(400):
            x, y = chance.randrange(256), chance.randrange(256)
            if count and all(math.hypot((x - a + 128) % 256 - 128, (y - b + 128) % 256 - 128) > radius + r + 3 for a, b, r in circles):
                circles.append((x, y, radius))
                count -= 1

    def pixel(x, y):
        inside = max(r - math.hypot((x - a + 128) % 256 - 128, (y - b + 128) % 256 - 128) for a, b, r in circles)
        return mix(PAPER, INK, min(max(inside + 0.5, 0), 1))

    return encode_png(256, 256, Picture.of(256, 256, pixel).rows)


def waves(half=6):
    """A rolling sheet; its mapping is square in the ground plan."""
    g = Gltf()
    cloth = unlit(g, "Cloth")

    def point(u, v):
        x, z = half * (2 * u - 1), half * (2 * v - 1)
        y = 0.45 * math.sin(1.7 * x + 0.5 * z) + 0.25 * math.sin(2.3 * z - 0.7 * x)
        return (x, y, z), (0, 1, 0)

    g.grid(120, 120, point, cloth)
    return g.text()


def wall(shear=0.0, size=2.0, mapped=1.0):
    """Upright, facing z; v runs down, and `shear` times as far to the right. `mapped`: units of u and v across it."""
    g = Gltf()
    corners = [(-1, 1), (1, 1), (-1, -1), (1, -1)]
    uvs = [(0.5 * mapped * (x + shear * y), -0.5 * mapped * y) for x, y in corners]
    g.mesh([(0.5 * size * x, 0.5 * size * y, 0) for x, y in corners], [(0, 0, 1)] * 4, [0, 2, 1, 1, 2, 3], unlit(g, "Wall"), uvs=uvs)
    return g.text()


FRONT = ("--eye", "0,0,4", "--target", "0,0,0", "--fov", 40)


def band(exponent):
    """The colour of a scale: each whole number has its own hue, fading to the next one's."""
    hues = ((214, 122, 92), (233, 196, 120), (122, 168, 140), (86, 118, 160))
    low = math.floor(exponent)
    return mix(hues[low % 4], hues[(low + 1) % 4], exponent - low)


@figure
def scales(studio):
    """The paper's figure 5."""
    camera = ("--eye", "0,2.0,4.4", "--target", "0,-0.3,0.3", "--fov", 42)
    size = 396, 300
    example = studio.put("dabs.png", dabs())
    look = dict(size=320, skew="off")

    def draw(**meta):
        return studio.render(waves(), *size, painted(example, **{**look, **meta}), *camera)

    def region(exponent_u, exponent_v, q, contrast):
        level = math.floor(4 * q + 0.5) / 4  # n = 4
        return WHITE if contrast == 0 else mix((226, 221, 208), (74, 142, 96) if level < 0 else (190, 78, 66), min(abs(level), 1))

    regions = studio.aov("metatexture", waves(), *size, painted(example, size=320, skewLevels=4), *camera, color=region)
    return table([tile(example, 396, 300, studio), draw(mode="object", tiles=12), draw(blend=0.01),
                  draw(), regions, draw(skew="exact", skewLevels=4)], 3)


def tile(example, width, height, studio):
    """The example texture, repeated at its own size on the screen: 320 pixels at 1080 lines, here at 300."""
    picture, step = Picture.read(example), 256 * 1080 / (320 * 300)
    return Picture.of(studio.size(width), studio.size(height),
                      lambda x, y: picture.at(int(x * step * studio.shrink) % 256, int(y * step * studio.shrink) % 256))


@figure
def gradients(studio):
    """The paper's figure 6."""
    g = Gltf()
    g.ball(1, unlit(g, "Ball"), rows=8, columns=14, repeat=(2, 1))
    camera = ("--eye", "1.2,1.2,-2.3", "--target", "0,0,0", "--fov", 42.5)
    example = studio.put("dabs.png", dabs())
    pictures, fields = [], []
    for source in ("fragment", "smooth"):
        knobs = painted(example, gradients=source, size=260)
        pictures.append(studio.render(g.text(), 420, 420, knobs, *camera))
        fields.append(studio.aov("metatexture", g.text(), 420, 420, knobs, *camera, samples=1,
                                 color=lambda u, v, q, gain: WHITE if gain == 0 else band(u)))
    return table([*fields, *pictures], 2)


@figure
def radial(studio):
    """The paper's section 3.3."""
    example = studio.put("dabs.png", dabs())
    camera = ("--eye", "0,0,1", "--target", "0,0,0", "--fov", 84)
    pictures = [studio.render(wall(size=8, mapped=4), 1194, 800, painted(example, radial=on, size=320, base=1.3, blend=0.2), *camera) for on in (False, True)]

    def by_angle(picture):
        """As the eye has it: pixels of equal angle from the middle; half as large."""
        w, h = picture.width, picture.height
        focal = 0.5 * h / math.tan(math.radians(42))
        step = math.atan(0.5 * w / focal) / (0.25 * w)

        def pixel(x, y):
            dx, dy = x + 0.5 - 0.25 * w, y + 0.5 - 0.25 * h
            away = math.hypot(dx, dy)
            reach = focal * math.tan(min(away * step, 1.5)) / away
            at = math.floor(0.5 * w + dx * reach), math.floor(0.5 * h + dy * reach)
            return picture.at(*at) if 0 <= at[0] < w and 0 <= at[1] < h else WHITE

        return Picture.of(w // 2, h // 2, pixel)

    return table([*(picture.halved() for picture in pictures), *map(by_angle, pictures)], 2)


@figure
def skew(studio):
    """The paper's figure 7."""
    example = studio.put("dabs.png", dabs())
    # A step of straightening that meets this mapping's own, and scales so close that nothing else is left to see.
    look = dict(size=420, base=1.1, skewLevels=3, blend=0.01)
    return beside(*(studio.render(wall(shear=1.0, size=4), 396, 396, painted(example, skew=kind, **look), *FRONT)
                    for kind in ("off", "approximate", "exact")))


@figure
def contour(studio):
    """The paper's figure 8."""
    g = Gltf()
    g.ball(1, unlit(g, "Ball"), 64, 128, repeat=(2, 1))
    example = studio.put("dashes.png", dashes())
    camera = ("--eye", "0,0.9,3", "--target", "0,0,0", "--fov", 42)
    return beside(*(studio.render(g.text(), 597, 480, painted(example, orient=orient, size=260), *camera) for orient in ("off", "contour")))


def dashes():
    """An example texture: horizontal dashes, 256 x 256."""
    chance, lines = random.Random(4), []
    for _ in range(4000):
        x, y = chance.randrange(256), chance.randrange(256)
        if len(lines) < 62 and all(abs((x - a + 128) % 256 - 128) > 52 or abs((y - b + 128) % 256 - 128) > 13 for a, b in lines):
            lines.append((x, y))

    def pixel(x, y):
        inside = max(4 - math.hypot(max(abs((x - a + 128) % 256 - 128) - 17, 0), (y - b + 128) % 256 - 128) for a, b in lines)
        return mix(PAPER, INK, min(max(inside + 0.5, 0), 1))

    return encode_png(256, 256, Picture.of(256, 256, pixel).rows)


@figure
def contrast(studio):
    """The paper's figure 9."""
    columns = []
    two = studio.put("two.png", blotches())
    for example in ("paper", two):
        for mode, blend in (("off", 0.01), ("off", 1), ("gaussian", 1), ("histogram", 1)):
            # Half way between two scales on both axes; without a blend, a whole scale.
            mapped = 8 if blend == 1 else 8 * math.sqrt(2)
            picture = studio.render(wall(mapped=mapped, size=4), 588, 400, painted(example, contrast=mode, blend=blend, skew="off", size=512),
                                    "--eye", "0,0,2", "--target", "0,0,0", "--fov", 40)
            shown = picture.crop(studio.size(50), studio.size(50), studio.size(147), studio.size(100)).enlarged(2)
            columns.append(above(shown, histogram(picture, shown.width, studio.size(80))))
    return table(columns, 4)


def blotches():
    """An example texture of two values: noise against a threshold, 128 x 128."""
    chance, n = random.Random(5), 128
    components = [(chance.randrange(-7, 8), chance.randrange(-7, 8), chance.random() * 7) for _ in range(40)]
    height = [[sum(math.cos(2 * math.pi * (a * x + b * y) / n + c) for a, b, c in components) for x in range(n)] for y in range(n)]
    return encode_png(n, n, Picture.of(n, n, lambda x, y: (40,) * 3 if height[y][x] < 1.5 else (215,) * 3).rows)


# -- Edge Breakup

def curve(points, steps=6):
    """Catmull and Rom's, through all points."""
    result, n = [points[0]], len(points)
    for i in range(n - 1):
        p = [points[min(max(i + k, 0), n - 1)] for k in (-1, 0, 1, 2)]
        for s in range(1, steps + 1):
            t = s / steps
            result.append(tuple(max(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t ** 3), 0)
                                for a, b, c, d in zip(*p)))
    return result


def vessel():
    """A jug on a table."""
    g = Gltf()
    clay, ground = g.material("Clay", (0.62, 0.26, 0.16, 1)), g.material("Table", (0.78, 0.72, 0.6, 1))
    g.lathe(curve([(0.01, 1.6), (0.15, 1.61), (0.33, 1.6), (0.24, 1.42), (0.26, 1.27), (0.52, 1.05), (0.7, 0.75), (0.66, 0.4), (0.5, 0.12),
                   (0.38, 0.01), (0.01, 0)]), clay, columns=96)
    g.torus(0.24, 0.07, clay, translation=(0.48, 1.2, 0))
    g.floor(5, ground)
    return g.text()


def torn(amount, inflation=None, **more):
    """Exaggerated, with the example texture enlarged as much."""
    return {**PLAIN, "light.source": "look", "warp.amount": amount, "warp.inflation": amount if inflation is None else inflation,
            "warp.metatexture.size": 64 * amount, "surface.indication": 0, **more}


def arrows(r, g, b, a):
    """The colour of a warp vector: right is red, down is green, as the example texture has them."""
    return WHITE if a == 0 else tuple(max(0, min(255, round(150 + 8 * x))) for x in (r, g, 0))


@figure
def breakup(studio):
    """The paper's figure 10."""
    camera = ("--eye", "0,1.6,4.2", "--target", "0,0.85,0", "--fov", 30)
    knobs = torn(16)
    size = 296, 400
    final = studio.render(vessel(), *size, knobs, *camera)
    clean = studio.aov("color", vessel(), *size, knobs, *camera, color=srgb)
    field = studio.aov("warp", vessel(), *size, knobs, *camera, color=arrows)
    flat = studio.aov("warp", wall(size=4), size[0] // 2, size[1] // 2, {**knobs, "warp.inflation": 0, "warp.amount": 32},
                      "--eye", "0,0,2", "--target", "0,0,0", "--fov", 40, color=arrows).enlarged(2)
    return beside(flat, field, clean, final)


def srgb(*values):
    return tuple(round(255 * (12.92 * x if x < 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055))
                 for x in (min(max(value, 0), 1) for value in values[:3]))


@figure
def inflation(studio):
    """The paper's figure 11."""
    camera = ("--eye", "0,1.6,4.2", "--target", "0,0.85,0", "--fov", 30)
    pictures = [studio.render(vessel(), 597, 420, torn(14, inflation=amount), *camera) for amount in (0, 14)]
    return beside(*(p.crop(p.width // 4, p.height // 16, p.width // 2, p.height // 3 * 2).enlarged(2) for p in pictures))


@figure
def boil(studio):
    """The paper's figure 12."""
    camera = ("--eye", "0,1.5,2.6", "--target", "0.05,1.38,0", "--fov", 17)
    pictures = [studio.render(vessel(), 294, 240, torn(20, **{"warp.boil": 0.5}), *camera, "--time", 2 * i / 24) for i in range(4)]
    return beside(*pictures)


@figure
def roll(studio):
    """The paper's figure 13."""
    camera = ("--eye", "0,1.6,4.2", "--target", "0.1,0.85,0", "--fov", 27)
    pictures = []
    for mode in ("metatexture", "screen"):
        for degrees in (0, 90):
            picture = studio.render(vessel(), 297, 297, torn(20, **{"warp.metatexture.mode": mode}), *camera, "--roll", degrees)
            pictures.append(picture)
    upright, rolled, fixed, fixed_rolled = pictures
    return beside(upright, rolled, rolled.turned(), fixed_rolled.turned())


@figure
def distance(studio):
    """The paper's figure 14."""
    camera = ("--eye", "0,1.6,14", "--target", "-0.2,1.05,0", "--fov", 11)
    return beside(*(studio.render(sailor(), 597, 400, torn(9, **{"warp.distance": amount, "warp.metatexture.size": 256}), *camera)
                    for amount in (0, 0.1)))


def sailor():
    """A small figure far away, and a post near by."""
    g = Gltf()
    coat, skin, cap, ground, wood = (g.material(name, color) for name, color in (
        ("Coat", (0.1, 0.16, 0.3, 1)), ("Skin", (0.75, 0.48, 0.35, 1)), ("Cap", (0.6, 0.12, 0.08, 1)), ("Deck", (0.75, 0.68, 0.52, 1)), ("Post", (0.3, 0.2, 0.14, 1))))
    g.lathe([(0, 1.5), (0.12, 1.5), (0.25, 1.4), (0.28, 1.0), (0.36, 0.5), (0.38, 0.45), (0, 0.45)], coat)
    for x in (-0.15, 0.15):
        g.lathe([(0, 0.5), (0.1, 0.5), (0.09, 0), (0, 0)], coat, translation=(x, 0, 0))
    g.ball(0.15, skin, 12, 24, translation=(0, 1.66, 0))
    g.lathe([(0, 1.86), (0.12, 1.84), (0.17, 1.76), (0.26, 1.73), (0, 1.72)], cap)
    g.floor(20, ground)
    g.lathe([(0, 1.5), (0.1, 1.5), (0.12, 0), (0, 0)], wood, translation=(-0.55, 0, 8))
    return g.text()


@figure
def ripple(studio):
    """The paper's figure 23."""
    g = Gltf()
    board = unlit(g, "Board", (1, 1, 1, 1))
    g.texture(board, make_png(256, 256, lambda x, y: (235, 232, 225) if (x // 8 + y // 8) % 2 else (60, 66, 80)))
    g.quad(9.6, board, (0, -4.8, -3))
    g.torus(0.75, 0.28, g.material("Ring", (0.72, 0.2, 0.13, 1)))
    camera = ("--eye", "0,0,4.6", "--target", "0,0,0", "--fov", 32)
    return beside(*(studio.render(g.text(), 396, 396, torn(16, 40, **{"materials.Board.warp.amount": 0, "surface.simplify": 0, "final.ripple": kind}), *camera)
                    for kind in ("paper", "depth-aware", "layered")))


# -- Further

@figure
def bases(studio):
    """The paper's section 7.4."""
    examples = studio.put("dabs.png", dabs()), studio.put("dashes.png", dashes())
    g = Gltf()
    g.floor(40, unlit(g, "Floor"))
    camera = ("--eye", "0,3,12", "--target", "0,0,8", "--fov", 40)
    return table([studio.render(g.text(), 396, 260, painted(examples[kind], size=420, base=base, levelRotation=turn, blend=0.01), *camera)
                  for kind, base, turn in ((0, 3, 0), (0, 2, 0), (0, 1.61803, 0), (0, 1.41421, 0), (1, 2, 0), (1, 2, 30))], 3)


@figure
def modes(studio):
    """The paper's section 3."""
    g = Gltf()
    g.ball(1, unlit(g, "Ball"), 64, 128, repeat=(2, 1))
    example, result = studio.put("dabs.png", dabs()), []
    for distance, height in ((4, 290), (8, 150)):
        for mode in ("metatexture", "object", "screen", "fractal"):
            fov = 2 * math.degrees(math.atan(math.tan(math.radians(15)) * height / 290))
            knobs = painted(example, mode=mode, size=300 * 290 / height, tiles=6)
            result.append(studio.render(g.text(), 294, height, knobs, "--eye", f"0,{0.2 * distance},{distance}", "--target", "0,0,0", "--fov", fov))
    return table(result, 4)


@figure
def cyclopean(studio):
    """The paper's section 3.2."""
    g = Gltf()
    g.grid(4, 12, lambda u, v: ((0, 2 - 4 * v, 1 - 6 * u), (1, 0, 0)), unlit(g, "Wall"))
    example, result = studio.put("dabs.png", dabs()), []
    width, height, ipd, middle = 900, 720, 0.5, 0.65
    focal = 0.5 * height / math.tan(math.radians(40)) / studio.shrink
    for on in (False, True):
        studio.render(g.text(), width, height, painted(example, cyclopean=on, size=200), "--eye", f"{middle},0,1", "--target", f"{middle},0,-9",
                      "--fov", 80, "--stereo", "separate", "--ipd", ipd)
        for eye, side in (("left", -1), ("right", 1)):
            seen = Picture.read(studio.folder / f"panel.{eye}.png")

            def on_the_wall(x, y, seen=seen, eye_x=middle + 0.5 * side * ipd):
                depth, up = 1.5 + x * studio.shrink / 150, 1 - y * studio.shrink / 150
                return seen.at(int(seen.width / 2 - focal * eye_x / depth), int(seen.height / 2 - focal * up / depth))

            result.append(Picture.of(studio.size(297), studio.size(297), on_the_wall))
    return beside(*result)


def main():
    arguments = sys.argv[1:]
    if arguments == ["--list"]:
        return print("\n".join(FIGURES))
    shrink, out = 1, HERE
    if "--small" in arguments:
        arguments.remove("--small")
        shrink = 4
    if "--out" in arguments:
        at = arguments.index("--out")
        out = Path(arguments[at + 1])
        del arguments[at:at + 2]
    program = HERE.parent.parent / "build/scumble"
    if arguments and arguments[0] not in FIGURES:
        program = Path(arguments.pop(0)).resolve()
    unknown = [name for name in arguments if name not in FIGURES]
    if unknown or not program.exists():
        sys.exit(f"there is no {unknown[0] if unknown else program}; figures: {', '.join(FIGURES)}")
    for name in arguments or FIGURES:
        with tempfile.TemporaryDirectory() as folder:
            picture = FIGURES[name](Studio(program, folder, shrink))
        picture.save(out / f"{name}.png")
        print(f"{name}.png  {picture.width} x {picture.height}, {(out / f'{name}.png').stat().st_size // 1024} kB")


if __name__ == "__main__":
    main()
