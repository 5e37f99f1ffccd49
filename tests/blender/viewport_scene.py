"""Installs the add-on, and saves a scene for viewport_test.py."""
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import scenes  # noqa: E402

archive, target = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
bpy.ops.preferences.addon_enable(module="scumble_blender")
scenes.still_life()
bpy.ops.wm.save_as_mainfile(filepath=target)
