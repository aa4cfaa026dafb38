"""Help, completion, manual pages, and what is told of flags that there are not."""
import functools
import re
import shutil
import subprocess
import unittest

from program import ProgramTest, run


@functools.cache
def said(*arguments):
    """What the program prints, which is the same each time; it must not fail."""
    result = run(*arguments)
    assert result.returncode == 0, result.stderr
    return result.stdout


def commands():
    """Paths of all commands, as completion knows them."""
    return [line.split("command='")[1].split("'")[0].split() for line in said("completion", "bash").splitlines() if ") command='" in line]


class HelpTest(ProgramTest):
    def test_help_in_all_its_forms(self):
        top = self.run_ok("--help").stdout
        self.assertEqual(self.run_ok("help").stdout, top)
        self.assertEqual(self.run_ok("-h").stdout, top)
        for command in commands():
            text = said(*command, "--help")
            self.assertEqual(self.run_ok("help", *command).stdout, text, command)
            self.assertIn("Usage: airsim360 " + " ".join(command), text)
        self.run_bad(2, "help", "colect", says=["did you mean 'collect'"])
        self.run_bad(2, "help", "world", "exprot", says=["did you mean 'export'"])

    def test_version(self):
        for flag in ["-V", "-v", "--version"]:
            self.assertRegex(self.run_ok(flag).stdout, r"^airsim360 \d+\.\d+\.\d+\n$")

    def test_an_unknown_flag_is_answered_with_one_short_line(self):
        for arguments, says in [
            (["render", "--wrold", "x"], ["render: unknown flag '--wrold'; did you mean '--world'?", "'airsim360 render --help'"]),
            (["render", "--resolution", "64x32"], ["did you mean '--size'?"]),
            (["plan", "--max-speed=3"], ["unknown flag '--max-speed'; did you mean '--vmax'?"]),
            (["world", "export", "box_room", "--output", "x.glb"], ["world export: ", "did you mean '--out'?", "'airsim360 world export --help'"]),
            (["collect", "--config", "x.yaml"], ["unknown flag '--config'; 'airsim360 collect --help'"]),
            (["world", "exprot"], ["did you mean 'export'?"]),
            (["--json", "worlds"], ["'--json' stands after the command: airsim360 worlds --json"]),
        ]:
            error = self.run_bad(2, *arguments, says=says).stderr
            self.assertLess(len(error), 200, error)

    def test_nothing_is_asked_where_nothing_is_near(self):
        error = self.run_bad(2, "frobnicate").stderr
        self.assertNotIn("did you mean", error)
        self.assertIn("choices:", error)

    def test_meaning_counts(self):
        out = self.folder / "out"
        for flag, value, meant in [("--products", "depth", "range"), ("--world", "newyork", "new_york_city"), ("--world", "nyc", "new_york_city"),
                                   ("--weather", "sunny", "clear"), ("--projection", "360", "erp"), ("--products", "segmentation", "semantic")]:
            arguments = {"--world": "box_room", "--out": out, flag: value}
            self.run_bad(2, "render", *[word for pair in arguments.items() for word in pair], says=[f"did you mean '{meant}'?"])
        self.assertFalse(out.exists())

    def test_required_flags_are_looked_for_before_a_world_is_built(self):
        # No such world: the flag is named first.
        for arguments, flag in [(["render", "--world", "no_world"], "--out"), (["fly", "--world", "no_world"], "--out"),
                                (["plan", "--world", "no_world", "--from", "0,0,2", "--to", "1,0,2", "--amax", "3", "--out", "x.csv"], "--vmax"),
                                (["plan", "--world", "no_world", "--from", "0,0,2", "--to", "1,0,2", "--vmax", "3", "--out", "x.csv"], "--amax"),
                                (["plan", "--world", "no_world", "--from", "0,0,2", "--vmax", "3", "--amax", "3", "--out", "x.csv"], "--to"),
                                (["world", "export", "no_world"], "--out"), (["agent"], "--world"), (["serve"], "--world")]:
            error = self.run_bad(2, *arguments, says=[flag]).stderr
            self.assertNotIn("unknown world", error)


class CompletionTest(ProgramTest):
    def complete(self, *words):
        """What bash offers for the last word of a line."""
        script = self.folder / "completion"
        script.write_text(said("completion", "bash"))
        # As readline splits it: = is a word of its own.
        split = [part for word in words for part in (re.split(r"(=)", word) if word.startswith("--") else [word]) if part or "=" not in word]
        quoted = " ".join("'" + word + "'" for word in split)
        line = f"source '{script}'; COMP_WORDS=({quoted}); COMP_CWORD={len(split) - 1}; _airsim360; printf '%s\\n' \"${{COMPREPLY[@]}}\""
        result = subprocess.run(["bash", "--norc", "--noprofile", "-u", "-c", line], capture_output=True, text=True, cwd=self.folder, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, ""), words)
        return [word for word in result.stdout.split("\n") if word]

    def test_bash_completes_commands_flags_and_values(self):
        self.assertIn("render", self.complete("airsim360", ""))
        self.assertEqual(self.complete("airsim360", "ren"), ["render"])
        self.assertEqual(self.complete("airsim360", "world", "ex"), ["export"])
        self.assertEqual(self.complete("airsim360", "render", "--ti"), ["--tier", "--time"])
        self.assertEqual(self.complete("airsim360", "render", "--tier", "f"), ["fast"])
        self.assertEqual(self.complete("airsim360", "render", "--tier=f"), ["fast"])
        self.assertEqual(self.complete("airsim360", "render", "--tier="), ["labels", "fast", "high", "reference"])
        self.assertEqual(self.complete("airsim360", "render", "--weather", "sun"), ["sunset"])
        self.assertIn("box_room", self.complete("airsim360", "collect", "--tier", "fast", "--world", ""))
        self.assertIn("city_park", self.complete("airsim360", "world", "export", ""))
        self.assertEqual(self.complete("airsim360", "completion", "z"), ["zsh"])
        (self.folder / "my town.glb").touch()
        self.assertEqual(self.complete("airsim360", "render", "--world", "my"), ["my town.glb"])
        # A value of which nothing is known, and one that is no flag.
        self.assertEqual(self.complete("airsim360", "render", "--pose", ""), [])
        self.assertEqual(self.complete("airsim360", "render", "--world", "--"), [])

    def test_all_flags_of_help_are_completed_and_no_other(self):
        for command in commands():
            help_flags = set(re.findall(r"^  (?:-\w,)*(--[a-z][a-z0-9-]*)", said(*command, "--help"), re.M))
            offered = {word for word in self.complete("airsim360", *command, "--")}
            self.assertEqual(offered, help_flags, command)

    def test_zsh_and_fish_take_their_scripts(self):
        for shell in ["zsh", "fish"]:
            script = self.folder / shell
            script.write_text(self.run_ok("completion", shell).stdout)
            if shutil.which(shell):
                result = subprocess.run([shell, "-n", script], capture_output=True, text=True, timeout=60)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.run_bad(2, "completion", "csh", says=["'csh'", "choices: bash, zsh, fish"])

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes(self):
        script = self.folder / "completion.fish"
        script.write_text(self.run_ok("completion", "fish").stdout)
        for line, wanted in [("airsim360 ren", "render"), ("airsim360 render --tier f", "fast"), ("airsim360 world ex", "export")]:
            result = subprocess.run(["fish", "--no-config", "-c", f"source {script}; complete -C '{line}'"], capture_output=True, text=True, timeout=60)
            self.assertEqual([row.split("\t")[0] for row in result.stdout.splitlines()], [wanted], result.stderr)


class ManTest(ProgramTest):
    def test_every_command_has_a_page_that_groff_reads_without_a_warning(self):
        pages = self.folder / "man1"
        self.run_ok("man", pages)
        wanted = {"airsim360.1"} | {"airsim360-" + "-".join(command) + ".1" for command in commands()}
        self.assertEqual({path.name for path in pages.iterdir()}, wanted)
        for page in pages.iterdir():
            text = page.read_text(encoding="ascii")
            for heading in [".TH ", ".SH NAME", ".SH SYNOPSIS", ".SH OPTIONS", ".SH EXIT STATUS"]:
                self.assertIn(heading, text, page)
            if shutil.which("groff"):
                result = subprocess.run(["groff", "-man", "-ww", "-Tutf8", page], capture_output=True, text=True, timeout=60)
                self.assertEqual((result.returncode, result.stderr), (0, ""), page)
            if shutil.which("mandoc"):
                result = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", page], capture_output=True, text=True, timeout=60)
                self.assertEqual(result.returncode, 0, (page, result.stdout))

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_a_page_says_what_help_says(self):
        pages = self.folder / "man1"
        self.run_ok("man", pages)
        for command in commands():
            page = pages / ("airsim360-" + "-".join(command) + ".1")
            shown = subprocess.run(["groff", "-man", "-Tascii", "-P-c", page], capture_output=True, text=True, timeout=60).stdout
            shown = " ".join(re.sub(".\x08", "", shown).split())
            for flag in re.findall(r"^  (?:-\w,)*(--[a-z][a-z0-9-]*)", said(*command, "--help"), re.M):
                self.assertIn(flag, shown, command)

    def test_without_a_folder_the_page_of_the_program_is_printed(self):
        self.assertTrue(self.run_ok("man").stdout.startswith(".TH AIRSIM360 1"))


if __name__ == "__main__":
    unittest.main()
