"""Every name that the public headers give stands in public_headers.txt: none comes, goes or moves by accident. A header is public
if another module includes it. After a change that is meant: public_headers_test.py --write."""
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = pathlib.Path(__file__).with_name("public_headers.txt")
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools"))
from check_layers import public_headers  # noqa: E402

KINDS = "cdefgmnpstuvx"  # classes, macros, enumerators, functions, enums, members, …; no locals


def of_headers(headers, root):
    """Lines 'HEADER SCOPE::NAME' of what the headers declare outside of namespace internal and of private parts."""
    tags = subprocess.run(["ctags", "-f", "-", "--sort=no", "--output-format=json", "--language-force=C++", f"--kinds-C++={KINDS}",
                           "--fields=+aKsS", *map(str, headers)], cwd=root, capture_output=True, text=True, check=True)
    lines = set()
    for tag in map(json.loads, tags.stdout.splitlines()):
        scope = tag.get("scope", "")
        hidden = tag.get("access") in ("private", "protected") or "internal" in scope.split("::") or "__anon" in scope + tag["name"]
        if not hidden and tag["kind"] != "namespace":
            lines.add(f"{tag['path']} {scope + '::' if scope else ''}{tag['name']}")
    return sorted(lines)


def public_names():
    source = ROOT / "src/airsim360"
    product = [p for p in source.rglob("*") if p.suffix in (".h", ".cc") and not p.stem.endswith(("_test", "_fuzz", "_bench"))]
    return of_headers(sorted(h.relative_to(ROOT / "src") for h in public_headers(source, product)), ROOT / "src")


@unittest.skipIf(shutil.which("ctags") is None, "ctags is not installed: apt-get install universal-ctags")
class PublicHeadersTest(unittest.TestCase):
    def test_nothing_changed_that_is_not_listed(self):
        listed, now = LIST.read_text().splitlines(), public_names()
        gone, new = sorted(set(listed) - set(now)), sorted(set(now) - set(listed))
        self.assertEqual((gone, new), ([], []), "if that is meant: tests/install/public_headers_test.py --write, and CHANGELOG.md")
        self.assertEqual(listed, now)

    def test_it_sees_what_a_user_may_use_and_nothing_else(self):
        names = set(public_names())
        for name in ["scene/scene.h airsim360::Scene::entities", "render/renderer.h airsim360::MakeRequest",
                     "scene/scene.h airsim360::SceneBuilder::AddMesh", "base/error.h airsim360::InputError"]:
            self.assertTrue("airsim360/" + name in names, name)
        self.assertFalse([name for name in names if "internal" in name.split(" ")[1].split("::")])
        self.assertFalse([name for name in names if name.endswith("_") and "::" in name], "members of classes are private")


if __name__ == "__main__":
    if "--write" in sys.argv:
        LIST.write_text("\n".join(public_names()) + "\n")
    else:
        unittest.main()
