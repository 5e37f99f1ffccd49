#!/usr/bin/env python3
"""A constant that a source file keeps to itself has a name of its own, and a function its own name or parameters.
Namespaces of which a file names both without their prefix, by `using namespace`, have no type in common.

./check compiles a dozen sources together (CMake's unity build). There a constant of one file's unnamed namespace is
seen by the files after it: where a header has the same name, it silently takes its place, and where a later file of the
same namespace has it, that file does not compile, in some builds and not in others.

    unity_names_test.py [ROOT]
"""
import collections
import pathlib
import re
import sys

DECLARATION = re.compile(
    r"^\s*(?:template <[^>]*>\s*)?(?:inline |static |\[\[\w+\]\] )*"
    r"(?:(?:constexpr |const |using |class |struct |enum class |enum )+[\w:<>,\s*&]*?\b(?P<named>\w+)\s*(?:=|\{|\[|;|:(?!:))"
    r"|(?!return|using|TEST|INSTANTIATE|namespace|else|case|public|private|friend|if|for|while|switch)"
    r"[\w:<>,*&\s]+?[\s*&](?P<function>\w+)\()")


def stripped(text):
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', text, flags=re.S)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"'(?:\\.|[^'\\\n])'", "' '", text)
    return re.sub(r"//[^\n]*", "", text)


def signature(statement, name):
    """A function's name with the types of its parameters."""
    depth, parameters = 0, [""]
    for letter in statement[statement.index(name + "(") + len(name) + 1:]:
        depth += {"(": 1, "<": 1, ")": -1, ">": -1}.get(letter, 0)
        if depth < 0:
            break
        if letter == "," and depth == 0:
            parameters.append("")
        else:
            parameters[-1] += letter
    types = [re.sub(r"\s*=.*", "", " ".join(parameter.split())) for parameter in parameters]
    types = [re.sub(r"(?<=[\w>*&])\s+\w+(\[\w*\])?$|(?<=[*&])\w+$", "", one) for one in types]
    return f"{name}({', '.join(types)})"


def names(text, aliases=False):
    """Triples of a name (of a function with the types of its parameters), whether it stands in an unnamed namespace, and
    the named namespaces around it; of namespaces' own declarations only."""
    levels = []  # of open braces: "named", "unnamed" (namespaces), "enum" or "other"
    spaces = []  # of each level: the named namespace that it opens, or nothing
    statement = ""
    found = []

    def around():
        return "::".join(space for space in spaces if space)

    def take():
        inside = set(levels)
        if inside <= {"named", "unnamed"}:
            if re.match(r"\s*using\s[^=]*;", statement):
                return  # another's name
            for extra in re.split(r",\s*(?=k[A-Z]\w*\s*=)", statement):
                if match := DECLARATION.match(extra) or re.match(r"\s*(?P<named>k[A-Z]\w*)\s*(?:=|\{)", extra):
                    function = match.groupdict().get("function")
                    name = match.groupdict().get("named") or function and signature(extra, function)
                    # Aliases of one type are no two types.
                    if name and (aliases or not statement.lstrip().startswith("using")):
                        found.append((name, "unnamed" in inside, around()))
        elif levels[-1] == "enum" and inside <= {"named", "unnamed", "enum"}:
            for name in re.findall(r"(?:^|,)\s*(\w+)", statement):
                found.append((name, "unnamed" in inside, around()))

    for token in re.split(r"([{};])", re.sub(r"^\s*#[^\n]*(?:\\\n[^\n]*)*", "", stripped(text), flags=re.M)):
        if token == "{":
            head = statement.strip()
            named = re.search(r"\bnamespace\s+([\w:]+)\s*$", head)
            spaces.append(named and named.group(1))
            if re.search(r"\bnamespace\s*$", head):
                levels.append("unnamed")
            elif named:
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
                spaces.pop()
            statement = ""
        elif token == ";":
            statement += ";"
            take()
            statement = ""
        else:
            statement += token
    return found


def drawn(text):
    """Pairs of a namespace and another, all of whose names a `using namespace` brings into it."""
    spaces, statement, found = [], "", set()
    for token in re.split(r"([{};])", stripped(text)):
        if token == "{":
            named = re.search(r"\bnamespace\s+([\w:]+)\s*$", statement.strip())
            spaces.append(named and named.group(1))
        elif token == "}":
            spaces = spaces[:-1]
        elif match := re.match(r"\s*using\s+namespace\s+([\w:]+)\s*$", statement + " " if token == ";" else ""):
            found.add(("::".join(space for space in spaces if space), match.group(1)))
        statement = "" if token in ("{", "}", ";") else token
    return found


def ambiguous(declared, pairs, own=None, aliases=None):
    """Types of two namespaces whose names one namespace has, as names with their places. `declared` has, of a namespace
    and a name, the files; `own` the same of what source files keep to themselves, `aliases` of other
    types' names, which may be there several times."""
    own, aliases = own or {}, aliases or {}
    sees = collections.defaultdict(set)
    for space, other in pairs:
        # Relative to the namespaces around, from the inside out.
        around = space.split("::") if space else []
        for depth in range(len(around), -1, -1):
            whole = "::".join([*around[:depth], other])
            if any(key[0] == whole for key in (*declared, *aliases)):
                sees[space].add(whole)
                break
    for space, others in sorted(sees.items()):
        places = collections.defaultdict(list)
        for one in sorted({space} | others):
            for key, files in declared.items():
                if key[0] == one and re.match(r"[A-Z]\w*$", key[1]):
                    places[key[1]].append(f"{one}:: ({', '.join(sorted(files))})")
        for name, of in sorted(places.items()):
            of += [f"{space}:: ({file})" for file in sorted(own.get((space, name), ()))]
            if len(of) > 1:
                yield name, of
        for other in sorted(others):
            for name in sorted(key[1] for key in aliases if key[0] == other and (space, key[1]) in own):
                yield name, [f"{other}:: ({', '.join(sorted(aliases[other, name]))})",
                             *(f"{space}:: ({file})" for file in sorted(own[space, name]))]


def selfTest():
    text = """
      namespace a {
      enum Kind { kFirst, kSecond = 3 };
      class Thing { int member(); };
      namespace {
      constexpr float kTrim = 1, kOther = 2;
      int helper(int x) { return x; }
      Own both(const glm::vec2& at, std::pair<int, int> of = {1, 2}) { return {}; }
      struct Own { int inner = 0; };
      using b::kBorrowed;
      using Also = Thing;
      const std::vector<std::string> kList{"a"};
      const glm::dvec3 kPlaces[] = {{1, 2, 3}};
      }  // namespace
      void open(int);
      }
    """
    got = {name: isOwn for name, isOwn, space in names(text) if space == "a"}
    want = {"Kind": False, "kFirst": False, "kSecond": False, "Thing": False, "kTrim": True, "kOther": True, "helper(int)": True, "both(const glm::vec2&, std::pair<int, int>)": True,
            "Own": True, "kList": True, "kPlaces": True, "open(int)": False}
    assert got == want, got
    pairs = drawn("namespace a { namespace { using namespace b; } } namespace c { using namespace a::b; }")
    assert pairs == {("a", "b"), ("c", "a::b")}, pairs
    declared = {("a", "T"): {"1"}, ("a::b", "T"): {"2"}, ("c", "U"): {"3"}, ("c", "f()"): {"4"}, ("a::b", "f()"): {"5"}}
    assert list(ambiguous(declared, pairs)) == [("T", ["a:: (1)", "a::b:: (2)"])]
    assert list(ambiguous({("a::b", "T"): {"2"}}, pairs, {("a", "T"): {"3"}})) == [("T", ["a::b:: (2)", "a:: (3)"])]


def main():
    selfTest()
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    failures = 0

    def report(name, files):
        nonlocal failures
        failures += 1
        print(f"{name}: {', '.join(sorted(files))}")

    # What is compiled into one target, and which headers it sees. The unit tests are one, wherever they lie.
    for sources, headers, isTests in ((["src"], ["src", "include"], False), (["src", "tests"], [], True),
                                      (["apps"], ["apps", "include"], False), (["python"], ["python", "include"], False),
                                      (["examples/demo_scene"], ["examples/demo_scene", "examples/mesh_kit"], False),
                                      (["examples/still_life"], ["examples/still_life", "examples/mesh_kit"], False),
                                      (["examples/henry_room"], ["examples/henry_room", "examples/mesh_kit"], False),
                                      (["examples/mesh_kit"], ["examples/mesh_kit"], False)):
        # Types and functions that are mistaken for others do not compile, or are ambiguous; constants do.
        own, others, inSpace, shared = (collections.defaultdict(set) for _ in range(4))
        for folder in sources:
            for file in (root / folder).rglob("*.cpp"):
                if file.name.endswith("_test.cpp") == isTests:
                    for name, isOwn, space in names(file.read_text()):
                        if re.match(r"k[A-Z]", name):
                            (own if isOwn else others)[name].add(str(file.relative_to(root)))
                        if isOwn and re.match(r"k[A-Z]|(?!TEST|INSTANTIATE)\w+\(|[A-Z]\w*$", name):
                            inSpace[space, name].add(str(file.relative_to(root)))
        # A type of a namespace that a header declares is ambiguous where a file before it has its own.
        for folder in ("src", "include", "tests") if sources[0] == "src" else headers:
            for file in (root / folder).rglob("*.h"):
                for name, isOwn, space in names(file.read_text()):
                    if not isOwn and space:
                        shared[space, name].add(str(file.relative_to(root)))
        for folder in headers:
            for file in (root / folder).rglob("*.h"):
                for name, _, _ in names(file.read_text()):
                    others[name].add(str(file.relative_to(root)))
        for name in own.keys() & others.keys():
            if len(own[name] | others[name]) > 1:
                report(name, own[name] | others[name])
        for key, files in inSpace.items():
            if len(files | shared[key]) > 1:
                report("::".join(key), files | shared[key])
    # What headers declare meets wherever they are compiled together.
    declared, own, aliases, pairs = *(collections.defaultdict(set) for _ in range(3)), set()
    for folder in ("src", "include", "apps", "tests", "python"):
        for file in (root / folder).rglob("*.[hc]*"):
            if file.suffix not in (".h", ".cpp"):
                continue
            text = file.read_text()
            pairs |= drawn(text)
            types = set(names(text))
            for found in names(text, aliases=True):
                name, isOwn, space = found
                kind = own if isOwn else declared if found in types else aliases
                if space and (kind is own and found in types or kind is not own and file.suffix == ".h"):
                    kind[space, name].add(str(file.relative_to(root)))
    for name, of in ambiguous(declared, pairs, own, aliases):
        report(name, of)
    print(f"{failures} names of unnamed namespaces that others have too")
    return failures > 0


sys.exit(main())
