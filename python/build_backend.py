"""Builds the wheel: CMake makes the compiled module, this packs it. A PEP 517 backend without dependencies.

The module holds our own libraries; Embree, TBB, OpenEXR and the like stay Debian's shared libraries, which is why the
wheel's platform is linux_x86_64 and not manylinux. The build folder is $AIRSIM360_BUILD, or `build`, where what is
built already is used. `python3 build_backend.py DIR` writes the wheel to DIR.
"""
import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
_PACKAGES = ("airsim360", "msgpackrpc")
_DATE = (1980, 1, 1, 0, 0, 0)  # of every file: the same sources give the same wheel


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / f"{_name()}.dist-info"
    folder.mkdir(parents=True)
    (folder / "METADATA").write_text(_metadata())
    (folder / "WHEEL").write_text(_wheel())
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    module = _compile(config_settings or {})
    files = dict(_sources())
    files[f"airsim360/{module.name}"] = _stripped(module)
    info = f"{_name()}.dist-info"
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = _wheel().encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = "".join(f"{name},sha256={_digest(data)},{len(data)}\n" for name, data in sorted(files.items()))
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()

    # Under a temporary name first: nothing is ever half-written.
    directory = pathlib.Path(wheel_directory)
    directory.mkdir(parents=True, exist_ok=True)
    wheel = directory / f"{_name()}-{_tag()}.whl"
    temporary = wheel.with_suffix(".tmp")
    with zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in sorted(files.items()):
            entry = zipfile.ZipInfo(name, _DATE)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(entry, data)
    os.replace(temporary, wheel)
    return wheel.name


def build_sdist(sdist_directory, config_settings=None):
    name = _name()
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    path = pathlib.Path(sdist_directory) / f"{name}.tar.gz"
    with tarfile.open(path, "w:gz") as archive:
        for file in listed.splitlines():
            archive.add(ROOT / file, f"{name}/{file}", recursive=False)
    return path.name


def _project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def _name():
    project = _project()
    return f"{project['name']}-{project['version']}"


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _metadata():
    project = _project()
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {project['version']}",
             f"Summary: {project['description']}", "License: Apache-2.0",
             f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {needed}" for needed in project["dependencies"]]
    for extra, needs in project["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f"Requires-Dist: {needed}; extra == '{extra}'" for needed in needs]
    return "\n".join(lines) + "\n"


def _wheel():
    return f"Wheel-Version: 1.0\nGenerator: airsim360\nRoot-Is-Purelib: false\nTag: {_tag()}\n"


def _digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def _sources():
    for package in _PACKAGES:
        for path in sorted((ROOT / "python" / package).rglob("*")):
            if path.suffix in (".py", ".pyi") or path.name == "py.typed":
                yield path.relative_to(ROOT / "python").as_posix(), path.read_bytes()


def _compile(settings):
    """The compiled module for the Python that runs this."""
    build = pathlib.Path(settings.get("build-dir") or os.environ.get("AIRSIM360_BUILD") or ROOT / "build").resolve()
    if not (build / "build.ninja").exists():
        python = getattr(sys, "_base_executable", None) or sys.executable
        _run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             f"-DPYTHON_EXECUTABLE={python}")
    jobs = os.environ.get("JOBS") or str(os.cpu_count())
    _run("cmake", "--build", build, "-j", jobs, "--target", "airsim360_native")
    module = build / "python/airsim360" / f"_native{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not module.exists():
        raise SystemExit(f"{build} was configured for another Python; set AIRSIM360_BUILD to a new folder")
    return module


def _stripped(module):
    copy = module.with_suffix(".stripped")
    _run("strip", "--strip-unneeded", "-o", copy, module)
    data = copy.read_bytes()
    copy.unlink()
    return data


def _run(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}\n{done.stdout}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: build_backend.py DIRECTORY")
    print(pathlib.Path(sys.argv[1]) / build_wheel(sys.argv[1]))
