#!/usr/bin/env python3
"""Tests write into a TestFolder alone: what they run beside has other names then.

./check runs the unit tests in several processes at once. A file of a fixed name is another process' file too, which
writes or removes it in the middle of a test.

    test_folders_test.py [ROOT]
"""
import pathlib
import re
import sys

SHARED_FOLDER = re.compile(r"\bTempDir\(\)|\btemp_directory_path\(|\btmpnam\(")
MAKER = "src/base/test_folder.h"


def faults(text):
    return [number for number, line in enumerate(text.splitlines(), 1) if SHARED_FOLDER.search(line)]


def main():
    assert faults('path = ::testing::TempDir() + "a";\nTestFolder folder;\nof = temp_directory_path() / "a";') == [1, 3]
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    files = [file for folder in ("src", "apps", "tests") for file in (root / folder).rglob("*")
             if file.name.endswith("_test.cpp") or (file.suffix in (".cpp", ".h") and "tests" in file.parts)]
    assert len(files) > 100, files
    found = [f"{file.relative_to(root)}:{line}" for file in files if str(file.relative_to(root)) != MAKER
             for line in faults(file.read_text())]
    for place in found:
        print(f"{place}: a folder that other processes have too; TestFolder makes one of its own")
    return len(found) > 0


sys.exit(main())
