#!/usr/bin/env python3
"""docs/papers.md names what there is: paths, knobs and their choices, tests, links, and all corrections to the papers.
docs/through.md has something in every cell of its table, and says of each what it means.

    tests/papers_test.py [ROOT]      exit code 1 with a line for each name that is wrong

Its tables have a row for each mechanism: section, mechanism, code, test, deviation. A row without code or without a
test says so by a dash.
"""
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import docs_test as docs  # noqa: E402

PAGE = "docs/papers.md"
TABLE_PAGE = "docs/through.md"
CELLS = ["mechanism", "code", "test", "deviation"]  # after the section, or the part of an unnumbered text
CODE, TEST = 2, 3
CORRECTIONS = range(1, 30)

# A group of knobs as sources declare it (src/look/define_params.h), and a row of its file.
GROUP = re.compile(r'#define PARAMS_FILE "([^"]+)"\n#define PARAMS_PATH "([^"]+)"')
ROW = re.compile(r'^PARAM\(\w+, (\w+),[^"]*"([^"]*)"', re.MULTILINE)
KNOB = re.compile(r"^([a-z]\w*(?:\.\w+)+)(?:=([\w-]+))?$")
TEST_NAME = re.compile(r"^[A-Z]\w*\.\w+$|^\w+_test\.py: ")


def knobs_of(root):
    """Choices or unit, by the whole name of each knob; groups have none."""
    knobs = {}
    for _, text in docs.sources(root, ("src",), (".h", ".cpp")):
        for file, group in GROUP.findall(text):
            knobs[group] = ""
            for name, choices in ROW.findall((root / "src" / file).read_text(encoding="utf-8")):
                knobs[f"{group}.{name}"] = choices
    return knobs


class Names:
    """What the page may name."""

    def __init__(self, root):
        self.root = root
        self.holders = docs.Holders(root)
        self.knobs = knobs_of(root)

    def fault(self, name):
        """What is wrong with a name in code, or nothing."""
        if TEST_NAME.match(name):
            return None if name in self.holders.tests else f"there is no test {name}"
        if name.startswith(("--", "_")):
            return None if name in self.holders.strings else f"the sources know no {name}"
        knob = KNOB.match(name)
        if "/" not in name and (knob or name in self.knobs):
            whole, choice = knob.groups() if knob else (name, None)
            if whole not in self.knobs:
                return f"there is no knob {whole}"
            if choice and choice not in self.knobs[whole].split("|"):
                return f"{choice} is no choice of {whole}"
            return None
        if "/" in name:
            places = (self.root / "src" / name, self.root / name)
            return None if any(place.is_file() for place in places) else f"there is no file {name}"
        return f"{name} is neither a path, a knob, a test, an option nor an attribute"


def check_row(names, cells):
    if len(cells) != len(CELLS) + 1:
        yield f"a row has {len(cells)} cells instead of {len(CELLS) + 1}"
        return
    for number, what in enumerate(CELLS, 1):
        if not cells[number]:
            yield f"the cell '{what}' is empty; write a dash"
    code, tests = docs.SPAN.findall(cells[CODE]), docs.SPAN.findall(cells[TEST])
    if cells[CODE] != "-" and not any("/" in name for name in code):
        yield "the code has no path; write a dash where there is none"
    if cells[TEST] != "-" and not (tests and all(TEST_NAME.match(name) for name in tests)):
        yield "the test has no name; write a dash where there is none"


def check_page(root):
    page = root / PAGE
    text = page.read_text(encoding="utf-8")
    names = Names(root)
    rows = 0
    for number, line in enumerate(text.splitlines(), 1):
        where = f"{PAGE}:{number}"
        for name in docs.SPAN.findall(line):
            if fault := names.fault(name):
                yield f"{where}: {fault}"
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("| ") and cells[1:] != CELLS:
            rows += 1
            yield from (f"{where}: {fault}" for fault in check_row(names, cells))
    if rows < 60:
        yield f"{PAGE}: its tables have {rows} rows"
    for number in CORRECTIONS:
        if not re.search(rf"\bF{number}\b", "\n".join(line for line in text.splitlines() if line.startswith("|"))):
            yield f"{PAGE}: no row has the correction F{number}"
    yield from docs.check_links(root, [page])


def check_table_of_pairs(root):
    """Letters of the table stand for tests below it, and numbers for reasons."""
    page = root / TABLE_PAGE
    text = page.read_text(encoding="utf-8")
    tests = docs.Holders(root).tests
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("| ")]
    if len(rows) < 11:
        yield f"{TABLE_PAGE}: the table has {len(rows)} rows"
    used = {mark for row in rows[1:] for cell in row[1:] for mark in cell.split()}
    letters = dict(re.findall(r"(?:^- |; )([a-z]2?): ([^;\n]*)", text, re.MULTILINE))
    reasons = set(re.findall(r"^(\d+)\. It |^(\d+)\. ", text[text.index("\n- a:"):], re.MULTILINE))
    known = set(letters) | {number for pair in reasons for number in pair if number}
    yield from (f"{TABLE_PAGE}: row {row[0]} has an empty cell" for row in rows for cell in row[1:] if not cell)
    yield from (f"{TABLE_PAGE}: nothing says what {mark} means" for mark in sorted(used - known))
    yield from (f"{TABLE_PAGE}: no cell has {mark}" for mark in sorted(known - used))
    for letter, line in letters.items():
        named = [name for name in docs.SPAN.findall(line) if TEST_NAME.match(name)]
        if not named:
            yield f"{TABLE_PAGE}: {letter} names no test"
        yield from (f"{TABLE_PAGE}: there is no test {name}" for name in named if name not in tests)
    yield from docs.check_links(root, [page])


def main():
    root = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else docs.ROOT
    problems = list(check_page(root)) + list(check_table_of_pairs(root))
    for problem in problems:
        print(problem, file=sys.stderr)
    if not problems:
        print("papers: every name of docs/papers.md and docs/through.md is there")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
