#!/usr/bin/env python3
"""A farm of a real Slurm on this machine: munge, one controller and two nodes, as processes of this test.

    tests/farm/slurm_test.py SCUMBLE DEMO_SCENE [--numbers]

A film of 48 frames is drawn by an array. In its middle one node is killed and comes back later, and a task is requeued by
hand. In the end every frame and the film are the bytes that one machine gives. Skipped, with a notice, where Slurm is not
installed or its programs may not run. --numbers: also the overhead a frame, without faults.
"""
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

NODES = ("one", "two")
FRAMES, CHUNK = 48, 6
CALL = ["--size", "960x540", "--samples", "4", "--look", "age-of-sail"]
PATIENCE = 120  # seconds


def skip(why):
    print(f"SKIPPED: a farm of Slurm: {why}")
    sys.exit(0)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def until(holds, what):
    end = time.monotonic() + PATIENCE
    while not holds():
        if time.monotonic() > end:
            raise AssertionError(f"in {PATIENCE} s it did not happen that {what}")
        time.sleep(0.1)


class Cluster:
    def __init__(self, folder):
        self.folder, self.processes = folder, {}
        # Slurm has its programs in sbin, which not every user's PATH has.
        self.env = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf"), "XDG_CACHE_HOME": str(folder / "cache"),
                    "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}
        missing = [name for name in ("munged", "slurmctld", "slurmd", "sbatch", "flock") if not shutil.which(name, path=self.env["PATH"])]
        if missing:
            skip("there is no " + ", ".join(missing))
        if os.getuid() != 0:
            skip("its nodes run jobs as others, which takes root")
        host = socket.gethostname().partition(".")[0]
        control, *ports = free_ports(1 + len(NODES))
        (folder / "munge").mkdir(mode=0o700)
        key = folder / "munge/key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        nodes = "\n".join(f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1 State=UNKNOWN" for name, port in zip(NODES, ports))
        (folder / "slurm.conf").write_text(f"""ClusterName=scumble
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CryptoType=crypto/munge
AuthInfo=socket={folder}/munge/socket
SlurmctldPort={control}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmdSpoolDir={folder}/spool-%n
StateSaveLocation={folder}/state
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
SlurmdParameters=config_overrides
SlurmdTimeout=10
KillWait=1
ReturnToService=2
MaxArraySize=9
{nodes}
PartitionName=all Nodes={",".join(NODES)} Default=YES State=UP
""")
        (folder / "state").mkdir()
        self.start("munged", "munged", "--foreground", "--force", f"--key-file={key}", f"--socket={folder}/munge/socket", f"--log-file={folder}/munge/log",
                   f"--pid-file={folder}/munge/pid", f"--seed-file={folder}/munge/seed")
        until(lambda: (folder / "munge/socket").exists() or self.processes["munged"].poll() is not None, "munged answers")
        self.start("slurmctld", "slurmctld", "-D")
        for name in NODES:
            self.node(name)
        try:
            until(lambda: self.ask("sinfo", "--noheader", "--format=%D %t") == f"{len(NODES)} idle" or
                  any(process.poll() is not None for process in self.processes.values()), "the nodes are idle")
        except AssertionError as error:
            self.stop()
            skip(str(error))
        dead = [name for name, process in self.processes.items() if process.poll() is not None]
        if dead:
            said = (folder / f"{dead[0]}.log").read_text().strip()
            self.stop()
            skip(f"{dead[0]} ends at once: {said[-300:]}")

    def start(self, name, *words):
        log = open(self.folder / f"{name}.log", "ab")
        self.processes[name] = subprocess.Popen(words, env=self.env, stdout=log, stderr=log, stdin=subprocess.DEVNULL, start_new_session=True)

    def node(self, name):
        self.start(name, "slurmd", "-D", "-N", name)

    def kill(self, name):
        """A node as if its power were gone: its daemon, what watches its jobs, and then their processes."""
        self.processes.pop(name).kill()
        jobs, watchers = [], set()
        for process in Path("/proc").glob("[0-9]*"):
            try:
                words = (process / "environ").read_bytes().split(b"\0")
                if f"SLURMD_NODENAME={name}".encode() in words and f"SLURM_CONF={self.folder}/slurm.conf".encode() in words:
                    jobs.append(int(process.name))
                    parent = (process / "stat").read_text().rpartition(")")[2].split()[1]
                    if Path(f"/proc/{parent}/comm").read_text().startswith("slurmstepd"):
                        watchers.add(int(parent))
            except OSError:
                pass  # it has ended
        assert jobs and watchers, f"nothing runs on node {name}"
        for process in [*watchers, *jobs]:
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def ask(self, *words):
        return subprocess.run(words, env=self.env, capture_output=True, text=True, check=False, timeout=30).stdout.strip()

    def stop(self):
        self.ask("scancel", "--user=root", "--signal=KILL")
        for process in self.processes.values():
            process.terminate()
        for process in self.processes.values():
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()


def farm(cluster, scumble, folder, *options):
    """Submits, and gives the numbers of both jobs."""
    done = subprocess.run([scumble, "farm", "slurm", "scene.glb", "--frames", f"0..{FRAMES - 1}", "-o", "shot.####.png", "--film", "shot.mp4", *CALL,
                           "--stage", str(folder / "disk"), "--submit", *options], cwd=folder, env=cluster.env, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    print(done.stdout.strip())
    words = done.stdout.split("\n")[-2].split()
    return words[1], words[words.index("job", 2) + 1]


def wait_for(cluster, job):
    def over():
        # What was requeued is held back for two minutes, unless it is told not to be.
        for task, reason in (line.split() for line in cluster.ask("squeue", "--noheader", "--array", "--states=PENDING", "--format=%i %r").splitlines()):
            if reason == "BeginTime":
                cluster.ask("scontrol", "update", f"JobId={task}", "StartTime=now")
        state = cluster.ask("scontrol", "show", "job", job)
        return "JobState=COMPLETED" in state or "JobState=FAILED" in state or "JobState=CANCELLED" in state
    until(over, f"job {job} ends")
    state = cluster.ask("scontrol", "show", "job", job)
    assert "JobState=COMPLETED" in state, state


def drawn(folder):
    return {path.name: path.read_bytes() for path in [*folder.glob("shot.*.png"), *folder.glob("shot.mp4")]}


def with_faults(cluster, scumble, folder):
    render, finish = farm(cluster, scumble, folder, "--chunk", str(CHUNK))

    def half_done(node):
        """The task of this node that has drawn some of its frames, but not all."""
        for task in cluster.ask("squeue", "--noheader", "--array", "--states=RUNNING", f"--job={render}", f"--nodelist={node}", "--format=%i").split():
            first = int(task.split("_")[1]) * CHUNK
            if 0 < sum((folder / f"shot.{number:04}.png").exists() for number in range(first, first + CHUNK)) < CHUNK:
                return task
        return None

    hit = []
    for node in reversed(NODES):
        until(lambda: half_done(node), f"a task of node {node} is half done")
        hit.append(half_done(node))
        if node == "two":
            cluster.kill(node)
            cluster.ask("scontrol", "update", "NodeName=two", "State=DOWN", "Reason=test")
        else:
            cluster.ask("scontrol", "requeue", hit[-1])
    print(f"the node of task {hit[0]} is killed, task {hit[1]} is requeued")
    cluster.node("two")
    cluster.ask("scontrol", "update", "NodeName=two", "State=RESUME")
    wait_for(cluster, finish)
    reports = folder / "shot.farm/stats" / render
    for task in hit:
        number = task.split("_")[1]
        assert not (reports / f"{number}.0.json").exists() and (reports / f"{number}.1.json").exists(), sorted(path.name for path in reports.iterdir())
        # What the first try has drawn is not drawn again.
        assert len(json.loads((reports / f"{number}.1.json").read_text())["frames"]) < CHUNK
    said = (folder / f"shot.farm/logs/{finish}.finish.txt").read_text()
    assert f"all {FRAMES} frames are there, whole" in said, said


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    scumble, demo_scene = (os.path.abspath(path) for path in sys.argv[1:3])
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="scumble farm ") as temporary:
        root = Path(temporary)
        # Slurm's own paths have no spaces; ours do.
        cluster = Cluster(Path(tempfile.mkdtemp(prefix="scumble_slurm_")))
        try:
            alone, together = root / "alone", root / "to gether"
            for folder in (alone, together):
                folder.mkdir()
                subprocess.run([demo_scene, folder / "scene.glb"], check=True, stdout=subprocess.DEVNULL)
            call = [scumble, "render", "scene.glb", "--frames", f"0..{FRAMES - 1}", "--quiet", *CALL]
            env = {**os.environ, "XDG_CACHE_HOME": str(root / "cache")}
            for output in ("shot.####.png", "shot.mp4"):
                subprocess.run([*call, "-o", output], cwd=alone, env=env, check=True, timeout=120)
            with_faults(cluster, scumble, together)
            expected, got = drawn(alone), drawn(together)
            assert set(expected) == set(got), set(expected) ^ set(got)
            for name, content in expected.items():
                assert content == got[name], f"{name} has other bytes"
            # Arrays hold 9 tasks here: portions grow.
            done = subprocess.run([scumble, "farm", "slurm", "scene.glb", "--frames", "0..99", "-o", "x.####.png", *CALL, "--chunk", "2", "--dry-run"],
                                  cwd=alone, env=cluster.env, capture_output=True, text=True, check=True, timeout=60)
            assert "12 a task; tasks: 9" in done.stdout and "it is 12" in done.stderr, done.stdout + done.stderr
            print(f"{FRAMES} frames and the film are what one machine draws; {time.monotonic() - begin:.0f} s")
            if "--numbers" in sys.argv:
                numbers(cluster, scumble, root, call, env)
        except AssertionError:
            # What a failure on another machine is understood by.
            for log in [*sorted(cluster.folder.glob("*.log")), *sorted((root / "to gether/shot.farm/logs").glob("*.txt"))]:
                print(f"-- {log.name}\n{log.read_text(errors='replace')[-3000:]}")
            raise
        finally:
            cluster.stop()
            shutil.rmtree(cluster.folder, ignore_errors=True)


def numbers(cluster, scumble, root, call, env):
    """Two nodes of one processor each, against two calls at once, each with half of the frames."""
    for round_ in range(3):
        for folder in ("n-alone", "n-farm"):
            shutil.rmtree(root / folder, ignore_errors=True)
            (root / folder).mkdir()
            shutil.copy(root / "alone/scene.glb", root / folder)
        begin = time.monotonic()
        half = FRAMES // 2
        calls = [subprocess.Popen([*call[:4], f"{first}..{first + half - 1}", *call[5:], "-o", "shot.####.png"], cwd=root / "n-alone", env=env)
                 for first in (0, half)]
        assert all(each.wait() == 0 for each in calls)
        alone = time.monotonic() - begin
        begin = time.monotonic()
        _, finish = farm(cluster, scumble, root / "n-farm", "--chunk", str(CHUNK))
        until(lambda: len(list((root / "n-farm").glob("shot.*.png"))) == FRAMES, "all frames are there")
        together = time.monotonic() - begin
        wait_for(cluster, finish)
        print(f"round {round_ + 1}: {1000 * alone / FRAMES:.0f} ms a frame by two calls, {1000 * together / FRAMES:.0f} by the farm")


if __name__ == "__main__":
    main()
