#!/usr/bin/env python3
"""Numbers are read and written without a locale, in all sources that are not tests.

A host program's locale (Qt and GTK programs set the user's) decides how strtod, printf and streams read and write them:
with a decimal comma. std::from_chars (base/numbers.h) and fmt have none.

    number_rules_test.py CHECKOUT
"""
import pathlib
import re
import sys
import unittest

SOURCES = ("src", "apps", "python")
RULES = {
    "reads numbers by the locale (use base/numbers.h or std::from_chars)":
        r"\b(strto[df]|strtold|atof|stof|stod|stold)\s*\(|\bv?f?s?scanf\s*\([^;]*?%[*0-9]*l?[aAeEfFgG]",
    "prints numbers by the locale (use fmt::format)":
        r"\b(v?f?printf|v?s?n?printf)\s*\([^;]*?%[-+ #0-9.*]*l?[aAeEfFgG]",
    "prints a number with a point by the locale (use fmt::format)":
        r"std::to_string\(\s*(double|float|[^()]*\b(seconds|fps|time|degrees|radius|share)\b|[^()]*\d\.\d)",
    "uses a stream's numbers (use fmt::format, or base/numbers.h)":
        r"\b(ostringstream|setprecision|std::cout|std::cerr|std::fixed|std::scientific)\b|\b(words|lines|stream|in|path|unit|folders)\s*>>\s*(?!word\b)\w",
}


def faults(text):
    # Comments may name what is not done; ImGui's own formats are not C's.
    code = re.sub(r"//[^\n]*", "", text)
    code = re.sub(r"ImGui::\w+\s*\([^;]*;", ";", code)
    found = []
    for what, rule in RULES.items():
        for match in re.finditer(rule, code, re.S):
            found.append((code.count("\n", 0, match.start()) + 1, what, " ".join(match[0].split())[:80]))
    return found


class NumberRules(unittest.TestCase):
    def test_sources_keep_them(self):
        checked = 0
        for folder in SOURCES:
            for path in sorted((ROOT / folder).rglob("*")):
                if path.suffix not in (".cpp", ".h") or path.stem.endswith("_test") or path.stem.startswith("test_"):
                    continue
                checked += 1
                for line, what, where in faults(path.read_text()):
                    self.fail(f"{path.relative_to(ROOT)}:{line}: {what}: {where}")
        self.assertGreater(checked, 300)

    def test_faults_are_found(self):
        for fault in ("x = std::strtod(text, &end);", "x = atof(text);", 'std::snprintf(text, 9, "%.2f", x);',
                      'std::printf("%d of %5.1f s\\n",\n  n, x);', "std::ostringstream out;", "words >> number;",
                      "std::to_string(seconds)", "std::stod(text)", 'sscanf(text, "%f", &x)'):
            self.assertTrue(faults(fault), fault)
        for right in ('std::printf("%d of %s\\n", n, name);', "std::getline(words, word, ',');", "std::to_string(count)",
                      '// never strtod(\nfmt::format("{:.2f}", x);', 'ImGui::SliderFloat("x", &x, 0, 1, "%.2f");',
                      "numbers >> 3", "std::strtoul(text)", 'sscanf(text, "%u x %u", &w, &h)'):
            self.assertEqual(faults(right), [], right)


if __name__ == "__main__":
    ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
