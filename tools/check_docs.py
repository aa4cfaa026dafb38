#!/usr/bin/env python3
"""Checks README.md, CONTRIBUTING.md, CHANGELOG.md and docs/**/*.md.

Usage: check_docs.py [ROOT] | check_docs.py --self-test. Prints one line per violation and exits 1 if there is any.
A page is at most 2,500 words, README.md at most 700 words and 15 numbers. Links, their anchors, and paths between backticks or in
blocks that begin with a folder of the repository exist; so do the sources that a page names by the end of their path. Every page is
in the nav of mkdocs.yml. With the program in $AIRSIM360 every `airsim360 …` command has that subcommand and those flags in its help.
"""
import functools
import itertools
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

PAGE_WORDS, README_WORDS, README_NUMBERS = 2500, 700, 15
SOURCES = (".h", ".cc", ".glsl", ".rgen", ".rchit", ".rmiss", ".rahit", ".cmake")
FENCE = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```$", re.M | re.S)
INLINE = re.compile(r"`([^`\n]+)`")


def plain(text):
    """The text without blocks and inline code."""
    return INLINE.sub("", FENCE.sub("", text))


def count_numbers(text):
    """Numbers that a reader sees: those of blocks, inline code, link targets and names do not count."""
    visible = re.sub(r"\]\([^)]*\)", "]", plain(text))
    return len(re.findall(r"(?<![\w.,])\d+(?:[.,]\d+)*", visible))


def slugs(text):
    """Anchors of the headings, as Python-Markdown makes them."""
    found = set()
    for heading in re.findall(r"^#{1,6} (.*)$", FENCE.sub("", text), re.M):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        words = re.sub(r"[^\w\s-]", "", heading.encode("ascii", "ignore").decode()).strip().lower()
        found.add(re.sub(r"[-\s]+", "-", words))
    return found


def check_size(name, text):
    words = len(text.split())
    most = README_WORDS if name == "README.md" else PAGE_WORDS
    errors = [f"{name}: {words} words, at most {most}"] if words > most else []
    if name == "README.md" and count_numbers(text) > README_NUMBERS:
        errors.append(f"{name}: {count_numbers(text)} numbers, at most {README_NUMBERS}")
    return errors


def check_links(root, page, text):
    errors = []
    for target, anchor in re.findall(r"\]\(([^)#\s]*)(?:#([^)]*))?\)", plain(text)):
        if re.match(r"\w+:", target):
            continue
        path = (page.parent / target) if target else page
        where = f"{page.relative_to(root)}: link {target}{'#' + anchor if anchor else ''}"
        if not path.exists():
            errors.append(f"{where}: no such file")
        elif anchor and path.suffix == ".md" and anchor not in slugs(path.read_text(encoding="utf-8")):
            errors.append(f"{where}: no such heading")
    return errors


def path_tokens(text):
    """Words between backticks and in blocks that may be paths."""
    codes = INLINE.findall(FENCE.sub("", text)) + [body for _, body in FENCE.findall(text)]
    for code in codes:
        for token in re.split(r"[\s=\"'(),;|]+", code):
            yield re.sub(r":\d+$", "", token.rstrip(".:…"))


def check_paths(root, name, text, files):
    """Tokens that begin with a folder of the repository, and sources by the end of their path."""
    folders = {file.split("/")[0] for file in files if "/" in file}
    modules = {file.split("/")[2] for file in files if file.startswith("src/airsim360/") and file.count("/") > 2}
    categories = root / "src/airsim360/scene/semantics.cc"
    named = set(re.findall(r'"([a-z_/]+)"', categories.read_text())) if categories.exists() else set()
    errors = []
    for token in sorted(set(path_tokens(text))):
        if token in named or re.fullmatch(r"[a-z]+/\d+", token):  # categories and entities
            continue
        if re.search(r"[<>{}$…\[\]]|NAME|snake_case", token) or token.startswith(("/", "-", "http")):
            continue
        if token.split("/")[0] in folders and "/" in token:
            if not any(root.glob(token.rstrip("/"))):
                errors.append(f"{name}: {token}: no such path")
        elif token.split("/")[0] in modules and re.fullmatch(r"[\w/*]+", token) and "/" in token:
            if not any(root.glob(f"src/airsim360/{token.rstrip('/')}")) and not any(root.glob(f"src/airsim360/{token}.*")):
                errors.append(f"{name}: {token}: no such folder or source below src/airsim360")
        elif token.endswith(SOURCES) and re.fullmatch(r"[\w./*]+", token) and not token.startswith("."):
            pattern = re.compile("(^|/)" + re.escape(token).replace(r"\*", "[^/]*") + "$")
            if not any(pattern.search(file) for file in files):
                errors.append(f"{name}: {token}: no source of this name")
    return errors


def check_nav(root, pages):
    """Every page of docs/ is in the nav, and the nav names no other."""
    nav = set(re.findall(r"^\s*- (?:[^:\n]*: )?['\"]?([\w./-]+\.md)['\"]?\s*$", (root / "mkdocs.yml").read_text(encoding="utf-8"), re.M))
    there = {page.relative_to(root / "docs").as_posix() for page in pages if root / "docs" in page.parents}
    return ([f"mkdocs.yml: docs/{page} is not in the nav" for page in sorted(there - nav)] +
            [f"mkdocs.yml: {page} of the nav does not exist" for page in sorted(nav - there)])


def commands(text):
    """Words of each `airsim360 …` command in sh blocks and inline code."""
    blocks = [body.replace("\\\n", " ") for language, body in FENCE.findall(text) if language == "sh"]
    inline = [code.replace("\\|", "|") for code in INLINE.findall(FENCE.sub("", text)) if code.startswith("airsim360 ")]
    for line in [line for block in blocks for line in block.splitlines()] + inline:
        try:
            words = shlex.split(line, comments=True)
        except ValueError:
            words = line.split()
        for i, word in enumerate(words):
            if word in ("airsim360", "build/bin/airsim360") and (i == 0 or words[i - 1].endswith((";", "|", "&&")) or "=" in words[i - 1]):
                end = next((j for j in range(i + 1, len(words)) if words[j] in ("|", "&&", ";", "&", ">")), len(words))
                yield words[i + 1:end]
                break


@functools.lru_cache(maxsize=None)
def help_of(program, command):
    """Help of a command as text, "" where there is none."""
    done = subprocess.run([program, *command, "--help"], capture_output=True, text=True, timeout=60, check=False)
    return done.stdout + done.stderr if done.returncode == 0 else ""


def check_command(ask, words):
    """What is wrong with a command; `ask` gives the help of a tuple of words."""
    if not words or not re.fullmatch(r"[a-z]+", words[0]):
        return []
    command = (words[0],)
    if not ask(command):
        return [f"no command {words[0]}"]
    if words[0] in ("world", "eval", "environments", "dataset", "mpde", "vln", "people", "language") and len(words) > 1 and re.fullmatch(r"[a-z]+", words[1]):
        command = (words[0], words[1])
        if not ask(command):
            return [f"no command {words[0]} {words[1]}"]
    if words[0] == "learn":  # `learn frames`, `learn segment train`
        command = tuple(itertools.takewhile(lambda word: re.fullmatch(r"[a-z]+", word), words[:2 if words[1:2] == ["frames"] else 3]))
        if not ask(command):
            return [f"no command {' '.join(command)}"]
    flags = re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", " ".join(words[1:]))
    return [f"{' '.join(command)} has no flag {flag}" for flag in flags
            if not re.search(rf"(?<![\w-]){flag}(?![\w-])", ask(command))]


def files_of(root):
    """Files of the repository, relative to its root."""
    done = subprocess.run(["git", "-C", str(root), "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True, check=False)
    if done.returncode == 0 and done.stdout:
        return done.stdout.splitlines()
    return [path.relative_to(root).as_posix() for path in root.rglob("*") if path.is_file()]


def check(root, program=None):
    pages = [root / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md") if (root / name).exists()]
    pages += sorted((root / "docs").rglob("*.md"))
    files, errors = files_of(root), check_nav(root, pages)
    for page in pages:
        name, text = page.relative_to(root).as_posix(), page.read_text(encoding="utf-8")
        errors += check_size(name, text) + check_links(root, page, text) + check_paths(root, name, text, files)
        if program:
            for words in commands(text):
                errors += [f"{name}: airsim360 {' '.join(words)}: {wrong}" for wrong in check_command(functools.partial(help_of, program), words)]
    return errors


def self_test():
    """Every rule finds what it is for, and nothing else."""
    helps = {("render",): "--world --out", ("world",): "export", ("world", "export"): "--out"}
    ask = lambda command: helps.get(command, "")
    assert check_command(ask, ["render", "--world", "w", "--out=x"]) == []
    assert check_command(ask, ["render", "--size", "1x1"]) == ["render has no flag --size"]
    assert check_command(ask, ["paint"]) == ["no command paint"]
    assert check_command(ask, ["world", "export", "w", "--out", "x"]) == []
    assert check_command(ask, ["world", "burn"]) == ["no command world burn"]
    page = "```sh\nA=1 airsim360 render --out x   # --size\nls | head\n```\nand `airsim360 worlds [--json]`\n"
    assert list(commands(page)) == [["render", "--out", "x"], ["worlds", "[--json]"]], list(commands(page))
    assert count_numbers("AirSim360 takes 1.5 s of 2,048 `3` [4](5.md)\n```\n6\n```\n") == 3
    assert slugs("# The `fly` command\n## A, b: c\n") == {"the-fly-command", "a-b-c"}
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "docs/guide").mkdir(parents=True)
        (root / "src").mkdir()
        (root / "src/a.cc").write_text("")
        (root / "mkdocs.yml").write_text("nav:\n  - Home: index.md\n  - gone.md\n")
        (root / "README.md").write_text("1 " * 16)
        (root / "docs/index.md").write_text("`src/a.cc` `src/b.cc` `b.cc` `a.cc` [x](guide/y.md#z) [n](no.md) `src/<x>`\n")
        (root / "docs/guide/y.md").write_text("word " * 2501)
        found = check(root)
    assert sorted(found) == sorted([
        "mkdocs.yml: docs/guide/y.md is not in the nav", "mkdocs.yml: gone.md of the nav does not exist",
        "README.md: 16 numbers, at most 15", "docs/guide/y.md: 2501 words, at most 2500",
        "docs/index.md: src/b.cc: no such path", "docs/index.md: b.cc: no source of this name",
        "docs/index.md: link guide/y.md#z: no such heading", "docs/index.md: link no.md: no such file"]), found


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        print("check_docs: every rule finds what it is for")
        return 0
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    errors = check(root, os.environ.get("AIRSIM360"))
    print("\n".join(errors) if errors else "docs: sizes, links, paths, nav" + (" and commands" if "AIRSIM360" in os.environ else "") + " hold")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
