#!/usr/bin/env python3
"""The add-on in the packaged Blender: without a window, and its viewport on a screen of Xvfb's.

    blender_test.py [--pictures FOLDER] BUILD [TEST...]

TEST: tests of addon_test.py, or "viewport".
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
MAKE_ZIP = HERE.parent.parent / "blender" / "make_zip"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--pictures", type=Path, help="where pictures of the window are kept")
    parser.add_argument("tests", nargs="*")
    args = parser.parse_args()
    if not shutil.which("blender"):
        sys.exit("there is no blender; install the package of that name")
    program = (args.build / "scumble").resolve()
    with tempfile.TemporaryDirectory(prefix="scumble-blender-") as folder:
        archive = Path(folder) / "scumble_blender.zip"
        subprocess.run([sys.executable, MAKE_ZIP, archive], check=True)
        # Whose settings these are must decide nothing. Debian's Blender takes the libraries of the first Python of its
        # version on the path: that must be the system's, which has numpy.
        environment = {**os.environ, "BLENDER_USER_RESOURCES": str(Path(folder) / "user"), "SCUMBLE": str(program),
                       "PYTHONDONTWRITEBYTECODE": "1", "PATH": "/usr/bin:" + os.environ.get("PATH", "")}
        blender = ["blender", "--factory-startup", "--python-exit-code", "1"]
        failures = 0
        if args.tests != ["viewport"]:
            failures += subprocess.run([*blender, "--background", "--python", HERE / "addon_test.py", "--", program,
                                        archive, *args.tests], env=environment, check=False, timeout=900).returncode
        if not args.tests or args.tests == ["viewport"]:
            pictures = args.pictures or Path(folder)
            pictures.mkdir(parents=True, exist_ok=True)
            scene = Path(folder) / "still.blend"
            subprocess.run([*blender, "--background", "--python", HERE / "viewport_scene.py", "--", archive, scene],
                           env=environment, check=True, timeout=120)
            failures += subprocess.run(
                ["xvfb-run", "-a", "-s", "-screen 0 1280x800x24", *blender, "--window-geometry", "0", "0", "1280", "800",
                 scene, "--python", HERE / "viewport_test.py", "--", pictures.resolve()],
                env=environment, check=False, timeout=180).returncode
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
