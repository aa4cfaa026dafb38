#!/usr/bin/env python3
"""Checks that the shaders and the CPU's renderer do not write the same numbers twice.

Usage: check_shading_literals.py [ROOT] [--list]. Counts the distinct floating-point literals that stand both in
src/airsim360/render/vulkan/shaders and in C++ of src/airsim360/render that no shader includes. What both need belongs in a
function of render/shared/shading_*.h or a constant of shading_constants.h. A few meet by chance (sRGB, guards against zero),
hence a limit and no ban. Exits 1 above it. Tries itself on four small files first.
"""
import argparse
import collections
import pathlib
import re
import sys
import tempfile

LIMIT = 20
TRIVIAL = {0.0, 0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 16.0, 100.0}
LITERAL = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+|\.\d+)f?(?![\w.])")
INCLUDE = re.compile(r'#include "(airsim360/render/[^"]+)"')


def without_comments(text):
    blank = lambda found: "\n" * found.group(0).count("\n")
    return re.sub(r"//[^\n]*", "", re.sub(r"/\*.*?\*/", blank, text, flags=re.S))


def literals(files):
    """Value -> places, as FILE:LINE."""
    places = collections.defaultdict(list)
    for path in files:
        for number, line in enumerate(without_comments(path.read_text()).splitlines(), 1):
            if line.lstrip().startswith(("#include", "#version", "#extension")):
                continue
            for found in LITERAL.finditer(line):
                if float(found.group(1)) not in TRIVIAL:
                    places[float(found.group(1))].append(f"{path.name}:{number}")
    return places


def in_both(root):
    render = root / "src/airsim360/render"
    shaders = sorted(path for path in (render / "vulkan/shaders").iterdir() if path.is_file())
    if not shaders:
        raise SystemExit(f"{render}/vulkan/shaders: no shaders there")
    shared = {root / "src" / name for path in shaders for name in INCLUDE.findall(path.read_text())}
    cpu = [
        path
        for path in sorted([*render.rglob("*.cc"), *render.rglob("*.h")])
        if path not in shared and "vulkan" not in path.parts and not re.search(r"_test\.cc$|^test_", path.name)
    ]
    glsl, cpp = literals(shaders), literals(cpu)
    return [(value, glsl[value], cpp[value]) for value in sorted(glsl.keys() & cpp.keys())]


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {
            "vulkan/shaders/a.glsl": '#include "airsim360/render/shared/s.h"\nfloat x = 0.37 * 0.5 + 1e-3; // 0.91\n',
            "shared/s.h": "float y = 0.77f;\n",
            "cpu/b.cc": "float z = 0.370f + .001f + 0.91f + 0.77f;  /* 0.61 */\n",
            "cpu/b_test.cc": "float t = 0.37f;\n",
        }.items():
            path = root / "src/airsim360/render" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        assert [value for value, *_ in in_both(root)] == [0.001, 0.37], in_both(root)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--list", action="store_true", help="every literal in both, with its places")
    arguments = parser.parse_args()
    self_test()
    both = in_both(arguments.root)
    if len(both) > LIMIT or arguments.list:
        for value, shaders, cpu in both:
            print(f"{value:g}: {', '.join(shaders[:3])} and {', '.join(cpu[:3])}")
    if len(both) > LIMIT:
        print(f"{len(both)} literals stand in shaders and in the CPU's renderer, at most {LIMIT} may")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
