#!/usr/bin/env python3
"""The job type for Flamenco: what it makes of settings, by node with stand-ins for what Flamenco's manager gives to scripts; and
those tasks, run as a worker runs them.

    tests/farm/flamenco_test.py SCUMBLE DEMO_SCENE [unittest's options]

Skipped, with a notice, where there is no node.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "farm/flamenco/scumble.js"
# Of Flamenco's manual and behaviour: ranges come with '-', whatever they were given with, and pairs as two numbers.
MANAGER = r"""
function explode(text) {
    const numbers = new Set();
    for (const part of text.replaceAll("..", "-").split(",")) {
        const ends = part.split("-").map(end => parseInt(end.trim(), 10));
        if (ends.some(isNaN) || ends.length > 2) throw new Error("invalid range " + text);
        for (let n = ends[0]; n <= ends[ends.length - 1]; ++n) numbers.add(n);
    }
    return [...numbers].sort((a, b) => a - b);
}
function merge(numbers) {
    const ranges = [];
    for (let first = 0, next = 0; first < numbers.length; first = next) {
        for (next = first + 1; next < numbers.length && numbers[next] === numbers[next - 1] + 1; ++next);
        if (next - first > 2) ranges.push(numbers[first] + "-" + numbers[next - 1]);
        else for (let i = first; i < next; ++i) ranges.push("" + numbers[i]);
    }
    return ranges.join(",");
}
function frameChunker(text, size) {
    const numbers = explode(text), chunks = [];
    if (size < 1) throw new Error("invalid chunk size");
    for (let i = 0; i < numbers.length; i += size) chunks.push(merge(numbers.slice(i, i + size)));
    return chunks;
}
const author = {
    Task: (name, type) => ({ name, type, commands: [], dependencies: [],
        addCommand(command) { this.commands.push(command); }, addDependency(task) { this.dependencies.push(task.name); } }),
    Command: (name, parameters) => ({ name, parameters }),
};
"""
scumble = demo_scene = None


class Flamenco(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="scumble flamenco "))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def compile(self, **settings):
        """The tasks, in the order in which they were added; settings that are not given have the job type's defaults."""
        text = f"""'use strict'; {MANAGER} {SCRIPT.read_text()}
const settings = {{}};
for (const setting of JOB_TYPE.settings) if ('default' in setting) settings[setting.key] = setting.default;
Object.assign(settings, {json.dumps(settings)});
for (const setting of JOB_TYPE.settings) if (setting.required && !settings[setting.key]) throw new Error(setting.key + ' is missing');
const job = {{ settings, tasks: [], addTask(task) {{ this.tasks.push(task); }} }};
compileJob(job);
process.stdout.write(JSON.stringify(job.tasks));"""
        done = subprocess.run(["node", "-"], input=text, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def run_task(self, task):
        """As a worker does: each command by itself, the task fails with the first that fails."""
        for command in task["commands"]:
            self.assertEqual(command["name"], "exec")
            words = [command["parameters"]["exe"], *command["parameters"]["args"]]
            done = subprocess.run(words, cwd="/", capture_output=True, text=True, timeout=120)
            if done.returncode:
                return done
        return done

    def test_tasks_and_what_they_wait_for(self):
        tasks = self.compile(scene="/s/a b.glb", frames="1-3, 5, 8..12", chunk_size=3, output="/s/f.####.png", look="ink",
                             options="--set 'paint.a b=1' --orbit=-30,15\n--aov=\"depth\"", scumble_cmd="{scumble}")
        self.assertEqual([(task["name"], task["type"]) for task in tasks],
                         [("render 1-3", "scumble"), ("render 5,8,9", "scumble"), ("render 10-12", "scumble"), ("check", "misc")])
        self.assertEqual(tasks[-1]["dependencies"], [task["name"] for task in tasks[:-1]])
        words = [command["parameters"]["args"] for command in tasks[1]["commands"]]
        self.assertEqual([each[-5] for each in words], ["--frames=5..5", "--frames=8..9"])
        self.assertEqual(words[0], ["render", "--set", "paint.a b=1", "--orbit=-30,15", "--aov=depth", "--look=ink", "--frames=5..5", "--fps=24",
                                    "--output=/s/f.####.png", "--resume", "/s/a b.glb"])
        self.assertEqual({command["parameters"]["exe"] for task in tasks for command in task["commands"]}, {"{scumble}"})
        self.assertEqual([command["parameters"]["args"][-5] for command in tasks[-1]["commands"]], ["--frames=1..3", "--frames=5..5", "--frames=8..12"])

    def test_films_know_what_frames_are(self):
        def calls(**settings):
            return [command["parameters"]["args"] for command in self.compile(scene="/s/a.glb", output="/s/f.####.exr", film="/s/f.mp4", **settings)[-1]["commands"]]

        self.assertEqual(calls(frames="0-1", fps=12), [["film", "--frames=0..1", "--fps=12", "--output=/s/f.mp4", "/s/f.####.exr"]])
        self.assertEqual(calls(frames="0-9", options="--stereo side-by-side --panorama=vr180"),
                         [["film", "--frames=0..9", "--fps=24", "--stereo=side-by-side", "--panorama=vr180", "--output=/s/f.mp4", "/s/f.####.exr"]])
        self.assertEqual(calls(frames="0-9", options="--stereo=separate"),
                         [["film", "--frames=0..9", "--fps=24", "--stereo=separate", f"--output=/s/f.{eye}.mp4", f"/s/f.####.{eye}.exr"] for eye in ("left", "right")])

    def test_a_film_of_frames_with_gaps_is_refused(self):
        with self.assertRaisesRegex(AssertionError, "without gaps"):
            self.compile(scene="/s/a.glb", frames="1-3,7", output="/s/f.####.png", film="/s/f.mp4")

    def test_workers_draw_what_one_machine_draws(self):
        subprocess.run([demo_scene, self.folder / "scene.glb"], check=True, stdout=subprocess.DEVNULL)
        small = ["--size", "64x36", "--samples", "1", "--quiet"]
        frames = {"output": str(self.folder / "f.####.png"), "film": str(self.folder / "f.mp4")}
        tasks = self.compile(scene=str(self.folder / "scene.glb"), frames="0-9", chunk_size=4, scumble_cmd=scumble, options=" ".join(small), **frames)
        self.assertEqual([task["name"] for task in tasks], ["render 0-3", "render 4-7", "render 8,9", "check", "film"])
        renders, (check, film) = tasks[:3], tasks[3:]
        self.assertEqual(film["dependencies"], ["check"])
        # Not all frames are there.
        self.assertEqual(self.run_task(renders[0]).returncode, 0)
        failed = self.run_task(check)
        self.assertEqual(failed.returncode, 3)
        self.assertIn("6 frames are not there, whole: 4..9", failed.stderr)
        # What an earlier try has left behind still draws while the task is tried again.
        left = subprocess.Popen([scumble, *renders[1]["commands"][0]["parameters"]["args"]])
        self.assertEqual(self.run_task(renders[1]).returncode, 0)
        self.assertEqual(left.wait(60), 0)
        for task in (renders[2], check, film):
            done = self.run_task(task)
            self.assertEqual(done.returncode, 0, done.stderr)
        alone = self.folder / "alone"
        alone.mkdir()
        for output in ("f.####.png", "f.mp4"):
            subprocess.run([scumble, "render", self.folder / "scene.glb", "--frames", "0..9", *small, "-o", alone / output], check=True)
        for path in alone.iterdir():
            self.assertTrue(path.read_bytes() == (self.folder / path.name).read_bytes(), f"{path.name} has other bytes")
        self.assertEqual(len(list(alone.iterdir())), 11)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    if not shutil.which("node"):
        print("SKIPPED: Flamenco's job type: there is no node")
        sys.exit(0)
    scumble, demo_scene = (os.path.abspath(path) for path in sys.argv[1:3])
    with tempfile.TemporaryDirectory(prefix="scumble flamenco cache ") as cache:
        os.environ["XDG_CACHE_HOME"] = cache
        program = unittest.main(argv=[sys.argv[0], *sys.argv[3:]], exit=False)
    sys.exit(not program.result.wasSuccessful())
