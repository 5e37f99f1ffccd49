#!/usr/bin/env python3
"""Debian's packages, as they are made and as they are installed.

    tests/packages/packages_test.py BUILD     BUILD: a build in which cpack has made packages

lintian finds nothing in them that is not explained in packaging/*.lintian-overrides. Then they are installed into a bare root
of Debian 12, without a compiler, and there the program draws the demo scene, with the bytes that the built one draws here, and
a C program draws by the shared library. The second part is skipped, with a notice, where no root can be made.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

RENDER = ["--size", "320x180", "--quiet", "--device", "cpu"]
PACKAGES = ("scumble", "libscumble1", "libscumble-dev", "scumble-doc", "python3-scumble")


def run(*words, **how):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **how)
    assert done.returncode == 0, f"{' '.join(map(str, words))}\n{done.stdout[-3000:]}{done.stderr[-3000:]}"
    return done.stdout


def field(package, name):
    return run("dpkg-deb", "--field", package, name).strip()


def files(package):
    return {line.split()[5].removeprefix(".") for line in run("dpkg-deb", "--contents", package).splitlines()}


def contents(debs, version):
    arch = run("dpkg", "--print-architecture").strip()
    triplet = run("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip()
    major = version.split(".")[0]
    for name, deb in debs.items():
        assert field(deb, "Version") == version, f"{deb.name}: {field(deb, 'Version')}"
        assert field(deb, "Architecture") == ("all" if name == "scumble-doc" else arch), name
    has = {name: files(deb) for name, deb in debs.items()}
    assert f"/usr/lib/{triplet}/libscumble.so.{major}" in has["libscumble1"], has["libscumble1"]
    assert {f"/usr/lib/{triplet}/libscumble.so", f"/usr/lib/{triplet}/libscumble.a", "/usr/include/scumble/scumble.h",
            f"/usr/lib/{triplet}/cmake/scumble/scumbleConfig.cmake"} <= has["libscumble-dev"]
    assert {"/usr/bin/scumble", "/usr/share/applications/scumble.desktop", "/usr/share/icons/hicolor/scalable/apps/scumble.svg",
            "/usr/share/mime/packages/scumble.xml", "/usr/share/metainfo/org.scumble.scumble.metainfo.xml", "/usr/share/man/man1/scumble-farm-slurm.1.gz",
            "/usr/share/bash-completion/completions/scumble", "/usr/share/scumble/looks/ink.json", "/usr/share/scumble/farm/flamenco/scumble.js"} <= has["scumble"]
    assert "/usr/share/doc/scumble/docs/looks.md" in has["scumble-doc"]
    module = {path.removeprefix("/usr/lib/python3/dist-packages/scumble/") for path in has["python3-scumble"]}
    assert {"__init__.py", "_scumble.pyi", "py.typed", f"_scumble.cpython-{sys.version_info[0]}{sys.version_info[1]}-{triplet}.so"} <= module, module
    assert f"libscumble1 (= {version})" in field(debs["python3-scumble"], "Depends"), field(debs["python3-scumble"], "Depends")
    assert f"libscumble1 (= {version})" in field(debs["libscumble-dev"], "Depends")
    for name in ("scumble", "libscumble1"):
        needs = field(debs[name], "Depends")
        assert "libvulkan1" in needs and "libopenexr" in needs, f"{name}: {needs}"
    shlibs = run("dpkg-deb", "--info", debs["libscumble1"], "shlibs")
    assert re.search(rf"^libscumble {major} libscumble1 \(>= {re.escape(version)}\)", shlibs, re.M), shlibs
    # No file belongs to two packages.
    shared = {path for a in has for b in has if a < b for path in has[a] & has[b] if not path.endswith("/")}
    assert not shared, shared


def completion(program, folder):
    """What bash offers, of what the package installs."""
    def offered(*words):
        text = f'source "$1"; compopt() {{ :; }}; COMP_WORDS=("${{@:2}}"); COMP_CWORD=$(($# - 2)); _scumble; printf "%s\\n" "${{COMPREPLY[@]}}"'
        return run("bash", "-c", text, "bash", folder / "usr/share/bash-completion/completions/scumble", *words).split()

    commands = re.findall(r"^  (\w+) ", run(program, "--help").split("Subcommands:")[1], re.M)
    assert set(commands) <= set(offered("scumble", "")), offered("scumble", "")
    assert offered("scumble", "render", "--look", "ink") == ["ink-wash", "ink"]
    assert offered("scumble", "render", "--set", "=", "shadow.thr") == ["shadow.threshold="]
    assert offered("scumble", "farm", "slurm", "--chu") == ["--chunk"]
    assert offered("scumble", "render", "--aov", "fin") == ["final-shadow", "final-color"]
    assert offered("scumble", "film", "--stereo", "over") == ["over-under"]


def manual(program, folder):
    """Every command has a page, and on it every option."""
    pages = folder / "usr/share/man/man1"
    for path in pages.iterdir():
        text = run("zcat", path).replace("\\-", "-")
        words = path.name.removesuffix(".1.gz").split("-")[1:]
        for option in re.findall(r"^  (-\S+)", run(program, *words, "--help"), re.M):
            assert f".B {option}" in text, f"{path.name} lacks {option}"
    assert len(list(pages.iterdir())) == 18, sorted(path.name for path in pages.iterdir())


def bare_root(build, debs, temporary):
    if not shutil.which("mmdebstrap"):
        print("SKIPPED: a bare root of Debian 12: there is no mmdebstrap")
        return
    if os.getuid() != 0 or subprocess.run(["unshare", "--mount", "true"], capture_output=True, check=False).returncode:
        print("SKIPPED: a bare root of Debian 12: nothing may be mounted here")
        return
    inside = temporary / "inside"
    inside.mkdir()
    for name in ("scumble", "libscumble1", "scumble-doc", "python3-scumble"):
        shutil.copy(debs[name], inside)
    shutil.copy(build / "c_face", inside)
    run(build / "demo_scene", inside / "demo.glb")
    (inside / "try").write_text(f"""set -eux
cd /inside
apt-get install -y --no-install-recommends ./*.deb mesa-vulkan-drivers vulkan-validationlayers >installed.txt
if command -v g++ || command -v cc || command -v cmake; then exit 1; fi
mkdir /tmp/out
scumble render demo.glb -o /tmp/out/demo.png {" ".join(RENDER)}
scumble render demo.glb -o /tmp/out/both.exr --look watercolour --stereo side-by-side {" ".join(RENDER)}
./c_face demo.glb /tmp/out/c.png
ldd ./c_face | grep /lib/.*/libscumble.so.1
python3 -c 'import scumble
scumble.Renderer("cpu").render(scumble.Scene("demo.glb"), size=(320, 180)).save("/tmp/out/python.png")'
ls /usr/lib/python3/dist-packages/scumble/__pycache__ | grep _renderer
scumble devices >/tmp/out/devices.txt
test -s /usr/share/man/man1/scumble.1.gz
apt-get remove -y scumble libscumble1 >/dev/null
if [ -e /usr/bin/scumble ] || [ -e /usr/lib/python3/dist-packages/scumble ]; then exit 1; fi
""")
    targets = run("apt-get", "indextargets", "--format", "$(REPO_URI)", "Created-By: Packages", "Codename: bookworm").split()
    out = temporary / "out"
    run("mmdebstrap", "--variant=apt", "--mode=root", f"--customize-hook=copy-in {inside} /", '--customize-hook=chroot "$1" sh /inside/try',
        f"--customize-hook=copy-out /tmp/out {temporary}", "bookworm", temporary / "root", *(targets[:1] or ["http://deb.debian.org/debian"]), timeout=900)
    drawn = temporary / "here.png"
    run(build / "scumble", "render", inside / "demo.glb", "-o", drawn, *RENDER)
    if run(build / "scumble", "devices").splitlines()[0].split("  ")[:2] == (out / "devices.txt").read_text().splitlines()[0].split("  ")[:2]:
        for name in ("demo.png", "python.png"):
            assert drawn.read_bytes() == (out / name).read_bytes(), f"what is installed draws another {name}"
    else:
        print("the drivers differ, so the pictures' bytes are not compared")
    assert (out / "both.exr").stat().st_size > 100_000 and (out / "c.png").stat().st_size > 1000


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    build = Path(sys.argv[1]).resolve()
    debs = {path.name.split("_")[0]: path for path in (build / "packages").glob("*.deb")}
    assert set(debs) == set(PACKAGES), sorted(debs)
    version = re.search(r'VERSION_STRING "(.*)"', (Path(__file__).resolve().parents[2] / "include/scumble/version.h").read_text())[1]
    contents(debs, version)
    run("lintian", "--allow-root", "--fail-on", "error,warning", *debs.values())
    with tempfile.TemporaryDirectory(prefix="scumble_packages_") as folder:
        unpacked = Path(folder) / "unpacked"
        run("dpkg-deb", "--extract", debs["scumble"], unpacked)
        run("desktop-file-validate", unpacked / "usr/share/applications/scumble.desktop")
        run("appstreamcli", "validate", "--no-net", unpacked / "usr/share/metainfo/org.scumble.scumble.metainfo.xml")
        completion(build / "scumble", unpacked)
        manual(build / "scumble", unpacked)
        bare_root(build, debs, Path(folder))
    print(f"{len(debs)} packages of version {version} hold what they should")


if __name__ == "__main__":
    main()
