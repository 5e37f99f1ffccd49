#!/usr/bin/env python3
"""The test of numbers' own test: what it must notice in a copy of the pages."""
import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import docs_numbers_test as numbers  # noqa: E402

RESULTS = "bench/results/lavapipe-2-cores"


class Numbers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="docs numbers ")
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for part in ("docs", "bench/results", "looks"):
            shutil.copytree(numbers.ROOT / part, self.root / part, ignore=shutil.ignore_patterns("*.png", "*.jpg"))
        # Of the tree folders count, and what stands in some files.
        for part in ("src", "include", "examples", "apps"):
            for path in (numbers.ROOT / part).rglob("*"):
                if path.is_dir():
                    (self.root / path.relative_to(numbers.ROOT)).mkdir(parents=True, exist_ok=True)
        for room in ("src/stage", "src/world", "src/frame", "src/measure"):
            for path in (numbers.ROOT / room).glob("*.h"):
                shutil.copy(path, self.root / room)
        for path in (numbers.ROOT / "src" / "features").rglob("*.cpp"):
            shutil.copy(path, self.root / path.relative_to(numbers.ROOT))
        for name in ("README.md", "src/passes/CMakeLists.txt", "src/shading/metatexture.params"):
            shutil.copy(numbers.ROOT / name, self.root / name)
        for name in ("bench", "tests"):
            (self.root / name).mkdir(exist_ok=True)

    def change(self, file, before, after):
        path = self.root / file
        text = path.read_text(encoding="utf-8")
        self.assertIn(before, text)
        path.write_text(text.replace(before, after, 1), encoding="utf-8")

    def notices(self, *words):
        problems = numbers.check(self.root)
        self.assertTrue(any(all(word in problem for word in words) for problem in problems), problems)

    def test_the_tree_as_it_is(self):
        self.assertEqual(numbers.check(self.root), [])

    def test_numbers_of_tables(self):
        for page, tables in numbers.TABLES.items():
            for name, table in tables.items():
                row = numbers.table_text(self.root, table)[-1]
                digit = max(i for i, letter in enumerate(row) if letter.isdigit())
                changed = row[:digit] + str((int(row[digit]) + 1) % 10) + row[digit + 1:]
                with self.subTest(table=name):
                    self.change(f"docs/{page}", row, changed)
                    self.notices(f"docs/{page}", "bench/results")
                    self.change(f"docs/{page}", changed, row)
        self.assertEqual(numbers.check(self.root), [])

    def test_numbers_of_results(self):
        path = self.root / RESULTS / "ocean.json"
        report = json.loads(path.read_text())
        report["cases"][0]["milliseconds"] += 1
        path.write_text(json.dumps(report))
        self.notices("docs/bench.md", "bench/results")

    def test_numbers_in_sentences(self):
        self.change("docs/sea.md", "30 percent for painting", "3 percent for painting")
        self.notices("docs/sea.md", "painting")

    def test_rows_and_tables_that_no_result_has(self):
        self.change("docs/bench.md", "<!-- table looks -->", "")
        self.notices("docs/bench.md", "'looks' is missing")
        self.notices("docs/bench.md", "no result holds")

    def test_results_say_when_and_where(self):
        for key in ("date", "revision", "machine"):
            path = self.root / RESULTS / "henry-4.json"
            whole = path.read_text()
            report = json.loads(whole)
            del report[key]
            path.write_text(json.dumps(report))
            self.notices("henry-4.json", key)
            path.write_text(whole)
        # Alone, and within a command.
        for before in ('"room.glb"', " room.glb"):
            changed = before.replace("room", "/tmp/room")
            with self.subTest(place=changed):
                self.change(f"{RESULTS}/henry-4.json", before, changed)
                self.notices("henry-4.json", "places")
                self.change(f"{RESULTS}/henry-4.json", changed, before)

    def test_may_include(self):
        self.change("docs/frame.md", "stage, world.", "stage.")
        self.notices("docs/frame.md", "src/frame may include")
        self.change("docs/house.md", "| public, base, scene |", "| public, base |")
        self.notices("docs/house.md", "src/sketch may include")

    def test_lists(self):
        for file, before, after, word in (("docs/passes.md", "| `order` |", "| |", "order"), ("docs/passes.md", "| `ocean` |", "| |", "ocean"),
                                          ("README.md", "| `dusk` |", "| |", "dusk"),
                                          ("docs/stage.md", "| `palette.h` |", "| |", "palette.h"),
                                          ("docs/measure.md", "| `src/measure/field.h` |", "| |", "field.h"),
                                          ("docs/metatexture.md", "`paper`, `sea`, `foam`, `nested`)", "`paper`)", "foam"),
                                          ("docs/house.md", "Henry's room, ", "", "henry")):
            with self.subTest(file=file):
                self.change(file, before, after)
                self.notices(file, word)

    def test_counts(self):
        (self.root / "docs" / "new.md").write_text("There are three example textures.\n")
        self.notices("docs/new.md", "example textures")


if __name__ == "__main__":
    unittest.main()
