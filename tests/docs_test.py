#!/usr/bin/env python3
"""Keeps the documentation true where a machine can tell.

    tests/docs_test.py PROGRAM [ROOT]      PROGRAM: the built `scumble`; exit code 1 with a list if something is wrong
    tests/docs_test.py PROGRAM --write     makes docs/knobs.md again

docs/knobs.md is what the program prints; relative links and pictures in README.md and docs/*.md lead somewhere; every
long option of `scumble` that README.md mentions is one that --help shows; the program that README.md shows is
examples/embed/main.cpp; every point of docs/limits.md ends with the names of what holds it, and where the sources are,
there are such tests, messages, constants and functions.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADER = "Every knob, as `scumble params` prints it. Made by `python3 tests/docs_test.py build/scumble --write`."

FENCE = re.compile(r"^ *(```|~~~)")
# [text](target) and ![text](target), with an optional title.
LINK = re.compile(r"\[[^\]]*\]\(\s*<?([^)\s>]+)>?(?:\s+[\"'][^)]*)?\)")
HEADING = re.compile(r"^#+ +(.*?) *#* *$")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
# Commands of other programs: their options are not ours.
OTHER_PROGRAM = re.compile(r"\b(cmake|ctest|ninja|git|python3|apt-get|\S+\.py)\b")

# [`name`, `name`] at the end of a point, or of a row of a table.
HELD = re.compile(r" \[(`[^`]+`(?:, `[^`]+`)*)\](?: \|)?$")
SPAN = re.compile(r"`([^`]+)`")
GTEST = re.compile(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", re.MULTILINE)
PYTHON_TEST = re.compile(r"^ *def (test_\w+)", re.MULTILINE)
CONSTANT = re.compile(r"\bk[A-Z]\w*")
CPP = (".cpp", ".h", ".glsl", ".vert", ".frag", ".comp")


def output_of(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


def knobs_page(program):
    return f"# Knobs\n\n{HEADER}\n\n```text\n{output_of(program, 'params')}```\n"


def lines_without_code(text):
    """The lines outside of fenced code, with code spans blanked."""
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        if FENCE.match(line):
            inside = not inside
        elif not inside:
            yield number, re.sub(r"`[^`]*`", "", line)


def anchors_of(text):
    """The anchors that headings get: lower case, punctuation gone, spaces to hyphens."""
    anchors, inside = set(), False
    for line in text.splitlines():
        if FENCE.match(line):
            inside = not inside
        match = None if inside else HEADING.match(line)
        if match:
            plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", match.group(1)).lower()
            anchors.add(re.sub(r"[^\w\- ]", "", plain).replace(" ", "-"))
    return anchors


def check_links(root, pages):
    for page in pages:
        for number, line in lines_without_code(page.read_text(encoding="utf-8")):
            for target in LINK.findall(line):
                if re.match(r"[a-z][a-z0-9+.-]*:", target):
                    continue
                path, _, anchor = target.partition("#")
                place = (page.parent / path).resolve() if path else page
                where = f"{page.relative_to(root)}:{number}"
                if not place.exists():
                    yield f"{where}: {target} leads nowhere"
                elif root not in [place, *place.parents]:
                    yield f"{where}: {target} leads out of the repository"
                elif anchor and place.suffix == ".md" and anchor not in anchors_of(place.read_text(encoding="utf-8")):
                    yield f"{where}: {target} names no heading of that page"


def check_options(root, program):
    """Options that README.md mentions: all of them are one of the commands', or the program's own."""
    known = set(OPTION.findall(output_of(program, "--help-all")))
    page = root / "README.md"
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if OTHER_PROGRAM.search(line):
            continue
        for option in OPTION.findall(line):
            if option not in known:
                yield f"README.md:{number}: `scumble` has no option {option}"


def check_knobs(root, program):
    page = root / "docs" / "knobs.md"
    if not page.exists() or page.read_text(encoding="utf-8") != knobs_page(program):
        yield ("docs/knobs.md is not what the program prints; make it again: "
               f"python3 tests/docs_test.py {program} --write")


def check_embed(root):
    source = root / "examples" / "embed" / "main.cpp"
    if source.exists():
        code = re.sub(r"\A(//.*\n)+", "", source.read_text(encoding="utf-8")).strip()
        if code not in (root / "README.md").read_text(encoding="utf-8"):
            yield "README.md does not show examples/embed/main.cpp as it is"


def sources(root, folders, endings):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in endings and path.is_file():
                yield path.name, path.read_text(encoding="utf-8")


class Holders:
    """What docs/limits.md may name: tests, messages, constants and functions."""

    def __init__(self, root):
        self.tests, self.words, self.functions, self.strings = set(), set(), set(), []
        for name, text in sources(root, ("src", "apps", "include", "python", "tests"), (*CPP, ".py")):
            if name.endswith("_test.cpp"):
                self.tests |= {f"{suite}.{test}" for suite, test in GTEST.findall(text)}
            if name.endswith("_test.py"):
                self.tests |= {f"{name}: {test}" for test in PYTHON_TEST.findall(text)}
        for name, text in sources(root, ("src", "apps", "include"), CPP):
            if not name.endswith("_test.cpp"):
                text = re.sub(r"(?m)//.*$", "", text)
                self.words |= set(CONSTANT.findall(text))
                self.functions |= set(re.findall(r"\b\w+(?=\()", text))
        for name, text in sources(root, ("src", "apps", "python", "tools"), (*CPP, ".py", "")):
            if not re.search(r"_test\.\w+$", name):
                self.strings += re.findall(r'"((?:[^"\\\n]|\\.)*)"', text)

    def has(self, name):
        if name.startswith('"'):
            return len(name) > 2 and name.endswith('"') and any(name[1:-1] in string for string in self.strings)
        if name.endswith("()"):
            return name[:-2] in self.functions
        return name in self.words or name in self.tests


def check_limits(root):
    page = root / "docs" / "limits.md"
    holders = Holders(root) if (root / "src").is_dir() else None
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        held = HELD.search(line)
        if line.startswith("- ") and not held:
            yield f"docs/limits.md:{number}: names nothing that holds it; end it like [`Suite.test`]"
        for name in SPAN.findall(held.group(1)) if held and holders else ():
            if not holders.has(name):
                yield f"docs/limits.md:{number}: there is no test, message, constant or function {name}"


def main():
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    program = str(Path(sys.argv[1]).resolve())
    if sys.argv[2:] == ["--write"]:
        (ROOT / "docs" / "knobs.md").write_text(knobs_page(program), encoding="utf-8")
        return 0
    root = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else ROOT
    pages = [root / "README.md", *sorted((root / "docs").glob("*.md"))]
    problems = [*check_knobs(root, program), *check_links(root, pages), *check_options(root, program), *check_embed(root),
                *check_limits(root)]
    for problem in problems:
        print(problem, file=sys.stderr)
    if not problems:
        print(f"docs: {len(pages)} pages are true where a machine can tell")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
