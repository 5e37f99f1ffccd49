#!/usr/bin/env python3
"""`scumble view` from outside, beside f3d and three.js: on a screen of Xvfb's, with hands of its own, looking at the pixels.

    bench/window.py SCENE... [--seconds 4] [--size 1280x720] [--edits 300] [--json FILE] [--program FILE] [-- OPTION...]

"first" is from the start of the process until there is a picture in the middle of its window, for browsers with their own start.
"answer" is from a motion of the mouse to the first pixel that is another one, the median of 15, from rest. "moving" is how many
pictures a second are seen while the mouse goes in circles. Programs that are not installed are left out. For scumble, memory is
that of the process after a tenth of --edits and after all: each saves another look, moves the camera, or undoes. Options after --
go to `scumble view`. It needs the packages `xvfb python3-xlib xdotool`, and of others `f3d chromium`.
"""
import argparse
import contextlib
import functools
import http.server
import json
import random
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from Xlib import X, display
from Xlib.ext import xtest

sys.dont_write_bytecode = True
from surroundings import ROOT, head, parse  # noqa: E402

sys.path.insert(0, str(ROOT / "tests" / "window"))
sys.path.insert(0, str(ROOT / "tests" / "web"))
import fins_test  # noqa: E402
import view_test  # noqa: E402

REGION = (240, 180)  # pixels in the middle that are looked at
PAINTED = 0.02  # of it: interfaces are grey, pictures are not
RATE = 120  # motions of the mouse a second
PAGE = """<!doctype html><body style="margin:0;overflow:hidden;background:#888"><script type="importmap">
{"imports": {"three": "/three/build/three.module.js"}}</script><script type="module">
import * as THREE from 'three';
import { GLTFLoader } from '/three/examples/jsm/loaders/GLTFLoader.js';
import { OrbitControls } from '/three/examples/jsm/controls/OrbitControls.js';
const renderer = new THREE.WebGLRenderer({antialias: true});
renderer.setSize(innerWidth, innerHeight);
document.body.appendChild(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x888888);
scene.add(new THREE.HemisphereLight(0xffffff, 0x444444, 2), new THREE.DirectionalLight(0xffffff, 2));
const {scene: model} = await new GLTFLoader().loadAsync('scene.glb');
scene.add(model);
const sphere = new THREE.Box3().setFromObject(model).getBoundingSphere(new THREE.Sphere());
const camera = new THREE.PerspectiveCamera(34, innerWidth / innerHeight, sphere.radius / 100, sphere.radius * 100);
camera.position.copy(sphere.center).add(new THREE.Vector3(1, 0.6, 1.6).setLength(2.6 * sphere.radius));
const controls = new OrbitControls(camera, renderer.domElement);
controls.target.copy(sphere.center);
const draw = () => renderer.render(scene, camera);
controls.addEventListener('change', draw);
controls.update();
draw();
</script>"""


class Eyes:
    """Looks at the middle of the screen, and has a mouse."""

    def __init__(self, screen, size):
        self.display = display.Display(screen.display)
        self.root = self.display.screen().root
        self.middle = (size[0] // 2, size[1] // 2)

    def see(self):
        x, y = self.middle[0] - REGION[0] // 2, self.middle[1] - REGION[1] // 2
        return self.root.get_image(x, y, *REGION, X.ZPixmap, 0xFFFFFFFF).data

    def is_painted(self):
        data = self.see()
        colourful = sum(max(data[i:i + 3]) - min(data[i:i + 3]) > 24 for i in range(0, len(data), 44))
        return colourful > PAINTED * len(data) / 44

    def mouse(self, x, y):
        xtest.fake_input(self.display, X.MotionNotify, x=int(x), y=int(y))
        self.display.sync()

    def button(self, down):
        xtest.fake_input(self.display, X.ButtonPress if down else X.ButtonRelease, 1)
        self.display.sync()

    def until(self, condition, seconds):
        start = time.perf_counter()
        while time.perf_counter() - start < seconds:
            if condition():
                return 1000 * (time.perf_counter() - start)
        raise RuntimeError("nothing has happened in the window")

    def rest(self):
        last, since = self.see(), time.perf_counter()
        while time.perf_counter() - since < 0.6:
            time.sleep(0.02)
            now = self.see()
            if now != last:
                last, since = now, time.perf_counter()


def answers(eyes, count=15):
    """Milliseconds from a motion to what it changes."""
    times = []
    for i in range(count):
        eyes.rest()
        before = eyes.see()
        eyes.mouse(eyes.middle[0] + 40 * (1 if i % 2 else -1), eyes.middle[1])
        times.append(eyes.until(lambda: eyes.see() != before, 20))
    return times


def pictures_a_second(eyes, seconds):
    start = next_motion = time.perf_counter()
    last, seen, motions = eyes.see(), 0, 0
    while (now := time.perf_counter()) - start < seconds:
        if now >= next_motion:
            turn = motions % 240
            eyes.mouse(eyes.middle[0] + (turn if turn < 120 else 240 - turn) * 2 - 120, eyes.middle[1])
            motions, next_motion = motions + 1, next_motion + 1 / RATE
        picture = eyes.see()
        if picture != last:
            last, seen = picture, seen + 1
    return seen / seconds


def watch(screen, size, command, seconds):
    """What a person sees of a program: numbers, and the process, which still runs."""
    eyes = Eyes(screen, size)
    start = time.perf_counter()
    process = subprocess.Popen([str(word) for word in command], env=screen.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    numbers = {}
    try:
        eyes.until(lambda: process.poll() is not None or eyes.is_painted(), 60)
        numbers["first"] = 1000 * (time.perf_counter() - start)
        if process.poll() is not None:
            raise RuntimeError(f"{command[0]} has ended with {process.returncode}")
        eyes.rest()
        eyes.mouse(*eyes.middle)
        eyes.button(True)
        numbers["answer"] = statistics.median(answers(eyes))
        numbers["moving"] = pictures_a_second(eyes, seconds)
        eyes.button(False)
        eyes.rest()
    except BaseException:
        process.kill()
        raise
    return numbers, process


def resident(process):
    return 1024 * int(view_test.Path(f"/proc/{process.pid}/status").read_text().split("VmRSS:")[1].split()[0])


def edit(screen, process, look, edits):
    """Resident bytes after a tenth of the edits and after all."""
    chance, early = random.Random(1), 0
    for number in range(edits):
        kind = number % 3
        if kind == 0:
            look.write_text(json.dumps({"shadow": {"threshold": round(chance.uniform(0.2, 0.8), 3)},
                                        "warp": {"amount": round(chance.uniform(0, 8), 2)}, "light": {"azimuth": chance.randrange(-180, 180)}}))
        elif kind == 1:
            screen.hand("key", chance.choice(["bracketleft", "bracketright", "equal", "minus", "1", "3", "7", "0"]))
        else:
            screen.hand("key", chance.choice(["ctrl+z", "ctrl+y", "b", "p", "v", "Escape"]))
        time.sleep(0.25)
        if number == edits // 10:
            early = resident(process)
        if process.poll() is not None:
            raise RuntimeError(f"the window has ended with {process.returncode} at edit {number}")
    return {"edits": edits, "bytesEarly": early, "bytesLate": resident(process)}


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *words):
        pass


@contextlib.contextmanager
def site(scene, folder):
    """A page of three.js that shows the scene; its address."""
    three = fins_test.fetched_three(ROOT / "build")
    if three is None:
        yield None
        return
    for name, target in (("three", three), ("scene.glb", Path(scene).absolute())):
        (folder / name).unlink(missing_ok=True)
        (folder / name).symlink_to(target)
    (folder / "index.html").write_text(PAGE)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/index.html"
    finally:
        server.shutdown()


def measure(scene, size, chosen, options):
    area = f"{size[0]}x{size[1]}"
    result = {"scene": Path(scene).stem, "size": area, "programs": {}}

    def one(name, command, after=None):
        # A server of its own, so that nothing else is on the screen.
        with contextlib.closing(view_test.Screen(size[0] + 80, size[1] + 60, folder / "state")) as screen:
            numbers, process = watch(screen, size, command, chosen.seconds)
            if after:
                numbers.update(after(screen, process))
            process.terminate()
            process.wait(20)
        result["programs"][name] = numbers
        print(f"{result['scene']:16} {name:10} " + "  ".join(f"{key} {value:.4g}" for key, value in numbers.items()), flush=True)

    with tempfile.TemporaryDirectory(prefix="scumble bench ") as name:
        folder = Path(name)
        copy = folder / Path(scene).name
        copy.symlink_to(Path(scene).absolute())
        command = [chosen.program, "view", copy, "--size", area, *options]
        # Once before, so that the pipelines are compiled as they are on any day but the first.
        with contextlib.closing(view_test.Screen(size[0] + 80, size[1] + 60, folder / "state")) as screen:
            _, process = watch(screen, size, command, 0.5)
            process.terminate()
            process.wait(20)
        look = copy.with_suffix(".look.json")
        one("scumble", command, (lambda screen, process: edit(screen, process, look, chosen.edits)) if chosen.edits else None)
        if shutil.which("f3d"):
            one("f3d", ["f3d", "--dry-run", f"--resolution={size[0]},{size[1]}", copy])
        if shutil.which("chromium"):
            (folder / "site").mkdir()
            with site(scene, folder / "site") as address:
                if address:
                    one("three", ["chromium", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run",
                                  "--kiosk", f"--user-data-dir={folder / 'profile'}", f"--window-size={size[0]},{size[1]}",
                                  "--window-position=0,0", f"--app={address}"])
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=4)
    parser.add_argument("--size", default="1280x720", metavar="WxH")
    parser.add_argument("--edits", type=int, default=300)
    chosen, options = parse(parser)
    size = tuple(int(number) for number in chosen.size.split("x"))
    report = head(chosen.program, options)
    for scene in chosen.scenes:
        report["results"].append(measure(scene, size, chosen, options))
    if chosen.json:
        Path(chosen.json).write_text(json.dumps(report, indent=1) + "\n")


if __name__ == "__main__":
    main()
