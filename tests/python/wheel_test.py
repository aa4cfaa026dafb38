"""The wheel, installed offline into a virtual environment of its own, imports and renders."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

SCRIPT = """
import airsim360, sys
assert airsim360.__file__.startswith(sys.prefix), airsim360.__file__
c = airsim360.World("box_room").capture([0, 0, 3], airsim360.Rig(width=128))
assert c.rgb.shape == (64, 128, 3) and c.rgb.any() and abs(c.range[32, 64] - 5) < 0.01, c.range[32, 64]
import airsim360.airsim, airsim360.gym
print(len(airsim360.World("box_room").entities))
"""


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **options)
    if done.returncode:
        raise AssertionError(f"{command}:\n{done.stdout}{done.stderr}")
    return done.stdout


def scikit_build_core():
    code = "import scikit_build_core; print(scikit_build_core.__version__)"
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip()


@unittest.skipUnless(scikit_build_core(), "tools/install_backport.sh python3-scikit-build-core")
class Wheel(unittest.TestCase):
    def test_a_clean_environment_imports_the_wheel(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            wheel = folder / pathlib.Path(run(sys.executable, ROOT / "python/build_backend.py", folder).split()[-1]).name
            names = zipfile.ZipFile(wheel).namelist()
            written = zipfile.ZipFile(wheel).read("airsim360-0.1.0.dist-info/WHEEL").decode()
            self.assertIn(f"Generator: scikit-build-core {scikit_build_core()}", written)
            self.assertTrue(any(name.endswith("/RECORD") for name in names))
            self.assertFalse([name for name in names if "__pycache__" in name])
            # NumPy comes from the system; everything of ours from the wheel.
            run(sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", folder / "venv")
            python = folder / "venv/bin/python"
            site = run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip()
            has_pip = subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True).returncode == 0
            if has_pip:
                run(sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--target", site, wheel)
            else:
                zipfile.ZipFile(wheel).extractall(site)
            environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
            self.assertEqual(run(python, "-c", SCRIPT, env=environment, cwd=folder).strip(), "7")


if __name__ == "__main__":
    unittest.main()
