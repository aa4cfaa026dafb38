#!/usr/bin/env python3
"""Checks that every header of src/ can be included alone, in three cheap ways which together say so.

1. What it takes from the standard library it includes, itself or by headers of this project, and so the types of this project.
   Precompiled headers and sources that are compiled together hide where it does not; this rule needs no compiler.
2. A header that is the first of this project's which some source includes is compiled alone by a build with
   -DAIRSIM360_UNITY=OFF, and so is one before which stands nothing but what it includes itself.
3. The others are compiled here, after the standard headers.

Usage: check_headers.py BUILD_FOLDER [--all] [--jobs N]. Prints one line for each header that fails and exits 1 if there is any.
--all compiles every header without anything before it; it takes minutes.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Text for several compilers, which stands between macros of those that include it.
TEXT = ("src/airsim360/render/shared/shading_", "src/airsim360/render/vulkan/shaders/")
# Name of std -> headers that give it.
CONTAINERS = "array deque list map set span string string_view unordered_map unordered_set vector"
NAMES = {
    "array": "array", "vector": "vector", "deque": "deque queue stack", "queue": "queue", "priority_queue": "queue", "stack": "stack",
    "map": "map", "multimap": "map", "set": "set", "multiset": "set", "unordered_map": "unordered_map",
    "unordered_set": "unordered_set", "span": "span", "optional": "optional", "nullopt": "optional", "variant": "variant",
    "visit": "variant", "monostate": "variant", "holds_alternative": "variant", "string": "string",
    "to_string": "string", "string_view": "string_view string", "function": "functional", "hash": "functional string optional memory",
    "unique_ptr": "memory", "shared_ptr": "memory", "weak_ptr": "memory", "make_unique": "memory", "make_shared": "memory",
    "enable_shared_from_this": "memory", "mutex": "mutex", "lock_guard": "mutex", "unique_lock": "mutex", "scoped_lock": "mutex",
    "shared_mutex": "shared_mutex", "once_flag": "mutex", "call_once": "mutex", "condition_variable": "condition_variable",
    "thread": "thread", "jthread": "thread", "atomic": "atomic", "future": "future", "promise": "future",
    "pair": "utility map unordered_map " + CONTAINERS, "make_pair": "utility map unordered_map " + CONTAINERS,
    "move": "utility memory functional variant optional " + CONTAINERS, "forward": "utility memory functional variant optional " + CONTAINERS,
    "swap": "utility memory functional variant optional " + CONTAINERS, "exchange": "utility", "tuple": "tuple functional memory", "tie": "tuple functional memory",
    "numeric_limits": "limits", "filesystem": "filesystem", "ifstream": "fstream", "ofstream": "fstream", "ostringstream": "sstream",
    "istringstream": "sstream", "stringstream": "sstream", "ostream": "ostream iostream sstream fstream iosfwd", "chrono": "chrono thread",
    "min": "algorithm", "max": "algorithm", "clamp": "algorithm", "sort": "algorithm", "find_if": "algorithm", "copy": "algorithm",
    "sqrt": "cmath", "sin": "cmath", "cos": "cmath", "abs": "cmath cstdlib", "hypot": "cmath", "exp": "cmath", "log": "cmath",
    "pow": "cmath", "floor": "cmath", "lround": "cmath", "atan2": "cmath", "isfinite": "cmath", "exp2": "cmath", "log2": "cmath",
    "memcpy": "cstring", "memcmp": "cstring", "memset": "cstring", "numbers": "numbers", "accumulate": "numeric", "mt19937": "random",
    "mt19937_64": "random", "runtime_error": "stdexcept", "logic_error": "stdexcept", "bit_cast": "bit", "popcount": "bit", "byte": "cstddef span",
    "is_same_v": "type_traits " + CONTAINERS, "source_location": "source_location", "exception_ptr": "exception future", "exception": "exception stdexcept",
}
# Names without std::. The standard promises them of the first header alone; libstdc++ and libc++ give them with these others.
WIDE = "algorithm atomic chrono cmath filesystem fstream functional memory mutex random sstream string string_view thread"
BARE = {
    **{f"{u}int{n}_t": "cstdint stdint.h " + WIDE for u in ("", "u") for n in (8, 16, 32, 64)},
    "size_t": "cstddef cstdio cstdlib cstring optional span " + WIDE,
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]', re.M)
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)


def headers():
    return sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / "src").rglob("*.h") if not p.relative_to(ROOT).as_posix().startswith(TEXT))


def includes(path, cache={}):
    """What a header includes of the project, and of others."""
    if path not in cache:
        found = INCLUDE.findall((ROOT / path).read_text()) if (ROOT / path).exists() else []
        ours = [name for _, name in found if name.startswith("airsim360/")]
        cache[path] = ["src/" + name for name in ours], {name for _, name in found if not name.startswith("airsim360/")}
    return cache[path]


def closure(path, cache={}):
    """Headers of others that a header includes, by way of this project's too."""
    if path not in cache:
        cache[path] = set()  # ends cycles
        ours, others = includes(path)
        cache[path] = others.union(*(closure(p) for p in ours)) if ours else set(others)
    return cache[path]


def missing(path):
    """The standard headers that a header needs and does not get."""
    text = COMMENT.sub(" ", INCLUDE.sub("", (ROOT / path).read_text()))
    there = closure(path)
    for names, pattern in ((NAMES, r"\bstd::(\w+)"), (BARE, r"(?<![\w:])(\w+_t)\b")):
        for name in sorted(set(re.findall(pattern, text)) & set(names)):
            if not there & set(names[name].split()):
                yield f"{path}: {name} without <{names[name].split()[0]}>"


DECLARED = re.compile(r"^(?:template <[^\n]*>\n)?(?:class|struct|enum class|enum|union)\s+(?:alignas\(\w+\) )?(\w+)\b(?![^\n{]*;)|^using (\w+) =", re.M)
OWN = re.compile(r"\b(?:class|struct|enum|union|using|typename|concept)\s+(?:class\s+)?(?:alignas\(\w+\)\s+)?(\w+)")


def project_closure(path, cache={}):
    """Headers of the project that a header includes."""
    if path not in cache:
        cache[path] = set()  # ends cycles
        ours = includes(path)[0]
        cache[path] = set(ours).union(*(project_closure(p) for p in ours))
    return cache[path]


def forward(path, cache={}):
    """Types that a header declares without saying what they are."""
    if path not in cache:
        cache[path] = set(re.findall(r"\b(?:class|struct|enum class) (\w+);", (ROOT / path).read_text())) if (ROOT / path).exists() else set()
    return cache[path]


def types(every):
    """Name of a type -> the only header that declares it."""
    found = {}
    for path in every:
        for names in DECLARED.findall((ROOT / path).read_text()):
            found.setdefault(names[0] or names[1], set()).add(path)
    return {name: paths.pop() for name, paths in found.items() if len(paths) == 1}


def missing_types(path, home):
    """The headers of this project that a header needs and does not get."""
    text = COMMENT.sub(" ", INCLUDE.sub("", (ROOT / path).read_text()))
    there = project_closure(path) | {path}
    for name in sorted(set(re.findall(r"(?<![\w:.>~])([A-Z]\w+)\b(?!\s*[(=]|<[^<>]*>\()", text)) & set(home) - set(OWN.findall(text))):
        if home[name] not in there and not any(name in forward(p) for p in there):
            yield f"{path}: {name} without {home[name].removeprefix('src/')}"


STANDARD = {name for names in (*NAMES.values(), *BARE.values()) for name in names.split()}


def read(path, met, known):
    """Reads a file as a compiler does after `met`, which grows; adds to `known` each header that comes when nothing has been met but
    what it includes itself, and standard headers that rule 1 knows: before it stands what would stand before it alone."""
    for _, name in INCLUDE.findall((ROOT / path).read_text()) if (ROOT / path).exists() else []:
        name = "src/" + name if name.startswith("airsim360/") else name
        if name in met:
            continue
        if name.startswith("src/"):
            if met - STANDARD <= closure(name) | project_closure(name):
                known.add(name)
            read(name, met, known)
        met.add(name)


def proven():
    """Headers that a build compiles as if alone."""
    known = set()
    for folder in ("src", "tests", "bench", "python"):
        for source in (ROOT / folder).rglob("*.cc"):
            ours = [name for _, name in INCLUDE.findall(source.read_text()) if name.startswith("airsim360/")]
            known.update("src/" + name for name in ours[:1])
            read(source.relative_to(ROOT), set(), known)
    return known


def to_compile(every):
    """Headers whose compilations, with the build's, prove all: the one that includes most first."""
    known, chosen = proven(), []
    for path in sorted(every, key=lambda path: (-len(project_closure(path)), path)):
        if path not in known:
            chosen.append(path)
            read(path, set(), known)
    return chosen


def commands(build):
    """Compiler, and by module the flags that find headers."""
    flags, compiler = {}, "c++"
    for entry in json.loads((build / "compile_commands.json").read_text()):
        match = re.match(re.escape(str(ROOT)) + r"/src/airsim360/(\w+)/", entry["file"])
        if not match:
            continue
        words = shlex.split(entry["command"])
        compiler = next(w for w in words if not w.endswith("ccache"))
        found = flags.setdefault(match[1], {"-I" + str(ROOT / "src")})
        found.update(w for w in words if w.startswith("-I"))
        found.update("-isystem" + b for a, b in zip(words, words[1:]) if a == "-isystem")
    return compiler, flags


def compile_alone(compiler, flags, before, path):
    found = sorted(flags.get(path.split("/")[2], {"-I" + str(ROOT / "src")}))
    before = ["-include", before] if before else []
    done = subprocess.run([*compiler, "-fsyntax-only", "-DAIRSIM360_ISA=isa_alone", *found, *before, "-include", str(ROOT / path), "-x", "c++", os.devnull],
                          capture_output=True, text=True)
    errors = [line for line in done.stderr.splitlines() if "error" in line]
    return f"{path}: {(errors or [done.stderr.strip()])[0]}" if done.returncode else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    every = headers()
    home = types(every)
    failures = [line for path in every for line in (*missing(path), *missing_types(path, home))]
    compiler, flags = commands(options.build)
    compiler = [compiler, "-std=c++20"] + (["-msse4.2"] if os.uname().machine == "x86_64" else [])
    with tempfile.TemporaryDirectory() as folder:
        before = ""
        if not options.all:
            before = folder + "/standard.h"
            names = sorted({name for words in NAMES.values() for name in words.split()} | {"cstddef", "cstdint"})
            pathlib.Path(before).write_text("".join(f"#include <{name}>\n" for name in names))
            subprocess.run([*compiler, "-x", "c++-header", before, "-o", before + ".gch"], check=True)
        alone = every if options.all else to_compile(every)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            failures += filter(None, pool.map(lambda path: compile_alone(compiler, flags, before, path), alone))
    print("\n".join(failures) or f"{len(every)} headers stand alone; {len(alone)} were compiled for it")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
