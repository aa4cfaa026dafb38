#!/usr/bin/env python3
"""Checks that clang-format leaves every C++ source as it is. With --fix it formats them. Other versions than 14 wrap a few lines
otherwise, so that one alone counts. Shaders keep their own layout.

Usage: check_format.py [--fix]. Names each file that differs and exits 1 if there is any; 77 without clang-format-14.
"""
import concurrent.futures
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
TOOL = "clang-format-14"


def sources():
    files = [p for folder in ("src", "tests", "bench", "python") for p in (ROOT / folder).rglob("*") if p.suffix in (".h", ".cc")]
    return sorted(p for p in files if "shaders" not in p.parts)


def differing(files):
    """Those of `files` that clang-format would change; one process for many files, which take it a few milliseconds each."""
    said = subprocess.run([TOOL, "--dry-run", "--Werror", *map(str, files)], stderr=subprocess.PIPE, text=True, check=False)
    found = sorted(set(re.findall(r"^(/.*?):\d+:\d+: error:", said.stderr, re.M)))
    if said.returncode != 0 and not found:
        raise SystemExit(said.stderr)
    return found


def main():
    if shutil.which(TOOL) is None:
        print(f"{TOOL} is not installed: apt-get install {TOOL}")
        return 77
    files = sources()
    if "--fix" in sys.argv:
        subprocess.run([TOOL, "-i", *map(str, files)], check=True)
        return 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        batches = [files[i:i + 100] for i in range(0, len(files), 100)]
        wrong = [str(pathlib.Path(name).relative_to(ROOT)) for found in pool.map(differing, batches) for name in found]
    print("\n".join(wrong + ["tools/check_format.py --fix formats them"]) if wrong else f"format: {len(files)} sources are as .clang-format says")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
