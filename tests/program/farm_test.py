#!/usr/bin/env python3
"""Frames for many machines, from outside: films of sequences, what is missing, and a farm's scripts, run as Slurm would run
them, without Slurm (tests/farm has the real one).

    tests/program/farm_test.py SCUMBLE DEMO_SCENE [unittest's options]     as program_test.py
"""
import json
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import program_test
from film_test import moving, probe
from program_test import DONE, NOT_WRITTEN, TINY, UNUSABLE, USAGE, Program

QUIET = [*TINY, "--quiet"]


class Missing(Program):
    def test_frames_that_are_missing_or_cut_are_named(self):
        self.put("moving.gltf", moving())
        call = ["render", "moving.gltf", "--frames", "0..7", "-o", "f.####.exr", "--aov", "depth,shadow-map", *QUIET]
        self.bad(UNUSABLE, *call, "--missing", says="8 frames are not there, whole: 0..7; draw them with --resume")
        self.good(*call)
        self.assertEqual(self.good(*call, "--missing"), "")
        before = {name: (self.folder / name).stat().st_mtime_ns for name in self.files()}
        (self.folder / "f.0002.exr").unlink()
        os.truncate(self.folder / "f.0004.exr", (self.folder / "f.0004.exr").stat().st_size - 1)
        (self.folder / "f.0005.shadow-map.exr").write_bytes(b"")
        self.before = self.files()
        self.bad(UNUSABLE, *call, "--missing", says="f.####.exr: 3 frames are not there, whole: 2, 4..5;")
        self.good(*call, "--resume")
        self.good(*call, "--missing")
        drawn = {name for name, then in before.items() if (self.folder / name).stat().st_mtime_ns != then}
        self.assertEqual(drawn, {f"f.000{n}{part}.exr" for n in (2, 4, 5) for part in ("", ".shadow-map")})

    def test_one_picture(self):
        self.bad(UNUSABLE, "render", "box.gltf", "-o", "x.png", *QUIET, "--missing", says="x.png: it is not there, whole")
        self.good("render", "box.gltf", "-o", "x.png", *QUIET)
        self.good("render", "box.gltf", "-o", "x.png", *QUIET, "--missing")

    def test_a_film_has_no_frames_to_look_for(self):
        self.bad(USAGE, "render", "box.gltf", "-o", "x.mp4", "--frames", "0..3", *QUIET, "--missing", says="`scumble film`")


@unittest.skipUnless(shutil.which("ffmpeg"), "there is no ffmpeg")
class Film(Program):
    def setUp(self):
        super().setUp()
        self.put("moving.gltf", moving())

    def both(self, film, pictures, *options, of_film=()):
        """The bytes of a film that is drawn, and of one that is made of its pictures."""
        call = ["render", "moving.gltf", "--frames", "3..8", *(QUIET if "--size" not in options else QUIET[2:]), *options]
        self.good(*call, "-o", "drawn" + film)
        self.good(*call, "-o", pictures)
        self.good("film", pictures, "-o", "made" + film, "--quiet", *of_film)
        return [(self.folder / (name + film)).read_bytes() for name in ("drawn", "made")]

    def test_of_pictures_it_is_the_film_that_is_drawn(self):
        for film, pictures, options, of_film in (
                (".mp4", "a.####.png", ["--fps", "23.976"], ["--fps", "23.976"]),
                (".webm", "b-##.png", [], ["--quality", "20"]),
                (".gif", "c.####.webp", ["--quality", "100"], []),
                (".mp4", "d.####.exr", ["--stereo", "side-by-side"], ["--stereo", "side-by-side"]),
                (".mp4", "e.####.png", ["--stereo", "over-under"], ["--stereo", "over-under"]),
                (".mp4", "f.####.exr", ["--stereo", "anaglyph"], ["--stereo", "anaglyph"])):
            with self.subTest(pictures=pictures):
                if film == ".gif":  # a WebP's quality is not the film's
                    self.good("render", "moving.gltf", "--frames", "3..8", *QUIET, "-o", "drawn.gif")
                    self.good("render", "moving.gltf", "--frames", "3..8", *options, *QUIET, "-o", pictures)
                    self.good("film", pictures, "-o", "made.gif", "--quiet")
                    drawn, made = [(self.folder / name).read_bytes() for name in ("drawn.gif", "made.gif")]
                else:
                    drawn, made = self.both(film, pictures, *options, of_film=of_film)
                self.same(drawn, made, pictures)
        stream = probe(self.folder / "made.mp4", "stream=nb_read_frames")["streams"][0]
        self.assertEqual(stream["nb_read_frames"], "6")

    def test_a_part_of_them(self):
        self.good("render", "moving.gltf", "--frames", "-2..9", "-o", "n.##.png", *QUIET)
        self.good("film", "n.##.png", "--frames", "-1..3", "-o", "x.mp4", "--quiet")
        self.good("film", "n.##.png", "-o", "y.mp4", "--quiet")
        counts = [probe(self.folder / name, "stream=nb_read_frames")["streams"][0]["nb_read_frames"] for name in ("x.mp4", "y.mp4")]
        self.assertEqual(counts, ["5", "12"])

    def test_mistakes(self):
        self.good("render", "moving.gltf", "--frames", "0..4", "-o", "f.####.png", *QUIET)
        (self.folder / "f.0002.png").unlink()
        shutil.copy(self.folder / "f.0001.png", self.folder / "f.1.png")  # is none of them
        self.before = self.files()
        for code, args, says in (
                (UNUSABLE, ["f.####.png", "-o", "x.mp4"], "f.####.png: of 5 pictures, 1 is not there, whole: 2;"),
                (UNUSABLE, ["f.####.png", "-o", "x.mp4", "--frames", "3..6"], "of 4 pictures, 2 are not there, whole: 5..6"),
                (UNUSABLE, ["g.####.png", "-o", "x.mp4"], "there is no such picture"),
                (UNUSABLE, ["no/f.####.png", "-o", "x.mp4"], "there is no such picture"),
                (USAGE, ["f.0001.png", "-o", "x.mp4"], "names no sequence"),
                (USAGE, ["f.####.png", "-o", "x.png"], "is no film"),
                (USAGE, ["f.####.mp4", "-o", "x.mp4"], "are no pictures"),
                (USAGE, ["f.####.png"], "--output is missing"),
                (USAGE, ["f.####.png", "-o", "x.mp4", "--frames", "3"], "is no range"),
                (USAGE, ["f.####.png", "-o", "x.mp4", "--fps", "0"], "--fps is out of range"),
                (USAGE, ["f.####.png", "-o", "x.mp4", "--quality", "99"], "--quality 99"),
                (NOT_WRITTEN, ["f.####.png", "-o", "no/x.mp4"], "the folder does not exist")):
            with self.subTest(args=args):
                self.bad(code, "film", *args, says=says)

    def test_pictures_of_two_sizes(self):
        self.good("render", "box.gltf", "-o", "f.1.png", *QUIET)
        self.good("render", "box.gltf", "-o", "f.2.png", "--size", "48x18", "--samples", "1", "--quiet")
        self.before = self.files()
        self.bad(UNUSABLE, "film", "f.#.png", "-o", "x.mp4", "--quiet", says="f.2.png: it has 48 x 18 pixels")


    def test_eyes_and_panoramas(self):
        # What is known of them goes into the film, and which eye's turn it is counts by the frame's number.
        for options, of_film in ((["--stereo", "wiggle"], ["--stereo", "wiggle"]),
                                 (["--panorama", "mono360", "--size", "64x32"], ["--panorama", "mono360"]),
                                 (["--panorama", "vr180", "--size", "32x32"], ["--panorama", "vr180"])):
            with self.subTest(options=options):
                drawn, made = self.both(".mp4", f"{options[1]}.####.exr", *options, of_film=of_film)
                self.same(drawn, made)
        call = ["render", "moving.gltf", "--frames", "0..1", "--panorama", "vr180", "--stereo", "separate", "--size", "32x32", "--samples", "1", "--quiet"]
        self.good(*call, "-o", "e.mp4")
        self.good(*call, "-o", "e.####.exr")
        for eye in ("left", "right"):
            self.good("film", f"e.####.{eye}.exr", "-o", f"made.{eye}.mp4", "--panorama", "vr180", "--stereo", "separate", "--quiet")
            self.same((self.folder / f"e.{eye}.mp4").read_bytes(), (self.folder / f"made.{eye}.mp4").read_bytes())

    def test_numbers_stand_in_the_file_name_alone(self):
        (self.folder / "x#1").mkdir()
        self.good("render", "box.gltf", "--frames", "3..4", "-o", "x#1/a.##.b.##.png", *QUIET)
        self.assertEqual(self.new_files() - {"moving.gltf"}, {"x#1/a.03.b.##.png", "x#1/a.04.b.##.png"})
        self.good("film", "x#1/a.##.b.##.png", "-o", "x.mp4", "--quiet")

    def test_a_picture_that_is_damaged_inside(self):
        self.good("render", "moving.gltf", "--frames", "0..2", "-o", "f.##.png", *QUIET)
        path = self.folder / "f.01.png"
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 0xff
        path.write_bytes(content)
        self.before = self.files()
        self.bad(UNUSABLE, "film", "f.##.png", "-o", "x.mp4", "--quiet", says=["f.01.png", "; delete it, and draw it again with"])


class Farm(Program):
    """The scripts of `scumble farm slurm`, run by bash with the variables that Slurm sets."""

    def setUp(self):
        super().setUp()
        self.put("moving.gltf", moving())
        self.node = Path(self.folder) / "node's disk"
        self.node.mkdir()
        self.nowhere = self.folder / "nowhere.conf"  # a cluster that is none
        self.nowhere.write_text("")
        self.before = self.files()

    def farm(self, *args, warnings=False):
        # No cluster is asked, whatever this machine has.
        done = self.run_program("farm", "slurm", *args, "--stage", str(self.node), environment={"SLURM_CONF": str(self.nowhere)})
        self.assertEqual(done.returncode, DONE, done.stderr)
        if not warnings:
            self.assertEqual(done.stderr, "")
        return done.stdout

    def script(self, folder, name, *args, task=None, job=7, **environment):
        env = {**os.environ, **environment, "SLURM_ARRAY_JOB_ID": str(job)}
        if task is not None:
            env["SLURM_ARRAY_TASK_ID"] = str(task)
        return subprocess.run(["bash", str(self.folder / folder / name), *args], cwd="/", env=env, capture_output=True, text=True, timeout=120)

    def frames(self, pattern):
        return {path.name: path.read_bytes() for path in self.folder.glob(pattern)}

    def test_tasks_draw_what_one_machine_draws(self):
        self.put("sub dir/look.json", json.dumps({"extends": "base.json"}))
        self.put("sub dir/base.json", json.dumps({"extends": "age-of-sail", "shadow": {"threshold": 0.4}}))
        call = ["moving.gltf", "--look", "sub dir/look.json", "--frames", "-3..10", "--orbit", "-30,15", "--stereo", "separate",
                "--set", "shadow.softness=0.5", "--seed", "3", "--fps", "12", "--aov", "depth", *TINY]
        said = self.farm(*call, "-o", "it's ##.png", "--film", "film.mp4", "--chunk", "4", "--at-once", "3",
                         "--sbatch=--partition=night", "--sbatch=--account=a b")
        self.assertIn("frames: 14 (-3..10), 4 a task; tasks: 4; files that are read: 3,", said)
        folder = "it's.farm"
        text = (self.folder / folder / "render.sbatch").read_text()
        for line in ("#SBATCH --array=0-3%3", "#SBATCH --partition=night", "#SBATCH --account=a b", "#SBATCH --requeue"):
            self.assertIn("\n" + line + "\n", text)
        self.assertNotIn("gres", text)
        # What was packed is what is drawn, whatever becomes of the files.
        for name in ("moving.gltf", "sub dir/base.json", "sub dir/look.json"):
            os.rename(self.folder / name, self.folder / (name + ".kept"))
        for task in (2, 0, 3, 1):
            done = self.script(folder, "render.sbatch", task=task)
            self.assertEqual(done.returncode, 0, done.stderr)
        # Asked again, nothing is drawn anew.
        times = {path: path.stat().st_mtime_ns for path in self.folder.glob("*.png")}
        self.assertEqual(self.script(folder, "render.sbatch", task=1).returncode, 0)
        self.assertEqual(times, {path: path.stat().st_mtime_ns for path in self.folder.glob("*.png")})
        done = self.script(folder, "finish.sbatch", "7")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("all 14 frames are there, whole", done.stdout)
        self.assertRegex(done.stdout, r"4 \S+")  # tasks, and their device
        farmed = self.frames("it's *.png") | self.frames("*.exr") | self.frames("film.*.mp4")
        self.assertEqual(len(farmed), 14 * 2 * 2 + 2)
        self.assertEqual([path.name for path in (self.node / f"scumble-{os.getuid()}").glob("inputs.*") if path.is_dir()],
                         [path.stem for path in (self.folder / folder).glob("inputs.*.tar")])

        for name in ("moving.gltf", "sub dir/base.json", "sub dir/look.json"):
            os.rename(self.folder / (name + ".kept"), self.folder / name)
        for name in farmed:
            (self.folder / name).unlink()
        self.good("render", *call, "-o", "it's ##.png", "--quiet")
        self.good("render", *[word for word in call if word not in ("--aov", "depth")], "-o", "film.mp4", "--quiet")
        alone = self.frames("it's *.png") | self.frames("*.exr") | self.frames("film.*.mp4")
        self.assertEqual(set(alone), set(farmed))
        for name in alone:
            self.same(alone[name], farmed[name], name)

    def test_what_is_missing_is_named_and_no_film_is_made(self):
        self.farm("moving.gltf", "--frames", "0..5", "-o", "f.####.png", "--film", "f.mp4", "--chunk", "2", *TINY)
        for task in (0, 2):
            self.assertEqual(self.script("f.farm", "render.sbatch", task=task).returncode, 0)
        done = self.script("f.farm", "finish.sbatch", "7")
        self.assertEqual(done.returncode, UNUSABLE)
        self.assertIn("2 frames are not there, whole: 2..3", done.stderr)
        self.assertFalse((self.folder / "f.mp4").exists())

    def test_a_task_that_was_killed_while_it_unpacked_does_not_hinder_the_next(self):
        self.farm("moving.gltf", "--frames", "0..1", "-o", "f.####.png", "--chunk", "1", *TINY)
        packed = next((self.folder / "f.farm").glob("inputs.*.tar")).stem
        stage = self.node / f"scumble-{os.getuid()}"
        (stage / (packed + ".part")).mkdir(parents=True)
        (stage / (packed + ".part") / "moving.gltf").write_text("half of it")
        old = stage / "inputs.0123456789abcdef"
        old.mkdir()
        os.utime(old, (0, 0))
        self.assertEqual(self.script("f.farm", "render.sbatch", task=0).returncode, 0)
        self.assertFalse(old.exists(), "copies that nobody uses are kept")
        # A process that an earlier task has left behind holds no lock, and may draw the same frames.
        left = subprocess.Popen(["bash", str(self.folder / "f.farm/render.sbatch")], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                env={**os.environ, "SLURM_ARRAY_JOB_ID": "7", "SLURM_ARRAY_TASK_ID": "1"})
        self.assertEqual(self.script("f.farm", "render.sbatch", task=1).returncode, 0)
        self.assertEqual(left.wait(60), 0)
        self.assertEqual(self.script("f.farm", "finish.sbatch", "7").returncode, 0)

    def test_links_and_parent_folders(self):
        """What is drawn is what a plain call draws, also where a name without '..' would be another file."""
        (self.folder / "other/deep").mkdir(parents=True)
        (self.folder / "link").symlink_to("other/deep")
        self.put("other/box.gltf", program_test.gltf((0.1, 0.2, 0.9)))
        self.farm("link/../box.gltf", "--frames", "0..1", "-o", "f.#.png", "--chunk", "9", *TINY)
        self.assertEqual(self.script("f.farm", "render.sbatch", task=0).returncode, 0)
        self.good("render", "link/../box.gltf", "--frames", "0..1", "-o", "g.#.png", *QUIET)
        self.same((self.folder / "f.0.png").read_bytes(), (self.folder / "g.0.png").read_bytes())
        self.before = self.files()
        self.bad(USAGE, "farm", "slurm", "link/../box.gltf", "box.gltf", "--frames", "0..1", "-o", "f.#.png", "--chunk", "9", *TINY,
                 says="another input has the same name", environment={"SLURM_CONF": str(self.nowhere)})

    def test_many_tasks_stage_at_once(self):
        self.farm("moving.gltf", "--frames", "0..7", "-o", "f.####.png", "--chunk", "1", *TINY)
        stage = self.node / f"scumble-{os.getuid()}"
        stage.mkdir()
        for round_ in range(3):
            # Also where the copy that is there is old, and there are others.
            for name in [f"inputs.{i:016}" for i in range(20)] + [path.name for path in stage.glob("inputs.*")]:
                (stage / name).mkdir(exist_ok=True)
                os.utime(stage / name, (0, 0))
            tasks = [subprocess.Popen(["bash", str(self.folder / "f.farm/render.sbatch")], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                      env={**os.environ, "SLURM_ARRAY_JOB_ID": "7", "SLURM_ARRAY_TASK_ID": str(task)}) for task in range(4)]
            for task in tasks:
                said = task.communicate(timeout=60)[0]
                self.assertEqual(task.returncode, 0, said)
            # Whether a driver keeps something in 'cache' is the driver's matter, and its environment's.
            self.assertEqual({path.name for path in stage.iterdir()} - {"cache"},
                             {"lock", *(path.stem for path in (self.folder / "f.farm").glob("inputs.*.tar"))})

    def test_a_device_that_is_lost_is_tried_again(self):
        program = self.folder / "program"
        program.write_text(f"""#!/bin/bash
echo try >>{str(self.folder)!r}/tries
[ "$(wc -l <{str(self.folder)!r}/tries)" -ge "$LOST" ] || exit 4
exit 3
""")
        program.chmod(0o755)
        self.farm("moving.gltf", "--frames", "0..1", "-o", "f.####.png", "--chunk", "9", *TINY, "--program", str(program))
        script = self.folder / "f.farm/render.sbatch"
        script.write_text(script.read_text().replace("sleep 20", "sleep 0"))
        for lost, code, tries in ((3, 3, 3), (9, 4, 3), (1, 3, 1)):
            self.assertEqual(self.script("f.farm", "render.sbatch", task=0, LOST=str(lost)).returncode, code)
            self.assertEqual(len((self.folder / "tries").read_text().split()), tries)
            (self.folder / "tries").unlink()

    def test_the_end_comes_however_tasks_ended(self):
        self.farm("moving.gltf", "--frames", "0..1", "-o", "f.####.png", "--chunk", "9", *TINY)
        done = self.script("f.farm", "finish.sbatch", "7")
        self.assertEqual(done.returncode, UNUSABLE)
        self.assertIn("2 frames are not there, whole: 0..1", done.stderr)
        for job, devices, says in (("8", ["One", "One"], False), ("9", ["One", "Two", ""], True)):
            reports = self.folder / "f.farm/stats" / job
            reports.mkdir(parents=True)
            for number, device in enumerate(devices):
                (reports / f"{number}.0.json").write_text(json.dumps({"device": device} if device else {}, indent=2))
            done = self.script("f.farm", "finish.sbatch", job)
            self.assertEqual("devices round differently" in done.stderr, says, done.stderr)
            self.assertRegex(done.stdout, r"\b" + str(devices.count("One")) + " One\n")
        # What is there needs no device.
        self.good("render", "moving.gltf", "--frames", "0..1", "-o", "f.####.png", *QUIET)
        nobody = {"VK_ICD_FILENAMES": "/no.json", "VK_DRIVER_FILES": "/no.json"}
        done = self.script("f.farm", "render.sbatch", task=0, **nobody)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("all 2 frames are there", self.script("f.farm", "finish.sbatch", "7", **nobody).stdout)

    def cluster(self, **says):
        """Programs of Slurm that print what they are told, and keep their words."""
        programs = self.folder / "programs"
        programs.mkdir()
        for name, text in says.items():
            (programs / name).write_text(f"#!/bin/bash\nprintf '%s ' {name} \"$@\" >>{str(self.folder)!r}/words\necho >>{str(self.folder)!r}/words\n{text}\n")
            (programs / name).chmod(0o755)
        return {"PATH": f"{programs}:{os.environ['PATH']}"}

    def test_what_the_cluster_says(self):
        environment = self.cluster(sinfo="echo '3 (null)'; echo '2 gres:gpu:4'; echo '2 gpu:a100:2(S:0)'", scontrol="echo 'MaxArraySize            = 5'",
                                   sbatch="[ -z \"$REFUSED\" ] || [[ $1 = --parsable && $2 != --dep* ]] || exit 1; echo '42;name'", scancel="")
        call = ["farm", "slurm", "moving.gltf", "--frames", "0..99", "-o", "f.####.png", *TINY, "--stage", str(self.node)]
        done = self.run_program(*call, "--chunk", "10", "--submit", environment=environment)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("it is 20", done.stderr)
        self.assertIn("job 42 draws 100 frames in 5 tasks; job 42 then", done.stdout)
        words = (self.folder / "words").read_text().splitlines()
        self.assertEqual([line.strip() for line in words if line.startswith("sbatch")],
                         [f"sbatch --parsable {self.folder}/f.farm/render.sbatch", f"sbatch --parsable --dependency=afterany:42 {self.folder}/f.farm/finish.sbatch 42"])
        text = (self.folder / "f.farm/render.sbatch").read_text()
        self.assertIn("#SBATCH --gres=gpu:1\n", text)
        self.assertIn("--device=gpu", text)
        # Whoever asks for a kind of GPU has asked.
        asked = self.run_program(*call, "--chunk", "20", "--dry-run", "--sbatch=--gres=gpu:a100:1", environment=environment).stdout
        self.assertNotIn("--gres=gpu:1\n", asked)
        # Without the second job there is no first one.
        done = self.run_program(*call, "--chunk", "20", "--submit", environment={**environment, "REFUSED": "1"})
        self.assertEqual(done.returncode, NOT_WRITTEN, done.stdout)
        self.assertIn("scancel 42", (self.folder / "words").read_text())

    def test_gpus(self):
        args = ["moving.gltf", "--frames", "0..1", "-o", "f.####.png", "--chunk", "1", *TINY, "--dry-run"]
        self.assertNotRegex(self.farm(*args), "gres|--device=gpu")
        asked = self.farm(*args, "--gpu", "yes")
        self.assertIn("#SBATCH --gres=gpu:1\n", asked)
        self.assertEqual(asked.count("gres"), 1, "the job that looks whether all are there needs none")
        # No task may fall back to a processor without a word.
        self.assertIn("render --device=gpu ", asked)
        self.assertNotIn("--device=gpu", self.farm(*args, "--gpu", "yes", "--device", "0"))

    def test_portions(self):
        args = ["moving.gltf", "-o", "f.####.png", *TINY, "--dry-run", "--quiet"]
        text = self.farm(*args, "--frames", "0..9999", "--chunk", "3", warnings=True)
        self.assertIn("10 a task; tasks: 1000", text)
        text = self.farm(*args, "--frames", "0..99")
        self.assertRegex(text, r"a frame takes \d+\.\d+ s here \(.+\), and starting \d+\.\d s\n")
        (self.folder / "x#1").mkdir()
        self.assertIn("--output=" + str(self.folder / "x#1/f.mp4"), self.farm(*args, "--frames", "0..9", "--film", "x#1/f.mp4"))
        text = self.farm(*args, "--turntable", "2")
        self.assertIn("frames: 48 (0..47)", text)
        self.assertRegex(text, r"--turntable=?\S* .*--frames=")
        none = self.run_program("farm", "slurm", *args, "--frames", "0..99", environment={"SLURM_CONF": str(self.nowhere), "VK_ICD_FILENAMES": "/no.json", "VK_DRIVER_FILES": "/no.json"})
        self.assertEqual(none.returncode, DONE, none.stderr)
        self.assertIn("no frame can be timed here", none.stdout)
        self.assertIn("25 a task; tasks: 4", none.stdout)
        self.assertEqual(self.new_files(), set())

    def test_mistakes(self):
        sequence = ["moving.gltf", "--frames", "0..9", "-o", "f.####.png", "--chunk", "2", *TINY]
        for code, args, says in (
                (USAGE, [], "write `scumble farm slurm`"),
                (USAGE, ["slrum"], "there is no command 'farm slrum'; did you mean 'slurm'?"),
                (USAGE, ["slurm"], "SCENE is missing; write `scumble farm slurm SCENE`"),
                (USAGE, ["slurm", "moving.gltf"], "is not a sequence of frames"),
                (USAGE, ["slurm", "moving.gltf", "--frames", "0..9", "-o", "f.mp4"], "give --film shot.mp4"),
                (USAGE, ["slurm", *sequence, "--chnk", "3"], "did you mean '--chunk'?"),
                (USAGE, ["slurm", *sequence[:5], "--chunk", "0"], "--chunk 0 is out of range"),
                (USAGE, ["slurm", *sequence, "--at-once", "0"], "--at-once 0"),
                (USAGE, ["slurm", *sequence, "--gpu", "many"], "use auto, yes or no"),
                (USAGE, ["slurm", *sequence, "--film", "f.png"], "is no film"),
                (USAGE, ["slurm", *sequence, "--sbatch=partition"], "is no option of sbatch"),
                (USAGE, ["slurm", *sequence, "--resume"], "there is no option '--resume'"),
                (UNUSABLE, ["slurm", "none.gltf", *sequence[1:]], "there is no such file"),
                (USAGE, ["slurm", *sequence, "--stage", "disk"], "--stage disk is no absolute path"),
                (USAGE, ["slurm", *sequence, "--program", "bin/scumble"], "is no absolute path"),
                (USAGE, ["slurm", *sequence, "--folder", "back\\slash"], "has a backslash"),
                (NOT_WRITTEN, ["slurm", *sequence, "--folder", "/proc/no"], "choose another --folder"),
                (NOT_WRITTEN, ["slurm", *sequence, "--film", "no/f.mp4"], "the folder does not exist")):
            with self.subTest(args=args):
                self.bad(code, "farm", *args, says=says)
        # Where there is no Slurm, the scripts are there to be taken to it.
        programs = self.folder / "programs"
        programs.mkdir()
        for name in ("bash", "tar", "sha256sum"):
            (programs / name).symlink_to(shutil.which(name))
        done = self.run_program("farm", "slurm", *sequence, "--submit", environment={"PATH": str(programs)})
        self.assertEqual(done.returncode, NOT_WRITTEN, done.stderr)
        self.assertRegex(done.stderr, r"\Ascumble: error: there is no sbatch on the PATH; .*f\.farm/submit.*\n\Z")
        self.assertTrue((self.folder / "f.farm/submit").exists())


if __name__ == "__main__":
    program_test.main()
