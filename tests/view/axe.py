"""axe-core, pinned with its hash in axe/package-lock.json: what it finds in a page."""
import functools
import pathlib
import shutil
import subprocess

from viewer import PROGRAM

SERIOUS = {"serious", "critical"}


@functools.cache
def source():
    """The script; None where npm cannot get it."""
    folder = pathlib.Path(PROGRAM).resolve().parents[1] / "npm_axe"
    script = folder / "node_modules/axe-core/axe.min.js"
    pins = pathlib.Path(__file__).parent / "axe"
    if not script.exists() or (folder / "package-lock.json").read_bytes() != (pins / "package-lock.json").read_bytes():
        folder.mkdir(parents=True, exist_ok=True)
        for name in ["package.json", "package-lock.json"]:
            shutil.copy(pins / name, folder / name)
        try:
            done = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=folder, capture_output=True, timeout=240)
        except (OSError, subprocess.TimeoutExpired):
            return None
        if done.returncode != 0:
            return None
    return script.read_text()


def findings(page):
    """[(rule, impact, html)] of everything that is serious; of WCAG 2.2 A and AA, and good practice."""
    if not page.run("Boolean(window.axe)"):
        page.run(source())
    found = page.run("axe.run(document, {resultTypes: ['violations']}).then(r => r.violations.map(v => [v.id, v.impact, v.nodes.map(n => n.html.slice(0, 200) + ' ' + (n.any[0]?.message ?? ''))]))")
    return [tuple(f) for f in found if f[1] in SERIOUS]
