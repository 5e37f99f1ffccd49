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
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SIZE = (640, 400)
SAMPLES = "1"


class Screen:
    """An X server of its own."""

    def __init__(self, width, height):
        self.size = (width, height)
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp"],
                                       pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.display = ":" + number.readline().strip()
        self.environment = {**os.environ, "DISPLAY": self.display}
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
    def __init__(self, screen, program, *options):
        self.screen, self.size = screen, SIZE
        self.started = time.monotonic()
        self.process = subprocess.Popen([program, "view", *map(str, options), "--size", f"{SIZE[0]}x{SIZE[1]}", "--samples", SAMPLES,
                                         "--validate"], env=screen.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def pixels(self):
        return self.screen.pixels(*self.size)

    def until_it_shows(self, picture, what, seconds=30):
        def same():
            assert self.process.poll() is None, self.process.communicate()
            return self.pixels() == picture
        return until(same, what, seconds)

    def resting(self):
        """What it shows when it does not change any more."""
        last, since = self.pixels(), time.monotonic()
        while time.monotonic() - since < 0.7:
            time.sleep(0.1)
            now = self.pixels()
            if now != last:
                last, since = now, time.monotonic()
        return last

    def key(self, *keys):
        self.screen.hand("key", *keys)

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

    def rendered(self, scene, *options, size=SIZE):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "picture.png"
            subprocess.run([self.program, "render", scene, "-o", path, "--size", f"{size[0]}x{size[1]}", "--samples", SAMPLES, "--quiet",
                            *map(str, options)], check=True, capture_output=True)
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
        number = subprocess.run(["xdotool", "search", "--name", "still.glb"], env=screen.environment, check=True, capture_output=True,
                                text=True).stdout.split()[0]
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
    chosen = parser.parse_args()
    if chosen.pictures:
        chosen.pictures.mkdir(parents=True, exist_ok=True)
    test = Test(chosen.build.resolve(), chosen.pictures)
    with tempfile.TemporaryDirectory(prefix="scumble window ") as folder, contextlib.closing(Screen(1024, 768)) as screen:
        for part in (test.look_at_a_scene, test.play, test.mistakes):
            part(screen, Path(folder))
            print(f"passed  {part.__name__}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
