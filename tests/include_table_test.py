#!/usr/bin/env python3
"""The include table's own test: what it must catch, and what it must let pass."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))
import include_table  # noqa: E402

# Files that exist in the little tree that each case is tried in.
TREE = """include/scumble/image.h src/base/files.h src/gpu/device.h src/scene/scene_data.h src/look/look_data.h
src/frame/pass.h src/frame/view.h src/renderer/uniforms.h src/frame/cache.h src/passes/blur/blur.h src/passes/blur/blur.shared.h
src/passes/warp/warp.h src/passes/warp/warp_knobs.h src/features/sea/waves.h src/features/sea/sea.glsl src/features/ink/ink.h src/gltf/json.h src/stage/framing.h src/world/textures.h src/passes/warp/warp.glsl src/shading/frame.glsl src/film/srgb.h tests/support/pictures.h
examples/mesh_kit/mesh.h""".split()

ALLOWED = [
    ("include/scumble/scene.h", '"scumble/image.h"'),
    ("include/scumble/scene.h", "<scumble/image.h>"),
    ("include/scumble/scene.h", "<vector>"),
    ("include/scumble/scene.h", "<glm/mat4x4.hpp>"),
    ("include/scumble/vulkan.h", "<vulkan/vulkan.h>"),
    ("src/base/files.cpp", "<fcntl.h>"),
    ("src/gpu/device.cpp", '"base/files.h"'),
    ("src/gpu/device.cpp", "<vulkan/vulkan.h>"),
    ("src/frame/pass.cpp", '"scene/scene_data.h"'),
    ("src/renderer/renderer.cpp", '"passes/blur/blur.h"'),
    ("src/renderer/uniforms.cpp", '"passes/blur/blur.h"'),
    ("src/renderer/pass_list.h", '"passes/warp/warp.h"'),
    ("src/passes/blur/blur.cpp", '"frame/pass.h"'),
    ("src/passes/blur/blur.cpp", '"passes/blur/blur.shared.h"'),
    ("src/passes/blur/blur.cpp", '"passes/warp/warp_knobs.h"'),
    ("src/passes/blur/blur.frag", '"blur.shared.h"'),
    ("src/passes/blur/blur.frag", '"../../shading/frame.glsl"'),
    ("src/passes/blur/blur_test.cpp", '"tests/support/pictures.h"'),
    ("src/passes/blur/blur_test.cpp", '"support/pictures.h"'),
    ("src/gltf/load.cpp", '"scene/scene_data.h"'),
    ("src/stage/framing.cpp", '"scene/scene_data.h"'),
    ("src/world/textures.cpp", '"stage/framing.h"'),
    ("src/world/textures.cpp", '"gpu/device.h"'),
    ("src/frame/pass.cpp", '"world/textures.h"'),
    ("src/features/sea/waves.cpp", '"base/files.h"'),
    ("src/features/sea/paint/paint.cpp", '"features/sea/waves.h"'),
    ("src/features/sea/paint/paint.cpp", '"frame/pass.h"'),
    ("src/features/sea/paint/paint.cpp", '"passes/warp/warp_knobs.h"'),
    ("src/features/sea/paint/paint.vert", '"../sea.glsl"'),
    ("bench/sea/main.cpp", '"features/sea/waves.h"'),
    ("src/film/png.cpp", "<png.h>"),
    ("src/film/png.cpp", '"scumble/image.h"'),
    ("src/film/png.cpp", '"generated_by_the_build.h"'),
    ("apps/scumble/main.cpp", "<CLI/CLI.hpp>"),
    ("apps/scumble/main.cpp", "<unistd.h>"),
    ("examples/demo_scene/main.cpp", '"mesh_kit/mesh.h"'),
    ("bench/many/main.cpp", '"mesh_kit/mesh.h"'),
    ("tests/golden_test.cpp", '"film/srgb.h"'),
]
FORBIDDEN = [
    ("include/scumble/scene.h", '"scene/scene_data.h"'),
    ("include/scumble/scene.h", "<vulkan/vulkan.h>"),
    ("include/scumble/scene.h", "<nlohmann/json.hpp>"),
    ("src/base/files.cpp", '"gpu/device.h"'),
    ("src/gpu/device.cpp", '"scene/scene_data.h"'),
    ("src/scene/import.cpp", '"gpu/device.h"'),
    ("src/scene/import.cpp", '"../gpu/device.h"'),
    ("src/scene/import_test.cpp", '"gpu/device.h"'),
    ("src/scene/scene.cpp", '"gltf/json.h"'),
    ("src/gltf/load.cpp", '"look/look_data.h"'),
    ("src/stage/framing.cpp", '"gpu/device.h"'),
    ("src/stage/framing.cpp", '"world/textures.h"'),
    ("src/world/textures.cpp", '"frame/pass.h"'),
    ("src/look/look.cpp", '"frame/view.h"'),
    ("src/features/sea/waves.cpp", '"features/ink/ink.h"'),
    ("src/features/sea/waves.cpp", '"passes/warp/warp.h"'),
    ("src/features/sea/waves.cpp", '"renderer/uniforms.h"'),
    ("src/scene/import.cpp", '"features/sea/waves.h"'),
    ("src/frame/pass.cpp", '"features/sea/waves.h"'),
    ("src/passes/blur/blur.cpp", '"features/sea/waves.h"'),
    ("src/renderer/uniforms.cpp", '"features/sea/waves.h"'),
    ("src/frame/pass.cpp", '"passes/blur/blur.h"'),
    ("src/frame/pass.cpp", '"passes/warp/warp_knobs.h"'),
    ("src/frame/pass.cpp", '"film/srgb.h"'),
    ("src/passes/blur/blur.cpp", '"passes/warp/warp.h"'),
    ("src/passes/blur/blur.cpp", '"../warp/warp.h"'),
    ("src/passes/blur/blur.cpp", '"renderer/uniforms.h"'),
    ("src/frame/pass.cpp", '"renderer/uniforms.h"'),
    ("src/passes/blur/blur.cpp", '"film/srgb.h"'),
    ("src/passes/blur/blur.cpp", '"passes/warp/generated_by_the_build.h"'),
    ("src/passes/blur/blur.frag", '"../warp/warp.glsl"'),
    ("src/shading/grade.glsl", '"../passes/warp/warp.glsl"'),
    ("src/film/png.cpp", '"scene/scene_data.h"'),
    ("src/film/png.cpp", '"gpu/device.h"'),
    ("apps/scumble/main.cpp", '"base/files.h"'),
    ("apps/scumble/main.cpp", "<vulkan/vulkan.h>"),
    ("examples/demo_scene/main.cpp", '"base/files.h"'),
    ("src/nowhere/file.cpp", "<vector>"),
]


def problems_of(file, include, indent=""):
    with tempfile.TemporaryDirectory(prefix="include table ") as folder:
        root = Path(folder)
        for name in [*TREE, file]:
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).touch()
        (root / file).write_text(f"// {include}\n{indent}#include {include}\n")
        return include_table.check(root)[0]


class IncludeTable(unittest.TestCase):
    def test_allowed(self):
        for file, include in ALLOWED:
            with self.subTest(file=file, include=include):
                self.assertEqual(problems_of(file, include), [])

    def test_forbidden(self):
        for file, include in FORBIDDEN:
            with self.subTest(file=file, include=include):
                problems = problems_of(file, include)
                self.assertEqual(len(problems), 1)
                self.assertTrue(problems[0][0].startswith(file + ":"))

    def test_sees_what_is_brought_along(self):
        with tempfile.TemporaryDirectory(prefix="include table ") as folder:
            root = Path(folder)
            for name, line in (("include/scumble/image.h", ""), ("src/gpu/device.h", ""), ("src/base/files.h", '#include "base/more.h"'),
                               ("src/base/more.h", '#include "gpu/device.h"'), ("src/film/png.cpp", '#include "base/files.h"'),
                               ("src/gpu/queue.cpp", '#include "base/files.h"')):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(line + "\n")
            found = [text for text, _ in include_table.check(root)[0]]
            self.assertEqual(found, ["src/base/files.h:1: includes base/more.h", "src/base/more.h:1: includes gpu/device.h",
                                     "src/film/png.cpp:1: includes base/files.h"])

    def test_names_the_line(self):
        text, rule = problems_of("src/film/png.cpp", '"gpu/device.h"')[0]
        self.assertEqual(text, "src/film/png.cpp:2: includes gpu/device.h")
        self.assertEqual(rule, "src/film may look into: include/scumble, src/base")

    def test_spaces_do_not_hide(self):
        self.assertEqual(len(problems_of("src/film/png.cpp", '"gpu/device.h"', "  ")), 1)


if __name__ == "__main__":
    unittest.main()
