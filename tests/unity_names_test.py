#!/usr/bin/env python3
"""A constant that a source file keeps to itself has a name of its own.

./check compiles a dozen sources together (CMake's unity build). There a constant of one file's unnamed namespace is
seen by the files after it, and where a header has the same name, it silently takes its place.

    unity_names_test.py [ROOT]
"""
import collections
import pathlib
import re
import sys

DECLARATION = re.compile(
    r"^\s*(?:template <[^>]*>\s*)?(?:inline |static |\[\[\w+\]\] )*"
    r"(?:(?:constexpr |const |using |class |struct |enum class |enum )+[\w:<>,\s*&]*?\b(?P<named>\w+)\s*(?:=|\{|\[|;|:)"
    r"|(?!return|using|TEST|INSTANTIATE|namespace|else|case|public|private|friend|if|for|while|switch)"
    r"[\w:<>,*&\s]+?[\s*&](?P<function>\w+)\()")


def stripped(text):
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', text, flags=re.S)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"'(?:\\.|[^'\\\n])'", "' '", text)
    return re.sub(r"//[^\n]*", "", text)


def names(text):
    """Pairs of a name and whether it stands in an unnamed namespace; of namespaces' own declarations only."""
    levels = []  # of open braces: "named", "unnamed" (namespaces), "enum" or "other"
    statement = ""
    found = []

    def take():
        inside = set(levels)
        if inside <= {"named", "unnamed"}:
            for extra in re.split(r",\s*(?=k[A-Z]\w*\s*=)", statement):
                if match := DECLARATION.match(extra) or re.match(r"\s*(?P<named>k[A-Z]\w*)\s*(?:=|\{)", extra):
                    name = match.groupdict().get("named") or match.groupdict().get("function")
                    if name:
                        found.append((name, "unnamed" in inside))
        elif levels[-1] == "enum" and inside <= {"named", "unnamed", "enum"}:
            for name in re.findall(r"(?:^|,)\s*(\w+)", statement):
                found.append((name, "unnamed" in inside))

    for token in re.split(r"([{};])", re.sub(r"^\s*#[^\n]*(?:\\\n[^\n]*)*", "", stripped(text), flags=re.M)):
        if token == "{":
            head = statement.strip()
            if re.search(r"\bnamespace\s*$", head):
                levels.append("unnamed")
            elif re.search(r"\bnamespace\s+[\w:]+\s*$", head):
                levels.append("named")
            else:
                statement += "{"
                take()
                levels.append("enum" if re.search(r"\benum\s+(?!class)", " " + head) and "enum class" not in head
                              else "other")
            statement = ""
        elif token == "}":
            if levels and levels[-1] == "enum":
                take()
            if levels:
                levels.pop()
            statement = ""
        elif token == ";":
            statement += ";"
            take()
            statement = ""
        else:
            statement += token
    return found


def selfTest():
    text = """
      namespace a {
      enum Kind { kFirst, kSecond = 3 };
      class Thing { int member(); };
      namespace {
      constexpr float kTrim = 1, kOther = 2;
      int helper(int x) { return x; }
      struct Own { int inner = 0; };
      }  // namespace
      void open(int);
      }
    """
    got = dict(names(text))
    want = {"Kind": False, "kFirst": False, "kSecond": False, "Thing": False, "kTrim": True, "kOther": True, "helper": True,
            "Own": True, "open": False}
    assert got == want, got


def main():
    selfTest()
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    failures = 0
    # What is compiled into one target, and which headers it sees.
    for sources, headers in ((["src"], ["src", "include"]), (["apps"], ["apps", "include"]), (["python"], ["python", "include"]),
                             (["examples/demo_scene"], ["examples/demo_scene", "examples/mesh_kit"]),
                             (["examples/still_life"], ["examples/still_life", "examples/mesh_kit"]),
                             (["examples/henry_room"], ["examples/henry_room", "examples/mesh_kit"]),
                             (["examples/mesh_kit"], ["examples/mesh_kit"])):
        own, others = collections.defaultdict(set), collections.defaultdict(set)
        for folder in sources:
            for file in (root / folder).rglob("*.cpp"):
                if not file.name.endswith("_test.cpp"):
                    for name, isOwn in names(file.read_text()):
                        (own if isOwn else others)[name].add(str(file.relative_to(root)))
        for folder in headers:
            for file in (root / folder).rglob("*.h"):
                for name, _ in names(file.read_text()):
                    others[name].add(str(file.relative_to(root)))
        for name in sorted(own):
            same = own[name] | {file for file in others.get(name, ()) if file not in own[name]}
            # Types and functions that are mistaken for others do not compile, or are ambiguous; constants do.
            if len(same) > 1 and name in others and re.match(r"k[A-Z]", name):
                failures += 1
                print(f"{name}: {', '.join(sorted(same))}")
    print(f"{failures} names of unnamed namespaces that others have too")
    return failures > 0


sys.exit(main())
