#!/usr/bin/env python3
"""Keeps numbers and lists of the pages what the results and the tree say.

    tests/docs_numbers_test.py             exit code 1 with a list if something is wrong
    tests/docs_numbers_test.py --write     makes the tables of docs/bench.md, docs/fins.md, docs/ink.md and docs/measure.md again

Tables of numbers in those pages stand below `<!-- table NAME -->` and are made from
bench/results; every result says when, of what revision and on what machine it was measured. Lines "May include" are those
of tools/include_table.py; tables of passes name all of src/passes and those of features; what is counted or listed is what is there.
"""
import json
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import include_table  # noqa: E402

MARK = re.compile(r"^<!-- table (\S+) -->$")


CPU, GPU = "lavapipe-2-cores", "nvidia-h200"


def load(root, name, machine=CPU):
    return json.loads((root / "bench" / "results" / machine / f"{name}.json").read_text(encoding="utf-8"))


# -- Tables: each a heading and rows of text.

def whole(number):
    return f"{number:.0f}"


def rough(number):
    """Two digits below 10, else whole."""
    return f"{number:.1f}" if number < 10 else whole(number)


def scene_name(report):
    scene = report["scene"]
    return re.sub(r"\.(glb|gltf)\b", "", scene if isinstance(scene, str) else scene[0])


def frames(root):
    yield ["scene", "triangles", "samples", "frame, ms", "yardstick, ms", "ratio", "goal"]
    for name, goal in (("duck-1", "5"), ("duck-4", "2.5"), ("spheres-1", "1.5"), ("spheres-4", "1.0"), ("harbour-1", "1.5"),
                       ("harbour-4", "1.0"), ("spheres-8m-1", "")):
        r = load(root, name)
        frame, yardstick = r["frameMilliseconds"], r["yardstickMilliseconds"]
        yield [scene_name(r), str(r["triangles"]), str(r["samples"]), whole(frame), rough(yardstick), f"{r['ratio']:.1f}",
               goal]


def frames_on_gpu(root):
    yield ["scene", "look", "triangles", "samples", "frame, ms", "yardstick, ms", "ratio", "the longest passes, ms"]
    for name, look in (("duck-1", ""), ("duck-4", ""), ("spheres-1", ""), ("spheres-4", ""), ("harbour-1", ""), ("harbour-4", ""),
                       ("spheres-8m-1", ""), ("ink-400k-1", "`ink`"), ("watercolour-200k-1", "`watercolour`"),
                       ("watercolour-200k-4", "`watercolour`")):
        r = load(root, name, GPU)
        longest = sorted(r["passes"], key=lambda each: -each["milliseconds"])[:3]
        yield [scene_name(r), look, str(r["triangles"]), str(r["samples"]), f"{r['frameMilliseconds']:.2f}",
               f"{r['yardstickMilliseconds']:.2f}", f"{r['ratio']:.1f}",
               ", ".join(f"`{each['name']}` {each['milliseconds']:.1f}" for each in longest)]


def paintings(machine):
    def table(root):
        yield ["painting", "splats", "triangles", "bake, s", "painting, MB", "fins, MB", "strokes, ms", "fins, ms", "faster",
               "frames a second, strokes", "fins", "FLIP, median", "most"]
        for r in load(root, "paintings", machine)["results"]:
            yield [r["subject"], str(r["splats"]), str(r["triangles"]), f"{r['bakeSeconds']:.1f}", f"{r['paintingBytes'] / 1e6:.1f}",
                   f"{r['finsBytes'] / 1e6:.1f}", rough(r["strokesMilliseconds"]), rough(r["finsMilliseconds"]), f"{r['faster']:.1f}",
                   rough(r["strokesFramesPerSecond"]), rough(r["finsFramesPerSecond"]), f"{r['flip']['median']:.3f}",
                   f"{r['flip']['most']:.3f}"]

    return table


def metatexture(root):
    goals = {"MetaTexture, 4 samples": "4.5", "MetaTexture, 8 samples": "9"}
    yield ["", "ms", "ratio", "goal"]
    for case in load(root, "metatexture")["cases"]:
        yield [case["name"], f"{case['milliseconds']:.1f}", f"{case['ratio']:.1f}", goals.get(case["name"], "")]


def start(root):
    yield ["scene", "median, s", "fastest, s", "slowest, s", "peak of memory, MiB"]
    for r in load(root, "start-to-picture")["results"]:
        yield [scene_name(r), *(f"{r[key]:.2f}" for key in ("medianSeconds", "fastestSeconds", "slowestSeconds")),
               whole(r["peakResidentBytes"] / 2**20)]


def window(root):
    names = {"scumble": "`scumble view`", "f3d": "f3d", "three": "three.js"}
    yield ["scene", "program", "first picture, s (goal 1)", "answer, ms", "pictures a second, moving", "MiB after 24 edits, and 240"]
    for r in load(root, "window")["results"]:
        for program, numbers in r["programs"].items():
            memory = " and ".join(whole(numbers[key] / 2**20) for key in ("bytesEarly", "bytesLate")) if "edits" in numbers else ""
            yield [r["scene"], names[program], f"{numbers['first'] / 1000:.2f}", whole(numbers["answer"]), f"{numbers['moving']:.1f}", memory]


def sequences(root):
    yield ["scene", "draws", "frames a second", "least to most", "above the sum of GPU passes", "GPU, ms", "CPU, ms", "reading back, ms",
           "writing, ms"]
    for r in load(root, "frames-per-second")["results"]:
        spread = r.get("spread", {}).get("framesPerSecond")
        yield [scene_name(r), str(r["drawCalls"]), f"{r['framesPerSecond']:.1f}",
               f"{spread['least']:.1f} to {spread['most']:.1f}" if spread else "one run", f"{100 * r['above']:.1f} %",
               whole(r["gpuMilliseconds"]), f"{r['cpuMilliseconds']:.2f}", whole(r["readbackMilliseconds"]),
               whole(r["writeMilliseconds"])]


def colorizers(root):
    yield ["", "ms", "ratio", "first turn, ms"]
    for case in load(root, "colorizers")["cases"]:
        yield [case["name"], f"{case['milliseconds']:.1f}", f"{case['ratio']:.1f}", whole(case["first"])]


def edits(root):
    yield ["", "ms", "of the whole", "its frame, ms"]
    for case in load(root, "edits")["cases"]:
        yield [case["name"], rough(case["milliseconds"]), f"{case['ratio']:.2f}", rough(case["frameMilliseconds"])]


def ocean(root):
    yield ["", "ms", "of the frame", "goal"]
    for case in load(root, "ocean")["cases"]:
        yield [case["name"], rough(case["milliseconds"]), f"{100 * case['ratio']:.1f} %", "3 %" if case["name"] == "both" else ""]


def looks(root):
    yield ["look", "scene", "pass", "ms", "of the frame, ms"]
    for look, name in (("henry", "colorize"), ("gouache-night", "limit")):
        r = load(root, f"{look}-4")
        cost = next(each["milliseconds"] for each in r["passes"] if each["name"] == name)
        yield [f"`{look}`", scene_name(r), f"`{name}`", whole(cost), whole(r["frameMilliseconds"])]


def watercolour(root):
    """The table of paper 004, which has frames of 1.3, 1.7 and 9.2 ms."""
    paper = [1.3, 1.7, 9.2]
    yield ["", "1 sample, ms", "of plain", "4 samples, ms", "of plain", "paper 004, ms", "of plain"]
    columns = []
    for samples in (1, 4):
        r = load(root, f"watercolour-200k-{samples}")
        took = {each["name"]: each["milliseconds"] for each in r["passes"]}
        plain = r["yardstickMilliseconds"]
        columns.append([plain, plain + took["pigment"], r["frameMilliseconds"]])
    for row, name in enumerate(["plain", "plain and texture generation", "the whole frame"]):
        cells = [name]
        for column in [*columns, paper]:
            cells += [rough(column[row]), f"{column[row] / column[0]:.1f}"]
        yield cells


def finding_lines(root):
    yield ["triangles", "`ink-lines`, ms", "plain, ms", "of plain", "ms a million triangles"]
    for name in ("ink-400k-1", "ink-2m-1", "ink-5m-1", "ink-9m-1"):
        r = load(root, name)
        took = next(each["milliseconds"] for each in r["passes"] if each["name"] == "ink-lines")
        yield [str(r["triangles"]), rough(took), rough(r["yardstickMilliseconds"]), f"{100 * took / r['yardstickMilliseconds']:.0f} %",
               rough(took / r["triangles"] * 1e6)]


MODES = ["metatexture", "object", "screen", "fractal"]
MEASURED = [("warp error, dolly", lambda m: m["temporal"]["dolly"]["vectors"]),
            ("warp error, orbit", lambda m: m["temporal"]["orbit"]["vectors"]),
            ("warp error, roll", lambda m: m["temporal"]["roll"]["vectors"]),
            ("warp error, moving object", lambda m: m["temporal"]["object"]["vectors"]),
            ("frequency drift, octaves", lambda m: m["frequencyDrift"]["vectors"]),
            ("contrast, from its mean", lambda m: m["contrastDeviation"]["vectors"]),
            ("contrast, from the example's", lambda m: m["contrastError"]["vectors"]),
            ("flatness error", lambda m: m["flatness"]["vectors"]),
            ("stereo difference", lambda m: m["stereo"]["warp"]["vectors"]),
            ("marks that die in an octave", lambda m: m["marks"]["died"]),
            ("stereo, final-color", lambda m: m["stereo"]["final-color"])]


def coherence(name):
    def table(root):
        yield ["vectors", *MODES]
        modes = load(root, f"coherence-{name}")["modes"]
        for row, of in MEASURED:
            # Less is better; the least is in bold.
            numbers = [of(modes[mode]) for mode in MODES]
            yield [row, *(f"**{n:.3f}**" if n == min(numbers) else f"{n:.3f}" for n in numbers)]

    return table


def rival_of(target):
    """Whom it is against, where that differs from scene to scene."""
    return f" of `{target['meaning'].rsplit(' ', 1)[1]}`" if "best rival" in target["name"] else ""


def targets(root):
    yield ["scene", "covers", "frequency (1.00)", "contrast (0.05)", "warp error (0.33)", "stereo (0.20)",
           "warp error, best rival (1.10)", "stereo, best rival (1.10)"]
    for name in COHERENCE:
        r = load(root, f"coherence-{name}")
        yield [scene_name(r), f"{100 * r['visible']:.0f} %",
               *(f"{t['value']:.2f}{rival_of(t)}{'' if t['kept'] else ', missed'}" for t in r["targets"])]


def lines(root):
    """Of 10,000 pixels that are drawn on; the least of each row in bold."""
    methods = ["ink", "plain", "freestyle", "lineart"]
    yield ["scene", "ours", "plain", "Freestyle", "Line Art"]
    for r in load(root, "lines")["results"]:
        numbers = [1e4 * r["lines"][method]["flickers"] for method in methods]
        yield [scene_name(r), *(f"**{n:.1f}**" if n == min(numbers) else f"{n:.1f}" for n in numbers)]


COHERENCE = ["suzanne", "sail-ship", "toycar", "demo"]
TABLES = {"bench.md": {"frames": frames, "metatexture": metatexture, "start": start, "window": window, "sequences": sequences, "colorizers": colorizers,
                       "edits": edits, "ocean": ocean, "looks": looks, "watercolour": watercolour, "finding-lines": finding_lines, "frames-on-gpu": frames_on_gpu},
          "fins.md": {"paintings": paintings(CPU), "paintings-on-gpu": paintings(GPU)},
          "ink.md": {"lines": lines},
          "measure.md": {"targets": targets, **{name: coherence(name) for name in COHERENCE}}}


def table_text(root, table):
    rows = list(table(root))
    rows.insert(1, ["---"] * len(rows[0]))
    return ["|" + "".join(f" {cell} |" if cell else " |" for cell in row).replace(" --- ", "---") for row in rows]


def remade(root, page, text):
    """The page with its tables as the results have them, the names of those, and lines of tables of numbers without a name."""
    lines, made, names, strays = text.splitlines(), [], [], []
    at = 0
    while at < len(lines):
        mark = MARK.match(lines[at])
        is_table = lines[at].startswith("|")
        made.append(lines[at])
        at += 1
        if mark and mark.group(1) in TABLES[page]:
            names.append(mark.group(1))
            made += table_text(root, TABLES[page][mark.group(1)])
            while at < len(lines) and lines[at].startswith("|"):
                at += 1
        elif is_table and re.search(r"\| [\d.]+( %| ms)? \|", made[-1]):
            strays.append(at)
    return "\n".join(made) + "\n", names, strays


def check_tables(root, write=False):
    for page, tables in TABLES.items():
        path = root / "docs" / page
        text = path.read_text(encoding="utf-8")
        made, names, strays = remade(root, page, text)
        if write:
            path.write_text(made, encoding="utf-8")
            continue
        for stray in strays:
            yield f"docs/{page}:{stray}: a number in a table that no result holds; give the table a name and a result"
        for name in sorted(set(tables) - set(names)):
            yield f"docs/{page}: the table '{name}' is missing"
        for number, (before, after) in enumerate(zip(text.splitlines(), made.splitlines()), 1):
            if before != after:
                yield f"docs/{page}:{number}: it is not what bench/results says; `python3 tests/docs_numbers_test.py --write` makes it again"
                break
        if len(made.splitlines()) != len(text.splitlines()):
            yield f"docs/{page}: a table has other rows than bench/results"


def check_prose(root):
    """Numbers of results in sentences."""
    cases = {case["name"]: 100 * case["ratio"] for case in load(root, "ocean")["cases"]}
    said = {("sea.md", r"([\d.]+) percent for waves and vertices"): f"{cases['both']:.1f}",
            ("sea.md", r"([\d.]+) percent for painting"): whole(cases["painting, the pass ocean"])}
    for (page, words), expected in said.items():
        found = re.search(words, (root / "docs" / page).read_text(encoding="utf-8"))
        if not found or found.group(1) != expected:
            yield f"docs/{page}: results say {expected} for '{words}', it says {found and found.group(1)}"


def check_results(root):
    files = sorted((root / "bench" / "results").rglob("*.json"))
    if len(files) < 10:
        yield f"bench/results: there are {len(files)} files"
    for path in files:
        report, where = json.loads(path.read_text(encoding="utf-8")), path.relative_to(root)
        if not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(Z|[+-]\d\d:\d\d)", str(report.get("date"))):
            yield f"{where}: it has no date"
        if not re.fullmatch(r"[0-9a-f]{7,40}(-dirty)?", str(report.get("revision"))):
            yield f"{where}: it has no revision"
        if not {"system", "processor", "processors"} <= set(report.get("machine") or {}):
            yield f"{where}: it does not name the machine"
        if re.search(r'["\s=]/\w', path.read_text(encoding="utf-8")):
            yield f"{where}: it names places of a machine"


# -- The include table

def may_include(room, allowed):
    """The words for a room of the table; what is in no checkout yet does not count."""
    names = {"include/scumble": "public headers", "src/passes/*": "passes", "src/passes/*/*_knobs.h": "knobs of other passes"}
    return [names.get(each, each.removeprefix("src/")) for each in allowed]


# Pages of rooms whose names are others.
ROOM_PAGES = {"app.md": "apps/scumble", "serve.md": "apps/serve", "viewer.md": "apps/viewer", "python.md": "python", "passes.md": "src/passes/*", "features.md": "src/features/*"}
PART_PAGES = {"ocean.md": "src/features/*", "ocean_maps.md": "src/features/*"}  # of one part of a room, which may use less
LIBRARY_WORDS = {"CLI": "CLI11", "fmt": "fmt", "nlohmann": "nlohmann-json", "cairo": "cairo"}


def words_of(line):
    text = re.sub(r"[`*]", "", line.split("May include:", 1)[1])
    text = re.split(r"\. |\.$|; ", text.strip(), maxsplit=1)[0]
    return [word.strip() for word in text.split(",")]


def check_may_include(root):
    seen = 0
    for path in sorted((root / "docs").glob("*.md")):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if "**May include:**" not in line:
                continue
            seen += 1
            where = f"docs/{path.name}:{number}"
            part = PART_PAGES.get(path.name)
            room = part or ROOM_PAGES.get(path.name, f"src/{path.stem}")
            if room not in include_table.TABLE:
                yield f"{where}: the include table has no room {room}"
                continue
            there = [each for each in include_table.TABLE[room] if "*" in each or (root / each).exists()]
            expected, found = may_include(room, there) or ["nothing"], words_of(line)
            if not set(found) <= set(expected) if part else found != expected:
                yield f"{where}: {room} may include: {', '.join(expected)}; it says: {', '.join(found)}"
    if seen < 10:
        yield f"docs: {seen} pages say what their room may include"
    # The table of the house.
    rows = {}
    for line in (root / "docs" / "house.md").read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|") and len(cells) == 3:
            names = re.findall(r"`([^`]+)`", cells[0])
            if names:
                rows[names[0].replace("NAME", "*")] = cells[2]
    for room, allowed in include_table.TABLE.items():
        if "*" not in room and not (root / room).exists():
            continue
        if room not in rows:
            yield f"docs/house.md: its table lacks {room}"
        elif room.startswith("src/") and room != "src/renderer":
            there = [each for each in allowed if "*" in each or (root / each).exists()]
            words = [word.replace("public headers", "public") for word in may_include(room, there)] or ["nothing"]
            found = [word.strip().replace("public headers", "public") for word in rows[room].split(";")[0].split(",")]
            if found != words:
                yield f"docs/house.md: {room} may include: {', '.join(words)}; it says: {', '.join(found)}"


# -- Lists and counts

NUMBERS = dict(zip("one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen".split(), range(1, 16)))


def folders(path):
    return {each.name for each in path.iterdir() if each.is_dir()}


def first_cells(text):
    """Names in code in the first cells of all tables' rows."""
    return {name for line in text.splitlines() if line.startswith("|") for name in re.findall(r"`([^`]+)`", line.split("|")[1])}


def headers(root, room):
    """Those of a room that are not for its tests alone."""
    files = sorted((root / room).glob("*.h"))
    return [path.name for path in files if not re.search(r"^// Tests only|namespace \S*::test\b", path.read_text(encoding="utf-8"))]


def check_lists(root):
    docs = root / "docs"
    named = first_cells((docs / "passes.md").read_text(encoding="utf-8"))
    for name in sorted(folders(root / "src" / "passes") - named):
        yield f"docs/passes.md: no table has the pass {name}"
    for path in sorted((root / "src" / "features").rglob("*.cpp")):
        text = path.read_text(encoding="utf-8")
        passes = re.findall(r'name\(\) const override \{ return "([^"]+)"', text) if "public Pass" in text else []
        for name in sorted(set(passes) - named):
            yield f"docs/passes.md: no table has the pass {name} of {path.relative_to(root)}"
    built = re.search(r"foreach\(pass ([^)]*)\)", (root / "src" / "passes" / "CMakeLists.txt").read_text()).group(1).split()
    for name in sorted(set(built) ^ folders(root / "src" / "passes")):
        yield f"src/passes/CMakeLists.txt and the folders differ: {name}"
    for room in ("stage", "world", "frame"):
        named = first_cells((docs / f"{room}.md").read_text(encoding="utf-8"))
        for header in headers(root, f"src/{room}"):
            if header not in named:
                yield f"docs/{room}.md: its table lacks {header}"
    named = first_cells((docs / "measure.md").read_text(encoding="utf-8"))
    for header in headers(root, "src/measure"):
        if f"src/measure/{header}" not in named:
            yield f"docs/measure.md: its table lacks {header}"
    named = first_cells((root / "README.md").read_text(encoding="utf-8"))
    for look in sorted(path.stem for path in (root / "looks").glob("*.json")):
        if look not in named:
            yield f"README.md: its table lacks the look {look}"
    house = next(line for line in (docs / "house.md").read_text(encoding="utf-8").splitlines() if line.startswith("| `examples`"))
    for example in sorted(folders(root / "examples")):
        if example.replace("_", " ").replace("embed", "embedding") not in house.lower().replace("'s", ""):
            yield f"docs/house.md: the row of examples lacks {example}"
    # Example textures: knobs name them.
    params = (root / "src" / "shading" / "metatexture.params").read_text(encoding="utf-8")
    textures = re.search(r'PARAM\(picture, example,[^"]*"([^"]+)"', params).group(1).split("|")
    for page in sorted(docs.glob("*.md")):
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
            if re.search(r"built in \(`torn`", line) and re.findall(r"`(\w+)`", re.search(r"built in \(([^)]*)\)", line).group(1)) != textures:
                yield f"docs/{page.name}:{number}: textures that are built in are {', '.join(textures)}"
    yield from check_counts(root, {"looks that ship": len(list((root / "looks").glob("*.json"))), "example textures": len(textures),
                                   "examples built in": len(textures), "built-in examples": len(textures),
                                   "passes in src/passes": len(folders(root / "src" / "passes"))})


def check_counts(root, counts):
    for page in [root / "README.md", *sorted((root / "docs").glob("*.md"))]:
        text = page.read_text(encoding="utf-8")
        for what, count in counts.items():
            for match in re.finditer(rf"\b(\w+) {what}", text):
                said = NUMBERS.get(match.group(1).lower(), int(match.group(1)) if match.group(1).isdigit() else count)
                if said != count:
                    yield f"{page.relative_to(root)}: there are {count} {what}, it says {match.group(1)}"


def check(root):
    return [*check_tables(root), *check_prose(root), *check_results(root), *check_may_include(root), *check_lists(root)]


def main():
    if sys.argv[1:] == ["--write"]:
        list(check_tables(ROOT, write=True))
        return 0
    problems = check(ROOT)
    for problem in problems:
        print(problem, file=sys.stderr)
    if not problems:
        print("docs: numbers and lists are those of the results and of the tree")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
