#!/usr/bin/env python3
"""web/fins.js in a real Chromium, with npm's three, against scumble's own pictures.

    tests/web/fins_test.py BUILD

A ball with fur on a skin, and strokes in the air, are baked; web/index.html draws it from several sides in a browser, with the orders of triangles and
without, and so does `scumble render`. They must look alike, in every tile; and without the orders they must not. So must the ball
whose orders another program has lost ("pruned"), and one whose orders are of other triangles ("spoiled"). three is fetched
from npm's registry, as a user would have it; where that cannot be reached, the test says that it skips.
"""
import hashlib
import http.server
import json
import math
import shutil
import struct
import subprocess
import sys
import tarfile
import tempfile
import threading
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests" / "support"))
from gltf import Gltf  # noqa: E402
from png import make_png  # noqa: E402

THREE = "https://registry.npmjs.org/three/-/three-0.187.0.tgz"
SHA512 = "422bbb47e0a687c0acb59b18d6e24e4969d595fa3b66d34b57b985f0996d9372" \
    "c1dc0b43bbd71166572744a90093c638cfa28ac37e73ed8ed4addee3598f1eb4"
SIZE = (480, 360)
BACKGROUND = "dceef5"
VIEWS = [(3.2, 1.8, 3.4), (-4.2, -0.6, 2.4), (0.4, 4.6, -2.0)]
# FLIP in the mean, and in the worst tile of 16 x 16 pixels. Colours are blended as their square roots here and as sRGB there, and
# the browser chooses among 14 orders.
MEAN, TILE = 0.02, 0.2

# Shows the page as a user has it, and sends what it draws.
HARNESS = """<!doctype html><body style="margin:0"><iframe id="page" style="border:0;width:%dpx;height:%dpx"></iframe>
<script>
const page = document.getElementById('page');
const tell = (path, body) => fetch(path, {method: 'POST', body});
async function draw(query) {
  await new Promise((done) => { page.onload = done; page.src = 'index.html?' + query; });
  const says = () => page.contentDocument.getElementById('says').textContent;
  for (let i = 0; i < 600 && says() !== ''; ++i) {
    if (says().startsWith('It cannot')) return tell('/problem', says());
    await new Promise((next) => setTimeout(next, 50));
  }
  for (let i = 0; i < 5; ++i) await new Promise((next) => page.contentWindow.requestAnimationFrame(next));
  const blob = await new Promise((made) => page.contentDocument.querySelector('canvas').toBlob(made, 'image/png'));
  return tell('/picture', blob);
}
window.onerror = (problem) => tell('/problem', String(problem));
(async () => { for (const query of await (await fetch('queries')).json()) await draw(query); tell('/done', ''); })();
</script>"""


def fetched_three(build):
    """The package's folder, or None."""
    folder = build / "npm"
    package = folder / Path(THREE).stem
    if package.exists():
        return package
    folder.mkdir(exist_ok=True)
    try:
        with urllib.request.urlopen(THREE, timeout=60) as answer:
            data = answer.read()
    except OSError as problem:
        print(f"SKIPPED: {THREE} cannot be had ({problem})")
        return None
    if hashlib.sha512(data).hexdigest() != SHA512:
        sys.exit(f"{THREE} is another file than it was")
    (folder / "three.tgz").write_bytes(data)
    with tarfile.open(folder / "three.tgz") as archive:
        archive.extractall(folder)
    (folder / "package").rename(package)
    return package


def drawn_in_browser(site, queries):
    pictures, problems, done = [], [], threading.Event()

    class Handler(http.server.SimpleHTTPRequestHandler):
        def __init__(self, *arguments):
            super().__init__(*arguments, directory=str(site))

        def do_POST(self):
            body = self.rfile.read(int(self.headers["Content-Length"]))
            if self.path == "/picture":
                pictures.append(body)
            elif self.path == "/problem":
                problems.append(body.decode())
                done.set()
            else:
                done.set()
            self.send_response(204)
            self.end_headers()

        def log_message(self, *_):
            pass

    (site / "queries").write_text(json.dumps(queries))
    (site / "harness.html").write_text(HARNESS % SIZE)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(prefix="scumble browser ") as profile, open(site / "browser.log", "w") as log:
        browser = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run",
             "--enable-logging=stderr", f"--user-data-dir={profile}", f"--window-size={SIZE[0] + 40},{SIZE[1] + 120}",
             f"http://127.0.0.1:{server.server_port}/harness.html"], stdout=log, stderr=log)
        finished = done.wait(180)
        browser.terminate()
        browser.wait(20)
    server.shutdown()
    if problems or not finished or len(pictures) != len(queries):
        console = [line for line in (site / "browser.log").read_text().splitlines() if "CONSOLE" in line]
        sys.exit("\n".join(["the browser drew %d of %d pictures" % (len(pictures), len(queries)), *problems, *console[:20]]))
    return pictures


def furry_ball(program, folder):
    """A ball that shows its colour, whatever the light, with fur on it, as fins; a joint has turned it half around."""
    g = Gltf()
    g.json["extensionsUsed"] = ["KHR_materials_unlit"]
    fur = g.material("Fur", extensions={"KHR_materials_unlit": {}})
    g.texture(fur, make_png(64, 64, lambda x, y: (224, 150, 80, 255) if (x // 16 + y // 16) % 2 else (110, 70, 60, 255)))
    g.ball(1, fur, 16, 32)
    turn_by_joint(g)
    (folder / "ball.gltf").write_text(g.text())
    run([program, "paint", "ball.gltf", "-o", "painted.glb", "--style", "fur", "--splats", "20000", "--quiet"], folder)
    run([program, "bake", "painted.glb", "-o", "ball.glb", "--texture", "1024", "--quiet"], folder)


def turn_by_joint(g):
    """All of the first mesh hangs on one joint, which is turned half around; it was bound as it stands without that."""
    count = g.json["accessors"][g.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]["count"]
    joints = g.accessor([(0, 0, 0, 0)] * count, "VEC4", "B", 5121)
    weights = g.accessor([(1, 0, 0, 0)] * count, "VEC4")
    g.json["meshes"][0]["primitives"][0]["attributes"].update({"JOINTS_0": joints, "WEIGHTS_0": weights})
    nodes = g.json["nodes"]
    nodes.append({"name": "Joint", "rotation": [0, 1, 0, 0]})
    g.json["skins"] = [{"joints": [len(nodes) - 1]}]
    nodes[0]["skin"] = 0
    g.json["scenes"][0]["nodes"].append(len(nodes) - 1)


def strokes_in_air(program, folder):
    """A few broad rings without a surface, as fins on a hull."""
    g = Gltf()
    g.json["meshes"].append({"primitives": []})
    g.json["nodes"].append({"mesh": 0})
    g.json["scenes"][0]["nodes"].append(0)
    for k, color in enumerate([(0.8, 0.3, 0.1, 1), (0.15, 0.3, 0.5, 1), (0.9, 0.75, 0.3, 1)]):
        points = [(math.sin(a) * (1 + 0.1 * k), 0.5 * (k - 1) + 0.2 * math.cos(2 * a), math.cos(a)) for a in (0.25 * i for i in range(26))]
        g.stroke(points, 0.28, color, "bristles", k)
    (folder / "rings.gltf").write_text(g.text())
    run([program, "bake", "rings.gltf", "-o", "rings.glb", "--texture", "1024", "--hull-cells", "16", "--quiet"], folder)


def rewritten(glb, change):
    """A .glb whose JSON and bytes something has changed."""
    length = int.from_bytes(glb[12:16], "little")
    root, binary = json.loads(glb[20:20 + length]), bytearray(glb[28 + length:])
    change(root, binary)
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def prune(root, _):
    """As tools do that know nothing of what extras name: accessors that nothing else uses go, and others are counted anew."""
    kept = [number for number, accessor in enumerate(root["accessors"]) if not accessor.get("name", "").startswith("scumble order")]
    assert len(kept) < len(root["accessors"])
    new = {old: number for number, old in enumerate(kept)}
    root["accessors"] = [root["accessors"][old] for old in kept]
    for primitive in (primitive for mesh in root["meshes"] for primitive in mesh["primitives"]):
        primitive["attributes"] = {name: new[old] for name, old in primitive["attributes"].items()}
        primitive["targets"] = [{name: new[old] for name, old in target.items()} for target in primitive.get("targets", [])]
        if not primitive["targets"]:
            del primitive["targets"]
        if "indices" in primitive:
            primitive["indices"] = new[primitive["indices"]]
    for skin in root.get("skins", []):
        if "inverseBindMatrices" in skin:
            skin["inverseBindMatrices"] = new[skin["inverseBindMatrices"]]


def spoil(root, binary):
    """Orders of other triangles: each has the first one as often as there are triangles."""
    for accessor in root["accessors"]:
        if accessor.get("name", "").startswith("scumble order"):
            view, size = root["bufferViews"][accessor["bufferView"]], {5123: 6, 5125: 12}[accessor["componentType"]]
            at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
            binary[at:at + size * (accessor["count"] // 3)] = binary[at:at + size] * (accessor["count"] // 3)


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{command[1]}: exit code {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    build = Path(sys.argv[1]).resolve()
    three = fetched_three(build)
    if not three:
        return
    site = build / "web"
    shutil.rmtree(site, ignore_errors=True)
    shutil.copytree(ROOT / "web", site)
    (site / "node_modules").mkdir()
    (site / "node_modules" / "three").symlink_to(three)
    program = build / "scumble"
    furry_ball(program, site)
    strokes_in_air(program, site)
    for name, change in (("pruned", prune), ("spoiled", spoil)):
        (site / f"{name}.glb").write_bytes(rewritten((site / "ball.glb").read_bytes(), change))
    cases = [(scene, ",".join(map(str, eye))) for scene in ("ball", "rings", "pruned", "spoiled") for eye in VIEWS]
    queries = [f"scene={scene}.glb&target=0,0,0&fov=34&background={BACKGROUND}&eye={eye}{orders}"
               for scene, eye in cases for orders in ("", "&orders=off")]
    pictures = drawn_in_browser(site, queries)
    failures = 0
    for number, (scene, eye) in enumerate(cases):
        run([program, "render", f"{scene}.glb", "-o", f"own-{number}.png", "--eye", eye, "--target", "0,0,0", "--fov", "34",
             "--size", "{}x{}".format(*SIZE), "--background", f"#{BACKGROUND}", "--set", "warp.amount=0", "--set", "ground.mode=off",
             "--set", "breakup.amount=0", "--set", "painting.warp=0", "--quiet"], site)
        differences = []
        for at, kind in enumerate(("orders", "none")):
            (site / f"browser-{number}-{kind}.png").write_bytes(pictures[2 * number + at])
            told = run([build / "compare_pictures", f"own-{number}.png", f"browser-{number}-{kind}.png", "0"], site)
            differences.append([float(word) for word in told.split()[:2]])
        (mean, tile), (without, worst) = differences
        good = mean <= MEAN and tile <= TILE and without > 2 * mean
        failures += not good
        print(f"{'passed' if good else 'FAILED'}  {scene} from {eye}: FLIP {mean:.4f}, worst tile {tile:.3f}; without orders {without:.4f}, {worst:.3f}")
    if failures:
        sys.exit(f"pictures are in {site}")


if __name__ == "__main__":
    main()
