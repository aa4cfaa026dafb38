"""cmake --install, then find_package(airsim360) from a project of its own."""
import os
import pathlib
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent


def run(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        raise AssertionError(f"{command}:\n{done.stdout[-4000:]}")
    return done.stdout


class Install(unittest.TestCase):
    def test_a_project_finds_the_package_and_renders(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            run("cmake", "--install", os.environ["AIRSIM360_BUILD"], "--prefix", folder / "prefix", "--strip")
            run("cmake", "-S", HERE / "consumer", "-B", folder / "build", "-DCMAKE_BUILD_TYPE=Release",
                f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}")
            run("cmake", "--build", folder / "build")
            self.assertEqual(run(folder / "build/consumer").strip(), "5.00")
            self.assertIn("box_room", run(folder / "prefix/bin/airsim360", "worlds"))
            for file in ("man/man1/airsim360.1", "man/man1/airsim360-world-export.1", "bash-completion/completions/airsim360",
                         "zsh/vendor-completions/_airsim360", "fish/vendor_completions.d/airsim360.fish"):
                self.assertGreater((folder / "prefix/share" / file).stat().st_size, 500, file)
            # Headers and libraries alone: nothing of the prefix names the source tree.
            for file in (folder / "prefix/lib/cmake/airsim360").glob("*.cmake"):
                self.assertNotIn(str(HERE.parents[1]) + "/", file.read_text(), file.name)


if __name__ == "__main__":
    unittest.main()
