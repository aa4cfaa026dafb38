#!/usr/bin/env python3
"""Checks that the compiler takes every source of a folder whose programs the ordinary build leaves out; writes no code.

Usage: check_compiles.py BUILD_FOLDER FOLDER [--alone]. Prints what is wrong and exits 1 if anything is.

Most of such a compilation are templates of headers: programs of one source are compiled as one, each in a namespace of its own after
the headers of all. What its own includes must bring to each is asked as of headers (check_headers.py): names of the standard library
and types of this project. --alone compiles each by itself, as a build does.
"""
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import check_headers


def without_code(command):
    """The words of a compile command that lead to no object."""
    words = shlex.split(command)
    at = words.index("-o")
    return [*words[:at], "-fsyntax-only", *words[at + 2:]]


def said(words, folder):
    """What a compiler says; nothing where it takes the source."""
    done = subprocess.run(words, cwd=folder, stderr=subprocess.PIPE, text=True)
    return done.stderr or ("" if done.returncode == 0 else f"exit status {done.returncode}\n")


def is_program(source):
    """Whether a source can stand in a namespace: it has a main, and says nothing in a namespace of the project."""
    text = source.read_text()
    return bool(re.search(r"^int main\(", text, re.M)) and not re.search(r'^namespace \w|^#define|^extern "C"', text, re.M)


def together(sources):
    """The text of one source that is all of them."""
    includes = {}
    for source in sources:
        for mark, name in check_headers.INCLUDE.findall(source.read_text()):
            beside = source.parent / name
            includes[f"#include <{name}>" if mark == "<" else f'#include "{beside if beside.exists() else name}"'] = None
    return "\n".join([*includes, *(f'namespace source_{i} {{\n#include "{source}"\n}}' for i, source in enumerate(sources))]) + "\n"


def needs(sources):
    """What sources use of the standard library and of the project's types and their includes do not bring."""
    home = check_headers.types(check_headers.headers())
    for source in sources:
        path = source.relative_to(check_headers.ROOT).as_posix()
        yield from (*check_headers.missing(path), *check_headers.missing_types(path, home))


def check_together(commands):
    """Of sources with their compile commands: which cannot stand with the others, and what is wrong with those that can."""
    joint = [source for source in commands if is_program(source)]
    if len(joint) < 2:
        return list(commands), []
    words, folder = commands[joint[0]]
    flags = dict.fromkeys(word for source in joint for word in commands[source][0] if word.startswith("-I"))
    with tempfile.NamedTemporaryFile("w", suffix=".cc") as file:
        file.write(together(joint))
        file.flush()
        if said([*words[:words.index("-c")], *flags, file.name], folder):
            return list(commands), []  # each alone says what it is
    return [source for source in commands if source not in joint], list(needs(joint))


def main():
    build, folder = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
    entries = json.loads((build / "compile_commands.json").read_text())
    commands = {file: (without_code(e["command"]), e["directory"]) for e in entries if (file := pathlib.Path(e["file"])).parent == folder}
    if not commands:
        sys.exit(f"{build}/compile_commands.json has no source of {folder}")
    alone, wrong = (list(commands), []) if "--alone" in sys.argv[3:] else check_together(commands)
    wrong += [f"{source}\n{text}" for source in alone if (text := said(*commands[source]))]
    print("\n".join([*wrong, f"{len(commands)} sources, {len(alone)} of them compiled alone, {len(wrong)} complaints"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
