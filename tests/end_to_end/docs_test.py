"""The blocks of README.md and docs/**/*.md do what they say: each page's ```sh and ```python blocks are pasted into a shell, in order.

A page has a folder of its own with links to what a clone holds (build, data, examples, tools, docs), PATH has build/bin. Blocks
marked ```sh slow or ```python slow run with AIRSIM360_SLOW_DOCS=1 alone. A command that ends with & is a server: it is waited for.

    docs_test.py                 # all pages
    docs_test.py 2/5             # every fifth page from the third on; what is asked of all pages goes with 0/5
    docs_test.py guide/maps.md   # pages whose path ends so
"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ["AIRSIM360"]).resolve()
BUILD = PROGRAM.parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
SLOW = os.environ.get("AIRSIM360_SLOW_DOCS") == "1"
OWN_CACHE = tempfile.TemporaryDirectory()
CACHE = os.environ.get("AIRSIM360_CACHE") or OWN_CACHE.name  # worlds are built once for all pages
COMMANDS = r"(airsim360|build/bin/airsim360|curl|PYTHONPATH=|python3|/usr/bin/python3|cmake|export|import airsim360)\b"


def name_of(page):
    """Path of a page in the repository."""
    return page.relative_to(ROOT).as_posix()


def blocks(page):
    """(language, slow, line, text) of the fenced blocks of a page."""
    text = page.read_text(encoding="utf-8")
    for found in re.finditer(r"^```(\w*)( slow)?\n(.*?)^```$", text, re.M | re.S):
        yield found[1], bool(found[2]), text[:found.start()].count("\n") + 1, found[3]


def script_of(page):
    """All blocks of a page as one script that stops at the first failure and says at which line of the page it began."""
    parts = ["set -euo pipefail", "trap 'kill $(jobs -p) 2>/dev/null || true' EXIT"]
    for language, slow, line, text in blocks(page):
        if slow and not SLOW:
            continue
        if language == "python":
            text = f"/usr/bin/python3 - <<'END_OF_BLOCK'\n{text}END_OF_BLOCK\n"
        elif language != "sh":
            continue
        # A server is ready when it says that it listens.
        text = re.sub(r"^(airsim360 (?:serve|agent)\b[^\n]*?) *&$",
                      r"\1 > server.log 2>&1 &\nfor i in $(seq 1500); do grep -q listening server.log && break; sleep 0.2; done",
                      text, flags=re.M)
        parts.append(f"echo \"[$SECONDS s] {name_of(page)}:{line}\" >&2\n{text}")
    return "\n".join([*parts, 'echo "[$SECONDS s] end" >&2'])


def slow_blocks(said):
    """(seconds, page:line) of the blocks that took ten seconds or more, by what the script of a page said."""
    begun = [(int(at), where) for at, where in re.findall(r"^\[(\d+) s\] (.*)$", said, re.M)]
    return [(end - start, where) for (start, where), (end, _) in zip(begun, begun[1:]) if end - start >= 10]


class Docs(unittest.TestCase):
    maxDiff = None

    def test_no_command_hides_outside_of_a_fence(self):
        for page in PAGES:
            plain = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
            self.assertEqual(re.findall(rf"^    {COMMANDS}.*", plain, re.M), [], name_of(page))

    def test_readme_is_short(self):
        words = len((ROOT / "README.md").read_text(encoding="utf-8").split())
        self.assertLessEqual(words, 700)

    def test_every_link_leads_to_a_file(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
                self.assertTrue((page.parent / target).exists(), f"{name_of(page)}: {target}")


def run_page(page):
    def test(self):
        script = script_of(page)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("data", "docs", "examples", "tools", "README.md"):
                os.symlink(ROOT / name, os.path.join(folder, name))
            os.symlink(BUILD, os.path.join(folder, "build"))
            environment = {"PATH": f"{BUILD / 'bin'}:/usr/bin:/bin", "HOME": folder, "PYTHONPATH": str(BUILD / "python"),
                           "PYTHONDONTWRITEBYTECODE": "1", "LANG": "C.UTF-8", "AIRSIM360": str(PROGRAM),
                           "AIRSIM360_CACHE": CACHE}
            environment |= {name: os.environ[name] for name in ("AIRSIM360_CACHE_PROGRAM",) if name in os.environ}
            done = subprocess.run(["bash", "-c", script], cwd=folder, env=environment, capture_output=True, text=True, timeout=1500)
            self.assertEqual(done.returncode, 0, f"{name_of(page)}\n{done.stdout[-2000:]}\n{done.stderr[-3000:]}")
            for seconds, where in slow_blocks(done.stderr):
                print(f"{seconds} s: {where}", flush=True)
    return test


def chosen(pages, what):
    """Those of some pages that are asked for: a share I/N, or ends of paths; none at all is an error."""
    if len(what) == 1 and (share := re.fullmatch(r"(\d+)/(\d+)", what[0])):
        return pages[int(share[1])::int(share[2])]
    found = [page for page in pages if not what or name_of(page).endswith(tuple(what))]
    if not found:
        sys.exit(f"docs_test.py: no page of the docs with blocks ends with {' or '.join(what)}")
    return found


if __name__ == "__main__":
    _what = sys.argv[1:]
    if _what and not _what[0].startswith("0/"):
        for _name in [name for name in vars(Docs) if name.startswith("test_")]:
            delattr(Docs, _name)
    for _page in chosen([page for page in PAGES if any(language in ("sh", "python") for language, *_ in blocks(page))], _what):
        _name = re.sub(r"\W", "_", name_of(_page).removesuffix(".md").removeprefix("docs/").lower())
        setattr(Docs, f"test_blocks_of_{_name}", run_page(_page))
    unittest.main(argv=sys.argv[:1])
