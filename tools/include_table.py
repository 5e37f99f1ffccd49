#!/usr/bin/env python3
"""Holds the table "Rooms, and who may look into which" of the design and fails where a file includes what its room may not.

    tools/include_table.py [ROOT]     checks the tree at ROOT (default: this checkout); exit code 1 with a list if it fails

What an included header brings along counts like what the file includes itself.
"""
import fnmatch
import os
import re
import sys
from pathlib import Path, PurePosixPath

# Who may look into which. `*` in a room's name stands for one folder; "own" is the room itself and always allowed.
# A target with a dot in it is a file, or files by a pattern. All of src/ may use the public headers: results and pictures are theirs.
PUBLIC = "include/scumble"
STAGE = [PUBLIC, "src/base", "src/scene", "src/look", "src/shading"]
WORLD = [*STAGE, "src/gpu", "src/stage"]
FRAME = [*WORLD, "src/world"]
# Passes read each other's knobs, and nothing else of each other.
PASS = [*FRAME, "src/frame"]
KNOBS = "src/passes/*/*_knobs.h"
TABLE = {
    PUBLIC: [],
    "src/base": [PUBLIC],
    "src/gpu": [PUBLIC, "src/base"],
    "src/scene": [PUBLIC, "src/base"],
    "src/sketch": [PUBLIC, "src/base", "src/scene"],
    "src/gltf": [PUBLIC, "src/base", "src/scene", "src/sketch"],
    "src/paint": [PUBLIC, "src/base", "src/scene", "src/gltf"],
    # The brush is the one that shaders draw with.
    "src/bake": [PUBLIC, "src/base", "src/scene", "src/gltf", "src/shading"],
    "src/look": [PUBLIC, "src/base"],
    "src/shading": [],
    "src/stage": STAGE,
    "src/world": WORLD,
    "src/frame": FRAME,
    "src/passes/*": [*PASS, KNOBS],
    # Nobody includes a feature: the build lists them, and the renderer calls what the list names.
    "src/features/*": [*PASS, KNOBS],
    "src/renderer": [*PASS, "src/passes/*"],
    "src/film": [PUBLIC, "src/base"],
    "src/c": [PUBLIC],
    "src/measure": [PUBLIC, "src/base"],
    "src/panorama": [PUBLIC, "src/base", "src/scene"],
    "src/study": [PUBLIC, "src/base"],
    "src/xr": [PUBLIC],
    "apps/viewer": [PUBLIC],
    "apps/serve": [PUBLIC],
    "apps/scumble": [PUBLIC, "apps/serve", "apps/viewer", "src/xr"],
    "examples": [PUBLIC],
    "python": [PUBLIC],
    # The cost of one technique by itself is measured from inside.
    "bench": [*PASS, "examples", "src/passes/*", "src/features/*"],
    # Tests of the whole look wherever they must; tests of one room lie in that room and follow its line.
    "tests": ["*"],
}

# Tests, and the references that several of a room compare with.
TEST_FILE = re.compile(r"(_test\.cpp|_reference\.(cpp|h))$")
TEST_ALSO = ["tests/support", "src/base/test_folder.h", "src/base/passing_file.h"]

# Libraries by the first part of an angle include; a room that is not listed may use any.
LIBRARIES = {
    PUBLIC: ["std", "glm"],
    "src/xr": ["std", "system", "fmt", "glm", "vulkan", "openxr"],
    "apps/viewer": ["std", "system", "fmt", "glm", "nlohmann", "vulkan", "GLFW", "imgui", "fontconfig"],
    "apps/serve": ["std", "system", "glm", "nlohmann"],
    "apps/scumble": ["std", "system", "CLI", "fmt", "nlohmann", "cairo"],
    "examples": ["std", "glm", "nlohmann"],
    "python": ["std", "system", "glm", "pybind11"],
}
# The public headers for engines that bring their own device, and for C.
LIBRARIES_OF_FILE = {"include/scumble/vulkan.h": ["std", "glm", "vulkan"], "include/scumble/scumble.h": ["system"]}
SYSTEM = {"unistd.h", "spawn.h", "fcntl.h", "signal.h", "termios.h", "stdlib.h", "string.h", "stdio.h", "errno.h", "dlfcn.h", "time.h", "poll.h", "stddef.h",
          "stdint.h", "malloc.h"}

SOURCES = {".h", ".hpp", ".cpp", ".cc", ".inl", ".params", ".glsl", ".vert", ".frag", ".comp", ".geom", ".tesc", ".tese"}
FOLDERS = ["include", "src", "apps", "examples", "python", "bench", "tests"]
# Where the compilers look, besides the folder of the including file.
SEARCH = ["src", "include", "examples", "bench", "tests", "src/shading", ""]
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]')


def room_of(path):
    """The room a file lies in, or None. The longest name wins; a pass's room is its own folder."""
    parts = PurePosixPath(path).parts
    best = None
    for room in TABLE:
        pattern = room.split("/")
        if len(parts) > len(pattern) and all(p in ("*", part) for p, part in zip(pattern, parts)):
            found = "/".join(parts[: len(pattern)])
            if best is None or len(found) > len(best[1]):
                best = (room, found)
    return best


def matches(target, allowed):
    """Whether a file is one of the allowed ones or lies in an allowed room."""
    if allowed == "*" or target == allowed:
        return True
    if "." in allowed:
        return fnmatch.fnmatchcase(target, allowed)
    pattern, parts = allowed.split("/"), target.split("/")
    return len(parts) > len(pattern) and all(p in ("*", part) for p, part in zip(pattern, parts))


def resolve(root, file, name):
    """The included file relative to root. One that a build generates is placed by its name; others give None."""
    for folder in [os.path.dirname(file), *SEARCH]:
        candidate = os.path.normpath(os.path.join(folder, name)).replace(os.sep, "/")
        if not candidate.startswith("..") and (root / candidate).is_file():
            return candidate
    for folder in ("src", "include"):
        candidate = os.path.normpath(os.path.join(folder, name)).replace(os.sep, "/")
        if room_of(candidate):
            return candidate
    return None


def library_of(name):
    if re.fullmatch(r"[a-z_0-9]+", name):
        return "std"
    if name in SYSTEM or name.startswith("sys/"):
        return "system"
    return re.split(r"[/.]", name)[0]


def problem_with(root, file, bracket, name):
    """Why this include is not allowed, or None."""
    room, place = room_of(file)
    target = resolve(root, file, name)
    if target is None or (bracket == "<" and not target.startswith("include/")):
        if bracket == '"':
            return None  # generated by the build, and in no room
        allowed = LIBRARIES_OF_FILE.get(file, LIBRARIES.get(room))
        if allowed is None or library_of(name) in allowed or TEST_FILE.search(file):
            return None
        return f"{room} may use these libraries: {', '.join(allowed)}"

    allowed = list(TABLE[room])
    if TEST_FILE.search(file):
        allowed += TEST_ALSO

    def may_see(other):
        return room_of(other) is None or other.startswith(place + "/") or any(matches(other, a) for a in allowed)

    rule = f"{room} may look into: {', '.join(allowed) or 'nothing but itself'}"
    if not may_see(target):
        return rule
    brought = sorted(other for other in brought_by(root, target) if not may_see(other))
    return f"{rule}; {target} brings {brought[0]}" if brought else None


def brought_by(root, file, known={}):
    """All files of the project that a file's includes lead to."""
    key = (root, file)
    if key not in known:
        known[key] = set()  # of those that include each other
        if (root / file).is_file():
            for line in (root / file).read_text(encoding="utf-8", errors="replace").splitlines():
                match = INCLUDE.match(line)
                target = match and resolve(root, file, match.group(2))
                if target and (match.group(1) == '"' or target.startswith("include/")):
                    known[key] |= {target} | brought_by(root, target)
    return known[key]


def check(root):
    """All forbidden includes below root as (line of text, the rule that it breaks), and the number of files looked at."""
    problems, count = [], 0
    for top in FOLDERS:
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in SOURCES or not path.is_file():
                continue
            file = path.relative_to(root).as_posix()
            count += 1
            if room_of(file) is None:
                problems.append((f"{file}: lies in no room", "a new room needs a line in tools/include_table.py"))
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
                match = INCLUDE.match(line)
                reason = match and problem_with(root, file, match.group(1), match.group(2))
                if reason:
                    problems.append((f"{file}:{number}: includes {match.group(2)}", reason))
    return problems, count


def main():
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    problems, count = check(root)
    if problems:
        print(f"{len(problems)} includes that the table of rooms does not allow:", file=sys.stderr)
        for rule in sorted({rule for _, rule in problems}):
            print("  " + rule, file=sys.stderr)
            for problem in [text for text, broken in problems if broken == rule]:
                print("    " + problem, file=sys.stderr)
        return 1
    if count == 0:
        print(f"there are no sources below {root}", file=sys.stderr)
        return 1
    print(f"include table: {count} files keep to it")
    return 0


if __name__ == "__main__":
    sys.exit(main())
