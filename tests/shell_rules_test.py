#!/usr/bin/env python3
"""No command of the shell scripts ends while something still writes to it.

Under `pipefail`, who writes to a reader that has ended dies of SIGPIPE, and the script fails with 141: but only where
there is more to write than a pipe holds, 64 KiB, so that a script is right for a year and then is not.

    shell_rules_test.py CHECKOUT
"""
import pathlib
import re
import subprocess
import sys
import unittest

# What reads to the end does the same: sed -n 1,10p instead of head, grep into /dev/null instead of grep -q.
ENDS_EARLY = re.compile(
    r"\|&?\s*(?:env\s+(?:\w+=\S+\s+)*)?"
    r"(head\b|grep\s+(?:-\w+\s+)*-\w*[qm]|grep\s[^|\n]*(?:--quiet|--max-count|-[a-zA-Z]*q\b)"
    r"|sed\s[^|\n]*?(?:\bq\b|\d+q|/q)|awk\s[^|\n]*\bexit\b|read\b)")


def scripts(checkout):
    for path in sorted(checkout.rglob("*")):
        parts = path.relative_to(checkout).parts
        if parts[0] in (".git", ".venv") or parts[0].startswith("build") or not path.is_file() or path.suffix:
            continue
        with path.open("rb") as file:
            begin = file.read(200)
        if re.match(rb"#!.*\b(ba)?sh\b", begin) or b"shellcheck shell=bash" in begin or parts == ("tools", "setup"):
            yield path


def faults(text):
    # A pipe may go on in the next line.
    text = re.sub(r"(^|\s)#[^\n]*", r"\1", text)
    text = re.sub(r"\|\s*\\?\n\s*", "| ", text)
    return [match[0] for match in ENDS_EARLY.finditer(text)]


class ShellRules(unittest.TestCase):
    def test_scripts_keep_them(self):
        found = list(scripts(ROOT))
        names = {str(path.relative_to(ROOT)) for path in found}
        self.assertLessEqual({"check", "demo", "package", "tools/setup", ".ci/run"}, names)
        for path in found:
            with self.subTest(path=path.relative_to(ROOT)):
                self.assertEqual(faults(path.read_text()), [])

    def test_faults_are_found(self):
        for fault in ("sort -rn slow | head -n 10", "list |\n  head -3", "list | grep -q word", "list | grep -F -qx word",
                      "list | sed 3q", "list | sed -n '/a/p;/b/q'", "list | awk '{ print; exit }'", "list | read -r first"):
            self.assertTrue(faults(fault), fault)
        for right in ("sort -rn slow | sed -n 1,10p", "grep -q word <<<\"$list\"", "list | tail -n 3", "list | grep -c word",
                      "# sort | head", "list | while read -r each; do echo; done", "list | awk '{ sum += $1 } END { print sum }'"):
            self.assertEqual(faults(right), [], right)

    def test_scripts_say_what_they_are_for(self):
        def run(*words):
            return subprocess.run([str(ROOT / words[0]), *words[1:]], capture_output=True, text=True, check=False, timeout=60)
        for name in ("demo", "package", "check"):
            for option in ("-h", "--help"):
                done = run(name, option)
                self.assertEqual((done.returncode, done.stderr), (0, ""), name)
                self.assertGreater(len(done.stdout), 60, name)
                self.assertNotIn("#", done.stdout)
            for wrong in ("--frobnicate", "everything"):
                done = run(name, wrong)
                self.assertEqual((done.returncode, done.stdout), (1, ""), f"{name} {wrong}")
                self.assertIn(wrong, done.stderr)
                self.assertIn(f"./{name} --", done.stderr)
        self.assertEqual(run("check", "--until").returncode, 1)
        self.assertIn("unit-tests", run("check", "--list").stdout.split())

    def test_the_rule_is_true(self):
        def code(pipe):
            return subprocess.run(["bash", "-o", "pipefail", "-c", pipe], stdout=subprocess.DEVNULL, check=False).returncode
        self.assertNotEqual(code("seq 100000 | sort -rn | head -n 10"), 0)
        self.assertEqual(code("seq 100000 | sort -rn | sed -n 1,10p"), 0)


if __name__ == "__main__":
    ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
