#!/usr/bin/env python3
"""Checks that the compiler takes every source of a folder whose programs the ordinary build leaves out; writes no code.

Usage: check_compiles.py BUILD_FOLDER FOLDER. Prints what the compiler says and exits 1 if there is an error or a warning.
"""
import json
import pathlib
import shlex
import subprocess
import sys


def without_code(command):
    """The words of a compile command that lead to no object."""
    words = shlex.split(command)
    at = words.index("-o")
    return [*words[:at], "-fsyntax-only", *words[at + 2:]]


def main():
    build, folder = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
    entries = [e for e in json.loads((build / "compile_commands.json").read_text()) if pathlib.Path(e["file"]).parent == folder]
    if not entries:
        sys.exit(f"{build}/compile_commands.json has no source of {folder}")
    failed = 0
    for entry in entries:
        done = subprocess.run(without_code(entry["command"]), cwd=entry["directory"], stderr=subprocess.PIPE, text=True)
        if done.returncode or done.stderr:
            failed += 1
            print(f"{entry['file']}\n{done.stderr}")
    print(f"{len(entries) - failed} of {len(entries)} sources compile")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
