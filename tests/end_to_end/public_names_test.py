"""Every command, flag and RPC function that users can name stands in public_names.txt: none comes, goes or changes its kind of
value by accident. After a change that is meant: public_names_test.py --write."""
import json
import pathlib
import re
import subprocess
import sys
import unittest

from command_line_test import commands
from program import PROGRAM, run

LIST = pathlib.Path(__file__).with_name("public_names.txt")


def flags_of(command):
    """'--name KIND' of every flag of a command, as its help shows them."""
    for line in run(*command, "--help").stdout.splitlines():
        match = re.match(r"  (?:-\w,\s*)?(--[\w-]+)(?:,--[\w-]+)*((?: [A-Z]\S*| in \[[^\]]*\]| \.\.\.)*)(?:  |$)", line)
        if match:
            yield f"{match[1]}{match[2]}"


def functions():
    """Names of the RPC functions, as the server tells them."""
    server = subprocess.Popen([PROGRAM, "serve", "--world", "box_room", "--port", "0", "--json"], stdout=subprocess.PIPE, text=True)
    try:
        text = ""
        for line in server.stdout:
            text += line
            if line.startswith("}"):
                break
        return sorted(json.loads(text)["functions"])
    finally:
        server.terminate()
        server.wait(10)
        server.stdout.close()


def public_names():
    lines = []
    for command in sorted(commands()):
        lines += [" ".join(["command", *command, flag]) for flag in sorted(flags_of(command))] or [" ".join(["command", *command])]
    return lines + [f"function {name}" for name in functions()]


class PublicNamesTest(unittest.TestCase):
    def test_nothing_changed_that_is_not_listed(self):
        listed, now = LIST.read_text().splitlines(), public_names()
        gone, new = sorted(set(listed) - set(now)), sorted(set(now) - set(listed))
        self.assertEqual((gone, new), ([], []), "if that is meant: tests/end_to_end/public_names_test.py --write, and CHANGELOG.md")
        self.assertEqual(listed, now)

    def test_the_list_is_not_empty_anywhere(self):
        listed = LIST.read_text()
        for name in ["command collect --out", "command world import --out", "function simGetImages", "function reset"]:
            self.assertIn(name, listed)


if __name__ == "__main__":
    if "--write" in sys.argv:
        LIST.write_text("\n".join(public_names()) + "\n")
    else:
        unittest.main()
