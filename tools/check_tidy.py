#!/usr/bin/env python3
"""clang-tidy over what the build compiles of src/airsim360 but its tests, with the short list of checks of .clang-tidy, all of them errors.

usage: check_tidy.py BUILD [-j JOBS] [PATTERN ...]

BUILD is a configured build folder. With patterns only units whose sources have one of them in their path. Sources that are compiled
together are read together, so that a header is parsed once for all of them.
"""
import argparse, concurrent.futures, json, os, re, shlex, subprocess, sys, tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def arguments(entry):
    """What clang understands of a command of GCC: without its precompiled headers, parameters and names of warnings."""
    words, kept = shlex.split(entry["command"]), []
    while words:
        word = words.pop(0)
        if word in ("-include", "-o", "-MT", "-MF"):
            words.pop(0)
        elif not re.match(r"-W|--param|-MD|-f(?!fp-contract|PIC)", word):
            kept.append(word)
    return kept


def sources(unit):
    if "/Unity/" not in unit:
        return [unit]
    with open(unit) as file:
        return re.findall(r'#include "([^"]+)"', file.read())


def check(folder, unit):
    done = subprocess.run(["clang-tidy-16", "--quiet", "--warnings-as-errors=*", "-p", folder, unit], capture_output=True, text=True, cwd=ROOT)
    return done.returncode, done.stdout.strip()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("patterns", nargs="*")
    asked = parser.parse_args()
    with open(os.path.join(asked.build, "compile_commands.json")) as file:
        commands = json.load(file)
    here = os.path.join(ROOT, "src", "airsim360") + os.sep
    entries, seen = [], set()
    for entry in commands:
        files = [f for f in sources(entry["file"]) if f.startswith(here) and not f.endswith("_test.cc")]
        if entry["file"] in seen:
            continue  # kernels are compiled for several processors
        seen.add(entry["file"])
        if files and (not asked.patterns or any(p in f for p in asked.patterns for f in files)):
            entries.append({"directory": entry["directory"], "file": entry["file"], "arguments": arguments(entry)})
    if not entries:
        sys.exit("check_tidy.py: no source has " + " or ".join(asked.patterns or ["a command in " + asked.build]))
    bad = 0
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        with open(os.path.join(folder, "compile_commands.json"), "w") as file:
            json.dump(entries, file)
        for status, text in pool.map(lambda e: check(folder, e["file"]), entries):
            bad += status != 0
            if status != 0:
                print(text, flush=True)
    print(f"clang-tidy: {len(entries)} units, {bad} with findings")
    return bad != 0


if __name__ == "__main__":
    sys.exit(main())
