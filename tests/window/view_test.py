#!/usr/bin/env python3
"""`scumble view` in a real window: under Xvfb, with keys and mouse of xdotool, and what is on the screen looked at.

    tests/window/view_test.py BUILD [--pictures FOLDER]

What the window shows without its panels is `scumble render`'s picture, byte for byte. Under the validation layers.
"""
import argparse
import contextlib
import json
import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
SIZE = (640, 400)
WIDE = (1000, 640)  # with room for windows beside the panel
SAMPLES = "1"


class Screen:
    """An X server of its own."""

    def __init__(self, width, height, state):
        """`state`: where windows keep what outlives them."""
        self.size = (width, height)
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp", "-noreset"],
                                       pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.display = ":" + number.readline().strip()
        self.environment = {**os.environ, "DISPLAY": self.display, "XDG_STATE_HOME": str(state)}
        self.environment.pop("WAYLAND_DISPLAY", None)

    def close(self):
        self.server.terminate()
        self.server.wait()

    def hand(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, stdout=subprocess.DEVNULL)

    def pixels(self, width, height):
        """RGB of the upper left corner, where windows are without a window manager."""
        return subprocess.run(["ffmpeg", "-v", "error", "-f", "x11grab", "-draw_mouse", "0", "-video_size", f"{width}x{height}", "-i",
                               self.display, "-frames:v", "1", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                              env=self.environment, check=True, capture_output=True).stdout


def picture_of(path):
    return subprocess.run(["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], check=True,
                          capture_output=True).stdout


def until(condition, what, seconds=30):
    """Milliseconds until it holds."""
    start = time.monotonic()
    while not condition():
        if time.monotonic() - start > seconds:
            raise AssertionError(f"{what}: not within {seconds} s")
        time.sleep(0.02)
    return 1000 * (time.monotonic() - start)


def part_that_differs(a, b):
    assert len(a) == len(b), (len(a), len(b))
    return sum(x != y for x, y in zip(a[::3], b[::3])) / (len(a) / 3)


def is_painted(pixels):
    """Whether there is more than the interface, which is grey."""
    return sum(max(pixels[i:i + 3]) - min(pixels[i:i + 3]) > 24 for i in range(0, len(pixels), 33)) > len(pixels) / 33 / 20


class Window:
    def __init__(self, screen, program, *options, size=None, environment=None):
        self.screen, self.size = screen, size or SIZE
        self.started = time.monotonic()
        self.process = subprocess.Popen([program, "view", *map(str, options), "--size", f"{self.size[0]}x{self.size[1]}", "--samples",
                                         SAMPLES, "--validate"], env={**screen.environment, **(environment or {})}, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def pixels(self):
        return self.screen.pixels(*self.size)

    def until_it_shows(self, picture, what, seconds=30):
        def same():
            assert self.process.poll() is None, self.process.communicate()
            return self.pixels() == picture
        return until(same, what, seconds)

    def resting(self, quiet=0.7):
        """What it shows when it has not changed for so many seconds."""
        last, since = self.pixels(), time.monotonic()
        while time.monotonic() - since < quiet:
            time.sleep(0.1)
            now = self.pixels()
            if now != last:
                last, since = now, time.monotonic()
        return last

    def key(self, *keys):
        self.screen.hand("key", *keys)

    def click(self, x, y):
        self.screen.hand("mousemove", x, y, "click", 1)

    def number(self, title):
        return subprocess.run(["xdotool", "search", "--name", title], env=self.screen.environment, check=True, capture_output=True,
                              text=True).stdout.split()[0]

    def drop(self, title, *files):
        # The platform's Python has the platform's packages.
        subprocess.run(["/usr/bin/python3", HERE / "drop.py", self.number(title), "250", "400", *map(str, files)], env=self.screen.environment,
                       check=True)

    def shows_more(self, before, part=0.01):
        """Waits until it differs from a picture, and rests."""
        until(lambda: part_that_differs(self.pixels(), before) > part, "something else in the window")
        return self.resting()

    def drag(self, button, way, modifier=None):
        x, y = self.size[0] // 2, self.size[1] // 2
        held = (["keydown", modifier], ["keyup", modifier]) if modifier else ([], [])
        self.screen.hand(*held[0], "mousemove", x, y, "mousedown", button)
        for step in range(1, 6):
            self.screen.hand("mousemove", x + way[0] * step // 5, y + way[1] * step // 5)
        self.screen.hand("mouseup", button, *held[1])

    def copied(self):
        """The command that draws what it shows, as words."""
        clipboard = ["xclip", "-selection", "clipboard"]
        subprocess.run([*clipboard, "-i"], input=b"nothing", env=self.screen.environment, check=True, stdout=subprocess.DEVNULL)
        self.key("ctrl+c")
        texts = []

        def is_there():
            done = subprocess.run([*clipboard, "-o"], env=self.screen.environment, capture_output=True, text=True, timeout=20)
            texts.append(done.stdout)
            return done.returncode == 0 and done.stdout != "nothing"
        until(is_there, "something in the clipboard")
        return shlex.split(texts[-1])

    def cpu_seconds(self):
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def closed(self):
        out, err = self.process.communicate(timeout=20)
        return self.process.returncode, out.decode(), err.decode()


class Test:
    def __init__(self, build, pictures):
        self.program, self.build, self.pictures = build / "scumble", build, pictures

    def rendered(self, *words, size=SIZE):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "picture.png"
            subprocess.run([self.program, "render", *map(str, words), "-o", path, "--size", f"{size[0]}x{size[1]}", "--samples", SAMPLES,
                            "--quiet"], check=True, capture_output=True)
            return picture_of(path)

    def drawn_by(self, words):
        assert words[:2] == ["scumble", "render"], words
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "picture.png"
            subprocess.run([self.program, *words[1:], "-o", path, "--quiet"], check=True, capture_output=True)
            return picture_of(path)

    def keep(self, name, window):
        if self.pictures:
            subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{window.size[0]}x{window.size[1]}",
                            "-i", "-", self.pictures / f"{name}.png"], input=window.pixels(), check=True)

    def look_at_a_scene(self, screen, folder):
        scene, look = folder / "still.glb", folder / "still.look.json"
        subprocess.run([self.build / "still_life", scene], check=True, capture_output=True)
        look.write_text(json.dumps({"shadow": {"threshold": 0.5}}))
        first = self.rendered(scene)
        window = Window(screen, self.program, scene)
        until(lambda: is_painted(window.pixels()), "a picture in the window")
        print(f"first picture: {1000 * (time.monotonic() - window.started):.0f} ms after the start")
        self.keep("panel", window)
        assert part_that_differs(window.resting(), first) > 0.005, "the panel does not show"
        window.key("n")
        window.until_it_shows(first, "the picture that `scumble render` draws")

        window.resting()
        before = window.cpu_seconds()
        time.sleep(2)
        spent = window.cpu_seconds() - before
        assert spent <= 0.03, f"an idle window has used {spent} s of 2"

        # Hands, and back again.
        for name, do in (("orbit", lambda: window.drag(1, (150, 40))), ("pan", lambda: window.drag(1, (90, 0), "shift")),
                         ("zoom", lambda: screen.hand("mousemove", 300, 200, "click", 4, "click", 4)),
                         ("look around", lambda: window.drag(3, (60, 0))), ("roll", lambda: window.key("bracketright", "bracketright")),
                         ("field of view", lambda: window.key("equal", "equal", "equal")), ("from the right", lambda: window.key("3")),
                         ("fly", lambda: (screen.hand("keydown", "w"), time.sleep(0.3), screen.hand("keyup", "w")))):
            before = window.resting()
            do()
            until(lambda: window.pixels() != before, name)
            assert part_that_differs(window.resting(), before) > 0.05, name
            self.keep(name, window)
            assert is_painted(window.pixels()), name
            window.until_it_shows(self.drawn_by(window.copied()), f"what the copied command draws after: {name}")
            window.key("0")
            window.until_it_shows(first, f"the look's camera after: {name}")
        # Everything, as `render` frames it.
        window.key("Home")
        until(lambda: part_that_differs(window.pixels(), first) > 0.02, "everything in the frame")
        window.resting()
        self.keep("everything", window)
        window.until_it_shows(self.drawn_by(window.copied()), "what the copied command draws of everything")
        window.key("0")
        window.until_it_shows(first, "the look's camera again")

        # Another look, and back.
        window.key("n")
        for line, name in ((149, "dusk"), (86, None)):
            before = window.resting()
            screen.hand("mousemove", 400, 57, "click", 1)
            until(lambda: part_that_differs(window.pixels(), before) > 0.05, "the list of looks")
            window.resting()
            self.keep(f"looks {name}", window)
            screen.hand("mousemove", 300, line, "click", 1)
            window.resting()
            window.key("n")
            window.until_it_shows(self.rendered(scene, "--look", name) if name else first, f"the look {name}")
            if name:
                assert window.copied()[3:5] == ["--look", name], window.copied()
            window.key("n")

        # A knob, found, turned, undone and turned again.
        screen.hand("mousemove", 400, 113, "click", 1)
        window.resting()
        screen.hand("type", "torn edge")
        window.resting()
        self.keep("search", window)
        screen.hand("mousemove", 433, 206, "mousedown", 1)
        for x in (436, 441, 446):
            screen.hand("mousemove", x, 206)
        screen.hand("mouseup", 1)
        window.resting()
        self.keep("knob", window)
        words = window.copied()
        assert any(word.startswith("warp.amount=") for word in words), words
        turned = self.drawn_by(words)
        assert part_that_differs(turned, first) > 0.02
        window.key("n")
        window.until_it_shows(turned, "the picture with another knob")
        window.key("ctrl+z")
        window.until_it_shows(first, "the picture before")
        window.key("ctrl+y")
        window.until_it_shows(turned, "the knob turned again")
        # Saved, which changes nothing else of the file; and undone all the same.
        look.write_text('{ // mine\n  "shadow": { "threshold": 0.5 }\n}\n')
        window.resting()
        window.key("ctrl+s")
        until(lambda: "warp" in look.read_text(), "the knob in the look's file")
        amount = next(word for word in words if word.startswith("warp.amount=")).split("=")[1]
        assert look.read_text() == '{ // mine\n  "shadow": { "threshold": 0.5 },\n  "warp": { "amount": %s }\n}\n' % amount, look.read_text()
        assert window.resting() == turned == self.rendered(scene), "the picture that was saved"
        assert not any(word.startswith("warp.") for word in window.copied()), window.copied()
        window.key("ctrl+z")
        window.until_it_shows(first, "and undone")

        # Saved by writing, by renaming, and broken.
        look.write_text(json.dumps({"shadow": {"threshold": 0.2}, "background": {"mode": "look", "horizon": "#C04030"}}))
        second = self.rendered(scene)
        assert second != first
        print(f"a look that was saved: seen after {window.until_it_shows(second, 'the look that was saved'):.0f} ms")
        other = folder / "still.look.json~"
        other.write_text(json.dumps({"shadow": {"threshold": 0.5}}))
        os.rename(other, look)
        window.until_it_shows(first, "the look that was renamed into its place")
        look.write_text('{"shadow": {"threshhold": 0.2}}')
        until(lambda: window.pixels() != first, "a message")
        broken = window.resting()
        self.keep("broken look", window)
        assert 0.01 < part_that_differs(broken, first) < 0.5, "the last good picture does not stay"
        look.write_text(json.dumps({"shadow": {"threshold": 0.5}}))
        window.until_it_shows(first, "the picture after the look was mended")
        # The scene too.
        subprocess.run([self.build / "demo_scene", folder / "other.glb"], check=True, capture_output=True)
        os.rename(folder / "other.glb", scene)
        until(lambda: part_that_differs(window.pixels(), first) > 0.3, "the scene that was saved")
        subprocess.run([self.build / "still_life", folder / "again.glb"], check=True, capture_output=True)
        os.rename(folder / "again.glb", scene)
        window.until_it_shows(first, "the first scene again")

        # Another size, and the help over it.
        number = window.number("still.glb")
        screen.hand("windowsize", number, 500, 450)
        window.size = (500, 450)
        window.until_it_shows(self.rendered(scene, size=window.size), "the picture of another size")
        screen.hand("windowsize", number, *SIZE)
        window.size = SIZE
        window.until_it_shows(first, "the first size again")
        window.key("h")
        until(lambda: part_that_differs(window.pixels(), first) > 0.1, "the help")
        self.keep("help", window)
        window.key("h")
        window.until_it_shows(first, "the picture without the help")
        window.key("ctrl+q")
        assert window.closed() == (0, "", ""), window.closed()

    def play(self, screen, folder):
        scene = folder / "demo.glb"
        subprocess.run([self.build / "demo_scene", scene], check=True, capture_output=True)
        window = Window(screen, self.program, scene, "--time", "1")
        until(lambda: is_painted(window.pixels()), "a picture in the window")
        window.key("n")
        paused = window.resting()
        window.key("Right")
        until(lambda: window.pixels() != paused, "one frame on")
        assert part_that_differs(window.resting(), paused) > 0.01
        window.key("Left")
        window.until_it_shows(paused, "one frame back")
        window.key("space")
        seen = set()
        start = time.monotonic()
        while time.monotonic() - start < 5:
            seen.add(window.pixels())
        assert len(seen) > 4, f"{len(seen)} pictures in five seconds"
        self.keep("playing", window)
        window.key("space")
        window.resting()
        window.key("ctrl+q")
        assert window.closed() == (0, "", ""), window.closed()

    def opened(self, screen, *options, size=WIDE, environment=None):
        window = Window(screen, self.program, *options, size=size, environment=environment)
        until(lambda: is_painted(window.pixels()), "a picture in the window")
        window.resting(1.5)  # the first one is coarse
        return window

    def close(self, window):
        window.key("ctrl+q")
        assert window.closed() == (0, "", ""), window.closed()

    def scene(self, folder, program, name):
        subprocess.run([self.build / program, folder / name], check=True, capture_output=True)
        return folder / name

    def pick(self, screen, folder):
        scene = self.scene(folder, "still_life", "picked.glb")
        first = self.rendered(scene, size=WIDE)
        window = self.opened(screen, scene)
        before = window.resting()
        window.click(380, 380)
        picked = window.shows_more(before)
        self.keep("picked", window)
        # The jug's material has knobs of its own.
        window.click(800, 178)
        screen.hand("type", "torn edge")
        window.resting()
        self.keep("picked search", window)
        screen.hand("mousemove", 793, 271, "mousedown", 1)
        for x in (796, 803, 810):
            screen.hand("mousemove", x, 271)
        screen.hand("mouseup", 1)
        window.shows_more(picked, 0.002)
        self.keep("picked knob", window)
        words = window.copied()
        assert any(word.startswith("materials.Enamel.warp.amount=") for word in words), words
        window.key("Escape", "n")
        turned = self.drawn_by(words)
        window.until_it_shows(turned, "the jug with another edge")
        assert 0.0005 < part_that_differs(turned, first) < 0.2, part_that_differs(turned, first)
        # Held, a key shows what the file says.
        screen.hand("keydown", "c")
        window.until_it_shows(first, "the picture as the look is saved")
        screen.hand("keyup", "c")
        window.until_it_shows(turned, "and as it is")
        window.key("ctrl+s")
        look = folder / "picked.look.json"
        until(look.exists, "a look beside the scene")
        amount = next(word for word in words if word.startswith("materials.")).split("=")[1]
        assert json.loads(look.read_text())["materials"] == {"Enamel": {"warp": {"amount": float(amount)}}}, look.read_text()
        # What was picked fills the frame, and the scene's camera is there again.
        window.key("n")
        window.resting()
        window.click(380, 380)
        window.resting()
        window.key("Home", "n")
        framed = window.shows_more(turned, 0.1)
        self.keep("framed", window)
        words = window.copied()
        assert words[words.index("--frame") + 1] == "Jug", words
        window.until_it_shows(self.drawn_by(words), "what was picked, framed")
        window.key("k")
        window.shows_more(framed, 0.1)
        words = window.copied()
        assert words[words.index("--camera") + 1] == "0", words
        window.until_it_shows(self.drawn_by(words), "the scene's camera")
        window.key("0", "Escape")
        # A click on nothing lets go of it.
        window.key("n")
        window.resting()
        for x, y in ((380, 380), (40, 40)):
            before = window.resting()
            window.click(x, y)
            window.shows_more(before)
        self.close(window)
        look.unlink()

    def drops(self, screen, folder):
        still, demo = self.scene(folder, "still_life", "still life.glb"), self.scene(folder, "demo_scene", "demo.glb")
        window = self.opened(screen, still)
        window.key("n")
        first = self.rendered(still, size=WIDE)
        window.until_it_shows(first, "the first scene")
        window.drop("still life.glb", demo)
        window.shows_more(first)
        self.keep("dropped scene", window)
        window.click(297, 240)
        window.until_it_shows(self.rendered(demo, size=WIDE), "the scene that was dropped")
        # What is not wanted goes, what is nothing is told, and what was dropped last of looks counts.
        before = window.pixels()
        window.drop("demo.glb", still)
        window.shows_more(before)
        window.key("Escape")
        window.until_it_shows(before, "the question put away")
        window.drop("demo.glb", folder / "notes.txt")
        window.shows_more(before)
        self.keep("dropped notes", window)
        window.key("Escape")
        window.until_it_shows(before, "the message put away")
        look = folder / "mine.json"
        look.write_text(json.dumps({"extends": "dusk", "shadow": {"threshold": 0.7}}))
        window.drop("demo.glb", look)
        window.until_it_shows(self.rendered(demo, "--look", look, size=WIDE), "the look that was dropped")
        # Two scenes in one world.
        before = window.resting()
        window.drop("demo.glb", still)
        window.shows_more(before)
        window.click(297, 240)
        alone = self.rendered(still, "--look", look, size=WIDE)
        window.until_it_shows(alone, "the first scene again")
        window.drop("still life.glb", demo)
        window.shows_more(alone)
        window.click(297, 269)
        both = self.rendered(still, demo, "--look", look, size=WIDE)
        assert part_that_differs(both, alone) > 0.005
        window.until_it_shows(both, "both scenes")
        self.keep("both scenes", window)
        window.until_it_shows(self.drawn_by(window.copied()), "what the copied command draws of both")
        # A picture behind everything.
        picture = folder / "sky & sea.png"
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "lavfi", "-i", "gradients=s=320x200:c0=orange:c1=purple:seed=1", "-frames:v",
                        "1", picture], check=True)
        window.drop("still life.glb", picture)
        window.shows_more(both)
        self.keep("dropped picture", window)
        window.click(297, 116)
        window.until_it_shows(self.rendered(still, demo, "--look", look, "--background", picture, size=WIDE), "the picture behind it")
        window.until_it_shows(self.drawn_by(window.copied()), "what the copied command draws over the picture")
        self.close(window)
        # They were opened last.
        window = self.opened(screen, still)
        before = window.resting()
        window.key("ctrl+o")
        window.shows_more(before)
        self.keep("open", window)
        window.click(150, 262)
        window.resting()
        window.key("n")
        window.until_it_shows(self.rendered(demo, size=WIDE), "the scene that was opened last")
        self.close(window)

    def compare(self, screen, folder):
        scene = self.scene(folder, "still_life", "compared.glb")
        first, dusk = self.rendered(scene, size=WIDE), self.rendered(scene, "--look", "dusk", size=WIDE)
        # One that was asked for is not the scene's own, which can be taken.
        window = self.opened(screen, scene, "--look", "dusk")
        window.key("n")
        window.until_it_shows(dusk, "the look that was asked for")
        window.key("n")
        window.resting()
        window.click(800, 57)
        window.resting()
        window.click(700, 86)
        window.resting()
        window.key("n")
        window.until_it_shows(first, "the first look")
        # All looks; the third is taken.
        window.key("l")
        until(lambda: part_that_differs(window.pixels(), first) > 0.3, "the sheet of looks")
        until(lambda: is_painted(window.resting()), "small pictures")
        time.sleep(2)
        window.resting()
        self.keep("all looks", window)
        window.click(820, 120)
        window.resting()
        window.until_it_shows(dusk, "the look that was taken")
        # Another look at the right of a line, which is dragged.
        window.key("n", "v")
        window.resting()
        window.click(800, 107)
        window.resting()
        self.keep("looks to compare", window)
        window.click(700, 178)
        window.resting()
        window.key("n")
        window.resting()
        self.keep("compared", window)
        calm = self.rendered(scene, "--look", "calm-morning", size=WIDE)
        self.assert_split(window, dusk, calm, 500)
        screen.hand("mousemove", 500, 100, "mousedown", 1, "mousemove", 400, 100, "mousemove", 300, 100, "mouseup", 1)
        window.resting()
        self.keep("compared further left", window)
        self.assert_split(window, dusk, calm, 300)
        window.key("v")
        window.until_it_shows(dusk, "the look alone again")
        # What passes put out.
        window.key("p")
        window.shows_more(dusk)
        until(lambda: part_that_differs(window.resting(), dusk) > 0.1, "the strip of passes")
        time.sleep(1)
        window.resting()
        self.keep("passes", window)
        before = window.pixels()
        window.click(482, 523)
        window.shows_more(before, 0.3)
        self.keep("a pass", window)
        screen.hand("mousemove", 300, 200)
        window.resting()
        self.keep("a pixel", window)
        window.key("Escape")
        window.key("p")
        window.until_it_shows(dusk, "the picture again")
        self.close(window)

    def both_eyes(self, screen, folder):
        scene = self.scene(folder, "still_life", "eyes.glb")
        window = self.opened(screen, scene)
        window.key("n", "b")
        pair = self.rendered(scene, "--stereo", "side-by-side", size=(WIDE[0] // 2, WIDE[1]))
        window.until_it_shows(pair, "both eyes side by side")
        window.until_it_shows(self.drawn_by(window.copied()), "what the copied command draws for both eyes")
        # The bottle in the right eye's half.
        window.click(800, 290)
        picked = window.shows_more(pair)
        self.keep("picked by both eyes", window)
        window.key("n", "Escape")
        window.until_it_shows(pair, "and let go of")
        window.key("b")
        width = 3 * WIDE[0]
        crossed = b"".join(pair[y + width // 2:y + width] + pair[y:y + width // 2] for y in range(0, len(pair), width))
        window.until_it_shows(crossed, "crossed")
        window.until_it_shows(self.drawn_by(window.copied()), "what the copied command draws crossed")
        window.key("b")
        with tempfile.TemporaryDirectory() as name:
            subprocess.run([self.program, "render", scene, "-o", f"{name}/eye.png", "--stereo", "separate", "--size",
                            f"{WIDE[0]}x{WIDE[1]}", "--samples", SAMPLES, "--quiet"], check=True)
            left, right = bytearray(picture_of(f"{name}/eye.left.png")), picture_of(f"{name}/eye.right.png")
        left[1::3], left[2::3] = right[1::3], right[2::3]
        window.until_it_shows(bytes(left), "red and cyan")
        window.until_it_shows(self.drawn_by(window.copied()), "what the copied command draws in red and cyan")
        self.keep("red and cyan", window)
        assert picked != pair
        window.key("b")
        window.until_it_shows(self.rendered(scene, size=WIDE), "one eye again")
        self.close(window)
        window = self.opened(screen, scene, "--stereo", "side-by-side", "--ipd", "0.1")
        window.key("n")
        window.until_it_shows(self.rendered(scene, "--stereo", "side-by-side", "--ipd", "0.1", size=(WIDE[0] // 2, WIDE[1])), "eyes apart")
        window.until_it_shows(self.drawn_by(window.copied()), "what the copied command draws for eyes apart")
        self.close(window)

    def assert_split(self, window, left, right, line):
        """Each side of the line is its picture, away from it and its labels."""
        seen, width = window.pixels(), 3 * window.size[0]
        for picture, low, high in ((left, 0, line - 20), (right, line + 20, window.size[0])):
            for y in range(0, 450, 10):
                assert seen[y * width + 3 * low:y * width + 3 * high] == picture[y * width + 3 * low:y * width + 3 * high], (y, low, high)

    def save(self, screen, folder):
        scene = self.scene(folder, "still_life", "saved.glb")
        window = self.opened(screen, scene)
        window.key("n")
        first = self.rendered(scene, size=WIDE)
        window.until_it_shows(first, "the picture")
        window.drag(1, (80, 10))
        seen = window.shows_more(first)
        window.key("F12")
        window.shows_more(seen)
        self.keep("save", window)
        window.click(77, 313)
        until(lambda: (folder / "saved-1.png").exists(), "the picture that was saved")
        assert picture_of(folder / "saved-1.png") == seen
        window.resting()
        self.keep("saved", window)
        # A turn, which is stopped.
        window.key("F12")
        window.resting()
        window.click(177, 226)
        window.resting()
        self.keep("save a turn", window)
        window.click(77, 327)
        children = Path(f"/proc/{window.process.pid}/task/{window.process.pid}/children")
        until(lambda: children.read_text(), "a film that is being made")
        time.sleep(1)
        self.keep("making", window)
        window.click(521, 57)
        until(lambda: not children.read_text(), "the end of it")
        assert not (folder / "saved-turn-1.mp4").exists()
        window.resting()
        self.keep("stopped", window)
        self.close(window)

    def kill(self, screen, folder):
        scene = self.scene(folder, "still_life", "killed.glb")
        first = self.rendered(scene, size=WIDE)
        window = self.opened(screen, scene)
        window.click(800, 149)
        screen.hand("type", "torn edge")
        window.resting()
        screen.hand("mousemove", 793, 242, "mousedown", 1, "mousemove", 803, 242, "mousemove", 813, 242, "mouseup", 1)
        window.resting()
        words = window.copied()
        assert any(word.startswith("warp.amount=") for word in words), words
        turned = self.drawn_by(words)
        assert turned != first
        time.sleep(3)
        window.process.kill()
        window.closed()
        # Offered, taken, and offered again until it is saved.
        for answer in ("take", "throw away"):
            window = self.opened(screen, scene)
            self.keep(f"recovered, {answer}", window)
            window.click(45 if answer == "take" else 110, 62)
            window.resting()
            window.key("n")
            window.until_it_shows(turned if answer == "take" else first, answer)
            self.close(window)
        window = self.opened(screen, scene)
        window.key("n")
        window.until_it_shows(first, "nothing is offered any more")
        # Hidden, and shown again.
        number = window.number("killed.glb")
        screen.hand("windowunmap", number)
        time.sleep(0.5)
        screen.hand("windowmap", number)
        window.until_it_shows(first, "the picture after it was hidden")
        self.close(window)

    def knob_of(self, words, path):
        """What the copied command sets a knob to; nothing where it does not."""
        texts = [words[i + 1] for i, word in enumerate(words[:-1]) if word == "--set" and words[i + 1].startswith(path + "=")]
        assert len(texts) <= 1, texts
        return texts[0].split("=", 1)[1] if texts else None

    def keys(self, screen, folder):
        scene = self.scene(folder, "still_life", "keyed.glb")
        first = self.rendered(scene, size=WIDE)
        window = self.opened(screen, scene)

        def track(path):
            text = self.knob_of(window.copied(), path)
            return json.loads(text) if text and text.startswith("{") else text
        # A knob under the mouse gets a key; there is a time from then on.
        window.click(800, 149)
        screen.hand("type", "torn edge")
        screen.hand("key", "Return")
        window.resting()
        screen.hand("mousemove", 640, 242)
        window.resting()
        window.key("i")
        window.resting()
        self.keep("key", window)
        begin = track("warp.amount")
        assert begin["keys"][0][0] == 0 and len(begin["keys"]) == 1, begin
        # Turned at another time, it has another key.
        window.click(430, 604)
        window.resting()
        screen.hand("mousemove", 793, 242, "mousedown", 1, "mousemove", 803, 242, "mousemove", 823, 242, "mouseup", 1)
        window.resting()
        self.keep("two keys", window)
        words = window.copied()
        two = track("warp.amount")
        assert len(two["keys"]) == 2 and two["keys"][1][0] > 1 and two["keys"][1][1] > two["keys"][0][1], two
        turned = self.drawn_by(words)
        assert part_that_differs(turned, first) > 0.01
        window.key("n")
        window.until_it_shows(turned, "the picture at the second key")
        window.key("shift+Left")
        window.until_it_shows(first, "the picture at the first key")
        window.key("n")
        window.resting()
        # The second key is dragged to another time, which is undone at once.
        lane, begin, end = 540, 222, 958
        seconds = 10
        x = begin + (end - begin) * two["keys"][1][0] / seconds
        screen.hand("mousemove", round(x), lane, "mousedown", 1)
        for step in range(1, 6):
            screen.hand("mousemove", round(x) + 20 * step, lane)
        screen.hand("mouseup", 1)
        window.resting()
        self.keep("a key dragged", window)
        later = track("warp.amount")
        assert len(later["keys"]) == 2 and later["keys"][1][0] > two["keys"][1][0] + 0.5, (two, later)
        window.key("ctrl+z")
        window.resting()
        assert track("warp.amount") == two, track("warp.amount")
        # How it goes from one to the other.
        window.click(120, 573)
        window.resting()
        self.keep("interpolations", window)
        window.click(52, 524)
        window.resting()
        assert track("warp.amount") == {**two, "interpolation": "cubic"}, track("warp.amount")
        window.key("ctrl+z")
        window.resting()
        # It has one value again.
        window.click(350, 573)
        window.resting()
        assert isinstance(track("warp.amount"), str), track("warp.amount")
        window.key("ctrl+z")
        window.resting()
        assert track("warp.amount") == two
        window.key("ctrl+s")
        look = folder / "keyed.look.json"
        until(look.exists, "a look beside the scene")
        assert json.loads(look.read_text())["warp"]["amount"] == two, look.read_text()
        self.close(window)
        look.unlink()

    def way(self, screen, folder):
        scene = self.scene(folder, "still_life", "filmed.glb")
        window = self.opened(screen, scene)
        screen.hand("mousemove", 250, 200)
        first = window.resting()
        window.key("i")
        window.shows_more(first)
        self.keep("the camera's first key", window)
        window.click(430, 604)
        window.resting()
        window.drag(1, (120, -20))
        window.resting()
        screen.hand("mousemove", 250, 200)
        window.key("i")
        window.resting()
        self.keep("the camera's second key", window)
        words = window.copied()
        eye = json.loads(self.knob_of(words, "camera.eye"))
        assert len(eye["keys"]) == 2 and eye["interpolation"] == "ease", eye
        assert self.knob_of(words, "camera.mode") == "eye" and "--eye" not in words, words
        window.key("n")
        second = self.drawn_by(words)
        window.until_it_shows(second, "the picture at the second key")
        window.key("Left", "Left", "Left", "Left", "Left", "Left", "Left", "Left")
        between = window.shows_more(second)
        window.until_it_shows(self.drawn_by(window.copied()), "the picture on the way")
        assert part_that_differs(between, second) > 0.02
        # From elsewhere the way is seen, and a key of it is pulled.
        window.key("n")
        window.key("1")
        for _ in range(6):
            screen.hand("mousemove", 300, 250, "click", 5)
        window.resting()
        before = window.pixels()
        window.key("g")
        window.shows_more(before, 0.002)
        self.keep("the camera's way", window)
        self.close(window)

    def place(self, screen, folder):
        scene = self.scene(folder, "still_life", "placed.glb")
        first = self.rendered(scene, size=WIDE)
        window = self.opened(screen, scene)
        before = window.resting()
        window.click(963, 30)
        window.resting()
        self.keep("to be added", window)
        window.click(930, 72)
        window.shows_more(before)
        self.keep("added", window)
        words = window.copied()
        centre = [float(number) for number in self.knob_of(words, "colorizers.Sphere.volume.center").split(",")]
        drawn = self.drawn_by(words)
        assert part_that_differs(drawn, first) > 0.005, "what was added is not to be seen"
        # It lies where the picture was below the middle: there it is pulled, and its size too.
        screen.hand("mousemove", 400, 512, "mousedown", 1, "mousemove", 380, 500, "mousemove", 340, 440, "mouseup", 1)
        window.resting()
        self.keep("pulled", window)
        words = window.copied()
        pulled = [float(number) for number in self.knob_of(words, "colorizers.Sphere.volume.center").split(",")]
        assert pulled != centre and pulled[1] > centre[1], (centre, pulled)
        window.key("ctrl+z")
        window.resting()
        assert [float(number) for number in self.knob_of(window.copied(), "colorizers.Sphere.volume.center").split(",")] == centre
        window.key("ctrl+y")
        window.resting()
        # The light, on its disc in the middle.
        azimuth = self.knob_of(window.copied(), "light.azimuth")
        assert azimuth is None
        self.keep("light", window)
        light = self.light_at(window)
        screen.hand("mousemove", *light, "mousedown", 1, "mousemove", light[0] + 20, light[1], "mousemove", light[0] + 60, light[1] - 20, "mouseup", 1)
        window.resting()
        self.keep("another light", window)
        words = window.copied()
        assert self.knob_of(words, "light.source") == "look" and self.knob_of(words, "light.azimuth"), words
        window.key("n", "g")
        turned = self.drawn_by(words)
        window.until_it_shows(turned, "what was placed and lit, without handles")
        assert part_that_differs(turned, drawn) > 0.02
        window.key("n", "ctrl+z")
        window.resting()
        assert self.knob_of(window.copied(), "light.azimuth") is None, "one step of undoing"
        self.close(window)

    def light_at(self, window):
        """The middle of what has the light's colour."""
        pixels, width = window.pixels(), window.size[0]
        found = [(i % width, i // width) for i in range(width * window.size[1]) if pixels[3 * i:3 * i + 3] == bytes((255, 226, 120))]
        assert len(found) > 50, "there is no light's handle"
        return sum(x for x, _ in found) // len(found), sum(y for _, y in found) // len(found)

    def shaders(self, screen, folder):
        """A copy of the sources is compiled as it is saved."""
        source, build = folder / "sources", folder / "shader build"
        shutil.copytree(self.build.parent / "src", source / "src")
        shutil.copytree(self.build / "generated/shaders", build / "generated/shaders")
        here, there = str(self.build.parent / "src"), str(source / "src")
        for file in (build / "generated/shaders").iterdir():
            if file.name.endswith(".d") or file.name == "commands.json":
                text = file.read_text()
                escaped = there.replace(" ", "\\ ") if file.name.endswith(".d") else there
                text = text.replace(here, escaped)
                file.write_text(text)
        for file in (build / "generated/shaders").glob("*.spv"):
            os.utime(file)
        scene = self.scene(folder, "still_life", "shaded.glb")
        window = self.opened(screen, scene, "--shaders", build)
        window.key("n")
        first = self.rendered(scene, size=WIDE)
        window.until_it_shows(first, "the picture")
        shader = source / "src/passes/final_color/final_color.image.glsl"
        text = shader.read_text()
        changed = text[:text.rindex("return ")] + "return vec4(1, 0, 1, 1) * " + text[text.rindex("return ") + len("return "):]
        assert changed != text
        shader.write_text(changed)
        start = time.monotonic()
        until(lambda: sum(window.pixels()[1::3 * 97]) == 0, "the picture with another shader, without green")
        print(f"a shader that was saved: seen after {1000 * (time.monotonic() - start):.0f} ms")
        other = window.resting()
        self.keep("another shader", window)
        shader.write_text(changed.replace("return vec4(1, 0, 1, 1)", "return nothing"))
        until(lambda: window.pixels() != other, "a complaint")
        assert part_that_differs(window.resting(), other) < 0.3, "the last good picture does not stay"
        self.keep("a broken shader", window)
        shader.write_text(text)
        window.until_it_shows(first, "the first picture again")
        self.close(window)

    def managed(self, screen, folder):
        """Under a window manager, on a screen of its own: what it leaves there when it ends is in the way of others."""
        with contextlib.closing(Screen(1024, 768, folder / "state of managed")) as own:
            self.under_a_manager(own, folder)

    def under_a_manager(self, screen, folder):
        scene = self.scene(folder, "still_life", "managed.glb")
        manager = subprocess.Popen(["openbox", "--sm-disable"], env=screen.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            until(lambda: subprocess.run(["xdotool", "get_desktop"], env=screen.environment, capture_output=True).returncode == 0, "a window manager")
            window = Window(screen, self.program, scene)

            def shows(picture):
                """Wherever on the screen."""
                seen, line, width = screen.pixels(*screen.size), 3 * SIZE[0], 3 * screen.size[0]
                begin = seen.find(picture[:line])
                return begin >= 0 and all(seen[begin + y * width:begin + y * width + line] == picture[y * line:(y + 1) * line]
                                          for y in range(SIZE[1]))

            def is_visible():
                return subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "managed.glb"], env=screen.environment,
                                      capture_output=True).returncode == 0
            until(is_visible, "a window")
            number = window.number("managed.glb")
            screen.hand("windowactivate", "--sync", number)
            window.key("n")
            first = self.rendered(scene)
            until(lambda: shows(first), "the picture")
            screen.hand("windowminimize", "--sync", number)
            until(lambda: not is_visible(), "the window minimised")
            time.sleep(0.5)
            before = window.cpu_seconds()
            time.sleep(1)
            assert window.cpu_seconds() - before <= 0.03, "a window that is minimised works"
            screen.hand("windowactivate", "--sync", number)
            until(lambda: shows(first), "the picture after the window was minimised")
            window.key("F11")
            full = self.rendered(scene, size=screen.size)
            until(lambda: screen.pixels(*screen.size) == full, "the picture over the whole screen")
            window.key("F11")
            until(lambda: shows(first), "the picture in its window again")
            window.key("ctrl+q")
            assert window.closed() == (0, "", ""), window.closed()
        finally:
            manager.terminate()
            manager.wait()

    def fine_monitor(self, screen, folder):
        """On a monitor with twice as fine pixels all that is read is twice as large."""
        scene = self.scene(folder, "still_life", "fine.glb")

        def panel(dpi, size):
            with contextlib.closing(Screen(*size, folder / "state of fine")) as fine:
                subprocess.run(["/usr/bin/python3", "-c", f"""
from Xlib import Xatom, display
screen = display.Display()
screen.screen().root.change_property(Xatom.RESOURCE_MANAGER, Xatom.STRING, 8, b"Xft.dpi:\\t{dpi}")
screen.sync()"""], env=fine.environment, check=True)
                window = self.opened(fine, scene, size=size)
                window.key("n")
                bare = self.rendered(scene, size=size)
                window.until_it_shows(bare, "the picture in full")
                window.key("n")
                shown = window.shows_more(bare)
                self.keep(f"{dpi} dots an inch", window)
                self.close(window)
            width = size[0]
            rows = [y for y in range(size[1]) if shown[3 * width * y:3 * width * (y + 1)] != bare[3 * width * y:3 * width * (y + 1)]]
            middle = rows[len(rows) // 2]
            columns = [x for x in range(width) if shown[3 * (width * middle + x):3 * (width * middle + x) + 3] !=
                       bare[3 * (width * middle + x):3 * (width * middle + x) + 3]]
            return width - columns[0]
        coarse, fine = panel(96, (1920, 1080)), panel(192, (3840, 2160))
        assert abs(fine / coarse - 2) < 0.02, (coarse, fine)

    def lose_the_device(self, screen, folder):
        layers, switch = folder / "layers", folder / "lose it"
        layers.mkdir()
        subprocess.run(["g++", "-std=c++20", "-shared", "-fPIC", HERE / "lose_device.cpp", "-o", layers / "lose_device.so"], check=True)
        (layers / "lose_device.json").write_text(json.dumps({"file_format_version": "1.1.0", "layer": {
            "name": "VK_LAYER_TEST_lose_device", "type": "INSTANCE", "library_path": "./lose_device.so", "api_version": "1.3.0",
            "implementation_version": "1", "description": "loses devices"}}))
        scene = self.scene(folder, "still_life", "lost.glb")
        window = self.opened(screen, scene, environment={"VK_ADD_LAYER_PATH": str(layers), "LOSE_DEVICE": str(switch),
                                                         "VK_INSTANCE_LAYERS": "VK_LAYER_TEST_lose_device"})
        window.key("n")
        first = self.rendered(scene, size=WIDE)
        window.until_it_shows(first, "the picture")
        window.drag(1, (90, 10))
        turned = window.shows_more(first)
        for way in ((30, 0), (-30, 0)):
            switch.touch()
            window.drag(1, way)
            until(lambda: not switch.exists(), "the loss of the device")
            until(lambda: part_that_differs(window.pixels(), turned) > 0.02, "another picture on another device")
            turned = window.resting()
            self.keep("another device", window)
            window.until_it_shows(self.drawn_by(window.copied()), "the picture on another device")
        self.close(window)

    def demo(self, screen, folder):
        window = self.opened(screen)
        window.key("n")
        window.resting()
        self.keep("demo", window)
        words = window.copied()
        assert words[2].endswith("/demo.glb"), words
        window.key("space")
        self.close(window)

    def spectator(self, screen, folder):
        """What those see who do not wear the headset; without one, by the runtime of tests/xr."""
        scene = self.scene(folder, "still_life", "seen.glb")
        script = folder / "headset.json"
        script.write_text(json.dumps({"hands": {"pause": [1]}}))
        runtime = {"XR_RUNTIME_JSON": str(self.build / "xr_test/runtime.json"), "SCUMBLE_TEST_XR": str(script)}
        stand = ["--eye", "2.5,1.2,4", "--target", "0,1.2,0"]  # level, as headsets are
        words = [self.program, "xr", scene, *stand, "--spectator", "--size", f"{SIZE[0]}x{SIZE[1]}", "--samples", SAMPLES, "--ready", "0", "--validate", "--quiet"]
        out = folder / "seen.png"
        subprocess.run([self.program, "render", scene, *stand, "--fov", "60", "--size", f"{SIZE[0]}x{SIZE[1]}", "--samples", SAMPLES, "-o", out, "--quiet"], check=True)
        wanted = picture_of(out)
        process = subprocess.Popen(words, env={**screen.environment, **runtime}, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        until(lambda: process.poll() is not None or part_that_differs(screen.pixels(*SIZE), wanted) < 0.01, "what the headset sees")
        process.send_signal(signal.SIGINT)
        assert (process.communicate(timeout=60), process.returncode) == ((b"", b""), 0)
        nowhere = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = subprocess.run(words, env={**nowhere, **runtime}, capture_output=True, text=True, timeout=60)
        assert done.returncode == 4 and done.stderr.count("\n") == 1, done.stderr

    def mistakes(self, screen, folder):
        def run(*words, environment=screen.environment):
            done = subprocess.run([self.program, "view", *map(str, words)], env=environment, capture_output=True, text=True, timeout=60)
            return done.returncode, done.stderr
        scene = folder / "still.glb"
        nowhere = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        code, text = run(scene, environment=nowhere)
        assert code == 4 and text.count("\n") == 1 and "`scumble render`" in text, (code, text)
        code, text = run(folder / "none.glb")
        assert code == 3 and text.count("\n") == 1 and "none.glb" in text, (code, text)
        code, text = run(scene, "--look", "no-such-look")
        assert code == 2 and "no-such-look" in text, (code, text)
        code, text = run(scene, "--eye", "1,2")
        assert code == 2 and "--eye" in text, (code, text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("--pictures", type=Path, help="keep what the window shows there")
    parser.add_argument("--only", default="", help="parts whose names have this in them")
    chosen = parser.parse_args()
    if chosen.pictures:
        chosen.pictures.mkdir(parents=True, exist_ok=True)
    test = Test(chosen.build.resolve(), chosen.pictures)
    parts = (test.look_at_a_scene, test.play, test.pick, test.drops, test.compare, test.both_eyes, test.save, test.kill, test.keys, test.way, test.place, test.shaders,
             test.managed, test.fine_monitor, test.lose_the_device, test.demo, test.spectator, test.mistakes)
    with tempfile.TemporaryDirectory(prefix="scumble window ") as name:
        folder = Path(name)
        with contextlib.closing(Screen(1024, 768, folder / "state")) as screen:
            for part in parts:
                if chosen.only in part.__name__:
                    screen.environment["XDG_STATE_HOME"] = str(folder / f"state of {part.__name__}")
                    part(screen, folder)
                    print(f"passed  {part.__name__}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
