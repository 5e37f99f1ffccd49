#!/usr/bin/env python3
"""Manual pages and completions, from what the program says of itself.

    packaging/describe.py SCUMBLE FOLDER     SCUMBLE: the built program

writes FOLDER/man1/*.1.gz and FOLDER/scumble, for bash.
"""
import gzip
import re
import subprocess
import sys
from pathlib import Path

EXIT_CODES = (("0", "Done."), ("1", "Our own fault."), ("2", "Wrong usage."), ("3", "A file that was given cannot be used."),
              ("4", "No usable GPU, or it was lost."), ("5", "The output cannot be written."))
FILES = (("SCENE.look.json", "The look of the scene beside it, where none is named."),
         ("$XDG_CACHE_HOME/scumble, ~/.cache/scumble", "Compiled pipelines and what is known of drivers; may be deleted at any time."))
# What an option's value is completed by, beside those whose help lists it (auto|yes|no); all others by files.
WORDS = {"--stereo": "side-by-side over-under crossed anaglyph wiggle separate", "--panorama": "vr180 ods mono360", "--samples": "1 4",
         "--synthesis": "off on auto"}


class Help:
    """A command's help, taken apart."""

    def __init__(self, program, words):
        self.name = " ".join(["scumble", *words])
        text = subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout
        lines = text.splitlines()
        self.summary, self.usage = lines[0], lines[1].removeprefix("Usage: ")
        self.sections, self.footer = [], []  # sections: (title, [(name, text)])
        for line in lines[2:]:
            entry = re.match(r"  (\S.*?)(?:  +(\S.*))?$", line)
            if re.match(r"\S.*:$", line):
                self.sections.append((line[:-1], []))
            elif line.startswith(" " * 20) and self.sections and self.sections[-1][1]:
                name, said = self.sections[-1][1][-1]
                self.sections[-1][1][-1] = (name, (said + " " + line.strip()).strip())
            elif entry and self.sections:
                self.sections[-1][1].append((entry[1], entry[2] or ""))
            elif line.strip():
                self.footer.append(line.strip())
        self.commands = [name for title, entries in self.sections if title == "Subcommands" for name, _ in entries]
        self.options = [(name.split()[0].split("=")[0].split(","), name) for title, entries in self.sections
                        if title not in ("Subcommands", "Positionals") for name, _ in entries]


def pages_of(program, words=()):
    page = Help(program, list(words))
    return [page, *(below for command in page.commands for below in pages_of(program, [*words, command]))]


def roff(text):
    """As troff takes it: no line may begin as a request, and hyphens are minus signs."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line[:1] in ".'" else line for line in text.split("\n"))


def manual(page, pages, version):
    title = page.name.replace(" ", "-")
    out = [f'.TH {roff(title.upper())} 1 "" "scumble {version}" "User Commands"', ".SH NAME",
           f"{roff(title)} \\- {roff(page.summary.removeprefix('scumble: '))}", ".SH SYNOPSIS", f".B {roff(page.usage)}"]
    for heading, entries in page.sections:
        out.append(f'.SH "{roff(heading.upper())}"')
        for name, said in entries:
            out += [".TP", f".B {roff(name)}", roff(said) or "\\&"]
    examples = [line.removeprefix("Example: ") for line in page.footer if line.startswith("Example: ")]
    if examples:
        out.append(".SH EXAMPLES")
        for line in examples:
            out += [".nf", roff(line), ".fi"]
    notes = [line for line in page.footer if not line.startswith("Example: ")]
    if notes:
        out += [".SH NOTES", *map(roff, notes)]
    out.append('.SH "EXIT STATUS"')
    for code, said in EXIT_CODES:
        out += [".TP", f".B {code}", roff(said)]
    if page is pages[0]:
        out.append(".SH FILES")
        for name, said in FILES:
            out += [".TP", f".I {roff(name)}", roff(said)]
    others = [other.name.replace(" ", "-") for other in pages if other is not page]
    out += ['.SH "SEE ALSO"', ", ".join(f"\\fB{roff(other)}\\fR(1)" for other in others)]
    return "\n".join(out) + "\n"


def bash(program, pages):
    def printed(command):
        return subprocess.run([program, command], capture_output=True, text=True, check=True).stdout.splitlines()

    looks = [line.split()[0] for line in printed("looks") if line.strip()]
    knobs, block = [], ""
    for line in printed("params"):
        if re.match(r"\S+$", line):
            block = line
        elif found := re.match(r"  (\S+)  ", line):
            knobs.append(f"{block}.{found[1]}=")
    knobs = sorted(set(knobs))
    aovs = re.search(r"some of (.*)$", dict(entry for _, entries in pages[1].sections for entry in entries if entry[0].startswith("--aov"))["--aov TEXT ..."])[1]
    choices = (re.match(r"(--[a-z-]+) ([a-z]+(?:\|[a-z]+)+)(?:=|$)", name) for page in pages for _, name in page.options)
    listed = {found[1]: found[2].replace("|", " ") for found in choices if found}
    cases = [f'    {option}) COMPREPLY=($(compgen -W "{words}" -- "$word")); return ;;' for option, words in sorted({**listed, **WORDS}.items())]
    commands = [f'    "{page.name}") words="{" ".join([*page.commands, *(name for names, _ in page.options for name in names)])}" ;;' for page in pages]
    return f"""# bash completion for scumble; made by packaging/describe.py from what the program says of itself.

_scumble() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command=scumble words i
  # Bash takes = for a word of its own.
  [ "$word" = "=" ] && word=
  [ "$before" = "=" ] && before=${{COMP_WORDS[COMP_CWORD - 2]}}
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$command ${{COMP_WORDS[i]}}" in
      {" | ".join('"' + page.name + '"' for page in pages[1:])}) command="$command ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case $before in
{chr(10).join(cases)}
    --look) COMPREPLY=($(compgen -W "{" ".join(looks)}" -- "$word") $(compgen -f -X '!*.json' -- "$word") $(compgen -d -- "$word")); return ;;
    --aov) COMPREPLY=($(compgen -W "all {aovs.replace(",", "")}" -- "$word")); return ;;
    --set) compopt -o nospace; COMPREPLY=($(compgen -W "{" ".join(knobs)}" -- "$word")); return ;;
  esac
  case $command in
{chr(10).join(commands)}
  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
    *)
      compopt -o filenames
      [ "$command" != scumble ] && [ "$command" != "scumble farm" ] && words=
      COMPREPLY=($(compgen -W "$words" -- "$word") $(compgen -f -- "$word"))
      ;;
  esac
}}
complete -F _scumble scumble
"""


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, folder = sys.argv[1], Path(sys.argv[2])
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    pages = pages_of(program)
    (folder / "man1").mkdir(parents=True, exist_ok=True)
    for page in pages:
        path = folder / "man1" / (page.name.replace(" ", "-") + ".1.gz")
        # Without a name and a time in it, the same page has the same bytes.
        path.write_bytes(gzip.compress(manual(page, pages, version).encode(), 9, mtime=0))
    (folder / "scumble").write_text(bash(program, pages))


if __name__ == "__main__":
    main()
