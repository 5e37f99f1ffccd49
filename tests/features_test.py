#!/usr/bin/env python3
"""Nothing outside of a feature's folder names it: not its words, in whatever case, in the library or the program.

    features_test.py [ROOT]

Its looks, tests of the whole, bench and pages may. A feature's own `feature.cpp` may say which others' passes its own
lie above.
"""
import re
import sys
from pathlib import Path

# By feature: parts of words.
WORDS = {
    "ocean": re.compile(r"ocean|water(?!colo)|wave", re.IGNORECASE),
    "ink": re.compile(r"(?<![A-Za-z])ink(?![A-Za-z])|Ink[A-Z]"),
    # Paintings are scenes' own; how they are drawn is the feature's.
    "painting": re.compile(r"features/painting|(?<![A-Za-z])painting::|PaintingParams|\"painting\."),
    "watercolor": re.compile(r"watercolo|pigment", re.IGNORECASE),
}
# Names that other programs have given, and looks that are written.
MAY = {"src/sketch/brushes.cpp", "src/study/written_look.cpp"}
# A pass of a feature, with those that it lies above.
ABOVE = re.compile(r'\{"[a-z-]+", make\w+, \{[^{}]*\}\}')
FOLDERS = ["include", "src", "apps", "tools/cmake", "CMakeLists.txt"]


def files_in(root):
    for folder in FOLDERS:
        path = root / folder
        yield from ([path] if path.is_file() else sorted(each for each in path.rglob("*") if each.is_file()))


def problems(root):
    seen = 0
    for path in files_in(root):
        name = path.relative_to(root).as_posix()
        try:
            lines = path.read_text(encoding="utf-8").splitlines()
        except UnicodeDecodeError:
            continue
        seen += 1
        for feature, words in WORDS.items():
            if name.startswith(f"src/features/{feature}/") or name in MAY:
                continue
            for number, line in enumerate(lines, 1):
                if words.search(ABOVE.sub("", line) if path.name == "feature.cpp" else line):
                    yield f"{name}:{number}: names the feature '{feature}': {line.strip()}"
    if seen < 300:
        yield f"{root}: only {seen} files were found"


def main():
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    found = list(problems(root))
    print("\n".join(found) or "features: nothing outside of their folders names them")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
